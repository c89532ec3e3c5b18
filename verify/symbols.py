"""Polynomials over the integers in the parameters and angles of a loop of four rotations, and dual quaternions of them."""
import collections
import math
import re

from flint import fmpz_mpoly_ctx

from quantities import Unreadable

# Tangents of half the twists, lengths of the links, offsets, and tangents of half the angles of the joints.
NAMES = [letter + number for letter in "tadx" for number in "1234"]
RING = fmpz_mpoly_ctx.get(NAMES, "lex")
T, A, D, X = (RING.gens()[k:k + 4] for k in (0, 4, 8, 12))
ZERO, ONE = RING.constant(0), RING.constant(1)
OBLIQUE = math.prod((t * (1 + t * t) for t in T), start=ONE)  # not 0 where no twist is a multiple of pi
LONGEST = 5000  # characters of a polynomial


def polynomial(text):
    """A polynomial as python-flint writes it: multiplied out, and in the lexicographic order of the names."""
    terms = re.findall(r"([+-]?)([^+-]+)", str(text)[:LONGEST].replace(" ", ""))
    p = sum(((-1) ** (sign == "-") * math.prod(map(factor, term.split("*"))) for sign, term in terms), ZERO)
    if str(p) != text:
        raise Unreadable(f"found {str(text)[:40]!r}, expected a polynomial")
    return p


def factor(text):
    name, _, power = text.partition("^")
    if len(power) > 1:
        raise Unreadable(f"found {text[:40]!r}, expected an exponent of one digit")
    return RING.gen(NAMES.index(name)) ** int(power or 1) if name in NAMES else RING.constant(int(text))


def never_zero(p, allowed=ONE):
    """Whether p is not 0 where no twist is a multiple of pi and `allowed` is not 0: it has no factor besides theirs."""
    while p != 0 and (common := p.gcd(allowed * OBLIQUE)) != 1:
        p //= common
    return p != 0 and p.is_constant()


def parts(p, *places):
    """The coefficients of the powers of some variables, by the exponents."""
    found = collections.defaultdict(dict)
    for powers, c in p.to_dict().items():
        rest = tuple(0 if k in places else n for k, n in enumerate(powers))
        found[tuple(powers[k] for k in places)][rest] = c
    return collections.defaultdict(lambda: ZERO, {powers: RING.from_dict(part) for powers, part in found.items()})


def insert(p, quotients):
    """p, of degree 2 at most in some variables, with quotients in their places, times the squares of the denominators."""
    terms = []
    for powers, part in parts(p, *quotients).items():
        for n, (above, below) in zip(powers, quotients.values()):
            part = part * above**n * below ** (2 - n)
        terms.append(part)
    return sum(terms, ZERO)


def determinant(rows):
    if not rows:
        return ONE
    return sum((x * minor for x, minor in zip(rows[0], minors(rows[1:], len(rows)))), ZERO)


def minors(rows, count):
    """The minors of count - 1 rows of `count` entries, with signs, solve the linear equations of these rows where one of them is not 0."""
    return [(-1) ** k * determinant([row[:k] + row[k + 1:] for row in rows]) for k in range(count)]


def times(p, q):
    """The product of two quaternions."""
    return [p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]]


def screw(axis, tangent, length):
    """(cos + sin e) (2 + eps length e), a dual quaternion of a motion about and along x or z (axis 1 or 3): the tangent of half the
    angle is sin / cos."""
    sin, cos = tangent
    along = lambda one, own: [one, *(own if k == axis else ZERO for k in (1, 2, 3))]
    return along(2 * cos, 2 * sin), along(-sin * length, cos * length)


def around(motion, *others):
    """The product of dual quaternions, which are pairs of quaternions."""
    for real, dual in others:
        motion = times(motion[0], real), [x + y for x, y in zip(times(motion[0], dual), times(motion[1], real))]
    return motion
