"""Random mechanisms as the tables of mechanism files, with numbers of every form: rational and irrational, special and nearly special ones."""
import os
import pathlib
import random
import sys

sys.path.insert(0, os.path.dirname(os.environ.get("VERIFY", str(pathlib.Path(__file__).resolve().parents[1] / "verify.py"))))
from closures import SLIDE, TURN
from files import File
from mechanism import UNKNOWNS, about_z
from motions import IDENTITY, along, times, turn
from quantities import by_half_tangent, is_exact, number

TANGENTS = ["1/2", "1/3", "2/3", "1/4", "3/2", "2", "-1/2", "-2/5", "3/4", "-5/3"]
IRRATIONAL = ["sqrt(2)", "sqrt(3)/2", "cos(20 deg)", "2*sin(50 deg)", "pi/4"]
FREEDOMS = {"R": 1, "P": 1, "C": 2, "U": 2, "S": 3}
# Bodies of six-bars by their joints: f is the ground.
SIX_BARS = [("fa", "ab", "bc", "cf", "cd", "de", "ef"), ("fa", "ab", "bc", "cf", "bd", "de", "ef"), ("fa", "ab", "bc", "cf", "ad", "de", "ec")]


class Draw:
    def __init__(self, seed):
        self.random = random.Random(seed)

    def decimal(self, size=1000):
        return str(self.random.randint(-size, size) / 1000)

    def length(self):
        """A decimal, 0, an irrational number, or one off zero by a thousandth to a hundred millionth, as of arms as they are built."""
        kind = self.random.choices("decimal zero irrational small".split(), (80, 12, 3, 5))[0]
        return {"decimal": self.decimal(), "zero": "0", "irrational": self.random.choice(IRRATIONAL), "small": f"1e-{self.random.randint(3, 8)}"}[kind]

    def twist(self):
        kind = self.random.choices("half right degrees near".split(), (55, 32, 8, 5))[0]
        return {"half": {"tan_half_alpha": self.random.choice(TANGENTS)}, "right": {"alpha": self.random.choice(["0", "pi/2", "-pi/2", "pi"])},
                "degrees": {"alpha": f"{self.random.randint(1, 179)} deg"}, "near": {"tan_half_alpha": f"1 + 1e-{self.random.randint(3, 8)}"}}[kind]

    def joint(self, kind):
        further = {"R": {"d": self.length()}, "P": {"tan_half_theta": self.random.choice(TANGENTS)}}
        return {"type": kind, "a": self.length(), **self.twist(), **further.get(kind, {})}

    def joints(self, variables):
        kinds = []
        while (rest := variables - sum(FREEDOMS[kind] for kind in kinds)) > 0:
            kind = self.random.choices("RPCUS", (16, 2, 1, 1, 1))[0]
            if FREEDOMS[kind] <= rest and not (kind == "S" and "S" in kinds):
                kinds.append(kind)
        return [self.joint(kind) for kind in self.random.sample(kinds, len(kinds))]

    def reached(self, mechanism):
        """A pose that the joints reach, exactly or rounded to doubles."""
        value = lambda part: turn(2, *by_half_tangent(number(self.random.choice(TANGENTS)))) if part == TURN else along(0, 0, number(self.decimal()))
        parts = []
        for joint in File({}).chain(mechanism)["joints"]:
            own = [value(part) if part in (TURN, SLIDE) else part for part in UNKNOWNS[joint["type"]]]
            parts += about_z(joint, own, mechanism["convention"])
        rows = times(IDENTITY, *parts)
        text = str if all(map(is_exact, rows)) else lambda x: repr(float(x))
        return {"matrix": [[text(x) for x in row] for row in rows[:3]] + [["0", "0", "0", "1"]]}

    def arm(self):
        mechanism = {"kind": "arm", "convention": self.random.choice(["dh", "modified-dh"]), "joints": self.joints(self.random.choice([6] * 9 + [5, 4, 3]))}
        pose = self.reached(mechanism)
        for row in pose["matrix"][:3] if self.random.random() < 0.3 else ():
            row[3] = self.decimal(2000)  # another place
        return {"mechanism": mechanism, "pose": [pose]}

    def loop(self):
        joints = self.joints(self.random.choice([7] * 9 + [6, 5]))
        given = self.random.choice([k for k, joint in enumerate(joints, 1) if joint["type"] in "RPC"] or [1])
        value = {"distance": self.decimal()} if joints[given - 1]["type"] == "P" else {"tan_half": self.random.choice(TANGENTS)}
        return {"mechanism": {"kind": "loop", "convention": "dh", "joints": joints}, "input": [{"joint": given, **value}]}

    def platform(self):
        height = "0" if self.random.random() < 0.3 else None  # points of a plane
        base, plate = ([[self.decimal(), self.decimal(), height or self.decimal()] for _ in range(6)] for _ in range(2))
        for body in base, plate:
            if self.random.random() < 0.4:  # legs that meet
                body[self.random.randrange(3)] = body[self.random.randrange(3, 6)]
        turns = [turn(k, *by_half_tangent(number(self.random.choice(TANGENTS)))) for k in range(3)]
        rows = times(along(*(number(self.decimal()) for _ in range(3))), *turns)
        return {"mechanism": {"kind": "platform", "base": base, "plate": plate}, "pose": [{"matrix": [[*map(str, row)] for row in rows]}]}

    def linkage(self):
        return self.random.choice([self.four_bar, self.six_bar, self.legs, self.slider])()

    def linked(self, bodies, joints, given):
        """A linkage whose bodies have points of these names."""
        point = lambda: [self.decimal(4000), self.decimal(4000)]
        return {"mechanism": {"kind": "linkage", "space": "plane", "ground": "f", "joints": joints, "bodies": {
            body: {name: point() for name in names} for body, names in bodies.items()}}, "input": [{"given": given}]}

    def four_bar(self):
        """The fourth body is a bar or the pin of a slot."""
        last = self.random.choice([{"type": "RR", "of": ["a", "c"], "at": ["B", "C"], "length": str(self.random.randint(500, 9000) / 1000)},
                                   {"type": "PR", "of": ["c", "a"], "at": ["C", "B"], "along": ["3", "4"]}])
        joints = [{"name": "A", "type": "R", "of": ["f", "a"]}, {"name": "D", "type": "R", "of": ["f", "c"]}, {"name": "E", **last}]
        return self.linked({"f": "AD", "a": "AB", "c": "DC"}, joints, {"A": {"tan_half": self.random.choice(TANGENTS)}})

    def six_bar(self):
        pairs = dict(zip("ABCDEFG", self.random.choice(SIX_BARS)))
        joints = [{"name": name, "type": "R", "of": [*pair]} for name, pair in pairs.items()]
        bodies = {body: [name for name, pair in pairs.items() if body in pair] for body in "fabcde"}
        return self.linked(bodies, joints, {"A": {"tan_half": self.random.choice(TANGENTS)}})

    def legs(self):
        joints = [{"name": f"L{k}", "type": "RPR", "of": ["f", "p"], "at": [f"A{k}", f"B{k}"]} for k in range(3)]
        given = {f"L{k}": {"distance": str(self.random.randint(1000, 9000) / 1000)} for k in range(3)}
        return self.linked({"f": ["A0", "A1", "A2"], "p": ["B0", "B1", "B2"]}, joints, given)

    def slider(self):
        along = self.random.choice([["5", "12"], [["3", "4"], ["0", "1"]], ["1", "0"]])
        joints = [{"name": name, "type": "R", "of": [*pair]} for name, pair in (("A", "fa"), ("B", "ab"), ("C", "bc"))]
        joints.append({"name": "S", "type": "P", "of": ["f", "c"], "along": along})
        return self.linked({"f": "AS", "a": "AB", "b": "BC", "c": "CS"}, joints, {"A": {"tan_half": self.random.choice(TANGENTS)}})


def of_problem(problem):
    """The mechanism of a line of `looproot bench accuracy --export`."""
    texts = lambda value: [*map(texts, value)] if isinstance(value, list) else repr(value)
    if problem["kind"] == "platform":
        return {"mechanism": {"kind": "platform", "base": texts(problem["base"]), "plate": texts(problem["plate"]), "legs": texts(problem["legs"])}}
    joints = [{"type": axis["type"], "axis": texts(axis["direction"]), **({"point": texts(axis["point"])} if axis["type"] == "R" else {})}
              for axis in problem["axes"]]
    mechanism = {"kind": "arm", "convention": "screws", "joints": joints, "home": texts(problem["home"])}
    return {"mechanism": mechanism, "pose": [{"matrix": texts(problem["pose"])}]}
