"""Reads the data of a certificate, and mechanism files (equations/README.md), of which such data are a strict form.

Of an arm or loop there remains F_1(x_1) L_1 ... F_n(x_n) L_n = 1: rotations about and translations along z, and constant links.
"""
import functools
import json
import tomllib
from math import gcd

from flint import arb, fmpq

from closures import SLIDE, TURN, Chain, Platform
from motions import IDENTITY, QUARTER, about_x, about_z, along, dot, inverse, of_quaternion, placement, times, turned
from quantities import UNITS, Refused, Unreadable, angle, by_half_tangent, expression, fields, is_exact, items, whole

LARGEST = 64 << 20  # bytes of a mechanism file
FAULTS = (ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, TypeError, ValueError)
# Keys of a joint by its type: length and angle of its link, displacement along and angle about its axis.
KEYS = {"R": ("a", "alpha", "d", "theta0"), "P": ("a", "alpha", "d0", "theta"), "C": ("a", "alpha", "d0", "theta0"),
        "U": ("a", "alpha", "d"), "S": ("a", "alpha", "d")}
CARDAN = [TURN, QUARTER, TURN, inverse(QUARTER)]
VARIABLES = {"R": [TURN], "P": [SLIDE], "C": [TURN, SLIDE], "U": CARDAN, "S": [*CARDAN, TURN]}


class Reader:
    """`strict` stands for the data of a certificate, in which nothing is left out and nothing may be added."""

    def __init__(self, document, strict):
        units = document.get("units", {})
        self.document, self.strict = document, strict
        self.length, self.angle = UNITS[units.get("length", "m")], UNITS[units.get("angle", "rad")]

    def systems(self, has_input=True):
        """The closure equations of every case; those of a loop without its input if it is asked whether it moves."""
        mechanism = self.document["mechanism"]
        kind = mechanism["kind"]
        if kind == "platform":
            self.check(self.document, "mechanism")
            self.check(mechanism, "kind", "base", "plate", "legs_squared")
            points = [[[self.size(x) for x in items(p, 3)] for p in items(mechanism[key], 6)] for key in ("base", "plate")]
            if "pose" in self.document:
                return [Platform(*points, legs_of(self.pose(pose), *points)) for pose in self.document["pose"]]
            return [Platform(*points, self.squares(legs)) for legs in self.document.get("legs", [mechanism])]
        if kind not in ("arm", "loop"):
            raise Unreadable(f"found the kind {str(kind)[:40]!r}, expected one of arm, loop, platform")
        screws = ("home",) if mechanism["convention"] == "screws" else ()
        if kind == "arm":
            self.check(self.document, "mechanism", "pose")
            self.check(mechanism, "kind", "convention", "joints", *screws, optional=("base", "tool"))
            return [self.chain(mechanism, None, self.pose(pose)) for pose in self.one(self.document["pose"])]
        self.check(self.document, "mechanism", optional=("input",) if has_input else ())
        self.check(mechanism, "kind", "convention", "joints", *screws)
        inputs = self.one(self.document["input"]) if has_input and "input" in self.document else [None]
        return [self.chain(mechanism, given, IDENTITY) for given in inputs]

    def check(self, table, *needed, optional=()):
        if self.strict:
            fields(table, needed, optional)

    def one(self, cases):
        return items(cases, 1) if self.strict else cases

    def size(self, text):
        """A length in metres."""
        value, has_unit = expression(text)
        return value if has_unit else value * self.length

    def turn(self, table, key, half):
        """Cosine and sine."""
        if half not in table:
            return angle(table.get(key, "0"), self.angle)
        return (fmpq(-1), fmpq(0)) if table[half] == "inf" else by_half_tangent(expression(table[half])[0])

    def squares(self, legs):
        lengths = legs.get("lengths", legs.get("legs"))
        if lengths:
            return [self.size(x) ** 2 for x in items(lengths, 6)]
        return [expression(x)[0] * self.length**2 for x in items(legs.get("squared", legs.get("legs_squared")), 6)]

    def matrix(self, rows):
        return placement([[expression(x)[0] for x in items(row, 4)[:3]] + [self.size(row[3])] for row in items(rows, 4)])

    def pose(self, table):
        self.check(table, "matrix")
        if "matrix" in table:
            return self.matrix(table["matrix"])
        rotation = of_quaternion(*(expression(x)[0] for x in items(table["quaternion"], 4)))
        place = [self.size(x) for x in items(table["position"], 3)]
        return placement([[*row, x] for row, x in zip(rotation, place)] + [IDENTITY[3]])

    def chain(self, mechanism, given, pose):
        convention = mechanism["convention"]
        if convention not in ("dh", "modified-dh", "screws"):
            raise Unreadable(f"found the convention {str(convention)[:40]!r}, expected dh, modified-dh or screws")
        place = {key: self.matrix(mechanism[key]) if key in mechanism else IDENTITY for key in ("base", "home", "tool")}
        joint_held, variable_held, value = self.held(given) if given is not None else (0, None, None)
        joints, parts, spherical = items(mechanism["joints"]), [place["base"]], []
        if given is not None and not 1 <= joint_held <= len(joints):
            raise Unreadable("found an input of a joint that is not there")
        for at, joint in enumerate(joints, 1):
            kind = joint.get("type") if isinstance(joint, dict) else None
            if kind not in VARIABLES:
                raise Unreadable(f"found the joint {str(joint)[:60]}, expected one of type {', '.join(VARIABLES)}")
            own = list(VARIABLES[kind])
            if at == joint_held:
                if kind in "US" or variable_held not in own:
                    raise Unreadable(f"joint {at} has no such variable")
                own[own.index(variable_held)] = value
            if kind == "S":
                spherical.append(sum(isinstance(part, str) for part in parts))
            if convention == "screws":
                frame = self.axis(joint, kind)
                parts += [frame, *own, inverse(frame)]
            else:
                before, link = self.link(joint, kind)
                parts += [*reversed(link), *own, before] if convention == "modified-dh" else [*own, before, *link]
        return Chain([*parts, place["home"], place["tool"], inverse(pose)], spherical)

    def held(self, given):
        """The joint and the variable of an input, and the motion that it is."""
        variable = SLIDE if "distance" in given else TURN
        self.check(given, "joint", "distance" if variable == SLIDE else "angle")
        joint = whole(given["joint"]) if self.strict else int(given["joint"])
        value = along(0, 0, self.size(given["distance"])) if variable == SLIDE else about_z(*self.turn(given, "angle", "tan_half"))
        return joint, variable, value

    def link(self, joint, kind):
        """The constant motion about and along the axis of a joint, which all commute, and that to the next axis."""
        self.check(joint, "type", *KEYS[kind])
        a, alpha, d, *theta = KEYS[kind]
        before = along(0, 0, self.size(joint.get(d, "0")))
        if theta:
            before = times(before, about_z(*self.turn(joint, theta[0], "tan_half_" + theta[0])))
        return before, [along(self.size(joint[a]), 0, 0), about_x(*self.turn(joint, alpha, "tan_half_" + alpha))]

    def axis(self, joint, kind):
        """A frame on an axis whose z axis has its direction: moved by the half-turn about the line between both directions.

        In a certificate every number counts: a direction is of whole numbers without a common factor, and a point of the
        axis is the one nearest to the origin.
        """
        if kind not in "RPC":
            raise Unreadable(f"found a joint of type {kind} given by its axis, expected R, P or C")
        self.check(joint, "type", "axis", *(() if kind == "P" else ("point",)))
        u = [expression(x)[0] for x in items(joint["axis"], 3)]
        p = [self.size(x) for x in items(joint.get("point", ["0"] * 3), 3)]
        along_axis = dot(u, p) / dot(u, u)
        if self.strict and not (is_exact(u + p) and along_axis == 0 and all(x.q == 1 for x in u) and gcd(*(int(x.p) for x in u)) == 1):
            raise Refused("data: an axis is not written in the one form of certificates")
        square = dot(u, u)
        is_square = is_exact([square]) and square.p.is_square() and square.q.is_square()
        length = fmpq(square.p.isqrt(), square.q.isqrt()) if is_square else arb(square).sqrt()
        half = [u[0], u[1], u[2] + length] if u[0] != 0 or u[1] != 0 or u[2] > 0 else [fmpq(1), fmpq(0), fmpq(0)]
        rows = [[2 * half[i] * half[j] / dot(half, half) - int(i == j) for j in range(3)] for i in range(3)]
        return [[*row, x - along_axis * y] for row, x, y in zip(rows, p, u)] + [IDENTITY[3]]


def legs_of(pose, base, plate):
    """The squared lengths of the legs at a pose."""
    ends = [[x + row[3] for x, row in zip(turned(pose, b), pose)] for b in plate]
    return [dot(gap, gap) for gap in ([x - y for x, y in zip(end, a)] for end, a in zip(ends, base))]


def is_same(one, other):
    """Whether two systems have the same constants, as far as balls tell."""
    shape = lambda system: (type(system), system.size, system.kinds, system.spherical)
    pairs = zip(one.constants(), other.constants())
    return shape(one) == shape(other) and all(x == y if is_exact((x, y)) else arb(x).overlaps(arb(y)) for x, y in pairs)


@functools.cache
def of_file(path, has_input):
    """The cases of a mechanism file."""
    try:
        with open(path, "rb") as file:
            text = file.read(LARGEST).decode()
        is_json = text.lstrip().startswith("{")
        document = json.loads(text, parse_int=str, parse_float=str) if is_json else tomllib.loads(text, parse_float=str)
        return Reader(document, False).systems(has_input)
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None
    except FAULTS as error:
        raise Unreadable(f"{path}: no mechanism file: {str(error)[:80]}") from None
