"""Both checkers read the same: every number has one text, and what one of them cannot read the other one does not read either."""
import json

import pytest

from test_verify import CHECKERS, ROOT, LOOPROOT, run, written

# A number or an angle of the data, and other texts of the same value.
SAME = {
    "a": ("0.3", ["0.30", "3/10", "3e-1", "+0.3", " 0.3", "0.3 ", "(0.3)", "6/20", "0.1+0.2", "00.3", "--0.3", "sqrt(0.09)", "0.3+0*pi", "0.3\n", "0.3 # 9", "0.3\\\n"]),
    "alpha": ("pi/2", ["90*pi/180", "(90)*pi/180", "2*atan(1)", "-3*pi/2", "5*pi/2", "acos(0)", "0.5*pi", "pi/2 ", "-2*atan(-1)"]),
}
# Texts that are no decimals of modes, and such that are: whether both checkers take them for the same number.
DECIMALS = {"%se0": True, "%sE+0": True, "%se0000": True, "%s000": True, "%se00000": False, " %s": False, "%s/1": False, "%s+0": False, "%s_0": False,
            "%s" + "0" * 370: True, "%s" + "0" * 400: False, "1e401": False, "nan": False, "0x1": False, "\u0661": False, "": False}
BETWEEN = {"\n": True, "": True, "\r\n": True, "\u00a0": False, "\x0b": False, "\x0c": False, "\u2028": False}
INFO = {'"\\ud83d\\ude00"': True, '"\\ud800"': False, "[" * 126 + "]" * 126: True, "[" * 127 + "]" * 127: False, "9" * 308: True, "9" * 400: False, "-0": True, "NaN": False}


@pytest.fixture(scope="module")
def arm(tmp_path_factory):
    """A certificate of which the first joint has `a` of 0.3 and `alpha` of pi/2."""
    path = tmp_path_factory.mktemp("forms") / "certificate"
    run(LOOPROOT, "solve", ROOT / "equations/arm/manocha_canny_1994.toml", "-q", "--certificate", path)
    return json.loads(path.read_text())


def holds(checker, path):
    answer = CHECKERS[checker](path)
    assert "Traceback" not in answer.stderr and "panicked" not in answer.stderr and answer.stderr.count("\n") <= 1, answer
    return answer.returncode == 0


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_number_of_the_data_has_one_text(arm, tmp_path, checker):
    joint = arm["data"]["mechanism"]["joints"][0]
    for key, (own, others) in SAME.items():
        assert joint[key] == own
        for text in others:
            other = json.loads(json.dumps(arm))
            other["data"]["mechanism"]["joints"][0][key] = text
            assert not holds(checker, written(tmp_path / "other", other)), (key, text)
    assert holds(checker, written(tmp_path / "own", arm))


@pytest.mark.parametrize("checker", CHECKERS)
def test_a_number_on_two_lines_is_not_read_as_another_one(arm, tmp_path, checker):
    """The second number stands in the first columns of its line."""
    other = json.loads(json.dumps(arm))
    for text in "(0.15\n+4)", "(0.1\n+0.2)":
        other["data"]["mechanism"]["joints"][0]["a"] = text
        assert not holds(checker, written(tmp_path / "other", other)), text


@pytest.mark.parametrize("checker", CHECKERS)
def test_no_motion_stands_in_the_data_that_is_the_identity(arm, tmp_path, checker):
    identity = [[str(int(i == j)) for j in range(4)] for i in range(4)]
    for key in "base", "tool":
        other = json.loads(json.dumps(arm))
        other["data"]["mechanism"][key] = identity
        assert not holds(checker, written(tmp_path / "other", other)), key


@pytest.mark.parametrize("checker", CHECKERS)
def test_decimals_are_the_same_for_both_checkers(arm, tmp_path, checker):
    own = arm["modes"][0]["centre"][0]
    for form, is_decimal in DECIMALS.items():
        other = json.loads(json.dumps(arm))
        other["modes"][0]["centre"][0] = form % own if "%s" in form else form
        assert holds(checker, written(tmp_path / "other", other)) == is_decimal, form


@pytest.mark.parametrize("checker", CHECKERS)
def test_texts_are_the_same_for_both_checkers(arm, tmp_path, checker):
    text = json.dumps({key: value for key, value in arm.items() if key != "info"})
    for between, is_read in BETWEEN.items():
        (tmp_path / "two").write_text(text + between + text, encoding="utf-8", newline="")
        assert holds(checker, tmp_path / "two") == is_read, between
    for info, is_read in INFO.items():
        (tmp_path / "one").write_text('{"info":' + info + "," + text[1:])
        assert holds(checker, tmp_path / "one") == is_read, info[:20]


@pytest.mark.parametrize("checker", CHECKERS)
def test_what_is_no_number_is_said_in_one_line(arm, tmp_path, checker):
    """Python has remarks of its own about some of them."""
    for text in "0.3or 1", "1if 1else 2", "1/0", "(" * 900, "-" * 1900, "\u00b2":
        other = json.loads(json.dumps(arm))
        other["data"]["mechanism"]["joints"][0]["a"] = text
        assert not holds(checker, written(tmp_path / "other", other)), text
