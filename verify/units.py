"""Expressions of mechanism files (equations/README.md) in metres and radians, in the form of certificates."""
import ast
import re

from flint import fmpq

from exact import part_of_pi, rational
from quantities import EXPRESSION, LARGEST_OF_DATA, decimal, expect

UNITS = {"deg": "pi/180", "rad": "1", "m": "1", "cm": "1/100", "mm": "1/1000"}
PIECES = re.compile(r"([(),]|(?<![a-z])(?:deg|rad|mm|cm|m)\b)")
# Digits may be separated by underscores; Python and the decimals of certificates want no zeros in front, and a digit before a point.
DIGITS = [(re.compile(r"(?<=\d)_(?=\d)"), ""), (re.compile(r"(?<![\d.])0+(?=\d)"), ""), (re.compile(r"(?<!\d)(?=\.\d)"), "0"), (re.compile(r"(?<=\d)\.(?!\d)"), "")]
FUNCTIONS = {"sqrt": 1, "cos": 1, "sin": 1, "tan": 1, "acos": 1, "asin": 1, "atan": 1, "atan2": 2}  # with their numbers of arguments


def in_units(text, unit):
    """An expression in metres and radians; `unit` is that of an expression without one. A unit binds less tightly than a sum."""
    for pattern, digits in DIGITS:
        text = pattern.sub(digits, text)
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


def number_text(text, unit="m"):
    """A number as certificates write it: a rational one as such, another one as its expression."""
    plain = in_units(text, unit)
    own = evaluated(plain).rational
    return plain if own is None else str(own)


def angle_text(text, unit="rad"):
    """An angle: by the tangent of its half if that is rational, another one as its expression."""
    plain = in_units(text, unit)
    half = evaluated(plain).half_tangent()
    return plain if half is None else "pi" if half == "inf" else by_half_tangent(str(half))


def by_half_tangent(text):
    """The angle with the tangent of its half, a number as certificates write it."""
    return f"-2*atan({text[1:]})" if re.fullmatch(r"-[\d/]+", text) else f"2*atan({text})"


def evaluated(text):
    """The value of an expression without units."""
    expect(EXPRESSION.fullmatch(text), text, "an expression")
    return value_of(ast.parse(text, mode="eval").body, text)


def value_of(node, text):
    match node:
        case ast.Constant():
            return rational(decimal(text[node.col_offset:node.end_col_offset], LARGEST_OF_DATA))
        case ast.Name("pi"):
            return part_of_pi(fmpq(1))
        case ast.BinOp(left, sign, right):
            one, other = value_of(left, text), value_of(right, text)
            other = other.times(rational(fmpq(-1))) if isinstance(sign, ast.Sub) else other
            return {ast.Add: one.plus, ast.Sub: one.plus, ast.Mult: one.times, ast.Div: one.over}[type(sign)](other)
        case ast.UnaryOp(sign, operand):
            return value_of(operand, text).times(rational(fmpq({ast.UAdd: 1, ast.USub: -1}[type(sign)])))
        case ast.Call(ast.Name(name), arguments, []) if FUNCTIONS.get(name) == len(arguments):
            first, *others = (value_of(argument, text) for argument in arguments)
            return getattr(first, name)(*others)
    expect(False, text, "an expression")
