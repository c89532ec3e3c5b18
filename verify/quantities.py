"""Numbers and tables of a certificate. Rational numbers are exact (fmpq), all others balls of Arb; both add and multiply."""
import ast
import operator
import re

from flint import arb, ctx, fmpq

ctx.prec = 384  # bits: more than the 250 of a pose by a quaternion of four integers of 60 bits
LONGEST = 2000  # characters of a number
MOST_BITS = 8000  # of a rational number: those of a decimal of 900 digits behind the point and the largest exponent


class Unreadable(Exception):
    """The certificate cannot be read: exit code 1."""


class Refused(Exception):
    """An item does not hold: exit code 2."""


class Whole(str):
    """The digits of a whole number that JSON writes without quotes."""


DECIMAL = re.compile(r"([+-]?)(\d{1,900})(?:\.(\d{1,900}))?(?:[eE]([+-]?\d{1,3}))?\Z")
HALF_TANGENT = re.compile(r"(-?)2\*atan\(([\d./]+)\)\Z")
RIGHT_ANGLES = {"0": (1, 0), "pi/2": (0, 1), "pi": (-1, 0), "-pi/2": (0, -1), "-pi": (-1, 0)}
UNITS = {"deg": arb.pi() / 180, "rad": fmpq(1), "m": fmpq(1), "cm": fmpq(1, 100), "mm": fmpq(1, 1000)}
UNIT = re.compile(rf"(?<=[\d)i])\s*({'|'.join(UNITS)})\b")
SIGNS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
         ast.UAdd: operator.pos, ast.USub: operator.neg}
FUNCTIONS = {"sqrt": arb.sqrt, "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "acos": arb.acos, "asin": arb.asin,
             "atan": arb.atan, "atan2": arb.atan2}


def decimal(text):
    """The rational number that a decimal is."""
    match = DECIMAL.match(text) if isinstance(text, str) and not isinstance(text, Whole) else None
    if not match:
        raise Unreadable(f"found {str(text)[:40]!r}, expected a decimal number")
    sign, whole, tail, power = match.groups(default="")
    power = int(power or 0) - len(tail)
    if abs(power) > 1300:
        raise Unreadable(f"found {text[:40]!r}, expected a smaller exponent")
    size = fmpq(int(whole + tail)) * fmpq(10) ** max(power, 0) / fmpq(10) ** max(-power, 0)
    return -size if sign == "-" else size


def expression(text):
    """The value of an expression, and whether it has a unit, of which it is the number of metres or radians."""
    if isinstance(text, str) and DECIMAL.match(text):
        return decimal(text), False
    text = str(text)
    try:
        # A unit binds less tightly than a sum, as `|` does.
        written = UNIT.sub(r" | \1", text[:LONGEST + 1].strip())
        tree = ast.parse(written, mode="eval").body if len(written) <= LONGEST and written.isascii() else None
        value = value_of(tree, written)
        if not arb(value).is_finite() or isinstance(value, fmpq) and value.height_bits() > MOST_BITS:
            raise ValueError
    except (ArithmeticError, MemoryError, RecursionError, SyntaxError, TypeError, ValueError):
        raise Unreadable(f"found {text[:40]!r}, expected a number") from None
    return value, isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.BitOr)


def value_of(node, text):
    match node:
        case ast.Constant():
            return decimal(text[node.col_offset:node.end_col_offset])
        case ast.Name(id="pi"):
            return arb.pi()
        case ast.BinOp(left=left, op=ast.BitOr(), right=ast.Name(id=unit)) if unit in UNITS:
            return value_of(left, text) * UNITS[unit]
        case ast.BinOp(left=left, op=sign, right=right) if type(sign) in SIGNS:
            return SIGNS[type(sign)](value_of(left, text), value_of(right, text))
        case ast.UnaryOp(op=sign, operand=operand) if type(sign) in SIGNS:
            return SIGNS[type(sign)](value_of(operand, text))
        case ast.Call(func=ast.Name(id=name), args=arguments, keywords=[]) if name in FUNCTIONS:
            return FUNCTIONS[name](*(arb(value_of(argument, text)) for argument in arguments))
    raise ValueError


def by_half_tangent(t):
    """Cosine and sine."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


def angle(text, unit=UNITS["rad"]):
    """Cosine and sine of an angle, exact for right angles and for those written by the tangent of their half."""
    if text in RIGHT_ANGLES:
        return tuple(map(fmpq, RIGHT_ANGLES[text]))
    if match := HALF_TANGENT.match(str(text)):
        cos, sin = by_half_tangent(expression(match.group(2))[0])
        return cos, -sin if match.group(1) else sin
    value, has_unit = expression(text)
    radians = arb(value if has_unit else value * unit)
    return radians.cos(), radians.sin()


def is_exact(numbers):
    return all(isinstance(x, (int, fmpq)) for x in numbers)


def fields(table, needed, optional=()):
    """The values of a table that has these keys and no others."""
    if not isinstance(table, dict) or not set(needed) <= set(table) <= set(needed) | set(optional):
        found = sorted(map(str, table))[:9] if isinstance(table, dict) else str(table)[:40]
        raise Unreadable(f"found {found}, expected the keys {list(needed)}")
    return [table.get(key) for key in (*needed, *optional)]


def items(value, count=None):
    """A list of this length, or of any length up to 1000."""
    if not isinstance(value, list) or len(value) > 1000 or count not in (None, len(value)):
        raise Unreadable(f"found {str(value)[:40]!r}, expected a list" + (f" of {count}" if count is not None else ""))
    return value


def whole(value):
    if not isinstance(value, Whole) or len(value) > 6 or not value.isdigit():
        raise Unreadable(f"found {str(value)[:40]!r}, expected a whole number")
    return int(value)
