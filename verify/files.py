"""Mechanism files (equations/README.md), with which the data of a certificate are compared."""
import functools
import json
import re
import tomllib

from flint import arb, fmpq

from closures import Platform
from expressions import UNITS, expression
from frames import placement
from mechanism import Reader, angle
from motions import IDENTITY, difference, dot, of_quaternion
from quantities import Unreadable, by_half_tangent, decimal, is_exact, items

LARGEST = 64 << 20  # bytes of a mechanism file
QUARTERS = re.compile(r"(?P<number>[+-]?\d{1,9}(?:\.\d{1,9})?)\s*(?P<deg>deg)?|(?P<sign>-?)(?:(?P<times>\d{1,9})\*)?pi(?:/(?P<part>[1-9]\d{0,8}))?", re.ASCII)
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
            text = str(table.get(key, "0"))
            return right_angle(text, self.radians) or angle(text, self.radians)
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


def right_angle(text, unit):
    """Cosine and sine of a multiple of a quarter turn written in degrees or as a fraction of pi; otherwise nothing."""
    match = QUARTERS.fullmatch(text)
    if not match or match["number"] and not match["deg"] and unit is not UNITS["deg"]:
        return None
    quarters = decimal(match["number"]) / 90 if match["number"] else fmpq(2 * int(match["sign"] + (match["times"] or "1")), int(match["part"] or "1"))
    return tuple(map(fmpq, ((1, 0), (0, 1), (-1, 0), (0, -1))[int(quarters) % 4])) if quarters.q == 1 else None


def legs_of(pose, base, plate):
    """The squared lengths of the legs at a pose."""
    legs = [difference([dot(row, b) + row[3] for row in pose], a) for a, b in zip(base, plate)]
    return [dot(leg, leg) for leg in legs]


def is_same(one, other):
    """Whether two systems have the same constants: rational ones are equal, of others balls overlap. A rational number is never the
    same as one that is not known to be rational: it might be a convergent of it, for which other theorems hold."""
    shape = lambda system: (type(system), system.size, system.kinds, system.spherical)
    same = lambda x, y: x == y if is_exact((x, y)) else not is_exact([x]) and not is_exact([y]) and x.overlaps(y)
    return shape(one) == shape(other) and all(map(same, one.constants(), other.constants()))


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
