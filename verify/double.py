"""Theorem 15 of docs/certificate.md: double solutions at points with algebraic coordinates."""
import itertools

from algebraic import Algebraic, Points
from closures import TURN, proved_modes
from motions import IDENTITY, along, column, times, turn
from quantities import fields, require, whole
from short_loops import is_one_in

# The factors by which rows and columns are added up: other ones might hide that a form is not 0.
ROW, COLUMN = (1, 2, 4, 7, 11, 16), (1, -3, 5, 2, -7, 4)


def with_doubles(system, values, bound, item, other):
    """The modes with the double ones: they are as many as the bound allows, which counts them once with theorem 4 and twice with theorems 2 and 3."""
    require(system.size == system.equations == 6 and bound, "proof: double: only bounds of loops of six unknowns are covered")
    points = Points(system, other)
    check_double(system, points)
    modes = proved_modes(system, values, lambda centre, radius: is_one_in(points, system, centre, radius))
    count = sum(mode.multiplicity == 2 for mode in modes)
    require(count == points.modulus.degree(), f"proof: double: {count} modes are double, and {points.modulus.degree()} points")
    _, stated, *aid = fields(item, ("kind", "value", *["aid"] * ("aid" in item)))
    most, total = bound(system, *aid), len(modes) + (0 if item["kind"] == "eliminant" else count)
    require(most == whole(stated) == total, f"proof: {item['kind']}: the bound is {most}, {stated} is stated, and {total} solutions are proved")
    return modes


def screws(system, points):
    """The joint screws at the points, seen from the first frame: direction and moment, of a translation nothing and the direction."""
    before, found = IDENTITY, []
    for kind, own, link in zip(system.kinds, points.values, system.links):
        axis, place = column(before, 2), column(before, 3)
        found.append([*axis, *cross(place, axis)] if kind == TURN else [0, 0, 0, *axis])
        before = times(before, turn(2, *own) if kind == TURN else along(0, 0, *own), link)
    return found


def cross(x, y):
    return [x[k - 2] * y[k - 1] - x[k - 1] * y[k - 2] for k in range(3)]


def bracket(one, other):
    """The commutator of two screws."""
    (w, v), (x, y) = (one[:3], one[3:]), (other[:3], other[3:])
    return [*cross(w, x), *(a + b for a, b in zip(cross(w, y), cross(v, x)))]


def determinant(rows):
    """By the minors of the first rows, of all choices of columns."""
    minors = {(): 1}
    for count, row in enumerate(rows, 1):
        minors = {columns: sum((-1) ** (count - 1 - at) * row[k] * minors[columns[:at] + columns[at + 1:]] for at, k in enumerate(columns))
                  for columns in itertools.combinations(range(len(rows)), count)}
    return minors[tuple(range(len(rows)))]


def check_double(system, points):
    """At every point the six screws have the rank 5, and the loop opens to second order along the motion that is left."""
    joints = screws(system, points)
    rows = [[joint[i] for joint in joints] for i in range(6)]
    is_zero = lambda x: Algebraic([0], points.modulus) == x
    require(is_zero(determinant(rows)), "proof: double: the joint screws are independent at a point")
    motion = [determinant([[*row[:k], own, *row[k + 1:]] for row, own in zip(rows, COLUMN)]) for k in range(6)]
    wrench = [determinant([*rows[:i], ROW, *rows[i + 1:]]) for i in range(6)]
    opening = 0
    for j, k in itertools.combinations(range(6), 2):
        force = sum(w * x for w, x in zip(wrench, bracket(joints[j], joints[k])))
        opening = force * motion[j] * motion[k] + opening
    is_unit = (0 * points.values[0][0] + opening).value.gcd(points.modulus).degree() == 0
    require(is_unit, "proof: double: the loop opens at a point to a higher order than the second one")
