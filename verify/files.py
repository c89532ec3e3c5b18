"""Mechanism files (equations/README.md): their cases as the data of certificates, with which those of a certificate are compared."""
import functools
import math

from flint import fmpq

from documents import document_of
from four_bars import four_bars
from linkage_files import Planar
from mechanism import KEYS, matrix
from motions import difference, dot
from quantities import Refused, Unreadable, is_exact, items, number, require
from rounded import rotation_near, rotation_of
from sweep import system_of
from units import UNITS, angle_text, by_half_tangent, number_text

KINDS = ("arm", "loop", "platform", "linkage")  # of which there are certificates, where their numbers are given
NARROW = fmpq(1, 2**280)  # irrational numbers are known to 384 bits, rotation matrices to 300
FAULTS = (ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, SyntaxError, TypeError, ValueError)


class File:
    """A mechanism file, of which all numbers are texts."""

    def __init__(self, document):
        units = document.get("units", {})
        self.document, self.metre, self.radian = document, units.get("length", "m"), units.get("angle", "rad")

    def length(self, text):
        return number_text(text, self.metre)

    def angle(self, table, key, half):
        if half in table:
            return "pi" if table[half] == "inf" else by_half_tangent(number_text(table[half]))
        return angle_text(table.get(key, "0") if key == "theta0" else table[key], self.radian)

    def matrix(self, rows):
        *rows, last = items(rows, 4)
        rotation = [[*map(number_text, row[:3])] for row in rows]
        values = [[*map(number, row)] for row in rotation]
        if all(map(is_exact, values)):
            rotation = [map(str, row) for row in rotation_near(values)]
        return [[*texts, self.length(row[3])] for texts, row in zip(rotation, rows)] + [last]

    def pose(self, table):
        if "matrix" in table:
            return self.matrix(table["matrix"])
        quaternion = [number(number_text(x)) for x in items(table["quaternion"], 4)]
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
        angles = {key: self.angle(joint, key, f"tan_half_{key}") for key in (alpha, *theta)}
        return {"type": joint["type"], a: self.length(joint[a]), d: self.length(joint.get(d, "0")), **angles}

    def bond(self, bond):
        """A bond of a ring of atoms, about itself: the twist is what is missing to half a turn at its atom."""
        return {"type": "R", "a": "0", "alpha": angle_text(f"pi-({self.angle(bond, 'angle', 'tan_half_angle')})"), "d": self.length(bond["length"]), "theta0": "0"}

    def chain(self, mechanism):
        places = {key: self.matrix(mechanism[key]) for key in ("base", "home", "tool") if key in mechanism}
        if mechanism["convention"] == "screws":
            places.setdefault("home", [[str(int(i == j)) for j in range(4)] for i in range(4)])
        if mechanism["convention"] == "bonds":
            return {"kind": mechanism["kind"], "convention": "dh", "joints": [*map(self.bond, mechanism["bonds"])]}
        joints = [self.joint(joint, mechanism["convention"]) for joint in mechanism["joints"]]
        return {"kind": mechanism["kind"], "convention": mechanism["convention"], "joints": joints, **places}

    def input(self, given):
        value = {"distance": self.length(given["distance"])} if "distance" in given else {"angle": self.angle(given, "angle", "tan_half")}
        return {"joint": int(given["joint"]), **value}

    def squares(self, legs, base, plate):
        """The squares of the legs, which may be given by a pose."""
        if "matrix" in legs or "quaternion" in legs:
            pose, a, b = matrix(self.pose(legs)), *([[number(x) for x in point] for point in body] for body in (base, plate))
            sides = [difference([dot(row, y) + row[3] for row in pose], x) for x, y in zip(a, b)]
            require(all(map(is_exact, sides)), "file: legs of an irrational pose have no certificate")
            return [str(dot(side, side)) for side in sides]
        if lengths := legs.get("lengths", legs.get("legs")):
            return [f"({text})*({text})" for text in map(self.length, lengths)]
        return [f"({number_text(text)})*({UNITS[self.metre]})*({UNITS[self.metre]})" for text in legs.get("squared", legs.get("legs_squared"))]

    def cases(self, verb):
        """The data of every case, each as a function, as some have none."""
        document, mechanism = self.document, self.document["mechanism"]
        if mechanism["kind"] not in KINDS or "symbols" in document:
            return []
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
    same as one that is not known to be rational: it might be a convergent of it, for which other theorems hold. A wide ball is no number."""
    shape = lambda system: (type(system), system.size, system.equations, system.kinds, system.spherical)
    is_narrow = lambda x: not is_exact([x]) and x.rad() < NARROW * (1 + abs(x.mid()))
    same = lambda x, y: x == y if is_exact((x, y)) else is_narrow(x) and is_narrow(y) and x.overlaps(y)
    return shape(one) == shape(other) and all(map(same, one.constants, other.constants))


@functools.cache
def systems(path, verb):
    """The closure equations of the cases of a mechanism file that a certificate can be about."""
    try:
        return [system for case in File(document_of(path)).cases(verb) if (system := system_or_none(case))]
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None
    except FAULTS as error:
        raise Unreadable(f"{path}: no mechanism file: {str(error)[:80]}") from None


def system_or_none(case):
    try:
        return system_of(case())
    except Refused:
        return None


def is_about(system, path, verb):
    """Whether a file has a case with these closure equations."""
    return any(is_same(system, own) for own in systems(path, verb)) if system else False
