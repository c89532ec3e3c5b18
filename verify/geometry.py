"""Theorem 3 of docs/certificate.md: the most solutions that a loop with special axes, or a platform with special points can have."""
from flint import acb, acb_mat, arb, fmpq_mat

from closures import SLIDE, THREE_JOINTS, Platform
from lines import cross, eliminate
from motions import column, difference, dot, inverse
from quantities import is_exact

LEGS = range(6)


def geometry(system):
    if isinstance(system, Platform):
        return of_points(system.base, system.plate) if all(map(is_exact, system.base + system.plate)) else None
    return min(filter(None, map(lambda first: of_triple(system, first), range(6))), default=None)


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


def of_points(base, plate):
    """The least number of poses that is proved to be the most; None where it is 40."""
    bounds = [16] if any(three_meet(points) or in_pairs(points) for points in (base, plate)) else []
    dimension = lambda *bodies: fmpq_mat([[1, *(x for body in bodies for x in body[k])] for k in LEGS]).rank() - 1
    bounds += [{0: 16, 1: 16, 2: 16, 3: 32}.get(dimension(base, plate), 40)]  # affine images of points of a plane, or of space
    if dimension(base) == 3 and are_similar(base, plate):
        bounds.append(24)
    bounds.append(40 - at_infinity(base, plate))
    return min(bounds) if min(bounds) < 40 else None


def three_meet(points):
    return any(points.count(point) >= 3 for point in points)


def in_pairs(points):
    corners = [point for k, point in enumerate(points) if point not in points[:k]]
    if len(corners) != 3 or any(points.count(point) != 2 for point in corners):
        return False
    return any(x != 0 for x in cross(*(difference(corner, corners[0]) for corner in corners[1:])))


def are_similar(base, plate):
    square = lambda points, i, j: dot(difference(points[i], points[j]), difference(points[i], points[j]))
    pairs = [(square(base, i, j), square(plate, i, j)) for i in LEGS for j in range(i)]
    return any(y != 0 for _, y in pairs) and all(x * v == u * y for x, y in pairs for u, v in pairs)


def at_infinity(base, plate):
    """The number of isolated solutions `(v.a - nu) (w.b - mu) = sigma` with isotropic v and w normal to two directions."""
    return sum(solutions_normal_to(d, e, base, plate) for d in directions(base) for e in directions(plate))


def directions(points):
    """Returns the lines that go through two of the points, each once."""
    found = []
    for i in LEGS:
        for j in range(i):
            d = difference(points[i], points[j])
            if any(x != 0 for x in d) and all(any(x != 0 for x in cross(d, e)) for e in found):
                found.append(d)
    return found


def solutions_normal_to(d, e, base, plate):
    lines, others = lines_along(d, base), lines_along(e, plate)
    if len(lines) == 3 and lines == others:
        wanted = [(None, 1)]  # sigma may be 0, and the solution is counted once
    else:
        wanted = [((i[0], j[0]), 2) for i in lines for j in others if len(set(i) | set(j)) == 6]
    return sum(4 * count for place, count in wanted if all(
        is_isolated(d, e, base, plate, [own[0] for own in lines], place, signs) for signs in ((1, 1), (1, -1), (-1, 1), (-1, -1))))


def lines_along(d, points):
    """The legs by the lines of this direction on which their points lie."""
    lines = []
    for k in LEGS:
        line = next((own for own in lines if all(x == 0 for x in cross(d, difference(points[k], points[own[0]])))), None)
        line.append(k) if line else lines.append([k])
    return lines


def is_isolated(d, e, base, plate, classes, place, signs):
    """Whether the derivatives of the six equations by v, w, nu, mu and sigma have the rank 5: d is tangent to the isotropic
    directions at v, and e at w."""
    a, b = ([dot(normal(d, s), point) for point in points] for d, s, points in zip((d, e), signs, (base, plate)))
    if place is not None:
        nu, mu = a[place[0]], b[place[1]]
    else:  # a b - mu a - nu b + (nu mu - sigma) = 0 for three legs
        table = acb_mat([[a[k], b[k], 1] for k in classes])
        if not table.det().abs_lower() > 0:
            return False
        mu, nu, _ = table.solve(acb_mat([[a[k] * b[k]] for k in classes])).entries()
    rows = [[dot(d, base[k]) * (b[k] - mu), dot(e, plate[k]) * (a[k] - nu), b[k] - mu, a[k] - nu, 1] for k in LEGS]
    return len(eliminate(rows, range(5))[0]) == 5


def normal(d, sign):
    """An isotropic vector normal to a direction."""
    one = next(f for f in ([d[1], -d[0], 0], [0, d[2], -d[1]]) if any(x != 0 for x in f))
    length, other = arb(dot(d, d)).sqrt(), cross(d, one)
    return [acb(arb(x), sign * y / length) for x, y in zip(one, other)]
