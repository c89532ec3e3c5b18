"""Numbers and tables of a certificate. Rational numbers are exact (fmpq), all others balls of Arb; both add and multiply."""
import ast
import operator
import re

from flint import arb, ctx, fmpq

ctx.prec = 384  # bits: more than the 250 of a pose by a quaternion of four integers of 60 bits
DECIMAL = re.compile(r"([+-]?\d{1,900})(?:\.(\d{1,900}))?(?:[eE]([+-]\d{1,3}|\d{1,4}))?", re.ASCII)
LARGEST, LARGEST_OF_DATA = 400, 999  # digits before and behind the point, and exponent
EXPRESSION = re.compile(r"[-+*/(),. \w]{1,2000}", re.ASCII)  # on one line, without remarks: the places of its numbers are those in it
MOST_BITS = 8000  # of a rational number: those of a decimal of 900 digits behind the point and the largest exponent
SIGNS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
         ast.UAdd: operator.pos, ast.USub: operator.neg}
FUNCTIONS = ("sqrt", "cos", "sin", "tan", "acos", "asin", "atan", "atan2")


class Unreadable(Exception):
    """The certificate cannot be read: exit code 1."""


class Refused(Exception):
    """An item does not hold: exit code 2."""


def require(holds, refusal):
    if not holds:
        raise Refused(refusal)


def expect(is_so, found, expected):
    if not is_so:
        raise Unreadable(f"found {str(found)[:40]!r}, expected {expected}")


def decimal(text, most=LARGEST):
    """The rational number that a decimal is."""
    match = DECIMAL.fullmatch(text) if isinstance(text, str) else None
    expect(match and max(len(match[1].lstrip("+-")), len(match[2] or ""), abs(int(match[3] or 0))) <= most, text, "a decimal number as text")
    whole, tail, power = match.groups(default="")
    return fmpq(int(whole + tail)) * fmpq(10) ** (int(power or 0) - len(tail))


def number(text):
    """The value of an expression, exact where it is made of rational numbers."""
    expect(isinstance(text, str) and EXPRESSION.fullmatch(text), text, "a number as text")
    value = value_of(ast.parse(text.strip(), mode="eval").body, text.strip())
    is_short = not isinstance(value, fmpq) or value.height_bits() <= MOST_BITS
    expect(is_short and arb(value).is_finite(), text, "a number as text")
    return value


def value_of(node, text):
    match node:
        case ast.Constant():
            return decimal(text[node.col_offset:node.end_col_offset], LARGEST_OF_DATA)
        case ast.Name("pi"):
            return arb.pi()
        case ast.BinOp(left, sign, right):
            return SIGNS[type(sign)](value_of(left, text), value_of(right, text))
        case ast.UnaryOp(sign, operand):
            return SIGNS[type(sign)](value_of(operand, text))
        case ast.Call(ast.Name(name), arguments, []) if name in FUNCTIONS:
            return getattr(arb, name)(*(arb(value_of(argument, text)) for argument in arguments))
    raise Unreadable(f"found {text[:40]!r}, expected a number as text")


def by_half_tangent(t):
    """Cosine and sine."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def is_exact(numbers):
    return all(isinstance(x, (int, fmpq)) for x in numbers)


def fields(table, needed, optional=()):
    """The values of a table that has these keys and no others."""
    expect(isinstance(table, dict) and set(needed) <= set(table) <= {*needed, *optional}, table, f"a table with the keys {list(needed)}")
    return [table.get(key) for key in (*needed, *optional)]


def items(value, count=None):
    """A list of this length, or of any length up to 1000."""
    expect(isinstance(value, list) and len(value) <= 1000 and count in (None, len(value)), value, f"a list of {count or 'items'}")
    return value


def whole(value):
    expect(type(value) is int and 0 <= value < 10**6, value, "a whole number")
    return value
