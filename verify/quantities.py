"""Numbers and tables of a certificate. Rational numbers are exact (fmpq), all others balls of Arb; both add and multiply."""
import re

from flint import ctx, fmpq

ctx.prec = 384  # bits: more than the 250 of a pose by a quaternion of four integers of 60 bits
DECIMAL = re.compile(r"([+-]?\d{1,900})(?:\.(\d{1,900}))?(?:[eE]([+-]?\d{1,3}))?", re.ASCII)


class Unreadable(Exception):
    """The certificate cannot be read: exit code 1."""


class Refused(Exception):
    """An item does not hold: exit code 2."""


def decimal(text):
    """The rational number that a decimal is."""
    match = DECIMAL.fullmatch(text) if isinstance(text, str) else None
    if not match:
        raise Unreadable(f"found {str(text)[:40]!r}, expected a decimal number as text")
    whole, tail, power = match.groups(default="")
    return fmpq(int(whole + tail)) * fmpq(10) ** (int(power or 0) - len(tail))


def by_half_tangent(t):
    """Cosine and sine."""
    return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)


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
    if type(value) is not int or not 0 <= value < 10**6:
        raise Unreadable(f"found {str(value)[:40]!r}, expected a whole number")
    return value
