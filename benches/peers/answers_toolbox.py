#!/usr/bin/env python3
"""Robotics Toolbox.

Answers every chain by the Levenberg-Marquardt solver `ik_LM` from 100 random starts, one search each, and returns the
distinct solutions that it reaches.

    python3 -m venv venv && venv/bin/pip install roboticstoolbox-python
    looproot bench accuracy --set all --count 3 --export problems.jsonl
    venv/bin/python benches/peers/answers_toolbox.py problems.jsonl -o toolbox.jsonl --repeats 1
    looproot bench score toolbox.jsonl
"""
import importlib.metadata

import numpy
from roboticstoolbox import ET, ETS

from exchange import answer, multistart, steps

ITERATIONS = 100
"""A search that has not converged by then is given up: three times the default."""
SMALL = 1e-24
"""The solver stops where half the square of the error in metres and radians is less: an error of some 1e-12."""


def along_z(direction):
    """A rotation that turns z into a direction."""
    z = numpy.array(direction)
    x = numpy.cross(numpy.eye(3)[numpy.argmin(numpy.abs(z))], z)
    x /= numpy.linalg.norm(x)
    return numpy.column_stack([x, numpy.cross(z, x), z])


def motion(rotation, translation):
    full = numpy.eye(4)
    full[:3, :3], full[:3, 3] = rotation, translation
    return full


def prepare(problem):
    if problem["kind"] != "chain":
        return None
    directions, ways = steps(problem)
    last, parts = numpy.eye(3), []
    for axis, direction, way in zip(problem["axes"], directions, ways):
        turned = along_z(direction)
        parts += [ET.SE3(motion(last.T @ turned, last.T @ way)), ET.Rz() if axis["type"] == "R" else ET.tz()]
        last = turned
    home, pose = (numpy.array(problem[key]) for key in ("home", "pose"))
    chain = ETS([*parts, ET.SE3(motion(last.T @ home[:3, :3], last.T @ ways[-1]))])

    def iterate(start):
        found = chain.ik_LM(pose, q0=numpy.array(start), ilimit=ITERATIONS, slimit=1, tol=SMALL, joint_limits=False)
        return found.q if found.success else None

    return lambda: (multistart(problem, iterate), False)


if __name__ == "__main__":
    answer(f"Robotics Toolbox {importlib.metadata.version('roboticstoolbox-python')}" + __doc__[len("Robotics Toolbox"):], prepare)
