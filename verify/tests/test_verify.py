"""Both checkers on certificates of the library, on changed ones, and on what is no certificate."""
import json
import os
import pathlib
import re
import resource
import subprocess
import sys

import pytest
from flint import fmpq

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOOPROOT = os.environ["LOOPROOT"]
VERIFY = os.environ.get("VERIFY", str(ROOT / "verify" / "verify.py"))
ENTRIES = ["linkage/3rpr", "linkage/crank_slider", "linkage/eight_bar_03", "linkage/steering_optimum", "arm/manocha_canny_1994", "arm/puma560", "arm/ur5", "arm/mc16_1deg", "arm/general_02real", "chain/arm_3r3p", "chain/srrr",
           "chain/arm_ruru", "chain/ik_puma_type", "loop/rrsrr", "loop/cccr_1_angle", "loop/rrrrrrr_every_input",
           "platform/points_6_3", "platform/affine", "platform/hexapod", "platform/similar", "chain/crcr", "chain/arm_5rp_parallel_pair", "arm/chain_cc", "arm/chain_rrr_elbow", "chain/structure_5r",
           "overconstrained/planar_4r", "overconstrained/dietmaier_a", "overconstrained/dietmaier_broken", "overconstrained/rrcrp_b", "chain/arm_6r_two_wrists"]
MOTIONS = ["overconstrained/bennett_a", "overconstrained/bennett_broken", "overconstrained/waldron_hybrid", "loop/rrrrrrr_every_input",
           "overconstrained/spherical_4r", "overconstrained/dietmaier_a", "overconstrained/bennett_dyads_a", "chain/scp", "chain/ccc", "loop/rscr"]
IMMOBILE = ["overconstrained/bennett_broken", "chain/scp", "chain/ccc"]


NOTHING_COUNTED = ["far", "beyond", "overconstrained-dietmaier_broken"]  # certificates of no solution
CORE = ["verify.py", "quantities.py", "mechanism.py", "motions.py", "closures.py"]  # arms, loops, platforms and mobility
AID = {"first": 0, "hidden": 0, "shift": "0"}


def run(*command, limit=None):
    return subprocess.run([str(part) for part in command], capture_output=True, text=True, timeout=600, cwd=ROOT, preexec_fn=limit)


def limit():
    """500 MB and 5 s, the limits for what is no certificate."""
    resource.setrlimit(resource.RLIMIT_AS, (500_000_000, 500_000_000))
    resource.setrlimit(resource.RLIMIT_CPU, (5, 5))


CHECKERS = {
    "rust": lambda *rest, limit=None: run(LOOPROOT, "verify", *rest, limit=limit),
    "python": lambda *rest, limit=None: run(sys.executable, VERIFY, *rest, limit=limit),
}


def test_the_checker_can_be_read_in_one_sitting():
    texts = {path.name: path.read_text() for path in pathlib.Path(VERIFY).parent.glob("*.py")}
    sizes = {name: len(text.splitlines()) for name, text in texts.items()}
    core = sum(sizes[name] for name in CORE)
    assert core < 500 and f"five files of {core} lines" in (ROOT / "docs/certificate.md").read_text(), core
    assert all(size <= 150 for size in sizes.values()), sizes
    # Only verify.py knows of the further theorems.
    imported = {f"{name}.py" for file in CORE[1:] for name in re.findall(r"^from (\w+) import|^import (\w+)", texts[file], re.M) for name in name}
    assert not imported & (texts.keys() - set(CORE)), imported


@pytest.fixture(scope="session")
def certificates(tmp_path_factory):
    place = tmp_path_factory.mktemp("certificates")
    for entry in ENTRIES:
        run(LOOPROOT, "solve", f"equations/{entry}.toml", "-q", "--certificate", place / entry.replace("/", "-"))
    for entry in MOTIONS:
        name = entry.replace("/", "-") + ("-motion" if entry in ENTRIES else "")
        run(LOOPROOT, "mobility", f"equations/{entry}.toml", "-q", "--certificate", place / name)
    return place


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize("entry", MOTIONS)
def test_certificates_of_motions_hold(certificates, checker, entry):
    name = entry.replace("/", "-") + ("-motion" if entry in ENTRIES else "")
    answer = CHECKERS[checker](certificates / name, "--file", f"equations/{entry}.toml")
    assert answer.returncode == 0 and ("immobile" in answer.stdout) == (entry in IMMOBILE), answer


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_motions_are_refused(certificates, tmp_path, checker):
    mobile = json.loads((certificates / "overconstrained-bennett_a").read_text())
    broken = json.loads((certificates / "overconstrained-bennett_broken").read_text())
    other, at_rest = (json.loads((certificates / name).read_text()) for name in ("overconstrained-spherical_4r", "chain-ccc"))
    still, point = lines(certificates / "chain-structure_5r")[0], mobile["proof"][0]
    at_zero = {"kind": "curve", "polynomial": ["0", "1"], "values": [[["1"], ["0"]]] * 5, "aid": {"weights": ["0"] * 10}}
    forged = {
        "a broken loop that moves": {**broken, "claim": mobile["claim"], "proof": mobile["proof"]},
        "a mobile loop that does not move": {**mobile, "claim": broken["claim"], "proof": broken["proof"]},
        "another dimension": {**mobile, "claim": {**mobile["claim"], "mobility": 2}},
        "another word": {**mobile, "claim": {**mobile["claim"], "status": "immobile"}},
        "no proof": {**mobile, "proof": []},
        "a loop at rest that names no solution": {**broken, "modes": []},
        "a curve through a point of another loop": {**mobile, "proof": other["proof"]},
        "conjugate points that are two curves' points": {**mobile, "proof": [{**point, "polynomial": ["0", "0", "1"]}]},
        "a loop that closes and does not move": {**still, "claim": mobile["claim"], "modes": [], "proof": [at_zero]},
        "a solution of the loop at rest left out": {**at_rest, "modes": at_rest["modes"][1:]},
        "a solution of the loop at rest left out, and the number": {
            **at_rest, "modes": at_rest["modes"][1:], "proof": [{"kind": "general-bound", "value": len(at_rest["modes"]) - 1}]},
        "a solution of the loop at rest twice": {**at_rest, "modes": at_rest["modes"][:1] * len(at_rest["modes"])},
    }
    for name, certificate in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", certificate))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)
    answer = CHECKERS[checker](certificates / "overconstrained-bennett_a", "--file", "equations/overconstrained/bennett_b.toml")
    assert answer.returncode == 2 and "file" in answer.stdout, answer


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize("entry", ENTRIES)
def test_certificates_of_the_library_hold(certificates, checker, entry):
    answer = CHECKERS[checker](certificates / entry.replace("/", "-"), "--file", f"equations/{entry}.toml")
    assert answer.returncode == 0, answer


IN_MILLIMETRES = """
[units]
length = "mm"
angle = "deg"

[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type = "R", a = 0, alpha = 90, d = 100 },
    { type = "R", a = 431.8, alpha = 0, d = 0 },
    { type = "R", a = -20.3, alpha = 90, d = 150.05 },
    { type = "R", a = 0, tan_half_alpha = -1, d = 431.8 },
    { type = "R", a = 0, alpha = 90, d = 0 },
    { type = "R", a = 0, alpha = 0, d = 5.5 },
]
tool = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 50], [0, 0, 0, 1]]

[[pose]]
matrix = [[0, 0, 1, 300], [0, 1, 0, 20], [-1, 0, 0, 150], [0, 0, 0, 1]]

[[pose]]
quaternion = [0.5, 0.5, 0.5, 0.5]
position = [300, 20, 150]
"""


@pytest.mark.parametrize("checker", CHECKERS)
def test_certificates_are_about_files_in_other_units(tmp_path, checker):
    (tmp_path / "file.toml").write_text(IN_MILLIMETRES)
    run(LOOPROOT, "solve", tmp_path / "file.toml", "-q", "--certificate", tmp_path / "certificate")
    assert len(lines(tmp_path / "certificate")) == 2
    answer = CHECKERS[checker](tmp_path / "certificate", "--file", tmp_path / "file.toml")
    assert answer.returncode == 0, answer


@pytest.mark.parametrize("checker", CHECKERS)
def test_half_angle_tangents_of_files_have_signs_and_blanks(tmp_path, checker):
    text = IN_MILLIMETRES.replace('"deg"', '"rad"').replace("alpha = 90", 'alpha = "pi/2"')
    (tmp_path / "file").write_text(text.replace("alpha = 0, d = 5.5", 'alpha = "2 * atan(-1/3)", d = 5.5'))
    run(LOOPROOT, "solve", tmp_path / "file", "-q", "--certificate", tmp_path / "certificate")
    answer = CHECKERS[checker](tmp_path / "certificate", "--file", tmp_path / "file")
    assert answer.returncode == 0, answer


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_rational_number_near_an_irrational_one_is_another_number(tmp_path, checker):
    """The convergent of the square root of 2 agrees with it to more bits than balls have."""
    convergent = [fmpq(1)]
    while convergent[-1].height_bits() < 200:
        convergent.append(1 + 1 / (1 + convergent[-1]))
    for name, length in (("root", "sqrt(2)"), ("near", convergent[-1]), ("plain", "431.8")):
        text = IN_MILLIMETRES.replace("431.8, alpha", f'"{length}", alpha')
        (tmp_path / name).write_text(text)
        run(LOOPROOT, "solve", tmp_path / name, "-q", "--certificate", tmp_path / f"of-{name}")
    for name in ("root", "near", "plain"):
        for file in ("root", "near", "plain"):
            answer = CHECKERS[checker](tmp_path / f"of-{name}", "--file", tmp_path / file)
            assert answer.returncode == (0 if file == name else 2), (name, file, answer)


def lines(path):
    return [json.loads(line) for line in path.read_text().splitlines()]


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_solutions_of_short_loops_are_refused(certificates, tmp_path, checker):
    planar, dietmaier = (lines(certificates / f"overconstrained-{name}")[0] for name in ("planar_4r", "dietmaier_a"))
    arm, general = lines(certificates / "arm-chain_cc")[0], lines(certificates / "arm-manocha_canny_1994")[0]
    (bound, points), claim = planar["proof"], planar["claim"]
    of_own, four = dietmaier["proof"]
    assert bound["kind"] == "geometry-bound" and of_own["kind"] == "own-eliminant", (bound, of_own)
    forged = {
        "no points": {**planar, "proof": [bound]},
        "no points, and none claimed": {**planar, "proof": [bound], "claim": {**claim, "complex": 0, "real": 0, "status": "unreachable"}},
        "no bound": {**planar, "proof": [points, points]},
        "points of another loop": {**planar, "proof": [bound, four]},
        "points of another position": {**planar, "proof": [bound, lines(certificates / "overconstrained-planar_4r")[1]["proof"][1]]},
        "a multiple polynomial": {**planar, "proof": [bound, {**points, "polynomial": [*points["polynomial"], "0"]}]},
        "a constant": {**planar, "proof": [bound, {**points, "polynomial": ["1"]}]},
        "no weights": {**planar, "proof": [bound, {**points, "aid": {"weights": ["0"] * len(points["aid"]["weights"])}}]},
        "a value left out": {**planar, "proof": [bound, {**points, "values": points["values"][1:]}]},
        "three proofs": {**planar, "proof": [bound, points, points]},
        "a mode left out": {**planar, "modes": planar["modes"][1:], "proof": [{**bound, "value": bound["value"] - 1}, points]},
        "another number": {**planar, "claim": {**claim, "complex": claim["complex"] + 1}},
        "a real solution less": {**planar, "claim": {**claim, "real": claim["real"] - 1}},
        "a mode of the loop left out": {**dietmaier, "modes": dietmaier["modes"][1:], "proof": [{**of_own, "value": 3}, four]},
        "modes of another loop": {**dietmaier, "modes": planar["modes"][:4]},
        "a mode with an added angle": {**dietmaier, "modes": [
            {**mode, "centre": [*mode["centre"][:5], "0.000001"]} for mode in dietmaier["modes"]]},
        "an eliminant that hides an added angle": {**dietmaier, "proof": [{**of_own, "aid": {**of_own["aid"], "first": 5}}, four]},
        "an arm of six joints": {**general, "proof": [{**of_own, "value": 16}, four]},
        "points of an arm of six joints": {**general, "proof": [*general["proof"], points]},
        "a polynomial of an arm of few joints": {**arm, "claim": {
            **arm["claim"], "verb": "derive", "unknown": 1, "degree": 1, "polynomial": ["0", "1"]}},
    }
    for name, certificate in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", certificate))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)


def written(path, certificate):
    path.write_text(json.dumps(certificate))
    return path


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_certificates_are_refused(certificates, tmp_path, checker):
    true = json.loads((certificates / "arm-manocha_canny_1994").read_text())
    check = CHECKERS[checker]
    half = {**true, "modes": true["modes"][:8], "claim": {**true["claim"], "complex": 8, "real": 8}}
    forged = {
        "half of the modes": half,
        "half of the modes and a bound of 8": {**half, "proof": [{"kind": "general-bound", "value": 8}]},
        "an incidence that is not there": {**half, "proof": [{"kind": "geometry-bound", "value": 8}]},
        "no proof": {**true, "proof": []},
        "a mode twice": {**true, "modes": true["modes"][:15] + true["modes"][:1]},
        "a mode moved by a turn": {**true, "modes": true["modes"][:15] + [turned(true["modes"][0])]},
        "another verb": {**true, "claim": {**true["claim"], "verb": "sweep"}},
        "an eliminant of another bound": {**half, "proof": [{"kind": "eliminant", "value": 8, "aid": AID}]},
        "an eliminant of no unknown": {**true, "proof": [{"kind": "eliminant", "value": 16, "aid": {**AID, "first": 6}}]},
        "no modes": {**true, "modes": [], "claim": {**true["claim"], "complex": 0, "real": 0, "status": "unreachable"}},
        "a multiplicity": {**true, "modes": [{**true["modes"][0], "multiplicity": 16}]},
    }
    for name, certificate in forged.items():
        answer = check(written(tmp_path / "forged", certificate))
        assert answer.returncode == 2 and "refused: " in answer.stdout, (name, answer)
    answer = check(certificates / "arm-manocha_canny_1994", "--file", "equations/arm/puma560.toml")
    assert answer.returncode == 2 and "file" in answer.stdout, answer


def turned(mode):
    first = f"{float(mode['centre'][0]) + 6.283185307179586:.12f}"
    return {**mode, "centre": [first, *mode["centre"][1:]], "radius": "0.0000001"}


@pytest.fixture(scope="session")
def far(certificates):
    """A platform with a leg longer than the way round by any other one."""
    source = (ROOT / "equations/platform/dietmaier_40real.toml").read_text()
    at = source.index("legs = ")
    (certificates / "far.toml").write_text(source[:at] + 'legs = [0.9, 0.9, 0.88, 1e-7, 1e7, 0.75]\n')
    # The wrist of this arm is 0.9 m away, which is less than all links together, and more than they reach.
    x, y, z = "-0.308696230834", "0.057579093148", "-0.152592450013"
    beyond = AS_BUILT.replace(x, "0.838").replace(y, "-0.059").replace(z, "-0.052")
    (certificates / "beyond.toml").write_text(beyond)
    for name in ("far", "beyond"):
        solved = run(LOOPROOT, "solve", certificates / f"{name}.toml", "-q", "--certificate", certificates / name)
        assert solved.returncode == 3 and not solved.stderr, solved
    return certificates / "far"


@pytest.mark.parametrize("checker", CHECKERS)
def test_distances_prove_that_nothing_is_in_reach(certificates, far, tmp_path, checker):
    assert json.loads(far.read_text())["proof"] == [{"kind": "distance"}]
    answer = CHECKERS[checker](far, "--file", f"{far}.toml")
    assert answer.returncode == 0 and re.search("no real solution|real 0", answer.stdout), answer
    true = json.loads((certificates / "platform-points_6_3").read_text())
    forged = {**true, "modes": [], "proof": [{"kind": "distance"}], "claim": {**json.loads(far.read_text())["claim"]}}
    answer = CHECKERS[checker](written(tmp_path / "forged", forged))
    assert answer.returncode == 2 and "distance" in answer.stdout, answer


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize(("entry", "joints"), [("arm/puma560", "0,0,0,0,0,0"), ("arm/kr6_r900", "0,0,0,0,0,0"), ("arm/ur5", "0,0,0,0,0,0")])
def test_self_motions_are_certified(certificates, tmp_path, checker, entry, joints):
    path = tmp_path / "curve"
    run(LOOPROOT, "solve", f"equations/{entry}.toml", "-q", "--joints", joints, "--certificate", path)
    answer = CHECKERS[checker](path)
    assert answer.returncode == 0 and re.search("self-motion", answer.stdout), answer
    true, isolated = json.loads(path.read_text()), lines(certificates / "arm-puma560")[0]
    forged = {
        "two dimensions": {"claim": {**true["claim"], "self_motion": 2}},
        "another verb": {"claim": {**true["claim"], "verb": "mobility"}},
        "a number of solutions": {"claim": {**true["claim"], "real": 1}},
        "another status": {"claim": {**true["claim"], "status": "complete"}},
        "no proof": {"proof": []},
        "an item more": {"proof": true["proof"] * 2},
        "another item": {"proof": [{"kind": "general-bound", "value": 16}]},
        "a mode": {"modes": isolated["modes"][:1]},
        "another pose": {"data": {**true["data"], "pose": isolated["data"]["pose"]}},
    }
    for name, parts in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", {**true, **parts}))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize("name", NOTHING_COUNTED)
def test_where_no_solution_is_counted_another_one_shows_the_data(certificates, far, tmp_path, checker, name):
    true = lines(certificates / name)[0]
    (mode,) = true["modes"]
    assert true["claim"]["real"] == true["claim"].get("complex", 0) == true["proof"][0].get("value", 0) == 0
    forged = {
        "no mode": {"modes": []},
        "two modes": {"modes": [mode, mode]},
        "a real mode": {"modes": [{**mode, "real": not mode["real"]}]},
        "another mode": {"modes": [{**mode, "centre": ["0.1", *mode["centre"][1:]]}]},
        "solutions that are counted": {"claim": {**true["claim"], "complex": 1}},
        "a real solution that is counted": {"claim": {**true["claim"], "real": 1, "status": "complete"}},
    }
    assert CHECKERS[checker](written(tmp_path / "true", true)).returncode == 0
    for what, change in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", {**true, **change}))
        assert answer.returncode == 2 and "refused: " in answer.stdout, (what, answer)


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize("entry", ["chain/ik_general", "loop/crrrrr_every_input"])
def test_closure_polynomials_are_certified(tmp_path, checker, entry):
    path = tmp_path / "derived"
    run(LOOPROOT, "derive", f"equations/{entry}.toml", "-q", "--certificate", path)
    answer = CHECKERS[checker](path, "--file", f"equations/{entry}.toml")
    assert answer.returncode == 0 and re.search("polynomial|degree 16", answer.stdout), answer
    true = json.loads(path.read_text())
    bound, member = true["proof"]
    coefficients = true["claim"]["polynomial"]
    forged = {
        "another coefficient": {"claim": {**true["claim"], "polynomial": ["7", *coefficients[1:]]}},
        "a common factor": {"claim": {**true["claim"], "polynomial": [str(2 * int(c)) for c in coefficients]}},
        "another degree": {"claim": {**true["claim"], "polynomial": coefficients[1:], "degree": 15}},
        "another unknown": {"claim": {**true["claim"], "unknown": true["claim"]["unknown"] % 6 + 1}},
        "a negative joint": {
            "claim": {**true["claim"], "unknown": 6},
            "proof": [bound, {**member, "aid": {**member["aid"], "first": -7, "hidden": 0}}],
        },
        "no membership": {"proof": [bound]},
        "no bound": {"proof": [member]},
        "no list of all solutions": {"proof": [{"kind": "distance"}, member], "modes": []},
        "a mode left out": {"modes": true["modes"][1:]},
        "a claim of solve": {"claim": {**true["claim"], "verb": "solve"}},
    }
    for name, change in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", {**true, **change}))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)


@pytest.fixture(scope="session")
def of_four_joints(certificates):
    answer = run(LOOPROOT, "conditions", "4R", "-q", "--certificate", certificates / "conditions")
    assert answer.returncode == 0 and not answer.stderr, answer
    return certificates / "conditions"


@pytest.mark.parametrize("checker", CHECKERS)
def test_families_of_loops_that_move_are_certified(of_four_joints, tmp_path, checker):
    answer = CHECKERS[checker](of_four_joints)
    assert answer.returncode == 0, answer
    true = json.loads(of_four_joints.read_text())
    families = true["claim"]["families"]
    of = lambda *families, **others: {"claim": {**true["claim"], "families": list(families), **others}}
    first, second, last = families[0], families[1], families[-1]
    forged = {
        "a family left out": of(*families[1:]),
        "a family twice": of(first, first, *families[2:]),
        "the curve of another family": of({**first, "motion": second["motion"]}, *families[1:]),
        "the lengths of another family": of({**first, "conditions": [*first["conditions"][:4], second["conditions"][4],
                                                                     *first["conditions"][5:]]}, *families[1:]),
        "a condition of lengths left out": of({**first, "conditions": [*first["conditions"][:3], "a1 - a3", *first["conditions"][4:]]},
                                              *families[1:]),
        "a condition that says nothing": of({**first, "conditions": [*first["conditions"][:3], "0", *first["conditions"][4:]]},
                                            *families[1:]),
        "offsets that differ from 0": of({**first, "conditions": first["conditions"][:8]}, *families[1:]),
        "an angle that is fixed": of({**first, "motion": ["x2", *first["motion"][1:]]}, *families[1:]),
        "an angle of which nothing is said": of({**first, "motion": [first["motion"][0], "0", first["motion"][2]]}, *families[1:]),
        "another class": of({**first, "class": "spherical"}, *families[1:]),
        "spherical loops with a length": of(*families[:-1], {**last, "conditions": [*last["conditions"][:7], "d3"]}),
        "another curve of spherical loops": of(*families[:-1], {**last, "motion": first["motion"][2:]}),
        "any twists": of(*families, oblique_links=[1, 2, 3]),
        "other joints": of(*families, moving_joints=[1, 3]),
        "another status": of(*families, status="incomplete"),
        "five joints": {"data": {"joints": 5}},
        "a mechanism": {"data": {"joints": 4, "mechanism": {}}},
        "no proof": {"proof": []},
        "another proof": {"proof": [{"kind": "curve"}]},
        "two proofs": {"proof": true["proof"] * 2},
        "a polynomial that is not multiplied out": of({**first, "motion": [first["motion"][0], "(x1 + x3)", first["motion"][2]]},
                                                      *families[1:]),
        "a power that takes long": of({**first, "motion": [first["motion"][0], "x1^99999999999999999999 + x3", first["motion"][2]]},
                                      *families[1:]),
        "a power of a condition that takes long": of({**first, "conditions": [
            *first["conditions"][:4], first["conditions"][4].replace("t1^2", "t1^999999999"), *first["conditions"][5:]]}, *families[1:]),
        "what is no polynomial": of({**first, "motion": [first["motion"][0], "x1 +", first["motion"][2]]}, *families[1:]),
        "no text": of({**first, "motion": [first["motion"][0], 7, first["motion"][2]]}, *families[1:]),
    }
    for name, change in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", {**true, **change}))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)
        assert "Traceback" not in answer.stderr and "panicked" not in answer.stderr, (name, answer)
    answer = CHECKERS[checker](of_four_joints, "--file", "equations/overconstrained/bennett_a.toml")
    assert answer.returncode == 2 and "file" in answer.stdout, answer


def test_no_number_and_no_sign_of_the_families_may_change(of_four_joints, capsys):
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    import mutations
    assert mutations.main([str(of_four_joints)]) == 0, capsys.readouterr().out


AS_BUILT = """
[mechanism]
kind = "arm"
convention = "dh"
joints = [
    { type="R", a=-0.0000005241, alpha=-1.5707962383, d=-0.0000002601 },
    { type="R", a=0.4300002078, alpha=0.0000002514, d=0.1499991311 },
    { type="R", a=0.0199990263, alpha=-1.5707956519, d=-0.0000004813 },
    { type="R", a=-0.0000005313, alpha=1.5707973181, d=0.4299999405 },
    { type="R", a=0.0000006729, alpha=-1.5707963741, d=0.0000002781 },
    { type="R", a=-0.0000006988, alpha=0.0000002697, d=0.1000007361 },
]

[[pose]]
matrix = [[-0.776832129004, -0.125333327847, -0.617108904714, -0.308696230834], [0.354482413651, 0.722928945972, -0.593056453879, 0.057579093148], [0.520455629001, -0.679459561715, -0.517165971653, -0.152592450013], [0.0, 0.0, 0.0, 1.0]]
"""


@pytest.fixture(scope="session")
def as_built(certificates):
    """An arm of which the links are off by up to 1e-6: its real solutions are certified without the complex ones."""
    (certificates / "as_built.toml").write_text(AS_BUILT)
    run(LOOPROOT, "solve", certificates / "as_built.toml", "-q", "--certificate", certificates / "as_built")
    return certificates / "as_built"


@pytest.mark.parametrize("checker", CHECKERS)
def test_real_solutions_alone_are_certified(as_built, tmp_path, checker):
    answer = CHECKERS[checker](as_built, "--file", f"{as_built}.toml")
    assert answer.returncode == 0 and re.search("8 real solutions|real 8", answer.stdout), answer
    true = json.loads(as_built.read_text())
    modes, item = true["modes"], true["proof"][0]
    of = lambda count: {"modes": modes[:count], "claim": {**true["claim"], "real": count}, "proof": [{**item, "value": count}]}
    forged = {
        "a mode left out": of(7),
        "no modes": {**of(0), "claim": {**of(0)["claim"], "status": "unreachable"}},
        "a mode left out, and the bound as it is": {**of(7), "proof": [item]},
        "a mode twice": {"modes": modes[:7] + modes[:1]},
        "a radius too small": {"modes": [{**modes[0], "radius": "1e-40"}, *modes[1:]]},
        "a centre moved": {"modes": [{**modes[0], "centre": ["0.1", *modes[0]["centre"][1:]]}, *modes[1:]]},
        "another bound": {"proof": [{**item, "value": 9}]},
        "the complex solutions counted": {"claim": {**true["claim"], "complex": 16}},
        "another unknown": {"proof": [{**item, "aid": {"first": 0, "hidden": 3}}]},
        "another theorem": {"proof": [{"kind": "general-bound", "value": 8}], "claim": {**true["claim"], "complex": 8}},
    }
    for name, change in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", {**true, **change}))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout, (name, answer)


BROKEN = {
    "cut": lambda text: text[: len(text) // 2],
    "another version": lambda text: text.replace('"version":1', '"version":2'),
    "a number of a million digits": lambda text: text.replace('"version":1', '"version":' + "1" * 1_000_000),
    "an exponent": lambda text: re.sub(r'"radius":"[^"]*"', '"radius":"1e999999999"', text, count=1),
    "an exponent without quotes": lambda text: re.sub(r'"radius":"[^"]*"', '"radius":1e999999999', text, count=1),
    "NaN": lambda text: re.sub(r'"radius":"[^"]*"', '"radius":NaN', text, count=1),
    "NaN in the claim": lambda text: text.replace('"complex":8', '"complex":NaN', 1),
    "an exponent in the claim": lambda text: text.replace('"complex":8', '"complex":1e999999999', 1),
    "digits in a text": lambda text: re.sub(r'"radius":"[^"]*"', '"radius":"' + "1" * 1_000_000 + '"', text, count=1),
    "trailing garbage": lambda text: text.strip() + "garbage\n",
    "deep nesting": lambda text: "[" * 1_000_000,
    "nested data": lambda text: '{"data":' * 100_000,
    "nothing": lambda text: "",
}


@pytest.mark.parametrize("checker", CHECKERS)
@pytest.mark.parametrize("broken", [*BROKEN, "a folder", "no file", "bytes"])
def test_what_is_no_certificate_is_said_in_one_line(certificates, tmp_path, checker, broken):
    path = tmp_path / "broken"
    if broken == "a folder":
        path.mkdir()
    elif broken == "bytes":
        path.write_bytes(b"\xff\xfe\x00{")
    elif broken != "no file":
        path.write_text(BROKEN[broken]((certificates / "arm-puma560").read_text()))
    answer = CHECKERS[checker](path, limit=limit)
    assert answer.returncode == 1, answer
    lines = [line for line in answer.stderr.splitlines() if line]
    assert len(lines) == 1 and lines[0].startswith("error: ") and "Traceback" not in answer.stderr, answer


def test_without_python_flint_one_line_says_how_to_get_it():
    answer = run(sys.executable, "-S", VERIFY, "certificate.json")  # Python without what is installed
    assert answer.returncode == 1 and answer.stderr.count("\n") == 1 and "pip install python-flint" in answer.stderr, answer


CHANGED = ["arm/puma560", "chain/crcr", "loop/rrsrr", "overconstrained/bennett_a", "overconstrained/bennett_broken", "as_built", "arm/chain_cc",
           "overconstrained/dietmaier_a-motion", "chain/structure_5r", "chain/ccc", "linkage/3rpr", "linkage/crank_slider", "loop/rrrrrrr_every_input-motion",
           "platform/points_6_3", "chain/arm_6r_two_wrists", "derived", *NOTHING_COUNTED]


@pytest.fixture(scope="session")
def derived(certificates):
    run(LOOPROOT, "derive", "equations/chain/arm_4r2p_wrist_ppr.toml", "-q", "--certificate", certificates / "derived")


@pytest.mark.parametrize("entry", CHANGED)
def test_no_other_number_may_change(certificates, as_built, far, derived, capsys, entry):
    """What is under `aid`, radii and centres may stay valid; all other changes are refused by both checkers."""
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    import mutations
    assert mutations.main([str(certificates / entry.replace("/", "-"))]) == 0, capsys.readouterr().out


def test_numbers_of_every_kind_of_proof_are_changed(certificates, as_built, far, derived, of_four_joints, sweeps):
    """By the test above and those of families and sweeps."""
    sys.path.insert(0, os.path.dirname(VERIFY))
    import verify
    places = [*(certificates / entry.replace("/", "-") for entry in CHANGED), of_four_joints, *(place for place, *_ in sweeps.values())]
    changed = {item["kind"] for place in places for certificate in lines(place) for item in certificate["proof"]}
    assert changed == {*verify.BOUNDS, *verify.LISTS, *verify.MOTIONS, "points", "membership", "families", "discriminant"}


FOUR_BAR = """
[mechanism]
kind = "linkage"
space = "plane"
ground = "frame"
joints = "shared points"

[mechanism.bodies]
frame = { A = [0, 0], D = [4, 0], E = [5, 1] }
crank = { A = 0, B = 1 }
coupler = { B = 0, C = 3 }
rocker = { D = [0, 0], C = [3, 0], %s = [1, 2] }

[[input]]
joint = "A"
tan_half = "1/2"
"""


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_linkages_are_refused(tmp_path, checker):
    """A further joint of a file is a further loop, and a given joint that does not exist is no datum."""
    for name, point in ("four", "P"), ("over", "E"):
        (tmp_path / name).write_text(FOUR_BAR % point)
    run(LOOPROOT, "solve", tmp_path / "four", "-q", "--certificate", tmp_path / "certificate")
    answer = CHECKERS[checker](tmp_path / "certificate", "--file", tmp_path / "four")
    assert answer.returncode == 0 and "2 solutions" in answer.stdout.replace("complex 2", "2 solutions"), answer
    assert CHECKERS[checker](tmp_path / "certificate", "--file", tmp_path / "over").returncode == 2
    honest = json.loads((tmp_path / "certificate").read_text())
    for key, aid in ("0", {}), ("-1", {}), ("9", {}), (None, {"up": 200, "each": 200}), (None, {"up": 0, "down": 0}):
        forged = json.loads(json.dumps(honest))
        if key:
            forged["data"]["input"][0]["given"][key] = {"tan_half": "7"}
        forged["proof"][0]["aid"].update(aid)
        answer = CHECKERS[checker](written(tmp_path / "forged", forged))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout and "panicked" not in answer.stderr, (key, aid, answer)


# Loops that are swept, their joints, and of how many branches, circuits and limit positions.
SWEPT = {"overconstrained/planar_4r": {"1": (2, 2, 0), "3": (4, 2, 4)}, "overconstrained/spherical_4r": {"2": (2, 2, 0), "4": (4, 2, 4)},
         "overconstrained/slider_crank": {"1": (2, 2, 0), "2": (2, 2, 0), "3": (4, 2, 4)}, "overconstrained/hooke_rur": {"3": (4, 2, 4)},
         "linkage/watt_line": {"": (2, 1, 2)}, "linkage/chebyshev_line": {"": (4, 2, 4)}, "linkage/holditch": {"": (2, 2, 0)},
         "linkage/crank_slider": {"": (2, 1, 2)}, "linkage/inverted_slider_crank": {"": (2, 2, 0)},
         "linkage/spherical_four_bar": {"": (4, 2, 4)}, "linkage/spherical_coupler_curve": {"": (2, 1, 2)}, "linkage/spherical_symmetric_curve": {"": (2, 1, 2)}}
RSSR = """
[mechanism]
kind = "loop"
convention = "dh"
joints = [%s]
"""
COUPLERS = {"9": (2, 1, 2), "8": (2, 2, 0), "30": (0, 0, 0)}  # a coupler of 30 is too long
OTHERS = {("0.toml", "4"), ("1.toml", "3")}  # the other joint as the input


def rssr(coupler, first):
    joints = ['{ type = "R", a = 6, alpha = 0, d = 1 }', '{ type = "S", a = "%s", alpha = 0 }' % coupler, '{ type = "S", a = -4, alpha = 0 }',
              '{ type = "R", a = -2, tan_half_alpha = "-1/4", d = -4 }']
    return RSSR % ", ".join(joints[first:] + joints[:first])


def sweep(mechanism, joint, place):
    """The certificate of a full turn, and the answer itself."""
    options = ["--from", "-180 deg", "--to", "180 deg", "--steps", "12", "--json", *(["--joint", joint] if joint else [])]
    answer = run(LOOPROOT, "sweep", mechanism, *options, "--certificate", place)
    return place, json.loads(answer.stdout)


@pytest.fixture(scope="session")
def sweeps(tmp_path_factory):
    """(mechanism, joint) to the certificate, the answer and the numbers that are expected of it."""
    place, found = tmp_path_factory.mktemp("sweeps"), {}
    for entry, joints in SWEPT.items():
        for joint, counts in joints.items():
            found[entry, joint] = *sweep(f"equations/{entry}.toml", joint, place / f"{entry.replace('/', '-')}-{joint}"), counts
    for coupler, counts in COUPLERS.items():
        for first in range(4):  # the input is the joint behind it, or in front of it
            (mechanism := place / f"{coupler}-{first}.toml").write_text(rssr(coupler, first))
            joint = str((4 - first) % 4 + 1)
            found[str(mechanism), joint] = *sweep(mechanism, joint, place / f"{coupler}-{first}"), counts
        for first in range(2):  # the other joint as the input, which turns backwards
            (mechanism := place / f"{coupler}-{first}.toml").write_text(rssr(coupler, first))
            joint = str(4 - first)
            found[str(mechanism), joint] = *sweep(mechanism, joint, place / f"{coupler}-{first}-back"), counts
    return found


@pytest.mark.parametrize("checker", CHECKERS)
def test_sweeps_are_certified(sweeps, checker):
    texts = {}
    for (mechanism, joint), (certificate, listed, counts) in sweeps.items():
        file = mechanism if mechanism.endswith(".toml") else f"equations/{mechanism}.toml"
        answer = CHECKERS[checker](certificate, "--file", file)
        assert answer.returncode == 0 and f"branches {counts[0]}, circuits {counts[1]}" in answer.stdout, (mechanism, joint, answer)
        claim = json.loads(certificate.read_text())["claim"]
        circuits = len({branch["circuit"] for branch in listed["branches"]})
        assert (len(listed["branches"]), circuits, len(claim["limits"])) == counts and listed["verdict"]["status"] == claim["status"]
        found = sorted(limit["input"] for limit in listed["limits"])
        assert found == pytest.approx([float(limit["centre"]) for limit in claim["limits"]], abs=1e-9)
        other = CHECKERS[checker](certificate, "--file", "equations/linkage/steering_trapezoid.toml")
        assert other.returncode == 2 and "file" in other.stdout, other
        texts[mechanism, joint] = json.loads(certificate.read_text())["data"]
    # Wherever the list of joints begins, the four-bar is the same.
    for count, is_other in (4, False), (2, True):
        same = [data for (mechanism, joint), data in texts.items() if "/9-" in mechanism and ((mechanism[-6:], joint) in OTHERS) == is_other]
        assert len(same) == count and all(data == same[0] for data in same)


def test_no_number_of_a_sweep_may_change(sweeps, capsys):
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    import mutations
    assert mutations.main([str(certificate) for certificate, *_ in sweeps.values()]) == 0, capsys.readouterr().out


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_sweeps_are_refused(sweeps, tmp_path, checker):
    own, slide, plane = (json.loads(sweeps[key][0].read_text()) for key in (
        ("linkage/watt_line", ""), ("linkage/crank_slider", ""), ("linkage/inverted_slider_crank", "")))
    claimed = lambda **other: {**own, "claim": {**own["claim"], **other}}
    given = lambda **other: {**own, "data": {**own["data"], **other}}
    output = lambda **other: given(output={**own["data"]["output"], **other})
    one, other = own["claim"]["limits"]
    forged = {
        "other branches": claimed(branches=4), "other circuits": claimed(circuits=2), "another word": claimed(status="unreachable"),
        "a limit left out": claimed(limits=[one]), "the same one twice": claimed(limits=[one, one]), "another order": claimed(limits=[other, one]),
        "a wide interval": claimed(limits=[one, {**other, "radius": "0.1"}]), "another place": claimed(limits=[one, {**other, "centre": "1.1"}]),
        "a turn on": claimed(limits=[other, {**one, "centre": "5.77219455988255"}]), "no radius": claimed(limits=[one, {**other, "radius": "0"}]),
        "a longer crank": given(crank=["3", "0"]), "a number in another form": given(crank=["2.0", "0"]), "a further number": given(offset_squared="1"),
        "a common factor": output(axis=["0", "0", "2"]), "an axis backwards": output(axis=["0", "0", "-1"]), "no axis": output(axis=["0", "0", "0"]),
        "a mirrored centre": output(centre=["4", "1", "-1"]), "a negative square": output(radius_squared="-4"), "no circle": output(point=["4", "1", "0"]),
        "an irrational number": given(coupler_squared="sqrt(2)"), "no number": given(coupler_squared="1/0"),
        "a mode": {**own, "modes": [{}]}, "no proof": {**own, "proof": []}, "proved twice": {**own, "proof": own["proof"] * 2},
        "another discriminant": {**own, "proof": slide["proof"]}, "a multiple of it": {**own, "proof": [
            {"kind": "discriminant", "polynomial": [str(2 * int(c)) for c in own["proof"][0]["polynomial"]]}]},
        "another verb": claimed(verb="solve"), "a point that is not the nearest": {**slide, "data": {
            **slide["data"], "output": {"axis": ["3", "4", "0"], "point": ["11", "-8", "0"]}}},
        "a slide": {**plane, "data": {**slide["data"]}}, "a coupler too many": {**plane, "data": {**plane["data"], "coupler_squared": "1"}},
    }
    # A kite can be folded flat: branches meet there.
    folded = {"crank": ["1", "0"], "coupler_squared": "9", "output": {"axis": ["0", "0", "1"], "centre": ["3", "0", "0"], "radius_squared": "1"}}
    forged["a parallelogram"] = {**own, "data": folded, "claim": {**own["claim"], "circuits": 2, "limits": []}, "proof": [
        {"kind": "discriminant", "polynomial": ["0", "0", "144", "0", "0"]}]}
    for name, certificate in forged.items():
        answer = CHECKERS[checker](written(tmp_path / "forged", certificate))
        assert answer.returncode in (1, 2) and "holds" not in answer.stdout and "Traceback" not in answer.stderr, (name, answer)
        assert "panicked" not in answer.stderr, (name, answer)


def test_sweeps_that_have_no_certificate_say_why(tmp_path):
    for entry, joint, turn, why in (
        ("linkage/coupler_cognate", "", "360 deg", "multiple real root"), ("linkage/level_four_bar", "", "360 deg", "half a turn"),
        ("linkage/watt_line", "", "90 deg", "full turns"), ("loop/rssr", "1", "360 deg", "not proved"), ("linkage/watt_1", "", "360 deg", "four bodies"),
        ("overconstrained/bennett_a", "1", "360 deg", "only loops RSSR"), ("linkage/spherical_watt", "", "360 deg", "four bodies"),
    ):
        answer = run(LOOPROOT, "sweep", f"equations/{entry}.toml", "--from", "0", "--to", turn, "--steps", "12", "-q",
                     "--certificate", tmp_path / "none", *(["--joint", joint] if joint else []))
        assert answer.returncode in (0, 2) and why in answer.stderr and not (tmp_path / "none").exists(), (entry, answer)
