#!/usr/bin/env python3
"""looproot.

Answers every problem through the Python package, which sees the same doubles as all others.

    python3 -m venv venv && venv/bin/pip install ./python
    looproot bench accuracy --set all --count 20 --export problems.jsonl
    venv/bin/python benches/peers/answers_looproot.py problems.jsonl -o own.jsonl && looproot bench score own.jsonl
"""
import importlib.metadata

import numpy
import looproot

from exchange import answer


def prepare(problem):
    if problem["kind"] == "platform":
        platform = looproot.Platform(problem["base"], problem["plate"])
        return lambda: listed(platform.solve(legs=problem["legs"]))
    directions, points, letters = ([axis[key] for axis in problem["axes"]] for key in ("direction", "point", "type"))
    arm = looproot.from_screws(directions, points, problem["home"], joints="".join(letters))
    pose = numpy.array(problem["pose"])
    return lambda: listed(arm.ik(pose))


def listed(found):
    # The numbers are rounded: a self-motion reaches the pose of a robot at right angles but for that.
    return found.q.tolist(), [bool(x) for x in found.certified], bool(found.families)


if __name__ == "__main__":
    answer(f"looproot {importlib.metadata.version('looproot')}" + __doc__[len("looproot"):], prepare)
