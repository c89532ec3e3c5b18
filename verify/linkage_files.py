"""Linkages in the plane as the data of certificates write them, and those of mechanism files."""
import functools
from math import gcd, lcm

from flint import fmpq, fmpq_mat

from mechanism import cos_sin
from quantities import Refused, is_exact, number, require
from units import number_text


def plane(x, y):
    """The number x + i y as a matrix; its conjugate is the transpose."""
    require(is_exact((x, y)), "data: an irrational number of a linkage has no certificate")
    return fmpq_mat([[x, -y], [y, x]])


ZERO, ONE = plane(0, 0), plane(1, 0)


def over_length(u, other):
    """u over the root of the product of the squares of both lengths, which has to be rational: then `u * other'` has the length 1."""
    square = u.det() * other.det()
    require(square != 0 and square.p.is_square() and square.q.is_square(), "data: a direction has an irrational length")
    return u * fmpq(square.q.isqrt(), square.p.isqrt())


def texts(point):
    return [str(point[0, 0]), str(point[1, 0])]


def primitive(direction):
    """The whole numbers without a common factor in the ratio of the coordinates."""
    x, y = direction[0, 0], direction[1, 0]
    require((x, y) != (0, 0), "data: a direction is 0")
    whole = [int(c * lcm(int(x.q), int(y.q))) for c in (x, y)]
    return [str(c // gcd(*whole)) for c in whole]


def written(ground, pairs, given):
    """The data in the one form of certificates, so that every number counts. Bodies are numbered from 0, the ground, as the joints name
    them. A body has the axes of the file, and its origin at its first joint."""
    numbers, origins, bodies, joints = {ground: "0"}, {}, {"0": {}}, []
    for k, (kind, of, points, along) in enumerate(pairs, 1):
        for body, point in zip(of, points):
            own = numbers.setdefault(body, str(len(numbers)))
            bodies.setdefault(own, {})[str(k)] = texts(point - origins.setdefault(own, point))
        joints.append({"name": str(k), "type": kind, "of": [numbers[body] for body in of],
                       **({"along": [*map(primitive, along)]} if kind == "P" else {})})
    held = {str(k + 1): value(pairs[k][0], own) for k, own in given.items() if k >= 0}
    mechanism = {"kind": "linkage", "space": "plane", "ground": "0", "joints": joints, "bodies": bodies}
    return {"mechanism": mechanism, **({"input": [{"given": held}]} if held else {})}


def value(kind, given):
    """The given value of a joint: a distance, or the tangent of half an angle."""
    key, = given
    require(key == ("distance" if kind == "P" else "tan_half"), "data: a value of another kind than that of its joint")
    text = given[key]
    own = "inf" if kind == "R" and text == "inf" else number(text)
    require(own == "inf" or is_exact([own]), "data: an irrational number of a linkage has no certificate")
    return {key: str(own)}


def bring(known, name, **points):
    """Adds a body, under a name that no file can write if there is a body of this name."""
    own = (name,) if name in known else name
    known[own] = points
    return own


def joints_of(mechanism):
    """The joints, those of shared points among them: of the first body that has a point with each other one."""
    joints, bodies = mechanism["joints"], mechanism["bodies"]
    if joints != "shared points":
        return joints
    joints, at = [], {}
    for body in sorted(bodies, key=lambda body: body != mechanism["ground"]):  # the ground first
        for point in bodies[body]:
            at.setdefault(point, []).append(body)
    for point, of in at.items():
        number = 1
        for other in of[1:]:
            name = point if number == 1 else f"{point}{number}"
            while number > 1 and name in at:
                number += 1
                name = f"{point}{number}"
            number += 1
            joints.append({"name": name, "type": "R", "of": [of[0], other], "at": point})
    return joints


class Planar:
    """A mechanism file of a linkage. `file` has its units."""

    def __init__(self, file):
        self.file, self.document, self.mechanism = file, file.document, file.document["mechanism"]
        require(self.mechanism["space"] == "plane", "file: only linkages in the plane have certificates")

    def point(self, point):
        return plane(*(number(self.file.length(x)) for x in (point if isinstance(point, list) else [point, "0"])))

    def pairs(self):
        """(type, bodies, points, directions) of the joints R and P by their names, with those that bars, legs and pins in slots are made of."""
        known = {body: {name: self.point(own) for name, own in points.items()} for body, points in self.mechanism["bodies"].items()}
        parts = [part for joint in joints_of(self.mechanism) for part in self.parts(joint, known)]
        pairs = {name: pair for name, *pair in parts}
        require(len(pairs) == len(parts), "file: two joints have one name")
        return pairs

    def parts(self, joint, known):
        """The pairs of one joint. A body that it brings has the name of the joint."""
        require(joint["type"] in ("R", "P", "PR", "RR", "RPR"), "file: a joint of this type has no certificate")
        name, kind, (a, b), at = joint["name"], joint["type"], joint["of"], joint.get("at", joint["name"])
        places = at if isinstance(at, list) else [at, at]
        p, q = (known[body][place] for body, place in zip((a, b), places))
        if kind == "R":
            return [(name, "R", (a, b), (p, q), [])]
        if kind in ("P", "PR"):
            along = joint["along"]
            lines = [plane(*(number(number_text(x)) for x in line)) for line in (along if isinstance(along[0], list) else [along, along])]
        if kind == "P":
            return [(name, "P", (a, b), (p, q), lines)]
        if kind == "PR":
            pin = bring(known, name, pin=ZERO)
            return [(name, "P", (a, pin), (p, ZERO), lines), (f"{name}.pin", "R", (pin, b), (ZERO, q), [])]
        if kind == "RR":
            end = self.point(joint["length"])
            bar = bring(known, name, first=ZERO, second=end)
            return [(f"{name}.first", "R", (a, bar), (p, ZERO), []), (f"{name}.second", "R", (bar, b), (end, q), [])]
        lower, upper = bring(known, f"{name}.lower", end=ZERO), bring(known, f"{name}.upper", end=ZERO)
        return [(f"{name}.first", "R", (a, lower), (p, ZERO), []), (name, "P", (lower, upper), (ZERO, ZERO), [ONE, ONE]),
                (f"{name}.second", "R", (upper, b), (ZERO, q), [])]

    def given(self, kind, given):
        if kind == "P":
            return {"distance": self.file.length(given["distance"] if isinstance(given, dict) else given)}
        cos, sin = cos_sin(self.file.angle(given if isinstance(given, dict) else {"angle": given}, "angle", "tan_half"))
        require(is_exact((cos, sin)), "file: an angle without a rational half-angle tangent has no certificate")
        return {"tan_half": "inf" if cos == -1 else str(sin / (1 + cos))}

    def case(self, values):
        require("body" not in values, "file: the place of a body has no certificate")
        own = {values["joint"]: values} if "joint" in values else {}
        names, pairs = zip(*self.pairs().items())
        given = {names.index(name): value for name, value in {**values.get("given", {}), **own}.items()}
        return written(self.mechanism["ground"], pairs, {k: self.given(pairs[k][0], value) for k, value in given.items()})

    def cases(self):
        return [functools.partial(self.case, values) for values in self.document.get("input") or [{}]]
