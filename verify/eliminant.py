"""Theorems 4 and 5 of docs/certificate.md: an eliminant in one unknown of a loop, and how many solutions its roots allow."""
from flint import acb, fmpq, fmpq_mat, fmpq_poly

from closures import TURN, Chain, proved_modes
from lines import HELD, eliminate, equations
from motions import IDENTITY, times, turn
from quantities import Refused, by_half_tangent, decimal, fields, is_exact, require, whole
from short_loops import lengthened

LONGEST = 512  # bits of a number of a link
HALVES = [(1, 0, 1), (1, 0, -1), (0, 2, 0)]  # 1, cos, sin, times 1 + t^2, as polynomials in the half-angle tangent t
POWERS = [(1, 0, 0), (0, 1, 0), (0, 0, 1)]  # 1, x, x^2 of a distance
SHAPES = [(i, j) for i in range(4) for j in range(3)]  # the exponents of the columns u^i v^j
SOMEWHERE = fmpq(17, 5)  # a number at which nothing special is expected


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
            links[hidden] = times(turn(2, *by_half_tangent(shift)), links[hidden])
        self.rows = matrix(equations(links, kinds), kinds, hidden)
        # Rows that are independent at infinity have a minor of degree 24.
        for matrix_there in [[c for *_, c in row] for row in self.rows], at(self.rows, SOMEWHERE):
            pivots, _ = eliminate(matrix_there, range(12))
            if len(pivots) == 12:
                break
        else:
            raise Refused("proof: eliminant: it is 0")
        self.chosen = [self.rows[i] for i in pivots]

    def polynomial(self):
        """The minor over the rational numbers, of degree 24 at most, from 25 of its values."""
        places = [fmpq(k) for k in range(-12, 13)]
        values = fmpq_mat(25, 1, [fmpq_mat(at(self.chosen, t)).det() for t in places])
        solved = fmpq_mat([[t**k for k in range(25)] for t in places]).solve(values)
        return fmpq_poly(solved.entries()).numer()

    def solutions_at(self, root):
        """Those that a root allows: the corank, and none where the one vector of the kernel is not made of products u^i v^j."""
        pivots, rows = eliminate(at(self.rows, root), range(12))
        free = [j for j in range(12) if j not in pivots.values()]
        if len(free) > 2:
            raise Refused("proof: eliminant: too many solutions may have one value")
        if len(free) != 1:
            return len(free)
        vector = {free[0]: acb(1)} | {j: -rows[i][free[0]] / rows[i][j] for i, j in pivots.items()}
        product = {}
        for a, x in vector.items():  # products of two entries are equal where the sums of their exponents are
            for b, y in vector.items():
                product.setdefault((a // 3 + b // 3, a % 3 + b % 3), []).append(x * y)
        return int(all((same[0] - x).contains(0) for same in product.values() for x in same))


def check_rational(system, *others):
    if not isinstance(system, Chain) or system.size > 6 or system.spherical or not is_exact(system.constants):
        raise Refused("proof: only loops of at most six rotations and translations with rational constants are covered")
    if any(fmpq(x).height_bits() > LONGEST for x in (*system.constants, *others)):
        raise Refused("proof: the numbers are too long")


def most_solutions(system, aid):
    """Theorem 4: the number of solutions that the eliminant allows, complex ones included."""
    first, hidden, shift = fields(aid, ("first", "hidden", "shift"))
    shift, held = decimal(shift), 6 - system.size
    check_rational(system, shift)
    eliminant = Eliminant(system.links + [IDENTITY] * held, system.kinds + [HELD] * held, whole(first), whole(hidden), shift)
    minor, circle = eliminant.polynomial(), fmpq_poly([1, 0, 1]).numer()
    if eliminant.is_angle and minor.degree() < 24:
        raise Refused("proof: eliminant: an angle of pi is a root")
    while eliminant.is_angle and minor.degree() > 1 and divmod(minor, circle)[1] == 0:
        minor = divmod(minor, circle)[0]
    return sum(eliminant.solutions_at(root) for root, _ in minor.complex_roots()) if minor.degree() > 0 else 0


def own_eliminant(system, values, item):
    """Theorem 11: modes of the longer loop, as many as the eliminant of the loop itself allows it. One more solution of the longer loop may
    show that the data are these; it has to where no solution is allowed."""
    _, stated, aid = fields(item, ("kind", "value", "aid"))
    require(system.size < 6, "proof: own-eliminant: the loop has six unknowns")
    most, modes = most_solutions(system, aid), proved_modes(lengthened(system), values)
    holds = most == whole(stated) and len(modes) - most in ((0, 1) if most else (1,))
    require(holds, f"proof: own-eliminant: the bound is {most}, {stated} is stated, and {len(modes)} modes are proved")
    return modes


def immobile(system, data, item, modes):
    """Theorem 5: the longer loop has finitely many solutions, and it is this loop: one of them at least is shown."""
    longer, (_, aid) = lengthened(system), fields(item, ("kind", "aid"))
    most_solutions(longer, aid)
    require(proved_modes(longer, modes), "modes: no solution of the longer loop is shown")
    return 0
