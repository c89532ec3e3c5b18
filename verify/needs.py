"""Says how to get what the checker needs beside Python."""
import sys

try:
    import flint  # exact numbers, polynomials, and balls of Arb
except ModuleNotFoundError:
    sys.exit("error: found no module flint, expected python-flint: python3 -m pip install python-flint")
