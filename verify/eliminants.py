"""Theorems 4, 5 and 9 of docs/certificate.md: an eliminant in one unknown of a loop, and how many solutions its roots allow.

A line with a marked point, of direction l through p, is written as the vector (1, p, l, p.p, p.l, m, w) with m = p x l and
w = (p.p) l - 2 (p.l) p. Motions act on such vectors by matrices: numbers of degree 1 in cosines and sines, and 2 in distances.
"""
from flint import acb, arb, arb_mat, arb_poly, fmpq, fmpq_mat, fmpq_poly

from closures import TURN
from motions import IDENTITY, about_z, along, column, cross, dot, inverse, times, turned
from quantities import Refused, by_half_tangent, decimal, fields, is_exact, whole

HELD = "held"  # an unknown that stands at 0
LONGEST = 512  # bits of a number of a link
Z_AXIS = [fmpq(1)] + [fmpq(0)] * 3 + [fmpq(0), fmpq(0), fmpq(1)] + [fmpq(0)] * 8
HALVES = [(1, 0, 1), (1, 0, -1), (0, 2, 0)]  # 1, cos, sin, times 1 + t^2, as polynomials in the half-angle tangent t
POWERS = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]  # 1, x, x^2 of a distance
SHAPES = [(i, j) for i in range(4) for j in range(3)]  # the exponents of the columns u^i v^j


def moved(motion, line):
    """The line behind a motion."""
    one, p, l, square, inner, m, w, t = line[0], line[1:4], line[4:7], line[7], line[8], line[9:12], line[12:], column(motion, 3)
    p, l, m, w = (turned(motion, v) for v in (p, l, m, w))
    tt, tl = dot(t, t), dot(t, l)
    return [one, *(x + y * one for x, y in zip(p, t)), *l, square + 2 * dot(t, p) + tt * one, inner + tl,
            *(x + y for x, y in zip(m, cross(t, l))),
            *(x - 2 * y + tt * z - 2 * (tl + inner) * e for x, y, z, e in zip(w, cross(t, m), l, t))]


def split(line, kind):
    """Its images under an unknown: the coefficients of 1, cos, sin of an angle, or of 1, x, x^2 of a distance."""
    if kind == TURN:
        still, cos, sin = (moved(about_z(fmpq(c), fmpq(s)), line) for c, s in ((0, 0), (1, 0), (0, 1)))
        return [still, [x - y for x, y in zip(cos, still)], [x - y for x, y in zip(sin, still)]]
    if kind == HELD:
        return [line, [fmpq(0)] * 15, [fmpq(0)] * 15]
    up, down = (moved(along(0, 0, fmpq(x)), line) for x in (1, -1))
    return [line, [(x - y) / 2 for x, y in zip(up, down)], [(x + y) / 2 - z for x, y, z in zip(up, down, line)]]


def eliminate(rows, columns):
    """Gauss's algorithm with pivots that are proved not to be 0: their places, the rows and columns left, and the table then."""
    rows, left, columns, steps = list(rows), list(range(len(rows))), list(columns), []
    while left and columns:
        size, i, j = max((acb(rows[i][j]).abs_lower(), i, j) for i in left for j in columns)
        if not size > 0:
            break
        left.remove(i), columns.remove(j), steps.append((i, j))
        for k in left:
            factor = rows[k][j] / rows[i][j]
            rows[k] = [x - factor * y for x, y in zip(rows[k], rows[i])]
    return steps, left, columns, rows


def equations(links, kinds):
    """The combinations of the fourteen equations in which the last two unknowns do not occur: {exponents: coefficient}."""
    left, right = {(): Z_AXIS}, {(): Z_AXIS}
    for k in (2, 1, 0):
        left = {(e, *rest): part for rest, line in left.items() for e, part in enumerate(split(moved(links[k], line), kinds[k]))}
    for k in (4, 5):
        back = inverse(links[k - 1])
        right = {(*rest, e): part for rest, line in right.items() for e, part in enumerate(split(moved(back, line), kinds[k]))}
    right = {e: moved(inverse(links[5]), line) for e, line in right.items()}
    known = right.pop((0, 0))
    right = {e: line for e, line in right.items() if not all(x == 0 for x in line)}
    own = [(1, 0)] * (kinds[4] != HELD) + [(0, 1)] * (kinds[5] != HELD) + [(2, 0)] * (kinds[4] == TURN) + [(0, 2)] * (kinds[5] == TURN)
    left[0, 0, 0] = [x - y for x, y in zip(left[0, 0, 0], known)]
    table = [[line[i] for line in (*right.values(), *left.values())] for i in range(1, 15)]
    steps, others, *_, table = eliminate(table, range(len(right)))
    if len(steps) < len(right) or not set(own) <= set(right):
        raise Refused("proof: eliminant: the other unknowns do not follow from three of them")
    return [dict(zip(left, table[i][len(right):])) for i in others]


def matrix(found, kinds, hidden):
    """The equations times 1 + t^2 of every rotation, once and times the first other unknown u: rows of polynomials of degree
    2 in the hidden unknown for the columns u^i v^j."""
    rows, forms = [], [HALVES if kind == TURN else POWERS for kind in kinds[:3]]
    first, second = (k for k in range(3) if k != hidden)
    for equation in found:
        row = {shape: [fmpq(0)] * 3 for shape in SHAPES}
        for e, value in equation.items():
            for i, a in enumerate(forms[first][e[first]]):
                for j, b in enumerate(forms[second][e[second]]):
                    row[i, j] = [x + value * (a * b * c) for x, c in zip(row[i, j], forms[hidden][e[hidden]])] if a * b else row[i, j]
        rows.append(list(row.values()))
        rows.append([[fmpq(0)] * 3] * 3 + rows[-1][:9])
    return rows


def at(rows, t):
    return [[a + b * t + c * t * t for a, b, c in row] for row in rows]


class Eliminant:
    """A minor of the matrix that is not 0, for the unknown `first + hidden`, the loop being counted from `first`."""

    def __init__(self, links, kinds, first, hidden, shift=fmpq(0)):
        links, kinds = [*links[first:], *links[:first]], [*kinds[first:], *kinds[:first]]
        if not (first < 6 and hidden < 3 and kinds[3] in (TURN, HELD)) or HELD in kinds[:3]:
            raise Refused("proof: eliminant: no such unknown, or the fourth from the first is no rotation")
        self.is_angle = kinds[hidden] == TURN
        if self.is_angle:  # counted from another place
            links[hidden] = times(about_z(*by_half_tangent(shift)), links[hidden])
        self.rows = matrix(equations(links, kinds), kinds, hidden)
        steps = eliminate(at(self.rows, fmpq(17, 5)), range(12))[0]  # a number at which nothing special is expected
        if len(steps) < 12:
            raise Refused("proof: eliminant: it is 0")
        self.chosen, self.points = [self.rows[i] for i, _ in steps], [fmpq(k) for k in range(-12, 13)]

    def polynomial(self):
        """The minor over the rational numbers, of degree 24 at most, from 25 of its values."""
        values = fmpq_mat(25, 1, [fmpq_mat(at(self.chosen, t)).det() for t in self.points])
        solved = fmpq_mat([[t**k for k in range(25)] for t in self.points]).solve(values)
        return fmpq_poly([solved[k, 0] for k in range(25)]).numer()

    def polynomial_of_balls(self):
        return arb_poly.interpolate([arb(t) for t in self.points], [arb_mat(at(self.chosen, t)).det() for t in self.points])

    def solutions_at(self, root):
        """Those that a root allows: the corank, and none where the one vector of the kernel is not made of products u^i v^j."""
        steps, _, columns, entries = eliminate(at(self.rows, root), range(12))
        if len(columns) > 2:
            raise Refused("proof: eliminant: too many solutions may have one value")
        if len(columns) != 1:
            return len(columns)
        vector = {columns[0]: acb(1)}
        for i, j in reversed(steps):
            vector[j] = -sum((entries[i][k] * x for k, x in vector.items()), acb(0)) / entries[i][j]
        product = {}
        for a, x in vector.items():  # products of two entries are equal where the sums of their exponents are
            for b, y in vector.items():
                product.setdefault((a // 3 + b // 3, a % 3 + b % 3), []).append(x * y)
        return int(all((same[0] - x).contains(0) for same in product.values() for x in same))


def check_lengths(links, shift):
    if any(fmpq(x).height_bits() > LONGEST for link in links for row in link for x in row) or shift.height_bits() > LONGEST:
        raise Refused("proof: the numbers are too long")


def most_solutions(system, aid):
    """Theorem 4: the number of solutions that the eliminant allows, complex ones included."""
    first, hidden, shift = fields(aid, ("first", "hidden", "shift"))
    if system.kinds == "platform" or system.size > 6 or system.spherical or not is_exact(system.constants()):
        raise Refused("proof: eliminant: only loops of rotations and translations with rational constants have one")
    check_lengths(system.links, decimal(shift))
    links, kinds = ([*own, *[other] * (6 - system.size)] for own, other in ((system.links, IDENTITY), (system.kinds, HELD)))
    eliminant = Eliminant(links, kinds, whole(first), whole(hidden), decimal(shift))
    minor, circle = eliminant.polynomial(), fmpq_poly([1, 0, 1]).numer()
    if eliminant.is_angle and minor.degree() < 24:
        raise Refused("proof: eliminant: an angle of pi is a root")
    while eliminant.is_angle and minor.degree() > 1 and divmod(minor, circle)[1] == 0:
        minor = divmod(minor, circle)[0]
    return sum(eliminant.solutions_at(root) for root, _ in minor.complex_roots()) if minor.degree() > 0 else 0
