"""Certificates of double solutions: theorem 15 of docs/certificate.md."""
import copy
import json

import pytest

import mutations
from test_verify import CHECKERS, LOOPROOT, run

# A spherical wrist behind a stretched elbow, where two real solutions are double and four complex ones are simple; and a wrist of oblique axes at a
# posture where one of seven solutions is double.
ARMS = {
    "elbow": {"mechanism": {"kind": "arm", "convention": "dh", "joints": [
        {"type": "R", "a": "0.856", "alpha": "pi/2", "d": "0.444"},
        {"type": "R", "a": "0.623", "alpha": "0", "d": "0"},
        {"type": "R", "a": "0", "alpha": "pi/2", "d": "0"},
        {"type": "R", "a": "0", "alpha": "-pi/2", "d": "0.713"},
        {"type": "R", "a": "0", "alpha": "pi/2", "d": "0"},
        {"type": "R", "a": "0", "alpha": "0", "d": "0.457"}]}, "pose": [{"matrix": [
        ["1689/18785", "10852/18785", "-3048/3757", "-541657/469625"],
        ["-8776/93925", "76632/93925", "10719/18785", "40182423/18785000"],
        ["7164/7225", "177/7225", "184/1445", "408537/361250"],
        ["0", "0", "0", "1"]]}]},
    "wrist": {"mechanism": {"kind": "arm", "convention": "dh", "joints": [
        {"type": "R", "a": "0.537", "tan_half_alpha": "1/2", "d": "0.405"},
        {"type": "R", "a": "0.692", "tan_half_alpha": "-5/3", "d": "0.823"},
        {"type": "R", "a": "0.329", "tan_half_alpha": "-1/2", "d": "0.061"},
        {"type": "R", "a": "0", "tan_half_alpha": "3/2", "d": "0.129"},
        {"type": "R", "a": "0", "tan_half_alpha": "1/2", "d": "0"},
        {"type": "R", "a": "0.073", "tan_half_alpha": "1/3", "d": "0.318"}]}, "pose": [{"matrix": [
        ["-4987296/12138425", "108113828/1031766125", "934421979/1031766125", "24445993583/257941531250"],
        ["75168/2427685", "205198431/206353225", "-20843092/206353225", "91192504797/103176612500"],
        ["-850781/933725", "-1068192/79366625", "-32684256/79366625", "125153869077/79366625000"],
        ["0", "0", "0", "1"]]}]},
}


@pytest.fixture(scope="module", params=ARMS)
def stretched(request, tmp_path_factory):
    folder = tmp_path_factory.mktemp("double")
    file, certificate = folder / "arm.json", folder / "certificate"
    file.write_text(json.dumps(ARMS[request.param]))
    answer = run(LOOPROOT, "solve", file, "-q", "--certificate", certificate)
    assert certificate.exists(), answer
    return file, certificate


@pytest.mark.parametrize("checker", CHECKERS)
def test_double_solutions_are_certified(stretched, checker):
    file, certificate = stretched
    own = json.loads(certificate.read_text())
    numbers = [mode["multiplicity"] for mode in own["modes"]]
    assert 2 in numbers and sum(numbers) == 8 == own["claim"]["complex"] and own["proof"][1]["kind"] == "double", own["claim"]
    answer = CHECKERS[checker](certificate, "--file", file)
    assert answer.returncode == 0, answer


def forged(own):
    """Certificates that say something else, with what is refused."""
    def changed(change):
        new = copy.deepcopy(own)
        change(new)
        return new

    double = next(k for k, mode in enumerate(own["modes"]) if mode["multiplicity"] == 2)
    def without(new):
        new["modes"].pop(double)
    def simple(new):
        new["modes"][double]["multiplicity"] = 1
        new["claim"]["complex"] -= 1
    def triple(new):
        new["modes"][double]["multiplicity"] = 3
    def twice(new):
        new["modes"].append(new["modes"][double])
    def alone(new):
        new["proof"].pop()
    def as_points(new):
        new["proof"][1]["kind"] = "points"
    def by_distance(new):
        new["proof"][0] = {"kind": "distance"}
    yield from map(changed, (without, simple, triple, twice, alone, as_points, by_distance))


@pytest.mark.parametrize("checker", CHECKERS)
def test_forged_double_solutions_are_refused(stretched, tmp_path, checker):
    for number, new in enumerate(forged(json.loads(stretched[1].read_text()))):
        path = tmp_path / f"{number}"
        path.write_text(json.dumps(new))
        answer = CHECKERS[checker](path)
        assert answer.returncode == 2 and "Traceback" not in answer.stderr, (number, answer)


def test_no_other_number_of_a_double_solution_may_change(stretched):
    changed = [(key, new) for key, new in mutations.changed(json.loads(stretched[1].read_text())) if key not in mutations.FREE]
    accepted = mutations.accepted_by_rust([new for _, new in changed])
    kept = [key for (key, _), holds in zip(changed, accepted) if holds]
    assert len(changed) > 50 and set(kept) <= {"radius", "centre"}, kept
