"""Linkages in the plane: the vectors round their loops, from the data of a certificate, and those data from mechanism files."""
from flint import arb, fmpq, fmpq_mat

from closures import SLIDE, TURN
from linkage_files import ONE, over_length, plane, written
from mechanism import system_of as system_of_other
from quantities import Refused, by_half_tangent, expect, fields, items, number, require

MOST_JOINTS = 100  # more than those of fifty bodies and three loops


class Linkage:
    """Sums of vectors round loops that are 0: for every loop one coefficient of each column. Column 0 stands for the ground, the next
    for the classes of bodies that keep their directions against each other, and the last for slides, which lie along a line of a class."""
    spherical = [None, None]  # the bounds for loops of six unknowns do not apply to linkages: theorem 2 has none for two spherical joints

    def __init__(self, loops, classes, slides):
        self.loops, self.classes, self.slides = loops, classes, slides
        self.kinds = [TURN] * (classes - 1) + [SLIDE] * len(slides)
        self.size, self.equations = len(self.kinds), loops.nrows()
        self.constants = [*loops.entries(), fmpq(classes), *map(fmpq, slides)]

    def __getattr__(self, name):
        raise Refused("proof: linkages in the plane are covered by theorem 13 alone")

    def columns(self):
        """The exponents of the unknowns for each column: theta of a class, or a distance times theta of its class."""
        unit = lambda k: [int(k == j + 1) for j in range(self.size)]
        return [unit(k) for k in range(self.classes)] + [
            list(map(max, unit(self.classes + k), unit(own))) for k, own in enumerate(self.slides)]

    def closed(self, x):
        turns = [(1, 0)] + [(t.cos(), t.sin()) for t in x[:self.classes - 1]]
        turns += [tuple(s * part for part in turns[own]) for s, own in zip(x[self.classes - 1:], self.slides)]
        rows = self.loops.tolist()  # those of the coordinates x and y in turn, with (a, -b) and (b, a) for a + i b
        parts = [part for pair in turns for part in pair]
        return [sum((c * part for c, part in zip(row, parts) if c != 0), 0 * x[0]) for row in rows], arb(1)

    def forms(self, x):
        return [x]


def system_of(data):
    """The closure equations of the mechanism."""
    if data["mechanism"]["kind"] != "linkage":
        return system_of_other(data)
    mechanism, inputs = fields(data, ("mechanism",), ("input",))
    _, space, ground, joints, bodies = fields(mechanism, ("kind", "space", "ground", "joints", "bodies"))
    expect(space == "plane", space, "a linkage in the plane")
    pairs, read = [], lambda pair: plane(*map(number, items(pair, 2)))
    for joint in items(joints):
        name, kind, of, *along = fields(joint, ("name", "type", "of", *["along"] * (joint["type"] == "P")))
        expect(kind in ("R", "P") and of[0] != of[1], joint, "a joint R or P of two bodies")
        points = [read(bodies[body][name]) for body in items(of, 2)]
        pairs.append((kind, of, points, [read(own) for own in items(along[0], 2)] if along else None))
    given = {int(key) - 1: own for key, own in fields(items(inputs, 1)[0], ("given",))[0].items()} if "input" in data else {}
    require(written(ground, pairs, given) == data, "data: the linkage is not written in the one form of certificates")
    require(len(pairs) <= MOST_JOINTS and all(is_connected(pairs, k) for k in range(len(pairs))), "data: a joint is in no loop, or they are too many")
    return with_loops(pairs, given)


def is_connected(pairs, but):
    """Whether the bodies hang together without one of the joints."""
    seen = {"0"}
    for _ in pairs:
        seen |= {body for k, (_, of, *_) in enumerate(pairs) if k != but and seen & set(of) for body in of}
    return seen == {body for _, of, *_ in pairs for body in of}


def with_loops(pairs, given):
    """The loops that joints outside a tree of bodies close."""
    steps, kept = [], []  # from the frame of the first body to that of the second: (point, point, slide); bodies that keep their angle
    for k, (kind, (a, b), (p, q), along) in enumerate(pairs):
        if kind == "P":
            u, v = along
            kept.append((a, b, over_length(u, v) * v.transpose()))
            p += over_length(u, ONE) * number(given[k]["distance"]) if k in given else plane(0, 0)
        elif k in given:
            half = given[k]["tan_half"]
            kept.append((a, b, plane(*by_half_tangent(number(half)) if half != "inf" else (-1, 0))))
        steps.append((a, b, p, q, along[0] if kind == "P" and k not in given else None))
    names = dict.fromkeys(body for a, b, *_ in steps for body in sorted((a, b), key=int))
    classes, own = 0, {}  # of each body: its class, and its direction against that
    for body in sorted(names, key=int):
        if body not in own:
            own[body], classes = (classes, ONE), classes + 1
            for _ in kept:
                for a, b, turn in kept:
                    for one, other, by in ((a, b, turn), (b, a, turn.transpose())):
                        if one in own and other not in own:
                            own[other] = own[one][0], own[one][1] * by
    require(all(own[a][1] * turn == own[b][1] for a, b, turn in kept), "data: joints that keep directions contradict each other")
    slides = [own[a][0] for a, *_, u in steps if u is not None]
    count, at, vectors = classes + len(slides), classes, []
    for a, b, p, q, u in steps:
        vector = [plane(0, 0)] * count
        (c, turn), (d, other) = own[a], own[b]
        vector[c] += turn * p
        vector[d] -= other * q
        if u is not None:
            vector[at], at = turn * u, at + 1
        vectors.append(vector)
    origins, loops = {"0": [plane(0, 0)] * count}, []
    for _ in steps:
        for (a, b, *_), vector in zip(steps, vectors):
            if a in origins and b not in origins:
                origins[b] = [x + y for x, y in zip(origins[a], vector)]
                vector.clear()
            elif b in origins and a not in origins:
                origins[a] = [x - y for x, y in zip(origins[b], vector)]
                vector.clear()
    for (a, b, *_), vector in zip(steps, vectors):
        if vector:
            blocks = [(x + y - z).tolist() for x, y, z in zip(origins[a], vector, origins[b])]
            loops += [[c for block in blocks for c in block[k]] for k in range(2)]
    require(loops, "data: the linkage has no loop")
    return Linkage(fmpq_mat(loops), classes, slides)
