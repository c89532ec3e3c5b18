"""Reads the data of a certificate: a mechanism file (equations/README.md) in a strict form."""
import re

from flint import arb, fmpq

from closures import SLIDE, TURN, Chain, Platform
from expressions import expression
from frames import frame_on, placement
from motions import IDENTITY, along, inverse, times, turn
from quantities import Unreadable, by_half_tangent, fields, items, whole

# Keys of a joint by its type: length and angle of its link, displacement along and angle about its axis.
KEYS = {"R": ("a", "alpha", "d", "theta0"), "P": ("a", "alpha", "d0", "theta"), "C": ("a", "alpha", "d0", "theta0"),
        "U": ("a", "alpha", "d"), "S": ("a", "alpha", "d")}
QUARTER = turn(1, 0, 1)  # takes z to x
CARDAN = [TURN, QUARTER, TURN, inverse(QUARTER)]
VARIABLES = {"R": [TURN], "P": [SLIDE], "C": [TURN, SLIDE], "U": CARDAN, "S": [*CARDAN, TURN]}
HALF_TANGENT = re.compile(r"(-?)2\*atan\(([\d./]+)\)", re.ASCII)
RIGHT_ANGLES = {"0": (1, 0), "pi/2": (0, 1), "pi": (-1, 0), "-pi/2": (0, -1), "-pi": (-1, 0)}


def angle(text, unit=fmpq(1)):
    """Cosine and sine of an angle, exact for right angles and for those written by the tangent of their half."""
    if text in RIGHT_ANGLES:
        return tuple(map(fmpq, RIGHT_ANGLES[text]))
    if match := HALF_TANGENT.fullmatch(str(text)):
        cos, sin = by_half_tangent(expression(match.group(2)))
        return cos, -sin if match.group(1) else sin
    radians = arb(expression(text, unit))
    return radians.cos(), radians.sin()


class Reader:
    """Of a certificate nothing may be left out, and nothing may be added. Mechanism files allow more: files.py."""
    fields = staticmethod(fields)
    length = staticmethod(expression)

    def cos_sin(self, table, key):
        return angle(table[key])

    def pose(self, table):
        return self.matrix(*fields(table, ("matrix",)))

    def system(self, data, has_input=True):
        """The closure equations; those of a loop without its input if it is asked whether it moves."""
        mechanism = data["mechanism"]
        if mechanism["kind"] == "platform":
            fields(data, ("mechanism",))
            _, base, plate, squares = fields(mechanism, ("kind", "base", "plate", "legs_squared"))
            return Platform(self.points(base), self.points(plate), [expression(x) for x in items(squares, 6)])
        if mechanism["kind"] == "arm":
            pose, = items(fields(data, ("mechanism", "pose"))[1], 1)
            return self.chain(mechanism, self.pose(pose), None)
        fields(data, ("mechanism",), ("input",) if has_input else ())
        given, = items(data["input"], 1) if "input" in data else [None]
        return self.chain(mechanism, IDENTITY, given)

    def points(self, points):
        return [[self.length(x) for x in items(point, 3)] for point in items(points, 6)]

    def matrix(self, rows):
        *rows, last = (items(row, 4) for row in items(rows, 4))
        return placement([[*map(expression, row[:3]), self.length(row[3])] for row in rows] + [[*map(expression, last)]])

    def chain(self, mechanism, pose, given):
        """F_1(x_1) L_1 ... F_n(x_n) L_n = 1: rotations about and translations along z, and constant links."""
        kind, convention, joints = mechanism["kind"], mechanism["convention"], items(mechanism["joints"])
        if kind not in ("arm", "loop") or convention not in ("dh", "modified-dh", "screws"):
            raise Unreadable(f"found the kind {str(kind)[:40]!r} and the convention {str(convention)[:40]!r}")
        is_by_axes, places = convention == "screws", ("base", "tool") if kind == "arm" else ()
        self.fields(mechanism, ("kind", "convention", "joints", *["home"] * is_by_axes), places)
        base, home, tool = (self.matrix(mechanism[key]) if key in mechanism else IDENTITY for key in ("base", "home", "tool"))
        at, variable, value = self.held(given, len(joints)) if given is not None else (0, None, None)
        parts, spherical = [base], []
        for number, joint in enumerate(joints, 1):
            kind = joint["type"]
            own = list(VARIABLES[kind])
            if number == at:
                if kind in "US" or variable not in own:
                    raise Unreadable(f"joint {at} has no such variable")
                own[own.index(variable)] = value
            if kind == "S":
                spherical.append(sum(isinstance(part, str) for part in parts))
            if is_by_axes:
                if kind not in "RPC":
                    raise Unreadable(f"found a joint of type {kind} given by its axis, expected R, P or C")
                self.fields(joint, ("type", "axis", *["point"] * (kind != "P")))
                direction, point = items(joint["axis"], 3), items(joint.get("point", ["0"] * 3), 3)
                frame = frame_on([*map(expression, direction)], [*map(self.length, point)], type(self) is Reader)
                parts += [frame, *own, inverse(frame)]
            else:
                before, link = self.link(joint, kind)
                parts += [link, *own, before] if convention == "modified-dh" else [*own, before, link]
        return Chain([*parts, home, tool, inverse(pose)], spherical)

    def held(self, given, count):
        """The joint and the variable of an input, and the motion that it is."""
        is_slide = "distance" in given
        self.fields(given, ("joint", "distance" if is_slide else "angle"))
        if not 1 <= (joint := whole(given["joint"])) <= count:
            raise Unreadable("found an input of a joint that is not there")
        if is_slide:
            return joint, SLIDE, along(0, 0, self.length(given["distance"]))
        return joint, TURN, turn(2, *self.cos_sin(given, "angle"))

    def link(self, joint, kind):
        """The constant motion about and along the axis of a joint, and that about and along the normal to the next axis."""
        a, alpha, d, *theta = KEYS[kind]
        self.fields(joint, ("type", *KEYS[kind]))
        before = along(0, 0, self.length(joint.get(d, "0")))
        if theta:
            before = times(before, turn(2, *self.cos_sin(joint, *theta)))
        return before, times(along(self.length(joint[a]), 0, 0), turn(0, *self.cos_sin(joint, alpha)))
