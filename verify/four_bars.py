"""The four-bars of mechanism files as the data of certificates write them: of a loop, or of a linkage in the plane, whose input runs."""
import functools

from flint import fmpq, fmpq_mat

from closures import TURN
from linkage_files import Planar, over_length
from mechanism import system_of
from motions import IDENTITY, column, dot, inverse, times
from quantities import is_exact, require
from spherical import of_sphere
from sweep import written

KINDS = ("RSSR", "RSSP", "RRRR", "RRRP", "RRPR")  # the joints from the input on, A and B in the middle; of the last one A is in a plane of the output


def four_bars(file):
    """The data for every joint that may be the input, each as a function, as some have none."""
    kind, space = (file.document["mechanism"].get(key) for key in ("kind", "space"))
    of = of_loop if kind != "linkage" else of_linkage if space != "sphere" else functools.partial(of_sphere, round_loop=round_loop)
    return [functools.partial(of, file, k) for k in range(8)]  # a loop RSSR has eight unknowns


def of_loop(file, given):
    """The data of a loop whose unknown of this number runs."""
    mechanism = file.document["mechanism"]
    require(mechanism["kind"] == "loop" and mechanism["convention"] != "screws", "file: no loop by constants of Denavit and Hartenberg")
    system = system_of({"mechanism": file.chain(mechanism)})
    require(is_exact(system.constants), "file: an irrational number of a four-bar has no certificate")
    joints, links, at, k = "", [], None, 0
    while k < system.size:
        wide = 3 if k in system.spherical else 1
        at = len(links) if k == given else at
        joints += "S" if wide == 3 else "R" if system.kinds[k] == TURN else "P"
        links.append(system.links[k + wide - 1])
        k += wide
    require(at is not None and len(links) == 4, "file: no loop of four joints")
    joints, links = joints[at:] + joints[:at], links[at:] + links[:at]
    if joints in KINDS:
        return of_links(joints, links, 1)
    # The other way round the input turns backwards.
    joints = joints[0] + joints[:0:-1]
    require(joints in KINDS, "file: a loop of other joints")
    return of_links(joints, [inverse(link) for link in links[::-1]], -1)


def of_links(joints, links, sense):
    """The data of a loop of the input, the joints at A and B, and the output. The y axis is mirrored where the input turns backwards."""
    is_flat = joints[1] == "R" and has_parallel_axes(joints, links)
    if joints[1] == "R" and not is_flat:
        require(joints == "RRRR", "file: a slide that is not across three parallel axes")
        links = about_one_point(links)
    (x, y, height), side = column(links[0], 3), column(links[1], 3)
    b, u, ground = column(inverse(links[2]), 3), column(inverse(links[2]), 2), inverse(links[3])
    side = [*side[:2], 0 * height] if is_flat else side
    foot = b if joints[3] == "P" else [0 * height, 0 * height, b[2]]
    if joints[2] == "P":
        p = column(inverse(times(links[1], links[2])), 3)
        squares = {"offset_squared": (p[0] * u[1] - p[1] * u[0]) ** 2}
    else:
        squares = {"coupler_squared": dot(side, side), **({"radius_squared": b[0] * b[0] + b[1] * b[1]} if joints[3] == "R" else {})}
    place = [dot(row, foot) + row[3] for row in ground[:3]]
    place[2] = 0 * height if is_flat else place[2] - height
    mirrored = lambda v: [v[0], sense * v[1], *v[2:]]
    return written(mirrored([x, y]), mirrored(column(ground, 2)), mirrored(place), **squares)


def has_parallel_axes(joints, links):
    """Whether three axes are parallel, the fourth one is as well or slides across them, and nothing opens the loop along them."""
    axes = [links[0], links[1], times(*links[1:3])] if joints[2] == "P" else links[:3]
    slide = joints.find("P") - 1  # the link in front of it
    around, cosines = times(IDENTITY, *links), [link[2][2] for link in axes]
    is_across = lambda k: cosines[k] == 0 if k == slide else cosines[k] ** 2 == 1
    return all(map(is_across, range(3))) and around[2][2] == 1 and around[2][3] == 0


def about_one_point(links):
    """The links between points of the axes at the distance 1 from the one point in which all axes meet."""
    heights = []
    for link in links:
        w, t = column(link, 2), column(link, 3)
        require(w[:2] != [0, 0], "file: two neighbouring axes are parallel")
        h = -(t[0] * w[0] + t[1] * w[1]) / (w[0] * w[0] + w[1] * w[1])
        require(t[0] + h * w[0] == 0 and t[1] + h * w[1] == 0, "file: two neighbouring axes do not meet")
        heights.append((t[2] + h * w[2], h))
    require(all(heights[k - 1][1] == heights[k][0] for k in range(4)), "file: the axes meet in several points")
    return [[[*row[:3], row[2] - int(i == 2)] for i, row in enumerate(link[:3])] + [IDENTITY[3]] for link in links]


def of_linkage(file, given):
    """The data of a linkage of four bodies and four joints whose joint of this number runs."""
    planar = Planar(file)
    held = (file.document.get("input") or [{}])[0]
    joints, pairs = zip(*planar.pairs().items())
    require(len(joints) == 4 and given < 4 and "body" not in held, "file: no linkage of four joints that run")
    names = {held["joint"]} if "joint" in held else {*held.get("given", {})}
    require(names <= {joints[given]}, "file: another joint is held")
    place = lambda k, body: dict(zip(pairs[k][1], pairs[k][2]))[body]
    order, bodies = round_loop(pairs, given, 1)
    sense = 1 if pairs[order[1]][0] == "R" else -1  # the other way round the input turns backwards
    order, (b, c, d, a) = round_loop(pairs, given, sense)
    kinds, (input, second, third, output) = "".join(pairs[k][0] for k in order), order
    require(kinds in KINDS, "file: a linkage of other joints")
    between = lambda body, one, other: place(other, body) - place(one, body)
    crank, side, arm, ground = between(b, input, second), between(c, second, third), between(d, output, third), between(a, input, output)
    axis = fmpq_mat([[0, 0], [0, 0]])
    if kinds == "RRRP":
        axis, turn = slide(pairs[output], a)
        ground += turn * arm
    if kinds == "RRPR":
        u, turn = slide(pairs[third], c)
        squares = {"offset_squared": (u.transpose() * (side - turn * arm))[1, 0] ** 2 / u.det()}
    else:
        squares = {"coupler_squared": side.det(), **({"radius_squared": arm.det()} if kinds == "RRRR" else {})}
    flat = lambda vector, z: [vector[0, 0], sense * vector[1, 0], fmpq(z)]
    return written(flat(crank, 0)[:2], flat(axis, int(kinds != "RRRP")), flat(ground, 0), **squares)


def round_loop(pairs, given, sense):
    """The joints and bodies round the one loop: first the second body of the input, or the first one."""
    order, bodies = [given], [pairs[given][1][::sense][1]]
    for _ in range(3):
        nexts = [k for k in range(4) if k not in order and bodies[-1] in pairs[k][1]]
        require(len(nexts) == 1, "file: the joints are not round one loop")
        order.append(nexts[0])
        bodies.append(next(body for body in pairs[nexts[0]][1] if body != bodies[-1]))
    require(len(set(bodies)) == 4 and {bodies[0], bodies[3]} == {*pairs[given][1]}, "file: the joints are not round one loop")
    return order, bodies


def slide(pair, body):
    """The line of a slide in a body, and the rotation of the other body against it."""
    _, (first, _), _, (u, v) = pair
    turn = over_length(u, v) * v.transpose()  # of the second body against the first
    return (u, turn) if first == body else (v, turn.transpose())
