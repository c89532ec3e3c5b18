"""Loops and platforms from Python."""

import math

import numpy as np
import pytest

import looproot as lr


def test_modes_of_a_loop() -> None:
    loop = lr.Loop("rrsrr")
    s = loop.solve(input=2.5)
    assert s.q.shape[1] == len(loop.names) and s.verdict.status == "complete"
    assert "<canvas" in s.view()
    with pytest.raises(ValueError):
        loop.solve(input=math.nan)
    with pytest.raises(TypeError):
        loop.solve(0.3)  # type: ignore[misc]
    with pytest.raises(TypeError):
        loop.solve(input="0.3")  # type: ignore[arg-type]


def test_branches_of_a_loop() -> None:
    sweep = lr.Loop("rrsrr").sweep(-math.pi, math.pi, 24)
    assert sweep.branches and all(branch.shape[1] == len(sweep.names) for branch in sweep.branches)
    assert "type=\"range\"" in sweep.view()
    with pytest.raises(ValueError):
        lr.Loop("rrsrr").sweep(0, 0)
    with pytest.raises(ValueError):
        lr.Loop("rrsrr").sweep(0, 1, 0)


def test_poses_of_a_platform() -> None:
    rng = np.random.default_rng(3)
    platform = lr.Platform(rng.uniform(-1, 1, (6, 3)).round(2), rng.uniform(-1, 1, (6, 3)).round(2))
    pose = lr.Pose([0.1, 0.2, 0.9], quat_wxyz=[0.8, 0.6, 0, 0])
    legs = platform.legs(pose)
    s = platform.solve(legs=legs)
    assert s.matrix is not None and s.matrix.shape == (len(s), 4, 4)
    assert np.abs(s.matrix - pose.matrix).max(axis=(1, 2)).min() < 1e-7
    for matrix in s.matrix:
        assert np.abs(platform.legs(matrix) - legs).max() < 1e-9
    with pytest.raises(ValueError, match=r"\[2\]"):
        platform.solve(legs=[1, 1, -1, 1, 1, 1])
    with pytest.raises(ValueError, match=r"\(5,\)"):
        platform.solve(legs=[1] * 5)
    with pytest.raises(ValueError, match=r"\(6, 2\)"):
        lr.Platform(np.zeros((6, 2)), np.zeros((6, 3)))


def test_forty_real_poses() -> None:
    platform = lr.Platform.load("dietmaier_40real")
    assert platform.title.startswith("Dietmaier")


def test_mobility_and_conditions() -> None:
    assert lr.mobility("bennett_a")["mobility"] == 1
    assert lr.conditions("4R")["proof"] == "proved"
    assert lr.Loop("bennett_a").mobility()["proof"] == "proved"
    with pytest.raises(KeyError):
        lr.mobility("no such thing")


def test_load_finds_the_kind() -> None:
    assert isinstance(lr.load("ur5"), lr.Arm)
    assert isinstance(lr.load("rsrc"), lr.Loop)
    assert isinstance(lr.load("dietmaier_40real"), lr.Platform)
    assert "ur5" in lr.names() or "arm/ur5" in lr.names()
