#!/usr/bin/env python3
"""pinocchio.

Answers every chain by the iteration of pinocchio's documentation (damped least squares on the logarithm of the error) from 100
random starts, with full steps, and returns the distinct solutions that it reaches.

    python3 -m venv venv && venv/bin/pip install pin
    looproot bench accuracy --set all --count 3 --export problems.jsonl
    venv/bin/python benches/peers/answers_pinocchio.py problems.jsonl -o pinocchio.jsonl --repeats 1
    looproot bench score pinocchio.jsonl
"""
import importlib.metadata

import numpy
import pinocchio

from exchange import answer, multistart, steps

ITERATIONS = 100
"""A start that has not converged by then is given up: with full steps, those that converge need some ten."""
SMALL = 1e-12
"""The error in metres and radians at which the iteration stops: above rounding, far below what `bench score` tells apart."""
DAMPING = 0.1
"""Times the square of the error, where the documentation has a constant and steps of a tenth: no start runs away, and the last
steps are those of Newton's method."""


def prepare(problem):
    if problem["kind"] != "chain":
        return None
    model, joint = pinocchio.Model(), 0
    directions, ways = steps(problem)
    for axis, direction, way in zip(problem["axes"], directions, ways):
        kind = pinocchio.JointModelRevoluteUnaligned if axis["type"] == "R" else pinocchio.JointModelPrismaticUnaligned
        place = pinocchio.SE3(numpy.eye(3), numpy.array(way))
        joint = model.addJoint(joint, kind(numpy.array(direction)), place, f"q{joint + 1}")
    home, pose = (numpy.array(problem[key]) for key in ("home", "pose"))
    # The pose of the last joint, whose frame is turned as the base when all joint variables are 0.
    tool = pinocchio.SE3(home[:3, :3], numpy.array(ways[-1]))
    wanted = pinocchio.SE3(pose[:3, :3], pose[:3, 3]) * tool.inverse()
    data = model.createData()

    def iterate(start):
        q = numpy.array(start)
        for _ in range(ITERATIONS):
            pinocchio.forwardKinematics(model, data, q)
            difference = data.oMi[joint].actInv(wanted)
            error = pinocchio.log6(difference).vector
            if numpy.abs(error).max() < SMALL:
                return q
            jacobian = pinocchio.Jlog6(difference.inverse()) @ pinocchio.computeJointJacobian(model, data, q, joint)
            q = q + jacobian.T @ numpy.linalg.solve(jacobian @ jacobian.T + DAMPING * (error @ error) * numpy.eye(6), error)
        return None

    return lambda: (multistart(problem, iterate), False)


if __name__ == "__main__":
    answer(f"pinocchio {importlib.metadata.version('pin')}" + __doc__[len("pinocchio"):], prepare)
