"""Reads the data of a certificate: a mechanism file (equations/README.md) in a strict form. Nothing may be left out or added."""
import re
from math import gcd

from flint import arb, arb_mat, fmpq

from closures import SLIDE, TURN, Chain, Platform
from motions import IDENTITY, along, column, dot, inverse, of_quaternion, turn
from quantities import by_half_tangent, expect, fields, is_exact, items, number, require, whole

# Keys of a joint by its type: length and angle of its link, displacement along and angle about its axis.
LINK = ("a", "alpha", "d")
KEYS = {"R": (*LINK, "theta0"), "P": ("a", "alpha", "d0", "theta"), "C": ("a", "alpha", "d0", "theta0"), "U": LINK, "S": LINK}
KEYS_BY_AXIS = {"R": ("axis", "point"), "P": ("axis",), "C": ("axis", "point")}
CARDAN = [TURN, turn(1, 0, 1), TURN, turn(1, 0, -1)]  # the second axis is x
UNKNOWNS = {"R": [TURN], "P": [SLIDE], "C": [TURN, SLIDE], "U": CARDAN, "S": [*CARDAN, TURN]}
HALF_TANGENT = re.compile(r"(-?)2\*atan\(([\d./]+)\)", re.ASCII)
RIGHT_ANGLES = {"0": (1, 0), "pi/2": (0, 1), "pi": (-1, 0), "-pi/2": (0, -1)}
NEAR = fmpq(1, 2**300)  # irrational numbers are known to 384 bits


def cos_sin(text):
    """Cosine and sine of an angle, exact for right angles and for those written by the tangent of their half."""
    if text in RIGHT_ANGLES:
        return tuple(map(fmpq, RIGHT_ANGLES[text]))
    if match := HALF_TANGENT.fullmatch(text):
        cos, sin = by_half_tangent(number(match[2]))
        return cos, -sin if match[1] else sin
    radians = arb(number(text))
    return radians.cos(), radians.sin()


def matrix(rows):
    """A constant motion, orthonormal exactly, or as far as its irrational numbers are known: then its rotation is as near."""
    *rows, last = [[number(x) for x in items(row, 4)] for row in items(rows, 4)]
    off = [dot(column(rows, i), column(rows, j)) - int(i == j) for i in range(3) for j in range(3)]
    are_exact = all(is_exact(row[:3]) for row in rows)
    is_rotation = all(x == 0 if are_exact else abs(x) < NEAR for x in off) and arb_mat([row[:3] for row in rows]).det() > 0
    require(is_rotation and last == IDENTITY[3], "data: a matrix is no rotation")
    return [[x if are_exact or j == 3 else x + arb(0, NEAR) for j, x in enumerate(row)] for row in rows] + [IDENTITY[3]]


def frame_on(u, p=[fmpq(0)] * 3):
    """A frame whose z axis goes through p in the direction u, moved by the half-turn about the line between both directions. So
    that every number counts, u is of whole numbers without a common factor, and p is the point nearest to the origin."""
    require(is_exact(u + p) and dot(u, p) == 0 and all(x.q == 1 for x in u) and gcd(*(int(x.p) for x in u)) == 1,
            "data: an axis is not written in the one form of certificates")
    square = dot(u, u).p
    length = square.isqrt() if square.is_square() else arb(square).sqrt()
    half = [u[0], u[1], u[2] + length] if u[:2] != [0, 0] or u[2] > 0 else [fmpq(1), fmpq(0), fmpq(0)]
    rows = of_quaternion(fmpq(0), *half)
    return [[*(y / dot(half, half) for y in row), x] for row, x in zip(rows, p)] + [IDENTITY[3]]


def system_of(data):
    """The closure equations of the mechanism."""
    mechanism = data["mechanism"]
    if mechanism["kind"] == "platform":
        fields(data, ("mechanism",))
        _, base, plate, squares = fields(mechanism, ("kind", "base", "plate", "legs_squared"))
        base, plate = ([[number(x) for x in items(point, 3)] for point in items(body, 6)] for body in (base, plate))
        return Platform(base, plate, [number(x) for x in items(squares, 6)])
    if mechanism["kind"] == "arm":
        pose, = items(fields(data, ("mechanism", "pose"))[1], 1)
        return chain(mechanism, ("base", "tool"), [inverse(matrix(*fields(pose, ("matrix",))))], [])
    expect(mechanism["kind"] == "loop", mechanism["kind"], "an arm, a loop or a platform")
    fields(data, ("mechanism",), ("input",))
    return chain(mechanism, (), [], items(data["input"], 1) if "input" in data else [])


def chain(mechanism, places, end, inputs):
    """The motions of all joints, one behind the other, are those round a loop: the pose of an arm stands inverted at the end."""
    is_by_axes = mechanism["convention"] == "screws"
    _, convention, joints, *_ = fields(mechanism, ("kind", "convention", "joints", *["home"] * is_by_axes), places)
    expect(convention in ("dh", "modified-dh", "screws"), convention, "a convention")
    base, home, tool = ([matrix(mechanism[key])] if key in mechanism else [] for key in ("base", "home", "tool"))
    unknowns, parts, spherical = [list(UNKNOWNS[joint["type"]]) for joint in items(joints)], base, []
    for given in inputs:
        hold(given, joints, unknowns)
    for joint, own in zip(joints, unknowns):
        if joint["type"] == "S":
            spherical.append(sum(part in (TURN, SLIDE) for part in parts))
        parts += about_axis(joint, own) if is_by_axes else about_z(joint, own, convention)
    return Chain([*parts, *home, *tool, *end], spherical)


def hold(given, joints, unknowns):
    """The input of a loop takes the place of an unknown."""
    key = "distance" if "distance" in given else "angle"
    at, value = fields(given, ("joint", key))
    kind, held = (SLIDE, along(0, 0, number(value))) if key == "distance" else (TURN, turn(2, *cos_sin(value)))
    expect(0 < whole(at) <= len(joints) and joints[at - 1]["type"] in "RPC" and kind in unknowns[at - 1], given, "a joint's angle or distance")
    unknowns[at - 1][unknowns[at - 1].index(kind)] = held


def about_z(joint, own, convention):
    """The constants of Denavit and Hartenberg: motions along and about the axis of a joint, and the normal to the next axis."""
    _, a, alpha, d, *theta = fields(joint, ("type", *KEYS[joint["type"]]))
    beside = [along(0, 0, number(d)), *(turn(2, *cos_sin(text)) for text in theta)]
    link = [along(number(a), 0, 0), turn(0, *cos_sin(alpha))]
    return [*link, *own, *beside] if convention == "modified-dh" else [*own, *beside, *link]


def about_axis(joint, own):
    _, *vectors = fields(joint, ("type", *KEYS_BY_AXIS[joint["type"]]))
    frame = frame_on(*([number(x) for x in items(vector, 3)] for vector in vectors))
    return [frame, *own, inverse(frame)]
