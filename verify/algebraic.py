"""Points with algebraic coordinates: numbers of Q[T]/P for a square-free polynomial P.

What is 0 in Q[T]/P is 0 at every root of P. What has an inverse there is 0 at none of them.
"""
from flint import fmpq, fmpq_poly

from closures import TURN
from motions import IDENTITY
from quantities import Refused, decimal, fields, is_exact, items

MOST_CONJUGATES = 16  # solutions of six unknowns


class Algebraic:
    """A polynomial in T modulo P."""

    def __init__(self, value, modulus):
        self.value, self.modulus = fmpq_poly(value) % modulus, modulus

    def with_other(self, other, compute):
        if not isinstance(other, (Algebraic, fmpq, int)):
            return NotImplemented
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
        return self * -1

    def __eq__(self, other):
        return (self - other).value == 0

    def __truediv__(self, other):
        common, inverse, _ = other.value.xgcd(self.modulus)
        if common.degree() != 0:
            raise Refused("proof: a number is 0 at some of the conjugate points, and not at others")
        return self * Algebraic(inverse / common[0], self.modulus)

    def __rtruediv__(self, other):
        return Algebraic([other], self.modulus) / self

    __radd__, __rmul__ = __add__, __mul__


class Points:
    """As many different points as the degree of P, at all of which a loop closes: cosine and sine, or the distance, of every unknown."""

    def __init__(self, system, item):
        _, texts, values, aid = fields(item, ("kind", "polynomial", "values", "aid"))
        self.modulus = fmpq_poly([rational(text) for text in items(texts)])
        degree = self.modulus.degree()
        is_simple = degree > 0 and self.modulus.gcd(self.modulus.derivative()).degree() == 0
        if not is_simple or degree > MOST_CONJUGATES or len(texts) != degree + 1 or self.modulus[degree] != 1:
            raise Refused("proof: the polynomial of the points has no degree from 1 to 16, does not begin with 1, or has multiple roots")
        number = lambda texts: Algebraic([rational(text) for text in items(texts)], self.modulus)
        self.values = [[number(part) for part in items(own, 2 if kind == TURN else 1)]
                       for kind, own in zip(system.kinds, items(values, system.size))]
        if any(len(own) == 2 and own[0] * own[0] + own[1] * own[1] != 1 for own in self.values):
            raise Refused("proof: a cosine and a sine of the points are those of no angle")
        flat = [part for own in self.values for part in own]
        self.weights = [rational(text) for text in items(*fields(aid, ("weights",)), len(flat))]
        if self.weighed(flat) != Algebraic([0, 1], self.modulus):
            raise Refused("proof: the points are not told apart by the weights")
        if system.spherical or not is_exact(system.constants) or system.around(self.values) != IDENTITY:
            raise Refused("proof: points: the loop is not closed there")

    def weighed(self, values):
        return sum((x * weight for x, weight in zip(values, self.weights)), 0 * values[0])


def rational(text):
    """A decimal, or a quotient of two."""
    above, is_quotient, below = text.partition("/")
    return decimal(above) / decimal(below) if is_quotient else decimal(above)
