"""Closure equations, and the proof that a ball holds one solution of them: theorem 1 of docs/certificate.md."""
from flint import acb, acb_mat, acb_series, arb, fmpq

from motions import IDENTITY, along, column, difference, dot, of_quaternion, times, turn
from quantities import Refused, Unreadable, decimal, fields, items, whole

TURN, SLIDE = "turn", "slide"
MOST_RADIUS = fmpq(1, 1000)


class Chain:
    """V_1(x_1) L_1 ... V_n(x_n) L_n = 1, rotations about and translations along z."""

    def __init__(self, parts, spherical):
        self.kinds, self.links, self.spherical = [], [IDENTITY], spherical
        for part in parts:
            if part in (TURN, SLIDE):
                self.kinds.append(part)
                self.links.append(IDENTITY)
            else:
                self.links[-1] = times(self.links[-1], part)
        if not self.kinds:
            raise Unreadable("found no joint that moves")
        self.first, *self.links = self.links
        self.links[-1] = times(self.links[-1], self.first)
        self.size = len(self.links)

    def constants(self):
        return [x for link in self.links for row in link for x in row]

    def around(self, x):
        """The motion round the loop, of cosine and sine or the distance of every unknown."""
        moved = [turn(2, *own) if kind == TURN else along(0, 0, *own) for kind, own in zip(self.kinds, x)]
        return times(*(part for pair in zip(moved, self.links) for part in pair))

    def parts(self, x):
        return [(t.cos(), t.sin()) if kind == TURN else (t,) for kind, t in zip(self.kinds, x)]

    def values(self, x):
        return six(self.around(self.parts(x)))

    def is_solution(self, box):
        """Where the six equations hold the rotation is 1 or a half-turn, of trace 3 or -1."""
        m = self.around(self.parts(box))
        return (m[0][0] + m[1][1] + m[2][2] + 1).abs_lower() > 0

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
    size, kinds, spherical = 7, [SLIDE] * 7, []

    def __init__(self, base, plate, squares):
        self.base, self.plate, self.squares = base, plate, squares

    def constants(self):
        return [x for points in (self.base, self.plate, [self.squares]) for point in points for x in point]

    def values(self, x):
        rotation = of_quaternion(*x[:4])
        legs = [[dot(row, b) + y - z for row, y, z in zip(rotation, x[4:], a)] for a, b in zip(self.base, self.plate)]
        return [sum(y * y for y in x[:4]) - 1, *(dot(leg, leg) - square for leg, square in zip(legs, self.squares))]

    def is_solution(self, box):
        return True

    def forms(self, x):
        """A quaternion and its negative are one pose."""
        return [x, [*(-y for y in x[:4]), *x[4:]]]


def centre_of(system, mode):
    parts = [items(part, 2) if isinstance(part, list) else (part, "0") for part in items(mode["centre"], system.size)]
    return [acb(decimal(re), decimal(im)) for re, im in parts], arb(decimal(mode["radius"]))


def box_of(point, radius):
    """All numbers whose parts differ by at most `radius` from those of the centre."""
    off = arb(0, radius)
    return [acb(x.real + off, x.imag + off) for x in point]


def jacobian(system, x):
    """The derivatives of the equations, by power series in each unknown up to the first power."""
    zero = acb_series([0], prec=2)
    columns = [system.values([acb_series([t, int(j == k)], prec=2) for j, t in enumerate(x)]) for k in range(system.size)]
    return acb_mat([[(zero + value)[1] for value in column] for column in columns]).transpose()


def holds_one(system, point, radius):
    """Whether the ball holds exactly one zero of the closure equations, and this is a solution."""
    box = box_of(point, radius)
    slope = jacobian(system, box)
    try:
        inverse = slope.mid().inv().mid()
    except ZeroDivisionError:
        return False
    step, rest = inverse * acb_mat([[value] for value in system.values(point)]), inverse * slope - 1
    bends = [sum((x.abs_upper() for x in row), arb(0)) for row in rest.tolist()]
    return system.is_solution(box) and all(
        bend < 1 and x.abs_upper() + bend * radius < radius for x, bend in zip(step.entries(), bends))


def differ(kind, difference, radius):
    """Whether the difference of an unknown is larger than the radius, that of angles modulo 2 pi."""
    turns = range(-2, 3) if kind == TURN else [0]
    is_near = kind == SLIDE or abs(difference.real) < 12
    return is_near and all((difference - 2 * n * arb.pi()).abs_lower() > radius for n in turns)


def proved_modes(system, values):
    """All modes as (centre, radius, is real): each ball holds one solution, real or not as it says, and all differ."""
    modes = []
    for at, value in enumerate(items(values), 1):
        point, radius = centre_of(system, value)
        _, size, real, multiplicity = fields(value, ("centre", "radius", "real", "multiplicity"))
        if not isinstance(real, bool):
            raise Unreadable(f"mode {at}: found {str(real)[:20]!r} as `real`, expected true or false")
        if not 0 < decimal(size) <= MOST_RADIUS:
            raise Refused(f"mode {at}: the radius is not above 0 and at most 1/1000")
        if whole(multiplicity) != 1:
            raise Refused(f"mode {at}: multiplicity {multiplicity}, where a ball of an isolated simple solution counts 1")
        if not holds_one(system, point, radius):
            raise Refused(f"mode {at}: no solution is proved within the radius")
        if real and any(x.imag != 0 for x in point) or not real and not any(x.imag.abs_lower() > radius for x in point):
            raise Refused(f"mode {at}: its ball does not show that it is real or not real as it says")
        for k, (other, room, _) in enumerate(modes, 1):
            if not all(any(differ(*three, radius + room) for three in zip(system.kinds, difference(point, form)))
                       for form in system.forms(other)):
                raise Refused(f"modes {k} and {at}: they may be the same solution")
        modes.append((point, radius, real))
    return modes
