#!/usr/bin/env python3
"""PHCpack.

Answers arms of six rotations none of whose neighbouring axes are parallel, and platforms, by `phc -b` on their closure
equations. A problem that takes more than 300 seconds is answered by no solutions.

    apt-get install -y phcpack && python3 -m venv venv && venv/bin/pip install numpy
    looproot bench accuracy --set general,platform --count 3 --export problems.jsonl
    venv/bin/python benches/peers/answers_phcpack.py problems.jsonl -o phcpack.jsonl --repeats 1
    looproot bench score phcpack.jsonl

An arm is twelve equations in the directions u2 to u5 of its four inner axes (Wampler and Morgan 1991): their lengths, the
angles between neighbours, and the way along the arm, whose parts are combinations of u_i, u_i+1 and their product. A
platform is seven quadrics in the Study parameters of the plate, in the chart that a random linear form defines.
"""
import re
import subprocess
import tempfile
from pathlib import Path

import numpy

from exchange import answer, offsets

TIMEOUT = 300
"""Seconds for one problem."""
REAL = 1e-8
"""Solutions whose unknowns, of size 1, have smaller imaginary parts are real: above what a simple root shows, which PHCpack
refines to some 1e-14."""
PARALLEL = 1e-9
"""Neighbouring axes with a smaller sine span no frame."""

NUMBER = r"(?:[-+]\s*)?\d\.\d+E[-+]\d+"
VALUE = re.compile(rf"'([uxy]\w*)':\s*({NUMBER})\s*({NUMBER})\*1j")
"""An unknown with real and imaginary part in what `phc -x` writes."""


class Polynomial(dict):
    """A polynomial as its coefficients by monomial, a sorted tuple of names."""

    @staticmethod
    def of(value):
        return value if isinstance(value, Polynomial) else Polynomial({(): float(value)})

    def __add__(self, other):
        total = Polynomial(self)
        for monomial, coefficient in Polynomial.of(other).items():
            total[monomial] = total.get(monomial, 0.0) + coefficient
        return total

    def __mul__(self, other):
        product = Polynomial()
        for one, a in self.items():
            for two, b in Polynomial.of(other).items():
                monomial = tuple(sorted(one + two))
                product[monomial] = product.get(monomial, 0.0) + a * b
        return product

    def __sub__(self, other):
        return self + Polynomial.of(other) * -1.0

    __radd__, __rmul__ = __add__, __mul__

    def __str__(self):
        return "".join(f"{c:+.17g}" + "".join("*" + name for name in names) for names, c in self.items() if c != 0.0) or "0"


def unknowns(*names):
    return [Polynomial({(name,): 1.0}) for name in names]


def dot(u, v):
    return sum(a * b for a, b in zip(u, v))


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def solutions(equations):
    """All isolated real solutions of a square system, by name of the unknown."""
    with tempfile.TemporaryDirectory() as folder:
        given, found, listed = (Path(folder) / name for name in ("given", "found", "listed"))
        given.write_text(f"{len(equations)}\n" + "\n".join(f"{equation};" for equation in equations) + "\n")
        # phc appends the solutions to the file that it is given, and answers nothing where there are none.
        subprocess.run(["phc", "-b", given, found], timeout=TIMEOUT, check=True, capture_output=True)
        subprocess.run(["phc", "-x", given, listed], timeout=TIMEOUT, check=True, capture_output=True)
        text = listed.read_text() if listed.exists() else "[]"
    kept = []
    for solution in text.split("{")[1:]:
        values = {name: (float(real), float(imaginary.replace(" ", ""))) for name, real, imaginary in VALUE.findall(solution)}
        if all(abs(imaginary) < REAL for _, imaginary in values.values()):
            kept.append({name: real for name, (real, _) in values.items()})
    return kept


def prepare(problem):
    if problem["kind"] == "platform":
        return platform(*(numpy.array(problem[key]) for key in ("base", "plate", "legs")))
    if offsets(problem) is None:
        return None
    directions, points = (numpy.array([axis[key] for axis in problem["axes"]]) for key in ("direction", "point"))
    normals = numpy.cross(directions[:-1], directions[1:])
    if min(numpy.linalg.norm(normals, axis=1)) < PARALLEL:
        return None
    home, pose = (numpy.array(problem[key]) for key in ("home", "pose"))
    return arm(directions, points, normals, pose @ numpy.linalg.inv(home))


def arm(directions, points, normals, motion):
    """The solver of an arm whose axes have been moved by `motion` behind the sixth joint."""
    last = motion[:3, :3] @ directions[5]
    inner = [unknowns(f"u{k}x", f"u{k}y", f"u{k}z") for k in range(2, 6)]
    axes = [[Polynomial.of(x) for x in directions[0]], *inner, [Polynomial.of(x) for x in last]]
    equations = [dot(u, u) - 1.0 for u in inner]
    way = [Polynomial.of(x) for x in points[0] - motion[:3, :3] @ points[5] - motion[:3, 3]]
    for k in range(5):
        equations.append(dot(axes[k], axes[k + 1]) - directions[k] @ directions[k + 1])
        # Both axes move with the link between them, and the way from one to the other with them.
        parts = numpy.linalg.solve(numpy.column_stack([directions[k], directions[k + 1], normals[k]]), points[k + 1] - points[k])
        for part, vector in zip(parts, (axes[k], axes[k + 1], cross(axes[k], axes[k + 1]))):
            way = [total + part * x for total, x in zip(way, vector)]
    equations += way

    def angles(found):
        """The joint variables: each turns the next axis from where the joints before it have brought it."""
        vectors = [numpy.array([found[f"u{k}{x}"] for x in "xyz"]) for k in range(2, 6)] + [last]
        turned, values = numpy.eye(3), []
        for k, vector in enumerate(vectors):
            values.append(about(directions[k], directions[k + 1], turned.T @ vector))
            turned = turned @ rotation(directions[k], values[-1])
        aside = normals[4]
        return values + [about(directions[5], aside, turned.T @ motion[:3, :3] @ aside)]

    return lambda: ([angles(found) for found in solutions(equations)], False)


def about(axis, start, end):
    """The angle about an axis from one vector to another."""
    return numpy.arctan2(axis @ numpy.cross(start, end), start @ end - (axis @ start) * (axis @ end))


def rotation(axis, angle):
    x, y, z = axis
    skew = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return numpy.eye(3) + numpy.sin(angle) * skew + (1 - numpy.cos(angle)) * skew @ skew


def platform(base, plate, legs):
    """The solver of a platform: x is the quaternion of the plate, y half its product with the position on the left."""
    x, y = (unknowns(*(f"{letter}{k}" for k in range(4))) for letter in "xy")

    def times(p, q):
        scalar, vector = p[0] * q[0] - dot(p[1:], q[1:]), cross(p[1:], q[1:])
        return [scalar, *(v + p[0] * b + a * q[0] for v, a, b in zip(vector, p[1:], q[1:]))]

    conjugate = [x[0], *(a * -1.0 for a in x[1:])]
    chart = numpy.random.default_rng(1).normal(size=4)
    equations = [dot(x, y), dot(chart, x) - 1.0]
    for a, b, leg in zip(base, plate, legs):
        point = [Polynomial(), *(Polynomial.of(c) for c in b)]
        turned = times(times(x, point), conjugate)
        equations.append(
            4.0 * dot(y, y) + (a @ a + b @ b - leg**2) * dot(x, x) + 4.0 * dot(b, times(conjugate, y)[1:])
            - 4.0 * dot(a, times(y, conjugate)[1:]) - 2.0 * dot(a, turned[1:]))

    def pose(found):
        p, q = (numpy.array([found[f"{letter}{k}"] for k in range(4)]) for letter in "xy")
        place = 2.0 * numpy.array(times(q, [p[0], *-p[1:]])[1:]) / (p @ p)
        return [*(p / numpy.linalg.norm(p)), *place]

    return lambda: ([pose(found) for found in solutions(equations)], False)


if __name__ == "__main__":
    version = subprocess.run(["phc", "--version"], capture_output=True, text=True).stdout
    answer(f"PHCpack {version.split()[0].removeprefix('PHCv') if version else '?'}" + __doc__[len("PHCpack"):], prepare)
