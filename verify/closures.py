"""Closure equations, and the proof that a ball holds one solution of them: theorem 1 of docs/certificate.md."""
from flint import acb, acb_mat, arb, fmpq

from motions import IDENTITY, about_x, about_z, along, chain, column, dot, inverse, of_quaternion, times, turned
from quantities import Refused, Unreadable, by_half_tangent, decimal, fields, items, whole

TURN, SLIDE = "turn", "slide"
MOST_RADIUS = arb(1) / 1000
FAR = 2**20


class Chain:
    """V_1(x_1) L_1 ... V_n(x_n) L_n = 1, rotations about and translations along z."""

    def __init__(self, parts, spherical):
        self.kinds, self.links, self.spherical, before = [], [], spherical, IDENTITY
        for part in parts:
            if part in (TURN, SLIDE):
                self.links.append(before)
                self.kinds.append(part)
                before = IDENTITY
            else:
                before = times(before, part)
        if not self.kinds:
            raise Unreadable("found no joint that moves")
        self.first, self.links = self.links[0], [*self.links[1:], times(before, self.links[0])]
        self.size = len(self.links)

    def constants(self):
        return [x for link in self.links for row in link for x in row]

    def longer(self):
        """With rotations about axes that nothing distinguishes behind its last link, up to six unknowns."""
        parts = [part for pair in zip(self.kinds, self.links) for part in pair]
        for k in range(6 - self.size):
            cos, sin = by_half_tangent(fmpq(3, 5 + 2 * k))
            about_y = [[cos, 0, sin, 0], IDENTITY[1], [-sin, 0, cos, 0], IDENTITY[3]]
            about_x_axis = about_x(*by_half_tangent(fmpq(2 + k, 7)))
            frame = chain([inverse(self.first), along(fmpq(k + 1, 3), fmpq(1, k + 2), 0), about_x_axis, about_y])
            parts += [frame, TURN, inverse(frame)]
        return Chain(parts, self.spherical) if self.size < 6 else self

    def product(self, x):
        return self.around([(t.cos(), t.sin()) if kind == TURN else (t,) for kind, t in zip(self.kinds, x)])

    def around(self, x):
        """The motion round the loop, of cosine and sine or the distance of every unknown."""
        moved = [about_z(*own) if kind == TURN else along(0, 0, *own) for kind, own in zip(self.kinds, x)]
        return chain(part for pair in zip(moved, self.links) for part in pair)

    def values(self, x):
        return six(self.product(x))

    def jacobian(self, x):
        """Central differences, which are derivatives here: f(t) = a + b cos(t) + c sin(t) has f(t + pi/2) - f(t - pi/2) = 2 f'(t),
        and f(t) = a + b t has f(t + 1) - f(t - 1) = 2 f'(t)."""
        columns = []
        for k, kind in enumerate(self.kinds):
            step = arb.pi() / 2 if kind == TURN else 1
            ahead, back = (self.values([*x[:k], x[k] + by, *x[k + 1:]]) for by in (step, -step))
            columns.append([(u - v) / 2 for u, v in zip(ahead, back)])
        return acb_mat(columns).transpose()

    def check_solution(self, box):
        """Where the six equations hold the rotation is 1 or a half-turn, of trace 3 or -1."""
        m = self.product(box)
        return (m[0][0] + m[1][1] + m[2][2] + 1).abs_lower() > 0

    def forms(self, x):
        """A spherical joint has two triples of angles for every rotation."""
        forms = [x]
        for k in self.spherical:
            forms += [[*y[:k], y[k] + arb.pi(), -y[k + 1], y[k + 2] + arb.pi(), *y[k + 3:]] for y in forms]
        return forms

    def differ(self, k, difference, radius):
        """Whether a difference of the unknowns k is larger than the radius, that of angles modulo 2 pi."""
        if self.kinds[k] == SLIDE:
            return difference.abs_lower() > radius
        turns = range(-2, 3)
        return abs(difference.real) < 12 and all((difference - 2 * n * arb.pi()).abs_lower() > radius for n in turns)


def six(m):
    """What is 0 where a loop is closed: the skew part of the rotation, and the translation."""
    return [m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], *column(m, 3)]


class Platform:
    """|x|^2 = 1 and |p + R b - a|^2 = l^2 for the six legs; x is the quaternion of R, and the unknowns are x and p."""
    size, kinds, spherical = 7, "platform", []

    def longer(self):
        return self

    def __init__(self, base, plate, squares):
        self.base, self.plate, self.squares = base, plate, squares

    def constants(self):
        return [x for points in (self.base, self.plate, [self.squares]) for point in points for x in point]

    def values(self, x):
        """With |x| = 1: p.p + b.b + a.a + 2 (p - a).R b - 2 a.p - l^2."""
        q, p = x[:4], x[4:]
        rotation, values = of_quaternion(*q, norm=1), [sum(y * y for y in q) - 1]
        for a, b, square in zip(self.base, self.plate, self.squares):
            mixed = dot([u - v for u, v in zip(p, a)], turned(rotation, b)) - dot(a, p)
            values.append(dot(p, p) + dot(b, b) + dot(a, a) + 2 * mixed - square)
        return values

    def jacobian(self, x):
        """R is of degree 2 in each number of q: R(q + h) - R(q - h) is 2 h times its derivative. Of a ball much is lost if h is small."""
        q, p = x[:4], x[4:]
        slopes, rows = [], [[2 * y for y in q] + [0] * 3]
        for k in range(4):
            ahead, back = (of_quaternion(*q[:k], q[k] + by, *q[k + 1:], norm=1) for by in (FAR, -FAR))
            slopes.append([[(u - v) / (2 * FAR) for u, v in zip(*both)] for both in zip(ahead, back)])
        for a, b in zip(self.base, self.plate):
            gap, end = [u - v for u, v in zip(p, a)], turned(of_quaternion(*q, norm=1), b)
            rows.append([2 * dot(gap, turned(slope, b)) for slope in slopes] + [2 * (u + v) for u, v in zip(gap, end)])
        return acb_mat(rows)

    def check_solution(self, box):
        """Every solution of the seven equations is a pose."""
        return True

    def forms(self, x):
        """A quaternion and its negative are one pose."""
        return [x, [-y if k < 4 else y for k, y in enumerate(x)]]

    def differ(self, k, difference, radius):
        return difference.abs_lower() > radius


def centre_of(system, mode):
    parts = [items(part, 2) if isinstance(part, list) else (part, "0") for part in items(mode["centre"], system.size)]
    return [acb(decimal(re), decimal(im)) for re, im in parts], arb(decimal(mode["radius"]))


def box_of(point, radius):
    """All numbers whose parts differ by at most `radius` from those of the centre."""
    off = arb(0, radius)
    return [acb(x.real + off, x.imag + off) for x in point]


def prove(system, point, radius):
    """Whether the ball holds exactly one zero of the closure equations, and this is a solution."""
    box, size = box_of(point, radius), system.size
    value, slope = acb_mat(size, 1, system.values(point)), system.jacobian(box)
    try:
        inverse = acb_mat(size, size, [x.mid() for x in acb_mat(size, size, [x.mid() for x in slope.entries()]).inv().entries()])
    except ZeroDivisionError:
        return False
    step, rest = inverse * value, acb_mat(size, size, [int(i % (size + 1) == 0) for i in range(size * size)]) - inverse * slope
    for i in range(size):
        bend = sum((rest[i, j].abs_upper() for j in range(size)), arb(0))
        if not (bend < 1 and step[i, 0].abs_upper() + bend * radius < radius):
            return False
    return system.check_solution(box)


def proved_modes(system, values):
    """All modes as (centre, radius, is real): each ball holds one solution, real or not as it says, and all differ."""
    modes = []
    for at, value in enumerate(items(values), 1):
        point, radius = centre_of(system, value)
        _, _, real, multiplicity = fields(value, ("centre", "radius", "real", "multiplicity"))
        if not isinstance(real, bool):
            raise Unreadable(f"mode {at}: found {str(real)[:20]!r} as `real`, expected true or false")
        if not 0 < radius < MOST_RADIUS:
            raise Refused(f"mode {at}: the radius is not between 0 and 1/1000")
        if whole(multiplicity) != 1:
            raise Refused(f"mode {at}: multiplicity {multiplicity}, where a ball of an isolated simple solution counts 1")
        if not prove(system, point, radius):
            raise Refused(f"mode {at}: no solution is proved within the radius")
        if real and any(x.imag != 0 for x in point):
            raise Refused(f"mode {at}: said to be real, but its centre is not")
        if not real and not any(x.imag.abs_lower() > radius for x in point):
            raise Refused(f"mode {at}: said not to be real, but its ball holds real points")
        for k, (other, room, _) in enumerate(modes, 1):
            if not all(any(system.differ(j, x - y, radius + room) for j, (x, y) in enumerate(zip(point, form)))
                       for form in system.forms(other)):
                raise Refused(f"modes {k} and {at}: they may be the same solution")
        modes.append((point, radius, real))
    return modes
