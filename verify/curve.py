"""Theorem 6 of docs/certificate.md: a loop moves through points along a curve."""
from flint import fmpq

from algebraic import Points
from closures import TURN, six
from eliminant import check_rational
from lines import eliminate
from motions import along, times, turn
from quantities import Refused, by_half_tangent, items

MOST = 16  # the multiplicity of an isolated configuration and those of its conjugates are no greater together


class Series:
    """A power series with coefficients of any ring, up to an order that is common to all."""

    def __init__(self, terms):
        self.terms = terms

    def of(self, other):
        return other.terms if isinstance(other, Series) else [other] + [fmpq(0)] * (len(self.terms) - 1)

    def __add__(self, other):
        return Series([x + y for x, y in zip(self.terms, self.of(other))])

    def __neg__(self):
        return Series([-x for x in self.terms])

    def __sub__(self, other):
        return self + -other

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
        for x in self.terms:
            terms.append(x - sum((y * z for y, z in zip(reversed(terms), other.terms[1:])), fmpq(0)))
        return Series(terms)

    __radd__, __rmul__ = __add__, __mul__


def values(points, system, x, order):
    """The six equations, for half-angle tangents and distances beyond the points."""
    parts = []
    for kind, own, terms, link in zip(system.kinds, points.values, x, system.links):
        t = Series([*terms, *[fmpq(0)] * order][:order + 1])
        parts += [turn(2, *own), turn(2, *by_half_tangent(t))] if kind == TURN else [along(0, 0, *own), along(0, 0, t)]
        parts.append(link)
    zero = 0 * points.values[0][0]
    return [Series([zero] * (order + 1)) + f for f in six(times(*parts))]


def curve(system, data, item, modes):
    """The closure equations hold to the order that decides along the only motion of the first order."""
    items(modes, 0)
    check_rational(system)
    points, size = Points(system, item), system.size
    if all(root.imag != 0 for root, _ in points.modulus.complex_roots()):
        raise Refused("proof: curve: none of the points is real")
    unit = lambda k, count: [fmpq(int(i == k)) for i in range(count)]
    screws = [[f.terms[1] for f in values(points, system, [[fmpq(0), x] for x in unit(k, size)], 1)] for k in range(size)]
    # Behind the screws stands what the steps of elimination do to the six equations.
    pivots, rows = eliminate([[*(screw[i] for screw in screws), *unit(i, 6)] for i in range(6)], range(size), lambda x: int(x != 0))
    if len(pivots) != size - 1:
        raise Refused(f"proof: curve: the joint screws have the rank {len(pivots)}, expected {size - 1}")
    along_it = [[fmpq(0), fmpq(int(k not in pivots.values()))] for k in range(size)]
    for order in range(1, MOST // min(factor.degree() for factor, _ in points.modulus.factor()[1]) + 1):
        found = [f.terms[order] for f in values(points, system, along_it, order)]
        along_it = [own if len(own) > order else [*own, fmpq(0)] for own in along_it]
        for i, row in enumerate(rows):
            value = sum((x * y for x, y in zip(row[size:], found)), 0 * found[0])
            if i in pivots:
                along_it[pivots[i]][order] = -value / row[pivots[i]]
            elif value != 0:
                raise Refused("proof: curve: the loop opens along the motion")
    return 1
