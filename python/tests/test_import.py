"""What ``import looproot`` reads, and when."""

import ast
import subprocess
import sys
from pathlib import Path

import looproot as lr


def test_names_are_found_where_types_say() -> None:
    source = ast.parse(Path(lr.__file__).read_text(encoding="utf-8"))
    branch = next(node for node in source.body if isinstance(node, ast.If))
    typed = {alias.name: line.module for line in branch.body if isinstance(line, ast.ImportFrom) for alias in line.names}
    assert sorted(typed) == sorted(lr.__all__) == sorted(dir(lr))
    assert lr.batch.__name__ == "looproot.batch"
    for module, names in lr._MODULES.items():
        for name in names:
            assert typed[name] == module
            assert getattr(lr, name) is getattr(sys.modules[f"looproot.{module}"], name)


def test_the_solver_is_read_when_it_is_used() -> None:
    code = "import sys, looproot; assert 'looproot._core' not in sys.modules; looproot.robot; assert 'looproot._core' in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True)


def test_an_unknown_name_is_no_attribute() -> None:
    code = "from looproot import nothing"
    found = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert found.returncode == 1 and "ImportError: cannot import name 'nothing' from 'looproot'" in found.stderr


def test_solutions_do_not_change() -> None:
    arm = lr.robot("ur5")
    found = arm.ik(arm.poses[0])
    assert found.q is found.q
    try:
        found.q = None  # type: ignore[misc, assignment]
    except AttributeError as fault:
        assert "assignment to q" in str(fault)
    else:
        raise AssertionError("solutions were changed")
