"""Points with algebraic coordinates: numbers of Q[T]/P for a square-free polynomial P, and power series over them.

What is 0 in Q[T]/P is 0 at every root of P. What has an inverse there is 0 at none of them.
"""
from flint import fmpq, fmpq_poly

from closures import TURN
from quantities import Refused, Unreadable, expression, fields, is_exact, items

MOST_CONJUGATES = 16  # solutions of six unknowns


class Algebraic:
    """A polynomial in T modulo P."""

    def __init__(self, value, modulus):
        self.value, self.modulus = fmpq_poly(value) % modulus, modulus

    def with_other(self, other, compute):
        return Algebraic(compute(self.value, other.value if isinstance(other, Algebraic) else fmpq(other)), self.modulus)

    def __add__(self, other):
        return self.with_other(other, lambda x, y: x + y)

    def __sub__(self, other):
        return self.with_other(other, lambda x, y: x - y)

    def __mul__(self, other):
        return self.with_other(other, lambda x, y: x * y)

    def __rsub__(self, other):
        return -self + other

    def __neg__(self):
        return Algebraic(-self.value, self.modulus)

    def __eq__(self, other):
        return (self - other).value == 0

    def inverse(self):
        common, own, _ = self.value.xgcd(self.modulus)
        if common.degree() != 0:
            raise Refused("proof: a number is 0 at some of the conjugate points, and not at others")
        return Algebraic(own / common[0], self.modulus)

    __radd__, __rmul__ = __add__, __mul__


def points(item, kinds):
    """P, and cosine and sine or the distance of every unknown of the points that an item gives: as many different ones as its degree."""
    texts, values, aid = fields(item, ("kind", "polynomial", "values", "aid"))[1:]
    modulus = fmpq_poly([rational(text) for text in items(texts)])
    degree = modulus.degree()
    if not 0 < degree <= MOST_CONJUGATES or len(texts) != degree + 1 or modulus[degree] != 1 or modulus.gcd(modulus.derivative()).degree():
        raise Refused("proof: the polynomial of the points has no degree from 1 to 16, does not begin with 1, or has multiple roots")
    number = lambda texts: Algebraic([rational(text) for text in items(texts)], modulus)
    point = [[number(part) for part in items(own, 2 if kind == TURN else 1)] for kind, own in zip(kinds, items(values, len(kinds)))]
    if any(len(own) == 2 and own[0] * own[0] + own[1] * own[1] != 1 for own in point):
        raise Refused("proof: a cosine and a sine of the points are those of no angle")
    flat = [part for own in point for part in own]
    weights, = fields(aid, ("weights",))
    name = sum((x * rational(text) for x, text in zip(flat, items(weights, len(flat)))), Algebraic([0], modulus))
    if name != Algebraic([0, 1], modulus):
        raise Refused("proof: the points are not told apart by the weights")
    return modulus, point


def rational(text):
    value = expression(text)[0] if isinstance(text, str) else None
    if not is_exact([value]):
        raise Unreadable(f"found {str(text)[:40]!r}, expected a rational number as text")
    return value


class Series:
    """A power series with coefficients of any ring, up to an order that is common to all."""

    def __init__(self, terms):
        self.terms = terms

    def of(self, other):
        return other.terms if isinstance(other, Series) else [other] + [fmpq(0)] * (len(self.terms) - 1)

    def __add__(self, other):
        return Series([x + y for x, y in zip(self.terms, self.of(other))])

    def __sub__(self, other):
        return Series([x - y for x, y in zip(self.terms, self.of(other))])

    def __neg__(self):
        return Series([-x for x in self.terms])

    def __rsub__(self, other):
        return -self + other

    def __mul__(self, other):
        if not isinstance(other, Series):
            return Series([x * other for x in self.terms])
        mine, others = ([(k, x) for k, x in enumerate(series.terms) if x != 0] for series in (self, other))
        terms = [fmpq(0)] * len(self.terms)
        for i, x in mine:
            for j, y in others:
                if i + j < len(terms):
                    terms[i + j] = x * y + terms[i + j]
        return Series(terms)

    def __truediv__(self, other):
        """By a series that begins with 1."""
        terms = []
        for k, x in enumerate(self.terms):
            terms.append(x - sum((y * z for y, z in zip(reversed(terms), other.terms[1:])), fmpq(0)))
        return Series(terms)

    __radd__, __rmul__ = __add__, __mul__
