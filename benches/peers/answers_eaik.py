#!/usr/bin/env python3
"""EAIK.

Answers arms of six rotations of the classes that EAIK decomposes; answers that it marks as least squares are left out.

    python3 -m venv venv && venv/bin/pip install eaik
    looproot bench accuracy --set all --count 20 --export problems.jsonl
    venv/bin/python benches/peers/answers_eaik.py problems.jsonl -o eaik.jsonl && looproot bench score eaik.jsonl
"""
import importlib.metadata

import numpy
from eaik.IK_HP import HPRobot

from exchange import answer, offsets


def prepare(problem):
    given = offsets(problem)
    if given is None:
        return None
    directions, steps, pose = map(numpy.array, given)
    robot = HPRobot(directions, steps)
    if not robot.hasKnownDecomposition():
        return None

    def solve():
        found = robot.IK(pose)
        marked = numpy.atleast_1d(found.is_LS)
        return [q for q, least_squares in zip(numpy.atleast_2d(found.Q), marked) if not least_squares], False

    return solve


if __name__ == "__main__":
    answer(f"EAIK {importlib.metadata.version('eaik')}" + __doc__[len("EAIK"):], prepare)
