"""Ctrl-C ends a batch with what is done."""

import os
import signal
import subprocess
import sys

import pytest

import looproot as lr

PROGRAM = """
import numpy as np
import looproot as lr

arm = lr.robot("general_16real")
poses = np.repeat(arm.fk([0.3, -0.7, 0.4, 1.1, 0.5, -0.2])[None], 400_000, axis=0)
print("ready", flush=True)
b = arm.ik_batch(poses)
done = int((b.status == "complete").sum())
print(len(b), done, len(b.errors), set(b.errors.values()) == {"interrupted"}, b.offsets[-1] == len(b.q))
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of another kind")
def test_ctrl_c_ends_a_batch_with_what_is_done() -> None:
    # Where the tests run in the background the signal is ignored, and processes inherit that.
    process = subprocess.Popen(
        [sys.executable, "-c", PROGRAM],
        stdout=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert process.stdout is not None
    assert process.stdout.readline() == "ready\n"
    # Some chunks are solved before.
    try:
        process.wait(timeout=1.0)
    except subprocess.TimeoutExpired:
        os.kill(process.pid, signal.SIGINT)
    out, _ = process.communicate(timeout=120)
    count, done, errors, are_named, are_whole = out.split()
    assert process.returncode == 0
    assert int(count) == 400_000 and int(done) > 0 and int(errors) > 0
    assert int(done) + int(errors) == 400_000
    assert are_named == are_whole == "True"


def test_a_pose_that_is_not_finite_stops_no_others() -> None:
    arm = lr.robot("general_16real")
    poses = arm.poses.repeat(3, axis=0)
    poses[1, 0, 3] = float("inf")
    b = arm.ik_batch(poses)
    assert list(b.errors) == [1] and "inf" in b.errors[1]
