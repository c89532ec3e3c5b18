"""The four-bars of mechanism files as the data of certificates write them: of a loop, or of a linkage in the plane, whose input runs."""
import functools

from closures import TURN
from linkage_files import Planar, over_length
from mechanism import system_of
from motions import IDENTITY, column, difference, dot, inverse, times
from quantities import is_exact, require
from sweep import written


def four_bars(file):
    """The data for every joint that may be the input, each as a function, as some have none."""
    of = of_linkage if file.document["mechanism"]["kind"] == "linkage" else of_loop
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
    if joints in ("RSSR", "RSSP", "RRRR", "RRRP"):
        return of_links(joints, links, 1)
    # The other way round the input turns backwards.
    joints = joints[0] + joints[:0:-1]
    require(joints in ("RSSR", "RSSP", "RRRP"), "file: a loop of other joints")
    return of_links(joints, [inverse(link) for link in links[::-1]], -1)


def of_links(joints, links, sense):
    """The data of a loop of the input, the joints at A and B, and the output. The y axis is mirrored where the input turns backwards."""
    is_flat = joints[1] == "R" and has_parallel_axes(joints, links)
    if joints[1] == "R" and not is_flat:
        require(joints == "RRRR", "file: a slide that is not across three parallel axes")
        links = about_one_point(links)
    (x, y, height), side = column(links[0], 3), column(links[1], 3)
    b, ground = column(inverse(links[2]), 3), inverse(links[3])
    foot = b if joints[3] == "P" else [0 * b[0], 0 * b[0], b[2]]
    u, v, w = [dot(row, foot) + row[3] for row in ground[:3]]
    if is_flat:
        side, w = [*side[:2], 0 * w], height
    n = column(ground, 2)
    radius = () if joints[3] == "P" else (b[0] * b[0] + b[1] * b[1],)
    return written([x, sense * y], dot(side, side), [n[0], sense * n[1], n[2]], [u, sense * v, w - height], *radius)


def has_parallel_axes(joints, links):
    """Whether three axes are parallel, the fourth one is as well or slides across them, and nothing opens the loop along them."""
    around, cosines = times(IDENTITY, *links), [link[2][2] for link in links]
    are_parallel = all(x * x == 1 for x in cosines[:2]) and (cosines[2] == 0 if joints[3] == "P" else cosines[2] ** 2 == 1)
    return are_parallel and around[2][2] == 1 and around[2][3] == 0


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
    joints, held = planar.joints(), file.document.get("input", [{}])[0]
    require(len(joints) == 4 and given < 4 and "body" not in held, "file: no linkage of four joints that run")
    names = {held["joint"]} if "joint" in held else {*held.get("given", {})}
    require(names <= {joints[given]["name"]}, "file: another joint is held")
    pairs = [*map(planar.pair, joints)]
    place = lambda k, body: dict(zip(pairs[k][1], pairs[k][2]))[body]
    (a, b), order, bodies = pairs[given][1], [given], [pairs[given][1][1]]
    for _ in range(3):
        nexts = [k for k in range(4) if k not in order and bodies[-1] in pairs[k][1]]
        require(len(nexts) == 1, "file: the joints are not round one loop")
        order.append(nexts[0])
        bodies.append(next(body for body in pairs[nexts[0]][1] if body != bodies[-1]))
    input, second, third, output = order
    require(bodies[3] == a and len(set(bodies)) == 4, "file: the joints are not round one loop")
    require(all(pairs[k][0] == "R" for k in order[:3]), "file: a slide that is not at the output")
    _, c, d, _ = bodies
    crank, ground = place(second, b) - place(input, b), place(output, a) - place(input, a)
    side, arm = place(third, c) - place(second, c), place(third, d) - place(output, d)
    zero = 0 * side[0, 0]
    flat = lambda vector: [vector[0, 0], vector[1, 0], zero]
    if pairs[output][0] == "R":
        return written(flat(crank)[:2], side.det(), [zero, zero, zero + 1], flat(ground), arm.det())
    u, v = pairs[output][3]
    turn = over_length(u, v) * v.transpose()  # of the second body against the first
    line, turn = (u, turn) if pairs[output][1][0] == a else (v, turn.transpose())
    return written(flat(crank)[:2], side.det(), flat(line), flat(ground + turn * arm))
