"""Points with algebraic coordinates: numbers of Q[T]/P for a square-free polynomial P, and power series over them.

What is 0 in Q[T]/P is 0 at every root of P. What has an inverse there is 0 at none of them.
"""
from flint import acb, acb_poly, arb, ctx, fmpq, fmpq_poly

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
    """P, cosine and sine or the distance of every unknown, and weights, of the points that an item gives: as many different ones as the
    degree of P."""
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
    weights = [rational(text) for text in items(weights, len(flat))]
    if sum((x * w for x, w in zip(flat, weights)), Algebraic([0], modulus)) != Algebraic([0, 1], modulus):
        raise Refused("proof: the points are not told apart by the weights")
    return modulus, point, weights


def is_one_in(found, kinds, mode):
    """Whether a ball holds one of the points, with all further unknowns at 0."""
    (modulus, point, weights), (centre, radius, _), before = found, mode, ctx.prec
    ctx.prec = 1408  # bits: coefficients of some 400 cancel
    try:
        here = [(x.cos(), x.sin()) if kind == TURN else (x,) for kind, x in zip(kinds, centre)]
        root = sum((x * w for x, w in zip((x for own in here for x in own), weights)), acb(0)).mid()
        step = lambda t: acb_poly(modulus)(t) / acb_poly(modulus.derivative())(t)
        for _ in range(6):  # Newton's method, from 53 bits
            root = (root - step(root)).mid()
        off = arb(0, modulus.degree() * step(root).abs_upper())  # P'/P is the sum of 1/(t - root) over n roots
        root = acb(root.real + off, root.imag + off)
        for own, now in zip(point, here):
            values = [acb_poly(part.value)(root) for part in own]
            if len(values) == 1:
                is_near = (values[0] - now[0]).abs_upper() < radius
            else:  # cosine and sine of the difference, which is less than twice the sine if that is small and the cosine positive
                (cos, sin), (c, s) = values, now
                is_near = 2 * (sin * c - cos * s).abs_upper() < radius and (cos * c + sin * s).real > 0
            if not is_near:
                return False
        return all(x.abs_upper() < radius for x in centre[len(kinds):])
    finally:
        ctx.prec = before


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
