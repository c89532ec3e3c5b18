"""Says how to get what the checker needs beside Python."""
import sys
import warnings

warnings.simplefilter("ignore")  # of Python, about texts that are no numbers: one line says what was found
try:
    import flint  # exact numbers, polynomials, and balls of Arb
except ModuleNotFoundError:
    sys.exit("error: found no module flint, expected python-flint: python3 -m pip install python-flint")
