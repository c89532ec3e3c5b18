"""Linkages from Python."""

import math

import numpy as np
import pytest

import looproot as lr


def test_assemblies_of_a_linkage() -> None:
    linkage = lr.Linkage("linkage/jansen")
    s = linkage.solve(input={"O": math.pi / 2})
    assert s.q.shape == (8, len(linkage.names)) and s.verdict.proved and s.complete
    assert np.allclose(s.q[:, linkage.names.index("O")], math.pi / 2)
    assert s.bodies is not None and set(s.bodies) == set(linkage.bodies)
    assert all(places.shape == (8, 3) for places in s.bodies.values())
    assert "<canvas" in s.view()
    assert len(linkage.solve()) == 8
    assert "Jansen" in repr(linkage)


def test_bad_inputs_of_a_linkage() -> None:
    linkage = lr.Linkage("linkage/3prr")
    assert not all(linkage.angles)
    with pytest.raises(ValueError, match="unknown joint 'Z'"):
        linkage.solve(input={"Z": 1.0})
    with pytest.raises(ValueError):
        linkage.solve(input={linkage.names[0]: math.nan})
    with pytest.raises(TypeError):
        linkage.solve(input=0.3)  # type: ignore[arg-type]
    with pytest.raises(KeyError):
        lr.Linkage("no_such_linkage")
    with pytest.raises(ValueError, match="expected a linkage"):
        lr.Linkage("ur5")


def test_branches_and_curves_of_a_linkage() -> None:
    linkage = lr.Linkage("linkage/coupler_curve_symmetric")
    sweep = linkage.sweep("A", -math.pi, math.pi, 24, trace="coupler.P")
    assert len(sweep.branches) == 2 and sweep.branches[0].shape[1] == 4
    point = sweep.document["branches"][0]["rows"][0]["points"]["coupler.P"]
    curve = linkage.trace("coupler.P")["trace"]
    assert curve["degree"] == 6 and len(point) == 2
    assert linkage.derive()["polynomials"]
    assert linkage.mobility()["mobility"] == 1
    with pytest.raises(ValueError):
        linkage.sweep("A", 0, 0)
    with pytest.raises(ValueError):
        linkage.sweep("nothing", 0, 1)


def test_a_linkage_on_the_sphere() -> None:
    linkage = lr.load("linkage/spherical_3rrr")
    assert isinstance(linkage, lr.Linkage)
    s = linkage.solve()
    assert s.verdict.complex == 8 and s.bodies is not None
    assert all(np.allclose(np.linalg.norm(places, axis=1), 1) for places in s.bodies.values())
    found = linkage.mobility()
    assert (found["mobility"], found["gruebler"]) == (3, 3)


def test_a_linkage_in_space() -> None:
    linkage = lr.load("linkage/delta")
    assert isinstance(linkage, lr.Linkage)
    s = linkage.solve(input={"A1": 0.3})
    # The half tangent of 0.3 radian is no rational number.
    assert len(s) == 2 and s.verdict.proof == "rounded-data" and "<canvas" in s.view()
    assert s.bodies is not None and s.bodies["plate"].shape == (2, 7) and np.allclose(s.q[:, 0], 0.3)
    sweep = linkage.sweep("A1", 0.3, 0.6, 6, trace="plate.B1")
    assert len(sweep.branches) == 2
    rows = sweep.document["branches"][0]["rows"]
    assert len(rows) == 7 and len(rows[0]["points"]["plate.B1"]) == 3
    assert len(linkage.derive()["polynomials"][0]["coefficients"]) == 3
    # A plate on six legs is derived as a platform.
    assert lr.Linkage("linkage/6rus").derive()["degree"] == 36
