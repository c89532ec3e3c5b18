"""Theorem 8 of docs/certificate.md: no real solution, because one length is longer than all others together."""
from flint import arb

from quantities import Refused, count, fields, items


def length(vector):
    return sum((x * x for x in vector), arb(0)).sqrt()


def exceeds(sides):
    """Whether one side of a polygon is longer than the others together."""
    return any(side > sum(sides[:k] + sides[k + 1:], arb(0)) for k, side in enumerate(sides))


def is_too_far(system):
    if system.letters != "platform":
        lengths = [length([arb(row[3]) for row in link.balls[:3]]) for link in system.links]
        return all(system.turns) and exceeds(lengths)
    if any(square < 0 for square in system.squares):
        return True
    legs = [square.sqrt() for square in system.squares]
    between = lambda points, i, j: length([x - y for x, y in zip(points[i], points[j])])
    pairs = [(i, j) for i in range(6) for j in range(i)]
    return any(exceeds([legs[i], legs[j], between(system.base, i, j), between(system.plate, i, j)]) for i, j in pairs)


def check_distance(system, claim, modes, item):
    fields(item, ("kind",))
    if items(modes):
        raise Refused("modes: none are asked for here")
    if not is_too_far(system):
        raise Refused("proof: distance: no length exceeds the others together")
    _, status, _, real = fields(claim, ("verb", "status", "proof", "real"))
    if status != "unreachable" or count(real) != 0:
        raise Refused("claim: no real solution is proved, and nothing of complex ones")
    return "no real solution: proved"
