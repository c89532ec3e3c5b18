"""The data of a certificate against a mechanism file: TOML or JSON, as equations/README.md describes it."""
import json
import tomllib

from flint import arb

from quantities import Expression, Refused, Unreadable, angle, number, rational

ANGLES = {"alpha", "theta0", "theta", "angle"}
LARGEST = 64 << 20
UNIT = [[str(int(i == j)) for j in range(4)] for i in range(4)]


class Source:
    """The cases of a file as data of certificates."""

    def __init__(self, path):
        try:
            with open(path, "rb") as file:
                text = file.read(LARGEST).decode()
            as_text = {"parse_float": str}
            is_json = text.lstrip().startswith("{")
            document = json.loads(text, parse_int=str, **as_text) if is_json else tomllib.loads(text, **as_text)
            self.cases = list(self.read(document))
        except OSError as error:
            raise Unreadable(f"{path}: {error.strerror}") from None
        except (KeyError, TypeError, ValueError, AttributeError, IndexError, RecursionError, ZeroDivisionError) as error:
            raise Unreadable(f"{path}: no mechanism file: {str(error)[:80]}") from None

    def compare(self, data, is_motion=False):
        """No input decides whether a loop moves."""
        cases = [{"mechanism": case["mechanism"]} for case in self.cases] if is_motion else self.cases
        if not any(same(None, data, case) for case in cases):
            raise Refused("file: the data of the certificate are those of no case of the file")

    def read(self, document):
        units = document.get("units", {})
        self.length = {"m": "1", "cm": "1/100", "mm": "1/1000"}[units.get("length", "m")]
        self.degrees = units.get("angle", "rad") == "deg"
        mechanism = document["mechanism"]
        kind = mechanism["kind"]
        if kind == "platform":
            points = lambda key: [[self.size(x) for x in point] for point in mechanism[key]]
            own = {"kind": kind, "base": points("base"), "plate": points("plate")}
            for legs in document.get("legs", [mechanism]):
                lengths = legs.get("lengths", legs.get("legs"))
                squares = legs.get("squared", legs.get("legs_squared"))
                if lengths:
                    yield {"mechanism": {**own, "legs_squared": [self.square(x) for x in lengths]}}
                elif squares:
                    scale = arb(rational(self.length)) ** 2
                    yield {"mechanism": {**own, "legs_squared": [Expression(str(x)).value() * scale for x in squares]}}
            return
        own = {"kind": kind, "convention": mechanism["convention"], "joints": [self.joint(j) for j in mechanism["joints"]]}
        if own["convention"] == "screws":
            own["home"] = self.matrix(mechanism["home"]) if "home" in mechanism else self.matrix(UNIT)
        for key in ("base", "tool"):
            if key in mechanism and not all(x == int(i == j) for i, row in enumerate(self.matrix(mechanism[key])) for j, x in enumerate(row)):
                own[key] = self.matrix(mechanism[key])
        if kind == "arm":
            yield from ({"mechanism": own, "pose": [{"matrix": self.placement(pose)}]} for pose in document.get("pose", []))
        for given in document.get("input", []):
            key = next(key for key in ("angle", "tan_half", "distance") if key in given)
            value = self.size(given[key]) if key == "distance" else self.turn(given, "angle", "tan_half")
            yield {"mechanism": own, "input": [{"joint": str(given["joint"]), "angle" if key != "distance" else key: value}]}
        if kind == "loop" and "input" not in document:
            yield {"mechanism": own}

    def size(self, value):
        """A length in metres."""
        expression = Expression(str(value))
        has_unit = bool(expression.tokens) and expression.tokens[-1] in ("m", "cm", "mm")
        if not has_unit and rational(str(value)) is not None:
            return arb(rational(str(value)) * rational(self.length))
        return expression.value() * (1 if has_unit else arb(rational(self.length)))

    def square(self, value):
        return self.size(value) ** 2

    def turn(self, table, key, half):
        """Cosine and sine."""
        if half in table:
            if table[half] == "inf":
                return arb(-1), arb(0)
            t = Expression(str(table[half])).value()
            return (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
        if key not in table:
            return arb(1), arb(0)
        expression = Expression(str(table[key]))
        has_unit = bool(expression.tokens) and expression.tokens[-1] in ("deg", "rad")
        radians = expression.value()
        if self.degrees and not has_unit:
            radians = radians * arb.pi() / 180
        return radians.cos(), radians.sin()

    def joint(self, table):
        kind = table["type"]
        if "axis" in table:
            axis = [Expression(str(x)).value() for x in table["axis"]]
            point = [self.size(x) for x in table.get("point", ["0"] * 3)]
            square = sum(x * x for x in axis)
            along = sum(x * y for x, y in zip(axis, point)) / square
            own = {"type": kind, "axis": axis}
            return own if kind == "P" else {**own, "point": [p - along * x for p, x in zip(point, axis)]}
        own = {"type": kind, "a": self.size(table["a"]), "alpha": self.turn(table, "alpha", "tan_half_alpha")}
        if kind in ("P", "C"):
            own["d0"] = self.size(table.get("d0", "0"))
        else:
            own["d"] = self.size(table.get("d", "0"))
        if kind == "P":
            own["theta"] = self.turn(table, "theta", "tan_half_theta")
        elif kind in ("R", "C"):
            own["theta0"] = self.turn(table, "theta0", "tan_half_theta0")
        return own

    def matrix(self, rows):
        return [[Expression(str(x)).value() if k < 3 or i == 3 else self.size(x) for k, x in enumerate(row)] for i, row in enumerate(rows)]

    def placement(self, table):
        if "matrix" in table:
            return self.matrix(table["matrix"])
        w, x, y, z = (Expression(str(part)).value() for part in table["quaternion"])
        norm, p = w * w + x * x + y * y + z * z, [self.size(part) for part in table["position"]]
        return [[(w * w + x * x - y * y - z * z) / norm, 2 * (x * y - w * z) / norm, 2 * (x * z + w * y) / norm, p[0]],
                [2 * (x * y + w * z) / norm, (w * w - x * x + y * y - z * z) / norm, 2 * (y * z - w * x) / norm, p[1]],
                [2 * (x * z - w * y) / norm, 2 * (y * z + w * x) / norm, (w * w - x * x - y * y + z * z) / norm, p[2]],
                [arb(0), arb(0), arb(0), arb(1)]]


def same(key, own, other):
    """Whether data and what a file says agree: words equal, numbers to the working precision."""
    if isinstance(other, dict):
        return isinstance(own, dict) and set(own) == set(other) and all(same(name, own[name], other[name]) for name in other)
    if isinstance(other, list) and key == "axis":
        parts = [number(x)[0] for x in own] if isinstance(own, list) and len(own) == len(other) else []
        agree = all((parts[i] * other[j] - parts[j] * other[i]).contains(0) for i in range(len(parts)) for j in range(i))
        return bool(parts) and agree and sum(x * y for x, y in zip(parts, other)) > 0
    if isinstance(other, list):
        return isinstance(own, list) and len(own) == len(other) and all(same(key, x, y) for x, y in zip(own, other))
    if isinstance(other, tuple):
        return all(x.overlaps(y) for x, y in zip(angle(own)[0], other))
    return number(own)[0].overlaps(other) if isinstance(other, arb) else own == other
