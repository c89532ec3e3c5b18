"""Numbers of a certificate: decimals, fractions and expressions, enclosed in Arb balls and exact where they are rational."""
import re
from flint import acb, arb, ctx, fmpq, fmpz

ctx.prec = 384


class Unreadable(Exception):
    """The certificate cannot be read: exit code 1."""


class Refused(Exception):
    """An item does not hold: exit code 2."""


DECIMAL = re.compile(r"([+-]?)(\d{1,400})(?:\.(\d{1,400}))?(?:[eE]([+-]?\d{1,3}))?\Z")
FRACTION = re.compile(r"([+-]?)(\d{1,900})/(\d{1,900})\Z")
TOKEN = re.compile(r"\s*(?:(\d+(?:\.\d*)?(?:[eE][+-]?\d{1,3})?|\.\d+(?:[eE][+-]?\d{1,3})?)|([a-z]+[a-z0-9]*)|([-+*/(),]))")
HALF_TANGENT = re.compile(r"(-?)2\*atan\((\d{1,400}(?:\.\d{1,400})?|\d{1,900}/\d{1,900})\)\Z")
RIGHT_ANGLES = {"0": (1, 0), "pi/2": (0, 1), "pi": (-1, 0), "-pi/2": (0, -1), "-pi": (-1, 0)}
UNITS = {"deg": lambda x: x * arb.pi() / 180, "rad": lambda x: x, "m": lambda x: x, "cm": lambda x: x / 100, "mm": lambda x: x / 1000}


def text_of(value):
    if not isinstance(value, str) or len(value) > 2000:
        raise Unreadable(f"found {str(value)[:40]!r}, expected a number as text")
    return value


def whole(digits):
    return fmpz(int(digits))


def decimal(value):
    """The rational that a decimal is."""
    match = DECIMAL.match(text_of(value))
    if not match:
        raise Unreadable(f"found {value[:40]!r}, expected a decimal number")
    sign, head, tail, power = match.groups()
    tail, power = tail or "", int(power or 0) - len(tail or "")
    if abs(power) > 800:
        raise Unreadable(f"found {value[:40]!r}, expected an exponent of at most 400")
    size = fmpq(whole(head + tail)) * (fmpq(10) ** power if power >= 0 else fmpq(1) / fmpq(10) ** -power)
    return -size if sign == "-" else size


def rational(value):
    """The rational that a decimal or a fraction is; None for other expressions."""
    match = FRACTION.match(text_of(value))
    if match:
        sign, above, below = match.groups()
        if int(below) == 0:
            raise Unreadable(f"found {value[:40]!r}, a division by zero")
        return fmpq(whole(above), whole(below)) * (-1 if sign == "-" else 1)
    return decimal(value) if DECIMAL.match(value) else None


def number(value):
    """(ball, rational or None)"""
    exact = rational(value)
    return (arb(exact), exact) if exact is not None else (Expression(value).value(), None)


def angle(value):
    """((cos, sin) as balls, (cos, sin) as rationals or None)"""
    if text_of(value) in RIGHT_ANGLES:
        pair = tuple(map(fmpq, RIGHT_ANGLES[value]))
        return tuple(map(arb, pair)), pair
    match = HALF_TANGENT.match(value)
    if match:
        t = rational(match.group(2)) * (-1 if match.group(1) else 1)
        pair = ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))
        return tuple(map(arb, pair)), pair
    radians = Expression(value).value()
    return (radians.cos(), radians.sin()), None


class Expression:
    """sum [unit], with + - * / parentheses, pi, sqrt, and cos, sin, tan, acos, asin, atan, atan2 of radians or `deg`."""

    def __init__(self, text):
        self.text, self.tokens, at, self.depth = text_of(text), [], 0, 0
        while text[at:].strip():
            match = TOKEN.match(text, at)
            if not match or len(match.group(0)) > 450:
                self.fail()
            self.tokens.append(match.group(1) or match.group(2) or match.group(3))
            at = match.end()

    def fail(self):
        raise Unreadable(f"found {self.text[:40]!r}, expected a number")

    def value(self):
        value = self.quantity()
        if self.tokens or not value.is_finite():
            self.fail()
        return value

    def take(self, *symbols):
        return self.tokens.pop(0) if self.tokens and self.tokens[0] in symbols else None

    def quantity(self):
        value = self.sum()
        unit = self.take(*UNITS)
        return UNITS[unit](value) if unit else value

    def sum(self):
        self.depth += 1
        if self.depth > 40:
            self.fail()
        value = self.term()
        while (sign := self.take("+", "-")):
            value = value + self.term() if sign == "+" else value - self.term()
        self.depth -= 1
        return value

    def term(self):
        value = self.factor()
        while (sign := self.take("*", "/")):
            value = value * self.factor() if sign == "*" else value / self.factor()
        return value

    def factor(self):
        negative = False
        while (sign := self.take("+", "-")):
            negative ^= sign == "-"
        value = self.primary()
        return -value if negative else value

    def primary(self):
        if not self.tokens:
            self.fail()
        token = self.tokens.pop(0)
        if token[0].isdigit() or token[0] == ".":
            return arb(decimal("0" + token if token[0] == "." else token.rstrip(".") if token[-1] == "." else token))
        if token == "pi":
            return arb.pi()
        arguments = [self.quantity()] if token == "(" or self.take("(") else self.fail()
        while self.take(","):
            arguments.append(self.quantity())
        if not self.take(")"):
            self.fail()
        one = {"(": lambda x: x, "sqrt": arb.sqrt, "cos": arb.cos, "sin": arb.sin, "tan": arb.tan, "acos": arb.acos,
               "asin": arb.asin, "atan": arb.atan}
        if token in one and len(arguments) == 1:
            return one[token](arguments[0])
        if token == "atan2" and len(arguments) == 2:
            return arb.atan2(*arguments)
        self.fail()


def fields(value, needed, optional=()):
    """The values of a table that has these keys and no others."""
    if not isinstance(value, dict) or not set(needed) <= set(value) <= set(needed) | set(optional):
        found = sorted(map(str, value))[:9] if isinstance(value, dict) else str(value)[:40]
        raise Unreadable(f"found {found}, expected the keys {list(needed)}")
    return [value.get(key) for key in (*needed, *optional)]


def items(value, count=None):
    if not isinstance(value, list) or len(value) > 1000 or count is not None and len(value) != count:
        raise Unreadable(f"found {str(value)[:40]!r}, expected a list" + (f" of {count}" if count is not None else ""))
    return value


def count(value):
    """A whole number, which JSON writes without quotes."""
    if not isinstance(value, Whole) or len(value) > 6:
        raise Unreadable(f"found {str(value)[:40]!r}, expected a whole number")
    return int(value)


class Whole(str):
    """The digits of a whole number of JSON."""


def about(centre, radius):
    """The box of all numbers whose parts differ by at most `radius`, exactly or more, from those of the centre."""
    off = arb(0, radius)
    return acb(centre.real + off, centre.imag + off)
