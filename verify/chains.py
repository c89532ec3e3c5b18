"""Closure equations of arms and loops, derived from their data.

The loop is F_1(x_1) ... F_n(x_n) = 1 with motions F = A + cos(x) B + sin(x) C of rotations and F = A + x B of translations.
"""
from flint import acb, acb_mat, arb, fmpq

from quantities import Refused, Unreadable, angle, count, fields, items, number, rational

IDENTITY = [[int(i == j) for j in range(4)] for i in range(4)]


def matrix(rows):
    return [[rows[i][j] for j in range(4)] for i in range(4)]


def times(a, b):
    return [[sum((a[i][k] * b[k][j] for k in range(4)), 0) for j in range(4)] for i in range(4)]


def chain(parts):
    product = parts[0]
    for part in parts[1:]:
        product = times(product, part)
    return product


def inverse(m):
    turned = [[m[j][i] for j in range(3)] for i in range(3)]
    return [row + [-sum((row[k] * m[k][3] for k in range(3)), 0)] for row in turned] + [[0, 0, 0, 1]]


class Known:
    """A number or motion as balls, and as rationals where all it is made of is rational."""

    def __init__(self, balls, exact):
        self.balls, self.exact = balls, exact

    def __matmul__(self, other):
        exact = self.exact is not None and other.exact is not None
        return Known(times(self.balls, other.balls), times(self.exact, other.exact) if exact else None)

    def inverse(self):
        return Known(inverse(self.balls), None if self.exact is None else inverse(self.exact))


def built(make, *parts):
    """A matrix made from known numbers."""
    exact = all(part[1] is not None for part in parts)
    return Known(make(*(p[0] for p in parts)), make(*(p[1] for p in parts)) if exact else None)


def along(axis, distance):
    return built(lambda x: [[*IDENTITY[i][:3], x if i == axis else 0] for i in range(3)] + [[0, 0, 0, 1]], number(distance))


def about_x(text):
    return built(lambda cs: [[1, 0, 0, 0], [0, cs[0], -cs[1], 0], [0, cs[1], cs[0], 0], [0, 0, 0, 1]], angle(text))


def about_z(text):
    return built(lambda cs: [[cs[0], -cs[1], 0, 0], [cs[1], cs[0], 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]], angle(text))


def primitive(values, what):
    """Integers without a common factor: a direction has one form only."""
    parts = [rational(value) for value in values]
    if any(p is None or p.q != 1 for p in parts):
        raise Unreadable(f"{what}: found {str(values)[:60]}, expected whole numbers")
    common = 0
    for p in parts:
        common = p.p.gcd(common)
    if common != 1:
        raise Refused(f"{what}: the numbers are not without a common factor")
    return parts


def placement(rows, what):
    """A constant motion: an orthonormal matrix as it is, else the rotation nearest to it."""
    if rows is None:
        return Known(IDENTITY, IDENTITY)
    entries = [[number(entry) for entry in items(row, 4)] for row in items(rows, 4)]
    if [entry[1] for entry in entries[3]] != [0, 0, 0, 1]:
        raise Unreadable(f"{what}: found another last row than 0 0 0 1")
    exact, balls = ([[entry[k] for entry in row[:3]] for row in entries[:3]] for k in (1, 0))
    place = [row[3] for row in entries[:3]]
    gram = lambda i, j: sum(exact[k][i] * exact[k][j] for k in range(3)) - int(i == j)
    is_exact = all(e is not None for row in exact for e in row)
    if not is_exact or any(gram(i, j) != 0 for i in range(3) for j in range(3)):
        exact = datum(nearest_rotation(balls, what))
        balls = [[arb(x) for x in row] for row in exact]
    if not determinant(balls) > 0:
        raise Refused(f"{what}: a reflection is no rotation")
    make = lambda r, p: [[*r[i], p[i]] for i in range(3)] + [[0, 0, 0, 1]]
    known = exact is not None and all(p[1] is not None for p in place)
    return Known(make(balls, [p[0] for p in place]), make(exact, [p[1] for p in place]) if known else None)


def determinant(m):
    cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    return sum(x * y for x, y in zip(m[0], cross(m[1], m[2])))


def nearest_rotation(m, what):
    """The polar factor: a step M (3 - M'M)/2 keeps it, and where |M'M - 1| <= e, M is no farther than e from it."""
    gram = lambda i, j: sum(m[k][i] * m[k][j] for k in range(3)) - int(i == j)
    off = lambda: max((gram(i, j).abs_upper() for i in range(3) for j in range(3)))
    if not off() < 0.01:
        raise Refused(f"{what}: the matrix is no rotation")
    for _ in range(8):
        part = [[(3 * int(i == j) - sum(m[k][i] * m[k][j] for k in range(3))) / 2 for j in range(3)] for i in range(3)]
        m = [[sum(m[i][k] * part[k][j] for k in range(3)) for j in range(3)] for i in range(3)]
    off = 3 * off()
    return [[x + arb(0, off) for x in row] for row in m]


def datum(m):
    """The rotation of the quaternion of m, rounded to four integers over 2^60."""
    s = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]
    d = [1 + sum(a * m[k][k] for k, a in enumerate(row)) for row in s]
    low, high = (lambda i, j: m[i][j] - m[j][i]), (lambda i, j: m[i][j] + m[j][i])
    table = [[d[0], low(2, 1), low(0, 2), low(1, 0)], [low(2, 1), d[1], high(0, 1), high(0, 2)],
             [low(0, 2), high(0, 1), d[2], high(1, 2)], [low(1, 0), high(0, 2), high(1, 2), d[3]]]
    row = max(range(4), key=lambda k: float(d[k].mid()))
    norm = sum(x * x for x in table[row]).sqrt()
    w, x, y, z = (fmpq((v / norm * 2**60 + arb(0.5)).mid().floor().unique_fmpz()) for v in table[row])
    n = w * w + x * x + y * y + z * z
    return [[1 - 2 * (y * y + z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
            [2 * (x * y + w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - w * x) / n],
            [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, 1 - 2 * (x * x + y * y) / n]]


def balls(m):
    return acb_mat(4, 4, [acb(m[i][j]) for i in range(4) for j in range(4)])


QUARTER = Known(*2 * [[[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]]])  # takes z to x
JOINTS = {"R": ("a", "alpha", "d", "theta0"), "P": ("a", "alpha", "theta", "d0"), "C": ("a", "alpha", "theta0", "d0"),
          "U": ("a", "alpha", "d"), "S": ("a", "alpha", "d")}
LETTERS = {"R": "R", "P": "P", "C": "RP", "U": "RR", "S": "S"}


def dh_joint(value, first):
    """The links and variables of a joint: constant motions, and True (rotation about z) or False (translation along z)."""
    kind = value.get("type") if isinstance(value, dict) else None
    if kind not in JOINTS:
        raise Unreadable(f"found the joint {str(value)[:60]}, expected one of type {', '.join(JOINTS)}")
    own = dict(zip(("type", *JOINTS[kind]), fields(value, ("type", *JOINTS[kind]))))
    link = [along(0, own["a"]), about_x(own["alpha"])]
    if kind == "R":
        joint = [True, about_z(own["theta0"]), along(2, own["d"])]
    elif kind == "P":
        joint = [about_z(own["theta"]), False, along(2, own["d0"])]
    elif kind == "C":
        joint = [True, False, about_z(own["theta0"]), along(2, own["d0"])]
    else:
        joint = [True, QUARTER, True, QUARTER.inverse()] + ([True] if kind == "S" else []) + [along(2, own["d"])]
    return (link[::-1] + joint if first else joint + link), LETTERS[kind]


def screw_joint(value):
    kind = value.get("type") if isinstance(value, dict) else None
    if kind not in ("R", "P", "C"):
        raise Unreadable(f"found the joint {str(value)[:60]}, expected one of type R, P or C")
    keys = ("type", "axis") if kind == "P" else ("type", "axis", "point")
    _, axis, point = (*fields(value, keys), None)[:3]
    u = primitive(items(axis, 3), "an axis")
    p = [rational(x) for x in items(point, 3)] if point is not None else [fmpq(0)] * 3
    if any(x is None for x in p):
        raise Unreadable(f"found the point {str(point)[:60]}, expected three fractions")
    if sum(x * y for x, y in zip(u, p)) != 0:
        raise Refused("a point of an axis is not the one nearest to the origin")
    square = sum(x * x for x in u)
    exact = fmpq(square.p.isqrt()) if square.p.is_square() else None
    frame = Known(onto_axis(u, p, arb(square).sqrt()), None if exact is None else onto_axis(u, p, exact))
    return [frame, *{"R": [True], "P": [False], "C": [True, False]}[kind], frame.inverse()], LETTERS[kind]


def onto_axis(u, p, length):
    """A frame at p whose z axis is along u: the half-turn about the line between both, or about the x axis."""
    m = [u[0], u[1], u[2] + length] if u[0] != 0 or u[1] != 0 or u[2] > 0 else [fmpq(1), fmpq(0), fmpq(0)]
    square = sum(x * x for x in m)
    return [[*(2 * m[i] * m[j] / square - int(i == j) for j in range(3)), p[i]] for i in range(3)] + [[0, 0, 0, 1]]


class Chain:
    """V_1(x_1) L_1 ... V_n(x_n) L_n = 1, rotations about and translations along z."""

    def __init__(self, data):
        kind = data["mechanism"]["kind"]
        mechanism, cases = fields(data, ("mechanism", "pose") if kind == "arm" else ("mechanism",), () if kind == "arm" else ("input",))
        screws = mechanism.get("convention") == "screws"
        needed = ("kind", "convention", "joints") + (("home",) if screws else ())
        found = dict(zip((*needed, "base", "tool"), fields(mechanism, needed, ("base", "tool") if kind == "arm" else ())))
        convention, base, tool = found["convention"], found.get("base"), found.get("tool")
        given = items(cases, 1)[0] if cases is not None else None
        if convention not in ("dh", "modified-dh", "screws"):
            raise Unreadable(f"found the convention {str(convention)[:40]!r}, expected dh, modified-dh or screws")
        parts, self.letters = [placement(base, "base")], ""
        joint, which, value = self.given(None if kind == "arm" else given)
        for at, item in enumerate(items(found["joints"]), 1):
            own, letters = screw_joint(item) if screws else dh_joint(item, convention == "modified-dh")
            if at == joint:
                here = own.index(which) if any(x is which for x in own) and "S" not in letters and "U" != item["type"] else None
                if here is None:
                    raise Unreadable(f"joint {at} has no such variable")
                own[here], letters = value, letters.replace("R" if which else "P", "", 1)
                joint = None
            parts += own
            self.letters += letters
        if joint is not None:
            raise Unreadable("found an input of a joint that is not there")
        parts += [placement(found.get("home"), "home"), placement(tool, "tool")]
        if kind == "arm":
            parts.append(placement(fields(given, ("matrix",))[0], "pose").inverse())
        self.turns = [part for part in parts if isinstance(part, bool)]
        links, behind = [], Known(IDENTITY, IDENTITY)
        for part in reversed(parts):
            if isinstance(part, bool):
                links.insert(0, behind)
                behind = Known(IDENTITY, IDENTITY)
            else:
                behind = part @ behind
        if not links:
            raise Unreadable("found no joint that moves")
        links[-1] = links[-1] @ behind
        self.links, self.size = links, len(links)
        self.balls = [balls(link.balls) for link in links]
        self.spherical = [at + 2 * self.letters[:at].count("S") for at, letter in enumerate(self.letters) if letter == "S"]

    def given(self, value):
        if value is None:
            return None, None, None
        if not isinstance(value, dict) or "angle" not in value and "distance" not in value:
            raise Unreadable(f"found the input {str(value)[:60]}, expected a joint and its angle or distance")
        which = "angle" in value
        joint, text = fields(value, ("joint", "angle" if which else "distance"))
        return count(joint), which, about_z(text) if which else along(2, text)

    def motion(self, k, x):
        c, s = (x.cos(), x.sin()) if self.turns[k] else (acb(1), acb(0))
        z = 0 if self.turns[k] else x
        return acb_mat(4, 4, [c, -s, 0, 0, s, c, 0, 0, 0, 0, 1, z, 0, 0, 0, 1]) * self.balls[k]

    def slope(self, k, x):
        c, s = (x.cos(), x.sin()) if self.turns[k] else (0, 0)
        z = 0 if self.turns[k] else 1
        return acb_mat(4, 4, [-s, -c, 0, 0, c, -s, 0, 0, 0, 0, 0, z, 0, 0, 0, 0]) * self.balls[k]

    def product(self, x):
        product = self.motion(0, x[0])
        for k in range(1, self.size):
            product = product * self.motion(k, x[k])
        return product

    def values(self, x):
        return six(self.product(x))

    def jacobian(self, x):
        motions = [self.motion(k, x[k]) for k in range(self.size)]
        behind = [balls(IDENTITY)]
        for motion in reversed(motions[1:]):
            behind.insert(0, motion * behind[0])
        columns, before = [], balls(IDENTITY)
        for k in range(self.size):
            columns.append(six(before * self.slope(k, x[k]) * behind[k]))
            before = before * motions[k]
        return acb_mat(6, 6, [columns[k][i] for i in range(6) for k in range(6)])

    def check_solution(self, at, box):
        """Where the six equations hold the rotation is 1 or a half-turn, of trace 3 or -1."""
        product = self.product(box)
        trace = product[0, 0] + product[1, 1] + product[2, 2]
        if not (trace + 1).abs_lower() > 0:
            raise Refused(f"mode {at}: the loop may close by a half-turn there")

    def apart(self, one, other, radius):
        """Whether balls of these radii together hold no common configuration: angles modulo 2 pi, and a spherical joint has
        two triples of angles for every rotation."""
        forms = [other]
        for at in self.spherical:
            forms += [[*x[:at], x[at] + arb.pi(), -x[at + 1], x[at + 2] + arb.pi(), *x[at + 3:]] for x in forms]
        return all(any(self.far(k, one[k] - form[k], radius) for k in range(self.size)) for form in forms)

    def far(self, k, difference, radius):
        turns = (-2, -1, 0, 1, 2) if self.turns[k] else (0,)
        if self.turns[k] and not abs(difference.real) < 12:
            return False
        return all((difference - 2 * turn * arb.pi()).abs_lower() > radius for turn in turns)


def six(m):
    return [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], m[0, 3], m[1, 3], m[2, 3]]
