"""Theorems 2, 3 and 8 of docs/certificate.md: how many solutions a mechanism of a kind, or of a geometry, can have."""
from flint import arb

from closures import SLIDE, TURN
from motions import column, cross, dot, inverse
from points import of_points
from quantities import is_exact

THREE_JOINTS = {0: 4, 1: 4, 2: 2, 3: 1}  # the ways in which they bring a point to its place, by their number of translations


def general(system):
    """Theorem 2."""
    if system.kinds == "platform":
        return 40
    slides = system.kinds.count(SLIDE)
    if system.spherical:
        return THREE_JOINTS.get(slides) if len(system.spherical) == 1 else None
    return {0: 16, 1: 16, 2: 8, 3: 2}.get(slides)


def geometry(system):
    """Theorem 3."""
    if system.kinds == "platform":
        return of_points(system.base, system.plate) if all(map(is_exact, system.base + system.plate)) else None
    return min(filter(None, (of_triple(system, first) for first in range(6))), default=None)


def of_triple(system, first):
    """Three neighbouring axes that are parallel, or meet in a point."""
    around = [(first + k) % 6 for k in range(6)]
    if system.spherical or any(system.kinds[k] == SLIDE for k in around[:3]):
        return None
    slides = sum(system.kinds[k] == SLIDE for k in around[3:])
    before, behind = system.links[around[0]], system.links[around[1]]
    if all(m[0][2] == 0 and m[1][2] == 0 for m in (before, behind)):
        return {0: 8, 1: 4}.get(slides)
    plain = all(m[0][3] == 0 and m[1][3] == 0 for m in (before, behind)) and behind[2][3] == 0
    one, other = crossing(inverse(before)), crossing(behind)
    meet = plain or one and other and one[0] * other[1] - other[0] * one[1] == 0
    return 2 * THREE_JOINTS[slides] if meet else None


def crossing(m):
    """Where on the z axis its image under a link crosses it, as a quotient."""
    (x, y, z), (u, v, w) = column(m, 3), column(m, 2)
    square = u * u + v * v
    return (z * square - (x * u + y * v) * w, square) if x * v - y * u == 0 and square != 0 else None


def distance(system):
    """Theorem 8: no real solution, where one side of a closed polygon would be longer than the others together."""
    if system.kinds != "platform":
        is_open = all(kind == TURN for kind in system.kinds) and exceeds([length(column(link, 3)) for link in system.links])
    else:
        between = lambda points, i, j: length([x - y for x, y in zip(points[i], points[j])])
        legs, pairs = [arb(x).sqrt() for x in system.squares], [(i, j) for i in range(6) for j in range(i)]
        is_open = any(square < 0 for square in system.squares) or any(exceeds(
            [legs[i], legs[j], between(system.base, i, j), between(system.plate, i, j)]) for i, j in pairs)
    return 0 if is_open else None


def length(vector):
    return arb(dot(vector, vector)).sqrt()


def exceeds(sides):
    return any(side > sum(sides[:k] + sides[k + 1:], arb(0)) for k, side in enumerate(sides))
