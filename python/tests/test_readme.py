"""The programs of the README run as they are printed."""

import re
from pathlib import Path

import pytest

README = Path(__file__).parents[1] / "README.md"
BLOCKS = re.findall(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)


def test_there_are_programs() -> None:
    assert BLOCKS


@pytest.mark.parametrize("program", BLOCKS)
def test_a_program_of_the_readme_runs(program: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    exec(compile(program, "README.md", "exec"), {})
    for page in re.findall(r'view\("([^"]+)"\)', program):
        assert "<canvas" in (tmp_path / page).read_text(encoding="utf-8")
