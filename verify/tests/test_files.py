"""Certificates and the mechanism files that they are about, with numbers, joints and conventions of every form; no other file is one of theirs."""
import json
import os
import pathlib
import re
import sys
import tomllib

import pytest
from flint import arb

from test_verify import CHECKERS, LOOPROOT, VERIFY, run

sys.path.insert(0, os.path.dirname(VERIFY))
import documents
import files
import sweep
import units
from quantities import Unreadable

ARM = """
[units]
angle = "deg"
length = "mm"
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = "sqrt(4)", alpha = "acos(3/5) rad", d = "100*cos(60 deg)" },
    { type = "R", a = "sqrt(9/4) cm", alpha = "30 + 60", d = "1_00.5" },
    { type = "R", a = 200, alpha = "(asin(5/13) + pi/2) rad", d = "300*sin(acos(4/5))" },
    { type = "R", a = 13, alpha = "2*atan(1/3) rad", d = "pi/pi" },
    { type = "R", a = 140, alpha = "acos(7/25)/2 rad", d = "25 + sqrt(2)*sqrt(2)", theta0 = "atan2(3, -4) rad" },
    { type = "R", a = 7, tan_half_alpha = "sqrt(1/4)", d = 5.5 },
]
[[pose]]
matrix = [[0, 0, 1, "sqrt(900)"], ["cos(acos(3/5))", "sin(acos(3/5))", 0, 20], ["-sqrt(16)/5", "0.6", 0, 115], [0, 0, 0, 1]]
"""
CARDAN = """
[mechanism]
kind = "arm"
convention = "modified-dh"
joints = [
    { type = "U", a = 0, tan_half_alpha = "sqrt(1/9)", d = "sqrt(4)" },
    { type = "R", a = 1, alpha = "acos(3/5)", d = "1/2" },
    { type = "U", a = "sqrt(9/16)", alpha = "pi/2" },
    { type = "R", a = 2, alpha = "asin(4/5)", d = 1, theta0 = "acos(-3/5)" },
]
[[pose]]
quaternion = ["4/5", "1/5", "2/5", "sqrt(4)/5"]
position = [1, "3/2", "sqrt(1/4)"]
"""
RING = """
[mechanism]
kind = "loop"
convention = "bonds"
bonds = [
    { length = "sqrt(9/4)", tan_half_angle = "3/2", name = "first" },
    { length = 1.6, angle = "acos(-1/3)" },
    { length = 1.4, angle = "100 deg" },
    { length = 1.5, angle = "acos(-5/13)" },
    { length = 1.55, tan_half_angle = "7/5" },
    { length = 1.45, angle = "2*atan(4/3)" },
    { length = 1.5, angle = "105 deg" },
]
[[input]]
joint = 1
angle = "60 deg"
"""
EXACT_RING = RING.replace('"60 deg"', '"acos(3/5)"').replace("acos(-1/3)", "acos(-3/5)").replace("100 deg", "90 deg").replace("105 deg", "acos(-4/5)")
LEGS = """
[mechanism]
kind = "linkage"
space = "plane"
ground = "base"
joints = [
    { name = "leg1", type = "RPR", of = ["base", "plate"], at = ["A1", "B1"] },
    { name = "leg2", type = "RPR", of = ["base", "plate"], at = ["A2", "B2"] },
    { name = "leg3", type = "RPR", of = ["base", "plate"], at = ["A3", "B3"] },
]
[mechanism.bodies]
base = { A1 = [0, 0], A2 = ["sqrt(16)", 0], A3 = [1, 3] }
plate = { B1 = [0, 0], B2 = [1, "1/3"], B3 = ["sin(pi/6)", 1] }
[[input]]
given = { leg1 = 2, leg2 = { distance = "sqrt(9)" }, leg3 = 2.5 }
"""
BAR = """
[mechanism]
kind = "linkage"
space = "plane"
ground = "f"
joints = [
    { name = "A", type = "R", of = ["f", "crank"] },
    { name = "D", type = "R", of = ["f", "rocker"] },
    { name = "rod", type = "RR", of = ["crank", "rocker"], at = ["B", "C"], length = "sqrt(25/4)" },
]
[mechanism.bodies]
f = { A = [0, 0], D = [3, "1/2"] }
crank = { A = 0, B = 1 }
rocker = { D = 0, C = [2, 0] }
[[input]]
joint = "A"
angle = "acos(3/5)"
"""
SLOT = """
[mechanism]
kind = "linkage"
space = "plane"
ground = "f"
joints = [
    { name = "A", type = "R", of = ["f", "crank"] },
    { name = "D", type = "R", of = ["f", "lever"] },
    { name = "slot", type = "PR", of = ["lever", "crank"], at = ["S", "B"], along = ["sqrt(9)", 4] },
]
[mechanism.bodies]
f = { A = [0, 0], D = [3, "1/2"] }
crank = { A = 0, B = 1 }
lever = { D = 0, S = [0, "1/2"] }
[[input]]
joint = "A"
angle = "2*acos(3/5)"
"""
# A bar with the name of a body, which joints behind it name.
NAMED = BAR.replace("25/4", "8").replace("sqrt(8)", "2.25").replace('"rod"', '"crank"')
NAMED = NAMED.replace(first := NAMED[NAMED.index("    { name"):NAMED.index('    { name = "crank"')], "").replace("\n]\n", "\n" + first + "]\n")
TEXTS = {"arm": ARM, "exact arm": ARM.replace("sqrt(2)*sqrt(2)", "2"), "cardan": CARDAN, "ring": RING, "exact ring": EXACT_RING,
         "legs": LEGS, "bar": BAR, "named": NAMED, "slot": SLOT}
VERBS = {"ring": ["solve", "mobility"], "exact ring": ["solve", "mobility"], "bar": ["solve", "sweep"], "slot": ["solve", "sweep"]}
TURN = ["--from", "0", "--to", "360 deg", "--steps", "12"]
NUMBER = re.compile(r"(?<![A-Za-z_])\d+(?:\.\d+)?")


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """(name, verb) to the file and the certificate."""
    place, found = tmp_path_factory.mktemp("files"), {}
    for name, text in TEXTS.items():
        (file := place / f"{name}.toml").write_text(text)
        for verb in VERBS.get(name, ["solve"]):
            certificate = place / f"{name}.{verb}"
            run(LOOPROOT, verb, file, *(TURN if verb == "sweep" else []), "-q", "--certificate", certificate)
            found[name, verb] = file, certificate
    return found


@pytest.mark.parametrize("checker", CHECKERS)
def test_numbers_joints_and_conventions_of_files_are_read(written, checker):
    for (name, verb), (file, certificate) in written.items():
        answer = CHECKERS[checker](certificate, "--file", file)
        assert answer.returncode == 0, (name, verb, answer)
        for (other, own), (of, _) in written.items():
            if other != name and own == verb:
                answer = CHECKERS[checker](certificate, "--file", of)
                assert answer.returncode == 2 and "file" in answer.stdout, (name, other, answer)


def mutations(text):
    """The text with one digit of one number of its geometry changed, for every number, with a joint left out or doubled, and with two joints
    of a chain exchanged; a linkage with its joints in another order is the same."""
    start = text.index("[mechanism]")
    for number in NUMBER.finditer(text, start):
        digits = [k for k in range(number.start(), number.end()) if text[k].isdigit()]
        at = digits[min(2, len(digits) - 1)]
        yield f"{number.group()} at {number.start()}", text[:at] + str((int(text[at]) + 3) % 10) + text[at + 1:]
    joints = [line for line in text.splitlines() if line.startswith("    {")]
    for one, other in zip(joints, joints[1:]) if '"linkage"' not in text else ():
        yield f"{one} and the next", text.replace(f"{one}\n{other}", f"{other}\n{one}")
    yield "a joint less", text.replace(joints[0] + "\n", "")
    yield "a joint more", text.replace(joints[-1], joints[-1] + "\n" + re.sub(r'name = "(\w+)"', r'name = "\1x"', joints[-1]))


def is_own(data, verb, text):
    """Whether the data are those of a case of a file, or None where it cannot be read."""
    try:
        document = documents.as_texts(tomllib.loads(text, parse_float=str))
        systems = [own for case in files.File(document).cases(verb) if (own := files.system_or_none(case))]
    except (*files.FAULTS, Unreadable, files.Refused):
        return None
    return any(files.is_same(sweep.system_of(data), own) for own in systems)


def is_free(verb, text, other):
    """Whether only the value of the input differs, which is no datum of a motion or a sweep."""
    return verb in ("mobility", "sweep") and other[:other.index("[[input]]")] == text[:text.index("[[input]]")]


def test_no_number_of_a_file_may_change(written):
    read = 0
    for (name, verb), (file, certificate) in written.items():
        text, data = file.read_text(), json.loads(certificate.read_text().splitlines()[0])["data"]
        assert is_own(data, verb, text), (name, verb)
        for what, other in mutations(text):
            answer = is_own(data, verb, other)
            read += answer is not None
            assert not answer or is_free(verb, text, other), (name, verb, what)
    assert read > 250, read


def test_both_checkers_refuse_changed_files(written, tmp_path):
    """What the library reads of a changed file, it refuses as well."""
    for name, verb in ("arm", "solve"), ("exact ring", "solve"), ("legs", "solve"), ("slot", "sweep"):
        file, certificate = written[name, verb]
        text = file.read_text()
        for what, other in list(mutations(text))[::3]:
            (tmp_path / "changed.toml").write_text(other)
            answer = CHECKERS["rust"](certificate, "--file", tmp_path / "changed.toml")
            assert answer.returncode == 2 or answer.returncode == 1 and "error" in answer.stderr or is_free(verb, text, other), (name, what, answer)


HOOKE = """
[mechanism]
kind = "linkage"
space = "sphere"
ground = "house"
joints = [
    { name = "S0", type = "R", of = ["house", "in"], zero = [[0, 1, 0], [1, 0, 0]] },
    { name = "F1", type = "R", of = ["in", "cross"] },
    { name = "G1", type = "R", of = ["cross", "out"] },
    { name = "S1", type = "R", of = ["out", "house"] },
]
[mechanism.bodies]
house = { S0 = [1, 0, 0], S1 = ["3/5", "cos(asin(3/5))", 0] }
in = { S0 = [0, 0, 1], F1 = [1, 0, 0] }
cross = { F1 = ["sqrt(1)", 0, 0], G1 = [0, 1, 0] }
out = { S1 = [0, 0, 1], G1 = [0, 1, 0] }
[[input]]
joint = "S0"
tan_half = "1/3"
"""


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_spherical_four_bar_is_that_of_its_file(tmp_path, checker):
    """A Hooke joint with its input measured from another direction, with other axes, or with another value held is another one."""
    (tmp_path / "own").write_text(HOOKE)
    run(LOOPROOT, "sweep", tmp_path / "own", *TURN, "-q", "--certificate", tmp_path / "certificate")
    for name, text, code in (
        ("own", HOOKE, 0), ("the value of the input", HOOKE.replace("1/3", "1/2"), 0), ("longer zero", HOOKE.replace("[[0, 1, 0]", "[[0, 2, 0]"), 0),
        ("another zero", HOOKE.replace("[[0, 1, 0]", "[[0, 3, 4]"), 2), ("an irrational zero", HOOKE.replace("[[0, 1, 0]", "[[0, 1, 1]"), 2),
        ("no zero", HOOKE.replace(", zero = [[0, 1, 0], [1, 0, 0]]", ""), 2), ("another axis", HOOKE.replace('"3/5", "cos(asin(3/5))"', '"5/13", "12/13"'), 2),
        ("a cross askew", HOOKE.replace("G1 = [0, 1, 0] }\nout", 'G1 = ["3/5", "4/5", 0] }\nout'), 2), ("another input", HOOKE.replace('joint = "S0"', 'joint = "G1"'), 2),
        ("in the plane", HOOKE.replace('"sphere"', '"space"'), 2),
    ):
        (tmp_path / "file").write_text(text)
        answer = CHECKERS[checker](tmp_path / "certificate", "--file", tmp_path / "file")
        # Linkages in space have other keys.
        assert answer.returncode == code or name == "in the plane" and answer.returncode == 1, (name, answer)


@pytest.mark.parametrize("checker", CHECKERS)
def test_what_is_no_file_is_about_nothing(written, tmp_path, checker):
    """An empty name, a key that stands twice, and a file that is cut are no mechanism; a mark of the order of bytes is none of its text."""
    (file, certificate), text = written["bar", "solve"], json.dumps(tomllib.loads(BAR))
    for name, content, code in (("marked", "\ufeff" + text, 0), ("twice", text.replace('"length": ', '"length": "9", "length": '), 1),
                                ("cut", text[:-40], 1), ("two joints", BAR.replace('name = "D"', 'name = "A"'), 1)):
        (tmp_path / "file").write_text(content)
        answer = CHECKERS[checker](certificate, "--file", tmp_path / "file")
        assert answer.returncode == code or name == "two joints" and answer.returncode == 2, (name, answer)
    assert CHECKERS[checker](certificate, "--file", "").returncode == 1


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_wide_ball_is_no_number_of_a_file(written, tmp_path, checker):
    """Numbers whose difference is lost in the digits that are known are not those of the file."""
    file, certificate = written["arm", "solve"]
    forged = json.loads(certificate.read_text())
    joint = forged["data"]["mechanism"]["joints"][4]
    large = "1" + "0" * 99
    joint["d"] = f"({joint['d']} + sqrt(2)*{large} - sqrt(2)*{large})"
    (tmp_path / "forged").write_text(json.dumps(forged))
    assert CHECKERS[checker](tmp_path / "forged", "--file", file).returncode == 2


def test_expressions_are_exact_where_files_say_so():
    for text, value in {"sqrt(4)": "2", "cos(pi/3)": "1/2", "sin(7*pi/6)": "-1/2", "tan(acos(3/5))": "4/3", "pi/pi": "1", "sin(40 deg)": None,
                        "sqrt(2)*sqrt(2)": None, "1_000.50": "2001/2", ".5": "1/2", "007": "7", "cos(60 deg)": "1/2", "3 cm": "3/100"}.items():
        own = units.number_text(text)
        assert own == value if value else units.evaluated(own).rational is None, (text, own)
    for text, half in {"acos(3/5)": "1/2", "acos(3/5)/2 + acos(3/5)/2": "1/2", "acos(3/5) + pi/2": "3", "-3*acos(3/5)": "-11/2", "atan2(0, -1)": "inf",
                       "3*acos(7/25)/2": None, "acos(7/25)/2": "1/3", "-540 deg": "inf", "270 deg": "-1", "1": None, "pi/3": None}.items():
        own = units.evaluated(units.in_units(text, "rad")).half_tangent()
        assert (str(own) if own is not None else None) == half, (text, own)


def test_exact_values_are_in_their_balls():
    """All expressions of two functions over some numbers: what is said to be exact lies in the ball of the value."""
    numbers = ["3/5", "-4/5", "2", "1/2", "pi", "0", "-1", "5/13", "pi/3", "9/4", "-pi/4"]
    inner = [f"{name}({x})" for name in units.FUNCTIONS if name != "atan2" for x in numbers] + [f"atan2({x}, {y})" for x in numbers for y in numbers]
    inner += [f"({x}) {sign} ({y})" for x in numbers for y in numbers for sign in "+-*/"]
    exactly = halves = 0
    for text in inner + [f"{name}({x})" for name in units.FUNCTIONS if name != "atan2" for x in inner] + [f"{x} / 2" for x in inner]:
        try:
            value = units.evaluated(text)
        except Unreadable:  # a division by zero
            continue
        if not value.ball.is_finite():
            continue
        if value.rational is not None:
            exactly += 1
            assert value.ball.overlaps(arb(value.rational)), text
        half = value.half_tangent()
        if half is not None:
            halves += 1
            cos, sin = (-1, 0) if half == "inf" else exact_cos_sin(half)
            assert value.ball.cos().overlaps(arb(cos)) and value.ball.sin().overlaps(arb(sin)), text
    assert exactly > 500 and halves > 500, (exactly, halves)


def exact_cos_sin(half):
    return (1 - half * half) / (1 + half * half), 2 * half / (1 + half * half)


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_mechanism_of_another_kind_is_another_mechanism(tmp_path, checker):
    run(LOOPROOT, "solve", "equations/arm/puma560.toml", "-q", "--certificate", tmp_path / "certificate")
    for entry in ("framework/bricard_borel", "displacement/between", "gearing/astroid", "conditions/bennett", "linkage/3rps", "platform/hexapod"):
        answer = CHECKERS[checker](tmp_path / "certificate", "--file", f"equations/{entry}.toml")
        assert answer.returncode == 2 and "file: " in answer.stdout and not answer.stderr, (entry, answer)
