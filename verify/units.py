"""Numbers of mechanism files (equations/README.md) as expressions in metres and radians, in the form of certificates."""
import re

from flint import fmpq

from quantities import decimal, is_exact, number

UNITS = {"deg": "pi/180", "rad": "1", "m": "1", "cm": "1/100", "mm": "1/1000"}
PIECES = re.compile(r"([(),]|(?<![a-z])(?:deg|rad|mm|cm|m)\b)")
HALF_TANGENT = re.compile(r"(-?)2\s*\*\s*atan\(([^()]*)\)")
QUARTERS = re.compile(r"(?P<number>[+-]?\d{1,9}(?:\.\d{1,9})?)\s*(?P<deg>deg)?|(?P<sign>-?)(?:(?P<times>\d{1,9})\*)?pi(?:/(?P<part>[1-9]\d{0,8}))?", re.ASCII)


def in_units(text, unit):
    """An expression in metres and radians; `unit` is that of an expression without one. A unit binds less tightly than a sum."""
    pieces = PIECES.split(text)
    starts, plain = [0], ""  # where the sums that are open begin
    for piece in pieces if any(own in UNITS for own in pieces[-2:]) else [*pieces, unit]:
        if piece in UNITS:
            plain = plain if UNITS[piece] == "1" else f"{plain[:starts[-1]]}({plain[starts[-1]:]})*{UNITS[piece]}"
            continue
        plain += piece
        if piece == ")":
            starts.pop()
        elif piece in ("(", ","):
            starts[-1:] = [*starts[-1:], len(plain)] if piece == "(" else [len(plain)]
    return plain.strip()


def by_half_tangent(text):
    t = number(text)
    if not is_exact([t]):
        return f"2*atan({text})"
    return f"-2*atan({-t})" if t < 0 else f"2*atan({t})"


def right_angle(text, unit):
    """A multiple of a quarter turn written in degrees or as a fraction of pi; otherwise nothing."""
    match = QUARTERS.fullmatch(text)
    if not match or match["number"] and not match["deg"] and unit != "deg":
        return None
    of_pi = fmpq(2 * int(match["sign"] + (match["times"] or "1")), int(match["part"] or "1")) if not match["number"] else None
    quarters = decimal(match["number"]) / 90 if match["number"] else of_pi
    return ("0", "pi/2", "pi", "-pi/2")[int(quarters) % 4] if quarters.q == 1 else None
