"""Arms from Python."""

import math
import threading
import time

import numpy as np
import pytest

import looproot as lr

Q = [0.3, -0.7, 0.4, 1.1, 0.5, -0.2]


@pytest.fixture(scope="module")
def arm() -> lr.Arm:
    return lr.robot("general_16real")


def test_a_pose_is_reached_by_the_joints_that_gave_it(arm: lr.Arm) -> None:
    s = arm.ik(arm.fk(Q))
    assert s.q.dtype == np.float64 and s.q.shape == (len(s), 6)
    assert s.complete and s.reachable and s.certified.all()
    assert np.abs(s.nearest(Q).q[0] - Q).max() < 1e-9
    assert np.abs(arm.ik(arm.fk(Q), near=Q).q[0] - Q).max() < 1e-9
    for q in s:
        assert np.abs(arm.fk(q) - arm.fk(Q)).max() < 1e-9


def test_the_jacobian_is_the_derivative_of_the_pose(arm: lr.Arm) -> None:
    found = arm.jacobian(Q)
    assert found.shape == (6, 6)
    for joint in range(6):
        moved = np.array(Q)
        moved[joint] += 1e-7
        assert np.abs((arm.fk(moved)[:3, 3] - arm.fk(Q)[:3, 3]) / 1e-7 - found[:3, joint]).max() < 1e-6


def test_a_bad_pose_is_reported_by_index_and_the_rest_solved(arm: lr.Arm) -> None:
    rng = np.random.default_rng(1)
    poses = arm.fk(rng.uniform(-3, 3, (40, 6)))
    poses[7] = np.nan
    poses[11, :3, 0] *= -1
    poses[23, 0, 0] += 0.1
    poses[29, :3, 3] = 100
    b = arm.ik_batch(poses)
    assert len(b) == 40 and sorted(b.errors) == [7, 11, 23]
    assert "nan" in b.errors[7].lower() and "reflection" in b.errors[11]
    assert b.status[29] == "unreachable" and len(b[29]) == 0
    assert (b.counts[[7, 11, 23, 29]] == 0).all() and b.offsets[-1] == len(b.q)
    one = arm.ik(poses[3])
    assert np.array_equal(np.sort(one.q, axis=0), np.sort(b[3], axis=0))
    padded = b.padded(16)
    assert padded.shape == (40, 16, 6) and np.isnan(padded[7]).all()
    with pytest.raises(ValueError):
        b.padded(0)
    with pytest.raises(IndexError):
        b[40]


def test_a_batch_lets_other_threads_run(arm: lr.Arm) -> None:
    # 20,000 poses take about a second. While a batch held the interpreter, the
    # other thread would stand still from its first pose to its last.
    poses = np.repeat(arm.fk(Q)[None], 20_000, axis=0)
    ticks: list[float] = []
    done = threading.Event()

    def tick() -> None:
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.001)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    arm.ik_batch(poses)
    end = time.perf_counter()
    done.set()
    thread.join()
    moments = [start, *(t for t in ticks if start < t < end), end]
    assert max(np.diff(moments)) < (end - start) / 2


@pytest.mark.parametrize(
    ("value", "kind", "text"),
    [
        ("pose", TypeError, "pose"),
        ([[1, 0], [0, 1]], ValueError, r"\(2, 2\)"),
        ([[1, 0, 0, 0], [0, 1, 0], [0, 0, 1, 0], [0, 0, 0, 1]], ValueError, "unequal"),
        (np.diag([1.0, 1.0, -1.0, 1.0]), ValueError, "reflection"),
        (np.diag([1.0, 1.0, np.nan, 1.0]), ValueError, r"\[2, 2\]"),
        (np.eye(4) * 1.1, ValueError, "last row"),
        (np.diag([1.1, 1.0, 1.0, 1.0]), ValueError, "rotation"),
        (np.eye(4) * 1j, TypeError, "complex"),
        (None, TypeError, "object"),
    ],
)
def test_what_is_no_pose_is_refused(arm: lr.Arm, value: object, kind: type[Exception], text: str) -> None:
    with pytest.raises(kind, match=text):
        arm.ik(value)


def test_joint_values_are_checked(arm: lr.Arm) -> None:
    with pytest.raises(ValueError, match=r"\(5,\)"):
        arm.fk([0.0] * 5)
    with pytest.raises(ValueError, match=r"\[1, 2\]"):
        arm.fk([[0.0] * 6, [0, 0, math.inf, 0, 0, 0]])
    with pytest.raises(ValueError, match=r"\(3,\)"):
        arm.ik(arm.fk(Q), near=[1, 2, 3])


def test_unknown_names_are_key_errors() -> None:
    with pytest.raises(KeyError):
        lr.robot("no such robot")
    with pytest.raises(TypeError):
        lr.robot(3)  # type: ignore[arg-type]
    with pytest.raises((KeyError, OSError)):
        lr.from_file("nowhere.toml")


def test_tables_need_a_convention_and_are_checked() -> None:
    rows = [[0.1, 1.0, 0.2]] * 6
    with pytest.raises(TypeError):
        lr.from_dh(rows)  # type: ignore[call-arg]
    with pytest.raises(ValueError, match="convention"):
        lr.from_dh(rows, convention="DH")
    with pytest.raises(ValueError, match=r"\[2, 1\]"):
        lr.from_dh([*rows[:2], [0, math.nan, 0], *rows[3:]], convention="dh")
    with pytest.raises(ValueError, match="6 letters"):
        lr.from_dh(rows[:5], convention="dh")
    with pytest.raises(ValueError, match="joint 3"):
        lr.from_dh(rows, convention="dh", limits=[[-1, 1]] * 2 + [[1, -1]] + [[-1, 1]] * 3)


def test_limits_are_marked() -> None:
    h = math.pi / 2
    rows = [[0, h, 0.4], [0.25, 0, 0], [0.02, h, 0], [0, -h, 0.22], [0, h, 0], [0, 0, 0.09]]
    arm = lr.from_dh(rows, convention="dh", limits=[[-2, 2]] * 6)
    s = arm.ik(arm.fk([0.1, 0.5, 0.3, 0.4, 0.5, 0.6]))
    assert s.within_limits is not None and s.within_limits.any() and not s.within_limits.all()
    assert lr.from_dh(rows, convention="dh").ik(np.eye(4)).within_limits is None


def test_screws_and_tables_agree() -> None:
    axes = [[0, 0, 1], [0, -1, 0], [0, -1, 0], [1, 0, 0], [0, -1, 0], [1, 0, 0]]
    points = [[0, 0, 0], [0, 0, 0.4], [0, 0, 0.8], [0, 0, 0.82], [0.4, 0, 0.82], [0, 0, 0.82]]
    home = np.eye(4)
    home[:3, 3] = [0.5, 0, 0.82]
    arm = lr.from_screws(axes, points, home)
    assert np.abs(arm.fk(np.zeros(6)) - home).max() < 1e-15
    assert arm.ik(arm.fk(Q)).reachable
    with pytest.raises(ValueError, match="row 1"):
        lr.from_screws([axes[0], [0, 0, 0], *axes[2:]], points, home)


def test_quaternions_are_never_positional() -> None:
    a = lr.Pose([1, 2, 3], quat_wxyz=[0.5, 0.5, 0.5, -0.5]).matrix
    b = lr.Pose([1, 2, 3], quat_xyzw=[0.5, 0.5, -0.5, 0.5]).matrix
    assert np.array_equal(a, b)
    with pytest.raises(TypeError):
        lr.Pose([1, 2, 3], [1, 0, 0, 0])  # type: ignore[misc]
    with pytest.raises(TypeError):
        lr.Pose([1, 2, 3])
    with pytest.raises(ValueError, match="norm"):
        lr.Pose([1, 2, 3], quat_wxyz=[2, 0, 0, 0])


def test_truth_is_refused_and_text_is_a_table(arm: lr.Arm) -> None:
    s = arm.ik(arm.fk(Q))
    with pytest.raises(TypeError):
        bool(s)
    assert "complete" in repr(s) and len(repr(s).splitlines()) == len(s) + 1
    html = s._repr_html_()
    assert "<svg" in html and "<table>" in html


def test_pages(arm: lr.Arm, tmp_path: object) -> None:
    path = f"{tmp_path}/page.html"
    page = arm.ik(arm.fk(Q)).view(path)
    assert open(path, encoding="utf-8").read() == page and "default-src 'none'" in page


def test_polynomials_become_sympy() -> None:
    arm = lr.robot("general_16real")
    found = arm.derive(arm.poses[0])
    assert found.polynomial is not None
    poly = found.polynomial.sympy()
    assert poly.degree() == found.polynomial.degree == 16


def test_a_pose_out_of_reach_is_drawn_with_the_nearest_configuration() -> None:
    pose = np.eye(4)
    pose[0, 3] = 5.0
    found = lr.robot("puma560").ik(pose)
    assert not found.reachable and found.complete
    nearest = found.document()["results"][0]["nearest"]
    # The arm reaches 0.9 m from its base.
    assert 4.0 < nearest["error"]["position"] < 4.3
    assert "The nearest configuration found misses the pose by 4.1" in found.view()
