"""Reads the problems of `looproot bench accuracy --export` and writes answers for `looproot bench score`."""
import argparse
import json
import os
import platform
import sys
import time


def answer(description, prepare):
    """Runs a solver over all problems. `prepare(problem)` gives a function without arguments that returns the solutions, and
    whether they are certified; or None where the solver takes no such problem. Only the function is timed."""
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
        solve = prepare(problem)
        if solve is None:
            return None
        seconds = []
        for _ in range(max(1, repeats)):
            start = time.perf_counter()
            solutions, certified = solve()
            seconds.append(time.perf_counter() - start)
    except BaseException as error:  # a panic of a Rust extension is no Exception
        if isinstance(error, (KeyboardInterrupt, SystemExit)):
            raise
        return {"solutions": [], "error": f"{type(error).__name__}: {str(error)[:200]}"}
    return {"solutions": [[float(x) for x in q] for q in solutions], "certified": certified, "seconds": min(seconds)}


def offsets(problem):
    """Directions of the axes, offsets from axis to axis and on to the tool, and the pose with the tool's rotation at home
    taken off: what solvers for products of exponentials ask for. None for other chains than of six rotations."""
    axes = problem.get("axes", [])
    if problem["kind"] != "chain" or len(axes) != 6 or any(axis["type"] != "R" for axis in axes):
        return None
    home, pose = problem["home"], problem["pose"]
    points = [axis["point"] for axis in axes] + [[row[3] for row in home[:3]]]
    steps = [points[0]] + [[b - a for a, b in zip(one, two)] for one, two in zip(points, points[1:])]
    turned = [[sum(pose[i][k] * home[j][k] for k in range(3)) for j in range(3)] + [pose[i][3]] for i in range(3)]
    return [axis["direction"] for axis in axes], steps, turned + [[0.0, 0.0, 0.0, 1.0]]
