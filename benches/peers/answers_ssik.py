#!/usr/bin/env python3
"""ssik.

Answers arms of six rotations for which ssik chooses a closed form. With SSIK_GENERAL=1 in the environment it answers those of
its general solver as well, whose preparation takes minutes for every arm and is not timed.

    python3 -m venv venv && venv/bin/pip install ssik
    looproot bench accuracy --set all --count 3 --export problems.jsonl
    venv/bin/python benches/peers/answers_ssik.py problems.jsonl -o ssik.jsonl && looproot bench score ssik.jsonl
"""
import importlib.metadata
import os

import numpy
from ssik import Manipulator

from exchange import answer, offsets

GENERAL = os.environ.get("SSIK_GENERAL") == "1"


def prepare(problem):
    given = offsets(problem)
    if given is None:
        return None
    directions, ways, pose = map(numpy.array, given)
    arm = Manipulator.from_axes(directions, ways)
    if arm.solver_name == "ikgeo.general_6r":
        if not GENERAL:
            return None
        arm.prepare()
    # Without joint limits; full turns more are no other solutions. ssik checks every solution in doubles, which proves nothing.
    return lambda: ([solution.q for solution in arm.solve(pose, respect_limits=False, enumerate_windings=False)], False)


if __name__ == "__main__":
    answer(f"ssik {importlib.metadata.version('ssik')}" + __doc__[len("ssik"):], prepare)
