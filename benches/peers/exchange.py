"""Reads the problems of `looproot bench accuracy --export` and writes answers for `looproot bench score`."""
import argparse
import json
import math
import os
import platform
import random
import sys
import time

STARTS = 100
"""Random starts of a solver that finds one solution from each."""
NEAR = 1e-6
"""Solutions whose joint variables all differ by less are one: the limit of `bench score` for well-conditioned ones."""


def answer(description, prepare):
    """Runs a solver over all problems. `prepare(problem)` gives a function without arguments that returns the solutions, and
    whether they are certified, and, where the solver tells such, whether they form a self-motion; or None where the solver takes no such
    problem. The function is timed, and `prepare` apart."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("problems")
    parser.add_argument("-o", "--output", default="answers.jsonl")
    parser.add_argument("--repeats", type=int, default=3, help="the fastest of so many runs is the time of an answer")
    options = parser.parse_args()
    with open(options.problems) as file:
        head, *problems = map(json.loads, file)
    named = os.path.relpath(options.problems, os.path.dirname(os.path.abspath(options.output)))
    with open(options.output, "w") as file:
        first = {"format": "looproot-answers", "version": 1, "solver": description.splitlines()[0].rstrip("."), "problems": named,
                 "hash": head["hash"], "machine": platform.processor() or platform.machine(), "command": " ".join(sys.argv)}
        print(json.dumps(first), file=file)
        for problem in problems:
            line = run(prepare, problem, options.repeats)
            if line is not None:
                print(json.dumps({"id": problem["id"], **line}), file=file)


def run(prepare, problem, repeats):
    """The answer to one problem; None where there is none."""
    try:
        start = time.perf_counter()
        solve = prepare(problem)
        setup = time.perf_counter() - start
        if solve is None:
            return None
        seconds = []
        for _ in range(max(1, repeats)):
            start = time.perf_counter()
            solutions, certified, *motion = solve()
            seconds.append(time.perf_counter() - start)
    except BaseException as error:  # a panic of a Rust extension is no Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit)):
            raise
        return {"solutions": [], "error": f"{type(error).__name__}: {str(error)[:200]}"}
    solutions = [[float(x) for x in q] for q in solutions]
    kept = first_forms(problem, solutions)
    return {"solutions": [solutions[k] for k in kept],
            "certified": [certified[k] for k in kept] if isinstance(certified, list) else certified, "seconds": min(seconds), "setup_seconds": setup,
            **({"self_motion": bool(motion[0])} if motion else {})}


def steps(problem):
    """Directions of the axes of a chain, and the ways from axis to axis and on to the tool, when all joint variables are 0.
    None for platforms."""
    if problem["kind"] != "chain":
        return None
    axes = problem["axes"]
    points = [axis["point"] for axis in axes] + [[row[3] for row in problem["home"][:3]]]
    ways = [points[0]] + [[b - a for a, b in zip(one, two)] for one, two in zip(points, points[1:])]
    return [axis["direction"] for axis in axes], ways


def offsets(problem):
    """Directions of the axes, offsets from axis to axis and on to the tool, and the pose with the tool's rotation at home
    taken off: what solvers for products of exponentials ask for. None for other chains than of six rotations."""
    axes = problem.get("axes", [])
    if problem["kind"] != "chain" or len(axes) != 6 or any(axis["type"] != "R" for axis in axes):
        return None
    home, pose = problem["home"], problem["pose"]
    turned = [[sum(pose[i][k] * home[j][k] for k in range(3)) for j in range(3)] + [pose[i][3]] for i in range(3)]
    return *steps(problem), turned + [[0.0, 0.0, 0.0, 1.0]]


def multistart(problem, iterate):
    """Distinct solutions of a chain that `iterate(start)` reaches from STARTS random starts, the same in every run; it
    returns None where it does not converge. Angles start in the whole circle and end between -pi and pi, translations
    start within the length of the chain."""
    draw = random.Random(problem["id"])
    turns = [axis["type"] == "R" for axis in problem["axes"]]
    length = sum(math.hypot(*way) for way in steps(problem)[1])
    found = []
    for _ in range(STARTS):
        end = iterate([draw.uniform(-math.pi, math.pi) if turn else draw.uniform(-length, length) for turn in turns])
        if end is None:
            continue
        end = [reduced(x, turn) for x, turn in zip(end, turns)]
        if not any(are_near(end, other, turns) for other in found):
            found.append(end)
    return found


def first_forms(problem, solutions):
    """Which solutions are left where of both forms of a rotation of a spherical joint, (a, b, c) and (a + pi, -b, c + pi), one
    is kept: solvers that know three rotations only find both."""
    turns, kept = [axis["type"] == "R" for axis in problem.get("axes", [])], []
    for k, solution in enumerate(solutions):
        others = [list(solution)]
        for first in problem.get("spherical", []):
            for other in list(others):
                a, b, c = other[first:first + 3]
                others.append(other[:first] + [a + math.pi, -b, c + math.pi] + other[first + 3:])
        if not any(are_near(other, solutions[j], turns) for other in others[1:] for j in kept):
            kept.append(k)
    return kept


def are_near(one, other, turns):
    return all(abs(reduced(a - b, turn)) < NEAR for a, b, turn in zip(one, other, turns))


def reduced(value, turn):
    """An angle between -pi and pi; a translation as it is."""
    return math.remainder(value, math.tau) if turn else value
