"""Numbers of the data that are not rational: balls of Arb that hold the values of expressions."""
import ast
import operator
import re

from flint import arb, fmpq

from quantities import Unreadable, decimal

LONGEST = 2000  # characters of an expression
MOST_BITS = 8000  # of a rational number: those of a decimal of 900 digits behind the point and the largest exponent
UNITS = {"deg": arb.pi() / 180, "rad": fmpq(1), "m": fmpq(1), "cm": fmpq(1, 100), "mm": fmpq(1, 1000)}
UNIT = re.compile(rf"(?<=[\d)i])\s*({'|'.join(UNITS)})\b")
SIGNS = {ast.Add: operator.add, ast.Sub: operator.sub, ast.Mult: operator.mul, ast.Div: operator.truediv,
         ast.UAdd: operator.pos, ast.USub: operator.neg}
FUNCTIONS = {"sqrt": arb.sqrt, "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "acos": arb.acos, "asin": arb.asin,
             "atan": arb.atan, "atan2": arb.atan2}


def expression(text, unit=fmpq(1)):
    """The value of an expression in metres or radians, exact where it is made of rational numbers; `unit` is that of a number
    without one."""
    try:
        # A unit binds less tightly than a sum, as `|` does.
        written = UNIT.sub(r" | \1", text[:LONGEST + 1].strip())
        tree = ast.parse(written, mode="eval").body if len(written) <= LONGEST and written.isascii() else None
        value = value_of(tree, written)
        if not arb(value).is_finite() or isinstance(value, fmpq) and value.height_bits() > MOST_BITS:
            raise ValueError
    except (ArithmeticError, MemoryError, RecursionError, SyntaxError, TypeError, ValueError):
        raise Unreadable(f"found {str(text)[:40]!r}, expected a number as text") from None
    return value if isinstance(tree, ast.BinOp) and isinstance(tree.op, ast.BitOr) else value * unit


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
