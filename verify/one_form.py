"""The one form of the numbers of arms, loops and platforms in a certificate: no other text of the same number is as good."""
from flint import fmpq

from motions import IDENTITY
from units import evaluated

PLACES = 24  # behind the point: a number of more is a fraction
ANGLES = ("alpha", "theta", "theta0", "angle")
RIGHT = {"0": "0", "1": "pi/2", "-1": "-pi/2", "inf": "pi"}  # by the tangent of the half
NOWHERE = [[str(x) for x in row] for row in IDENTITY]
SIZES = fmpq(10) ** -150, fmpq(10) ** 150


def is_in_one_form(data):
    """Whether all numbers are written as certificates write them, and no key stands there that says nothing. Data of other kinds are
    compared with what they should be where they are read."""
    mechanism = data.get("mechanism", {})
    if mechanism.get("kind") not in ("arm", "loop", "platform"):
        return True
    is_idle = any(mechanism.get(key) == NOWHERE for key in ("base", "tool")) or data.get("input") == []
    return not is_idle and all(is_number(*leaf) for leaf in leaves(data))


def leaves(value, key=None):
    """(key, text) of all numbers: the words of a mechanism are those of its kind, of its convention and of the types of its joints."""
    if isinstance(value, dict):
        for name, own in value.items():
            if name not in ("kind", "convention", "type"):
                yield from leaves(own, name)
    elif isinstance(value, list):
        for own in value:
            yield from leaves(own, key)
    elif isinstance(value, str):
        yield key, value


def is_number(key, text):
    value = evaluated(text)
    if key in ANGLES:
        half = value.half_tangent()
        plain = text if half is None else RIGHT.get(str(half)) or f"{'-' * (half < 0)}2*atan({rational(abs(half))})"
    else:
        own = value.rational
        plain = text if own is None else rational(own) if own == 0 or SIZES[0] <= abs(own) <= SIZES[1] else None
    return text == plain == text.strip()


def rational(x):
    """A decimal, where it has few places, or a fraction in lowest terms."""
    for places in range(PLACES + 1):
        scaled = x * 10**places
        if scaled.q == 1:
            digits = str(abs(int(scaled.p))).rjust(places + 1, "0")
            return "-" * (x < 0) + (f"{digits[:-places]}.{digits[-places:]}" if places else digits)
    return str(x)
