"""The equations of theorem 4 of docs/certificate.md: a line with a marked point, moved round a loop from both sides.

A line of direction l through the marked point p is written as the vector (1, p, l, p.p, p.l, m, w) with m = p x l and
w = (p.p) l - 2 (p.l) p. Motions act on such vectors by matrices: numbers of degree 1 in cosines and sines, and 2 in distances.
"""
from flint import acb, fmpq

from closures import TURN
from motions import along, column, difference, dot, inverse, turn
from quantities import Refused

HELD = "held"  # an unknown that stands at 0
Z_AXIS = [fmpq(int(k in (0, 6))) for k in range(15)]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def moved(motion, line):
    """The line behind a motion."""
    one, square, inner, t = line[0], line[7], line[8], column(motion, 3)
    p, l, m, w = ([dot(row, line[k:k + 3]) for row in motion[:3]] for k in (1, 4, 9, 12))
    tt, tl = dot(t, t), dot(t, l)
    return [one, *(x + y * one for x, y in zip(p, t)), *l, square + 2 * dot(t, p) + tt * one, inner + tl,
            *(x + y for x, y in zip(m, cross(t, l))),
            *(x - 2 * y + tt * z - 2 * (tl + inner) * e for x, y, z, e in zip(w, cross(t, m), l, t))]


def split(line, kind):
    """Its images under an unknown: the coefficients of 1, cos, sin of an angle, or of 1, x, x^2 of a distance."""
    if kind == TURN:
        still, cos, sin = (moved(turn(2, fmpq(c), fmpq(s)), line) for c, s in ((0, 0), (1, 0), (0, 1)))
        return [still, difference(cos, still), difference(sin, still)]
    if kind == HELD:
        return [line, [fmpq(0)] * 15, [fmpq(0)] * 15]
    up, down = (moved(along(0, 0, fmpq(x)), line) for x in (1, -1))
    return [line, [(x - y) / 2 for x, y in zip(up, down)], [(x + y) / 2 - z for x, y, z in zip(up, down, line)]]


def eliminate(rows, columns, size=lambda x: acb(x).abs_lower()):
    """Gauss and Jordan's algorithm with pivots that are proved not to be 0, the largest first: {row: column} of the pivots, and the
    rows then, in which every pivot is alone in its column."""
    pivots = {}
    while True:
        free = [j for j in columns if j not in pivots.values()]
        places = [(size(row[j]), i, j) for i, row in enumerate(rows) if i not in pivots for j in free]
        largest, i, j = max(places, default=(0, 0, 0))
        if not largest > 0:
            return pivots, rows
        pivots[i], scaled = j, [x / rows[i][j] for x in rows[i]]
        rows = [row if k == i or row[j] == 0 else [x - row[j] * y for x, y in zip(row, scaled)] for k, row in enumerate(rows)]


def equations(links, kinds):
    """The combinations of the fourteen equations in which the last two unknowns do not occur: {exponents: coefficient}."""
    left, right = {(): Z_AXIS}, {(): Z_AXIS}
    for k in (2, 1, 0):
        left = {(e, *rest): part for rest, line in left.items() for e, part in enumerate(split(moved(links[k], line), kinds[k]))}
    for k in (4, 5):
        back = inverse(links[k - 1])
        right = {(*rest, e): part for rest, line in right.items() for e, part in enumerate(split(moved(back, line), kinds[k]))}
    right = {e: moved(inverse(links[5]), line) for e, line in right.items()}
    left[0, 0, 0] = difference(left[0, 0, 0], right.pop((0, 0)))
    right = {e: line for e, line in right.items() if not all(x == 0 for x in line)}
    own = [(1, 0)] * (kinds[4] != HELD) + [(0, 1)] * (kinds[5] != HELD) + [(2, 0)] * (kinds[4] == TURN) + [(0, 2)] * (kinds[5] == TURN)
    pivots, table = eliminate([[line[i] for line in (*right.values(), *left.values())] for i in range(1, 15)], range(len(right)))
    if len(pivots) < len(right) or not set(own) <= set(right):
        raise Refused("proof: eliminant: the other unknowns do not follow from three of them")
    return [dict(zip(left, row[len(right):])) for i, row in enumerate(table) if i not in pivots]
