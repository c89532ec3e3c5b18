"""The four-bars of linkages on the sphere in mechanism files as the data of certificates write them."""
from flint import fmpq

from lines import cross
from linkage_files import joints_of, over_length, plane
from motions import IDENTITY, difference, dot, of_quaternion
from quantities import is_exact, items, number, require
from sweep import written
from units import number_text


def vector(texts):
    read = [number(number_text(text)) for text in items(texts, 3)]
    require(is_exact(read), "file: an irrational number of a four-bar has no certificate")
    return read


def pair(joint, bodies):
    """(type, bodies, directions, directions from which and to which the angle is measured) of a joint."""
    at = joint.get("at", joint["name"])
    places = [vector(bodies[body][name]) for body, name in zip(joint["of"], at if isinstance(at, list) else [at, at])]
    require(joint["type"] == "R" and dot(places[0], places[0]) == dot(places[1], places[1]), "file: directions of other lengths have no certificate")
    zero = joint.get("zero")
    return "R", joint["of"], places, [*map(vector, items(zero, 2))] if zero else references(*places)


def references(u, w):
    """Where a file names none: the coordinate axis least along u, in the first body, and where u, moved to w by the half-turn between both, has it."""
    first = IDENTITY[min(range(3), key=lambda k: abs(u[k]))][:3]
    if u == w:
        return [first, first]
    about = [x + y for x, y in zip(u, w)]
    about = about if any(x != 0 for x in about) else cross(u, first)
    factor = 2 * dot(about, first) / dot(about, about)
    return [first, [factor * x - y for x, y in zip(about, first)]]


def frame(direction):
    """The axes of the frame that the half-turn between z and a direction leads z to."""
    square = dot(direction, direction)
    require(square.p.is_square() and square.q.is_square(), "file: an axis of irrational length has no certificate")
    x, y, z = (part / fmpq(square.p.isqrt(), square.q.isqrt()) for part in direction)
    half = [x, y, z + 1] if z != -1 else IDENTITY[0][:3]
    return [[part / dot(half, half) for part in row] for row in of_quaternion(fmpq(0), *half)]


def across(frame, direction):
    """The coordinates across the z axis, as a number of the plane, and that along it."""
    x, y, z = (dot(row, direction) for row in frame)
    return plane(x, y), z


def of_sphere(file, given, round_loop):
    """The data of a linkage of four bodies and four joints whose joint of this number runs."""
    mechanism, held = file.document["mechanism"], (file.document.get("input") or [{}])[0]
    joints = joints_of(mechanism)
    require(len(joints) == 4 == len(mechanism["bodies"]) and given < 4 and "body" not in held, "file: no linkage of four joints that run")
    names = {held["joint"]} if "joint" in held else {*held.get("given", {})}
    require(names <= {joints[given]["name"]}, "file: another joint is held")
    pairs = [pair(joint, mechanism["bodies"]) for joint in joints]
    order, bodies = round_loop(pairs, given, 1)
    place = lambda k, body: dict(zip(pairs[k][1], pairs[k][2]))[body]
    for k, body in enumerate(bodies):
        require(any(x != 0 for x in cross(place(order[k], body), place(order[(k + 1) % 4], body))), "file: two neighbouring axes coincide")
    (input, second, third, output), (b, c, d, a) = order, bodies
    fixed, moved = frame(place(input, a)), frame(place(input, b))
    zero, other = (across(own, direction)[0] for own, direction in zip((fixed, moved), pairs[input][3]))
    crank, height = across(moved, place(second, b))
    crank = crank * over_length(zero, other) * other.transpose()  # where the zeros are one direction
    side, last, axis = difference(place(third, c), place(second, c)), place(third, d), place(output, d)
    part = dot(last, axis) / dot(axis, axis)
    (flat, up) = across(fixed, place(output, a))
    axis = [flat[0, 0], flat[1, 0], up]
    return written([crank[0, 0], crank[1, 0]], axis, difference([part * x for x in axis], [0, 0, height]), coupler_squared=dot(side, side),
                   radius_squared=dot(last, last) - part * dot(last, place(output, d)))
