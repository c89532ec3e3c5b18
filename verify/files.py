"""Mechanism files (equations/README.md): their cases as the data of certificates, with which those of a certificate are compared."""
import functools
import json
import math
import tomllib

from four_bars import four_bars
from linkage_files import Planar
from mechanism import KEYS, matrix
from motions import difference, dot
from quantities import Refused, Unreadable, is_exact, items, number, require
from rounded import rotation_near, rotation_of
from sweep import system_of
from units import HALF_TANGENT, UNITS, by_half_tangent, in_units, right_angle

LARGEST = 64 << 20  # bytes of a mechanism file
FAULTS = (ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, SyntaxError, TypeError, ValueError)


class File:
    """A mechanism file, of which all numbers are texts."""

    def __init__(self, document):
        units = document.get("units", {})
        self.document, self.metre, self.radian = document, units.get("length", "m"), units.get("angle", "rad")

    def length(self, text):
        return in_units(text, self.metre)

    def angle(self, table, key):
        half = "tan_half" if key == "angle" else "tan_half_" + key
        if half in table:
            return "pi" if table[half] == "inf" else by_half_tangent(in_units(table[half], "m"))
        text = table.get(key, "0")
        if match := HALF_TANGENT.fullmatch(text):
            return by_half_tangent(f"{match[1]}({match[2]})")
        return right_angle(text, self.radian) or in_units(text, self.radian)

    def matrix(self, rows):
        *rows, last = items(rows, 4)
        rotation = [[in_units(x, "m") for x in row[:3]] for row in rows]
        values = [[*map(number, row)] for row in rotation]
        if all(map(is_exact, values)):
            rotation = [map(str, row) for row in rotation_near(values)]
        return [[*texts, self.length(row[3])] for texts, row in zip(rotation, rows)] + [last]

    def pose(self, table):
        if "matrix" in table:
            return self.matrix(table["matrix"])
        quaternion = [number(in_units(x, "m")) for x in items(table["quaternion"], 4)]
        require(is_exact(quaternion), "file: an irrational quaternion has no certificate")
        rows = zip(rotation_of(quaternion), items(table["position"], 3))
        return [[*map(str, row), self.length(x)] for row, x in rows] + [["0", "0", "0", "1"]]

    def joint(self, joint, convention):
        if convention == "screws":
            axis, point = ([number(self.length(x)) for x in items(joint.get(key, ["0"] * 3), 3)] for key in ("axis", "point"))
            require(is_exact(axis + point), "file: an irrational axis has no certificate")
            foot = [x - u * dot(axis, point) / dot(axis, axis) for x, u in zip(point, axis)]
            whole = [x * math.lcm(*(int(y.q) for y in axis)) for x in axis]
            axis = [x / math.gcd(*(int(y.p) for y in whole)) for x in whole]
            places = {} if joint["type"] == "P" else {"point": [*map(str, foot)]}
            return {"type": joint["type"], "axis": [*map(str, axis)], **places}
        a, alpha, d, *theta = KEYS[joint["type"]]
        angles = {key: self.angle(joint, key) for key in (alpha, *theta)}
        return {"type": joint["type"], a: self.length(joint[a]), d: self.length(joint.get(d, "0")), **angles}

    def chain(self, mechanism):
        places = {key: self.matrix(mechanism[key]) for key in ("base", "home", "tool") if key in mechanism}
        if mechanism["convention"] == "screws":
            places.setdefault("home", [[str(int(i == j)) for j in range(4)] for i in range(4)])
        joints = [self.joint(joint, mechanism["convention"]) for joint in mechanism["joints"]]
        return {"kind": mechanism["kind"], "convention": mechanism["convention"], "joints": joints, **places}

    def input(self, given):
        is_slide = "distance" in given
        value = {"distance": self.length(given["distance"])} if is_slide else {"angle": self.angle(given, "angle")}
        return {"joint": int(given["joint"]), **value}

    def squares(self, legs, base, plate):
        """The squares of the legs, which may be given by a pose."""
        if "matrix" in legs or "quaternion" in legs:
            pose = matrix(self.pose(legs))
            a, b = ([[number(x) for x in point] for point in body] for body in (base, plate))
            sides = [difference([dot(row, y) + row[3] for row in pose], x) for x, y in zip(a, b)]
            require(all(map(is_exact, sides)), "file: legs of an irrational pose have no certificate")
            return [str(dot(side, side)) for side in sides]
        if lengths := legs.get("lengths", legs.get("legs")):
            return [f"({text})*({text})" for text in map(self.length, lengths)]
        squares = legs.get("squared", legs.get("legs_squared"))
        return [f"({in_units(text, 'm')})*({UNITS[self.metre]})*({UNITS[self.metre]})" for text in squares]

    def cases(self, verb):
        """The data of every case, each as a function, as some have none."""
        document, mechanism = self.document, self.document["mechanism"]
        if verb == "sweep" or mechanism["kind"] == "linkage":
            return four_bars(self) if verb == "sweep" else Planar(self).cases()
        if mechanism["kind"] == "platform":
            base, plate = ([[*map(self.length, point)] for point in mechanism[key]] for key in ("base", "plate"))
            of_legs = lambda legs: {"mechanism": {
                "kind": "platform", "base": base, "plate": plate, "legs_squared": self.squares(legs, base, plate)}}
            return [functools.partial(of_legs, legs) for legs in document.get("pose", document.get("legs", [mechanism]))]
        if mechanism["kind"] == "arm":
            of_pose = lambda pose: {"mechanism": self.chain(mechanism), "pose": [{"matrix": self.pose(pose)}]}
            return [functools.partial(of_pose, pose) for pose in document["pose"]]
        of_loop = lambda **given: {"mechanism": self.chain(mechanism), **given}
        inputs = document.get("input", []) if verb != "mobility" else []
        return [lambda given=given: of_loop(input=[self.input(given)]) for given in inputs] or [of_loop]


def is_same(one, other):
    """Whether two systems have the same constants: rational ones are equal, of others balls overlap. A rational number is never the
    same as one that is not known to be rational: it might be a convergent of it, for which other theorems hold."""
    shape = lambda system: (type(system), system.size, system.equations, system.kinds, system.spherical)
    same = lambda x, y: x == y if is_exact((x, y)) else not is_exact([x]) and not is_exact([y]) and x.overlaps(y)
    return shape(one) == shape(other) and all(map(same, one.constants, other.constants))


@functools.cache
def systems(path, verb):
    """The closure equations of the cases of a mechanism file that a certificate can be about."""
    try:
        with open(path, "rb") as file:
            text = file.read(LARGEST).decode()
        is_json = text.lstrip().startswith("{")
        document = json.loads(text, parse_int=str, parse_float=str) if is_json else tomllib.loads(text, parse_float=str)
        return [system for case in File(as_texts(document)).cases(verb) if (system := system_or_none(case))]
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None
    except FAULTS as error:
        raise Unreadable(f"{path}: no mechanism file: {str(error)[:80]}") from None


def system_or_none(case):
    try:
        return system_of(case())
    except Refused:
        return None


def as_texts(value):
    """With every number as text."""
    if isinstance(value, dict):
        return {key: as_texts(own) for key, own in value.items()}
    return list(map(as_texts, value)) if isinstance(value, list) else str(value)


def is_about(system, path, verb):
    """Whether a file has a case with these closure equations."""
    return any(is_same(system, own) for own in systems(path, verb)) if system else False
