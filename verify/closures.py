"""Closure equations, and the proof that a ball holds one solution of them: theorem 1 of docs/certificate.md."""
from collections import namedtuple

from flint import acb, acb_mat, acb_series, arb, fmpq

from motions import IDENTITY, along, column, difference, dot, of_quaternion, times, turn
from quantities import decimal, fields, items, require, whole

TURN, SLIDE = "turn", "slide"
THREE_JOINTS = {0: 4, 1: 4, 2: 2, 3: 1}  # the ways in which they bring a point to its place, by their number of translations
MOST_RADIUS = fmpq(1, 1000)
Mode = namedtuple("Mode", "centre radius is_real multiplicity")


class Chain:
    """V_1(x_1) L_1 ... V_n(x_n) L_n = 1, rotations about and translations along z."""
    equations = 6

    def __init__(self, parts, spherical):
        self.kinds, links, self.spherical = [part for part in parts if part in (TURN, SLIDE)], [IDENTITY], spherical
        for part in parts:
            if part in (TURN, SLIDE):
                links.append(IDENTITY)
            else:
                links[-1] = times(links[-1], part)
        self.first, *self.links = links
        self.size = len(self.links)
        self.links[-1] = times(self.links[-1], self.first)
        self.constants = [x for link in self.links for row in link for x in row]

    def parts(self, x):
        """Cosine and sine, or the distance, of every unknown."""
        return [(t.cos(), t.sin()) if kind == TURN else (t,) for kind, t in zip(self.kinds, x)]

    def around(self, parts):
        """The motion round the loop."""
        moved = [turn(2, *own) if kind == TURN else along(0, 0, *own) for kind, own in zip(self.kinds, parts)]
        return times(*(motion for pair in zip(moved, self.links) for motion in pair))

    def closed(self, x):
        """What is 0 where the loop is closed, and what is not 0 there: else the rotation might be a half-turn, of trace -1."""
        m = self.around(self.parts(x))
        return six(m), m[0][0] + m[1][1] + m[2][2] + 1

    def forms(self, x):
        """A spherical joint has two triples of angles for every rotation."""
        forms = [x]
        for k in self.spherical:
            forms += [[*y[:k], y[k] + arb.pi(), -y[k + 1], y[k + 2] + arb.pi(), *y[k + 3:]] for y in forms]
        return forms


def six(m):
    """What is 0 where a loop is closed: the skew part of the rotation, and the translation."""
    return [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], *column(m, 3)]


class Platform:
    """|x|^2 = 1 and |p + R b - a|^2 = l^2 for the six legs; x is the quaternion of R, and the unknowns are x and p."""
    equations, size, kinds, spherical = 7, 7, [SLIDE] * 7, []

    def __init__(self, base, plate, squares):
        self.base, self.plate, self.squares = base, plate, squares
        self.constants = [x for point in (*base, *plate, squares) for x in point]

    def closed(self, x):
        rotation = of_quaternion(*x[:4])
        legs = [[dot(row, b) + y - z for row, y, z in zip(rotation, x[4:], a)] for a, b in zip(self.base, self.plate)]
        return [sum(y * y for y in x[:4]) - 1, *(dot(leg, leg) - square for leg, square in zip(legs, self.squares))], arb(1)

    def forms(self, x):
        """A quaternion and its negative are one pose."""
        return [x, [*(-y for y in x[:4]), *x[4:]]]


def jacobian(system, x):
    """The derivatives of the equations, by power series in each unknown up to the first power."""
    zero = acb_series([0], prec=2)
    columns = [system.closed([acb_series([t, int(j == k)], prec=2) for j, t in enumerate(x)])[0] for k in range(system.size)]
    return acb_mat([[(zero + value)[1] for value in column] for column in columns]).transpose()


def holds_one(system, point, radius):
    """Whether the ball holds exactly one zero of the closure equations, and this is a solution."""
    box = [x + acb(arb(0, radius), arb(0, radius)) for x in point]
    slope, (values, _), (_, other) = jacobian(system, box), system.closed(point), system.closed(box)
    try:
        inverse = slope.mid().inv().mid()
    except ZeroDivisionError:
        return False
    steps, rest = inverse * acb_mat([[value] for value in values]), inverse * slope - 1
    bends = [sum((x.abs_upper() for x in row), arb(0)) for row in rest.tolist()]
    is_one = all(bend < 1 and x.abs_upper() + bend * radius < radius for x, bend in zip(steps.entries(), bends))
    return is_one and other.abs_lower() > 0


def are_apart(kinds, one, other, radius):
    """Whether one of the unknowns differs by more than the radius, angles modulo 2 pi."""
    # Of complex angles nearer than r, which is at most 1/500, |2 sin(d/2)| <= 2 sinh(r/2) < 1.001 r.
    sizes = [2 * (d / 2).sin() if kind == TURN else d for kind, d in zip(kinds, difference(one, other))]
    return any(size.abs_lower() > fmpq(1001, 1000) * radius for size in sizes)


def proved_modes(system, values, is_double=lambda centre, radius: False):
    """The modes, of which each ball holds one solution, real or not as it says, and all differ. Double ones are proved elsewhere."""
    require(system.size == system.equations, "closure: only loops of at most six unknowns are covered")
    modes = []
    for at, value in enumerate(items(values), 1):
        centre, size, is_real, multiplicity = fields(value, ("centre", "radius", "real", "multiplicity"))
        parts = [(part, "0") if isinstance(part, str) else items(part, 2) for part in items(centre, system.size)]
        point, radius = [acb(decimal(re), decimal(im)) for re, im in parts], arb(decimal(size))
        require(0 < decimal(size) <= MOST_RADIUS, f"mode {at}: the radius is not above 0 and at most 1/1000")
        is_as_said = is_real is all(x.imag == 0 for x in point) and (is_real or any(abs(x.imag) > radius for x in point))
        require(is_as_said, f"mode {at}: its ball does not show that it is real or not real as it says")
        is_proved = holds_one(system, point, radius) if whole(multiplicity) == 1 else multiplicity == 2 and is_double(point, radius)
        require(is_proved, f"mode {at}: no solution of this multiplicity is proved within the radius")
        for k, other in enumerate(modes, 1):
            differ = all(are_apart(system.kinds, point, form, radius + other.radius) for form in system.forms(other.centre))
            require(differ, f"modes {k} and {at}: they may be the same solution")
        modes.append(Mode(point, radius, is_real, multiplicity))
    return modes
