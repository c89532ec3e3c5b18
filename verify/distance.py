"""Theorem 8 of docs/certificate.md: nothing is in reach."""
from flint import arb

from closures import TURN, Platform
from motions import column, difference, dot


def distance(system):
    """Theorem 8: no real solution, where one side of a closed polygon would be longer than the others together."""
    if isinstance(system, Platform):
        between = lambda points, i, j: length(difference(points[i], points[j]))
        legs, pairs = [arb(x).sqrt() for x in system.squares], [(i, j) for i in range(6) for j in range(i)]
        is_open = any(square < 0 for square in system.squares) or any(exceeds(
            [legs[i], legs[j], between(system.base, i, j), between(system.plate, i, j)]) for i, j in pairs)
    else:
        is_open = all(kind == TURN for kind in system.kinds) and exceeds([length(column(link, 3)) for link in system.links])
    return 0 if is_open else None


def length(vector):
    return arb(dot(vector, vector)).sqrt()


def exceeds(sides):
    return any(side > sum(sides[:k] + sides[k + 1:], arb(0)) for k, side in enumerate(sides))
