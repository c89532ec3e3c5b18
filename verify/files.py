"""Mechanism files (equations/README.md), with which the data of a certificate are compared."""
import functools
import json
import tomllib

from flint import arb, fmpq

from closures import Platform
from expressions import UNITS, expression
from frames import placement
from mechanism import Reader, angle
from motions import IDENTITY, difference, dot, of_quaternion
from quantities import Unreadable, by_half_tangent, is_exact, items

LARGEST = 64 << 20  # bytes of a mechanism file
FAULTS = (ArithmeticError, AttributeError, LookupError, MemoryError, RecursionError, TypeError, ValueError)


class FileReader(Reader):
    def __init__(self, document):
        units = document.get("units", {})
        self.metres, self.radians = UNITS[units.get("length", "m")], UNITS[units.get("angle", "rad")]

    def fields(self, table, needed, optional=()):
        """Of a file other keys are not looked at."""

    def length(self, text):
        return expression(text, self.metres)

    def cos_sin(self, table, key):
        half = "tan_half" if key == "angle" else "tan_half_" + key
        if half not in table:
            return angle(table.get(key, "0"), self.radians)
        return (fmpq(-1), fmpq(0)) if table[half] == "inf" else by_half_tangent(expression(table[half]))

    def pose(self, table):
        if "matrix" in table:
            return self.matrix(table["matrix"])
        q = [expression(x) for x in items(table["quaternion"], 4)]
        norm = sum(x * x for x in q)
        rows = [[x / norm for x in row] for row in of_quaternion(*q)]
        return placement([[*row, self.length(x)] for row, x in zip(rows, items(table["position"], 3))] + [IDENTITY[3]])

    def squares(self, legs):
        if lengths := legs.get("lengths", legs.get("legs")):
            return [self.length(x) ** 2 for x in items(lengths, 6)]
        return [expression(x) * self.metres**2 for x in items(legs.get("squared", legs.get("legs_squared")), 6)]

    def systems(self, document, has_input):
        """The closure equations of every case."""
        mechanism = document["mechanism"]
        if mechanism["kind"] == "platform":
            points = [self.points(mechanism[key]) for key in ("base", "plate")]
            if "pose" in document:
                return [Platform(*points, legs_of(self.pose(pose), *points)) for pose in document["pose"]]
            return [Platform(*points, self.squares(legs)) for legs in document.get("legs", [mechanism])]
        if mechanism["kind"] == "arm":
            return [self.chain(mechanism, self.pose(pose), None) for pose in document["pose"]]
        inputs = document["input"] if has_input and "input" in document else [None]
        return [self.chain(mechanism, IDENTITY, {**given, "joint": int(given["joint"])} if given is not None else None) for given in inputs]


def legs_of(pose, base, plate):
    """The squared lengths of the legs at a pose."""
    legs = [difference([dot(row, b) + row[3] for row in pose], a) for a, b in zip(base, plate)]
    return [dot(leg, leg) for leg in legs]


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
        return FileReader(document).systems(as_texts(document), has_input)
    except OSError as error:
        raise Unreadable(f"{path}: {error.strerror}") from None
    except FAULTS as error:
        raise Unreadable(f"{path}: no mechanism file: {str(error)[:80]}") from None


def as_texts(value):
    """With every number as text."""
    if isinstance(value, dict):
        return {key: as_texts(own) for key, own in value.items()}
    return list(map(as_texts, value)) if isinstance(value, list) else str(value)
