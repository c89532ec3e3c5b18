"""Theorems 5 to 7 of docs/certificate.md: whether a closed loop moves, and in how many dimensions."""
from flint import ctx, fmpq, fmpq_mat, fmpq_series

from closures import TURN, Chain, proved_modes, six
from eliminants import check_lengths, most_solutions
from mechanism import Reader
from motions import IDENTITY, about_x, about_z, along, chain, inverse, times
from quantities import Refused, Unreadable, by_half_tangent, expression, fields, is_exact, items

MOST = 16  # the multiplicity of an isolated configuration is no greater
ctx.cap = MOST + 1


def of_data(data, most):
    """A loop of at most so many unknowns with rational constants and without spherical joints."""
    system, = Reader(data, True).systems(False)
    if system.size > most or system.spherical or not is_exact(system.constants()):
        raise Refused(f"proof: only loops of at most {most} unknowns with rational constants are covered")
    return system


def immobile(data, item, modes):
    """Theorem 5: the longer loop has finitely many solutions, and those of the loop are among them."""
    system, (_, aid) = of_data(data, 6), fields(item, ("kind", "aid"))
    parts = [part for pair in zip(system.kinds, system.links) for part in pair]
    for k in range(6 - system.size):  # more rotations, about axes that nothing distinguishes
        cos, sin = by_half_tangent(fmpq(3, 5 + 2 * k))
        frame = chain([inverse(system.first), along(fmpq(k + 1, 3), fmpq(1, k + 2), 0), about_x(*by_half_tangent(fmpq(2 + k, 7))),
                       [[cos, 0, sin, 0], IDENTITY[1], [-sin, 0, cos, 0], IDENTITY[3]]])
        parts += [frame, TURN, inverse(frame)]
    longer = Chain(parts, [])
    most_solutions(longer, aid)
    if proved_modes(longer, modes)[0] < 1:
        raise Refused("modes: a solution of the longer loop is asked for")
    return 0


def curve(data, item, modes):
    """Theorem 6: the closure equations hold to the order 16 along the only motion of the first order."""
    items(modes, 0)
    system, (_, point) = of_data(data, 6), fields(item, ("kind", "point"))
    size, kinds, links, small = system.size, system.kinds, list(system.links), fmpq_series([0, 1])
    for k, text in enumerate(items(point, size)):
        is_half_turn = kinds[k] == TURN and text == "inf"
        value = fmpq(0) if is_half_turn else expression(text)[0]
        if not is_exact([value]):
            raise Unreadable("proof: curve: found a number that is not rational")
        links[k] = times(about_z(fmpq(-1), fmpq(0)) if is_half_turn else moved(kinds[k], value), links[k])
    check_lengths(links, fmpq(0))
    if chain(links) != IDENTITY:
        raise Refused("proof: curve: the loop is not closed there")
    values = lambda x: [fmpq_series([0]) + f for f in six(chain(m for k in range(size) for m in (moved(kinds[k], x[k]), links[k])))]
    screws = [[fmpq(f[1]) for f in values([small * int(i == k) for i in range(size)])] for k in range(size)]
    reduced, rank = fmpq_mat(screws).rref()
    if rank != size - 1:
        raise Refused(f"proof: curve: the joint screws have the rank {rank}, expected {size - 1}")
    # The equations at the pivots are independent; all unknowns but one follow from them.
    rows = [next(i for i in range(6) if reduced[k, i] != 0) for k in range(rank)]
    for free in range(size):
        others = [k for k in range(size) if k != free]
        slope = fmpq_mat([[screws[k][i] for k in others] for i in rows])
        if slope.det() != 0:
            break
    step, along_it = slope.inv(), [small * int(k == free) for k in range(size)]
    for _ in range(MOST):
        value = values(along_it)
        for a, k in enumerate(others):
            along_it[k] = along_it[k] - sum((value[i] * step[a, b] for b, i in enumerate(rows)), fmpq_series([0]))
    if any(f[order] != 0 for f in values(along_it) for order in range(MOST + 1)):
        raise Refused("proof: curve: the loop opens along the motion")
    return 1


def moved(kind, t):
    """By a half-angle tangent or a distance."""
    return about_z(*by_half_tangent(t)) if kind == TURN else along(0, 0, t)


def regular(data, item, modes):
    """Theorem 7: with one unknown of seven held a real solution is simple."""
    _, held = fields(item, ("kind", "held"))
    system, = Reader({**data, "input": [held]}, True).systems()
    if system.size != 6 or system.spherical:
        raise Refused("proof: regular: only loops of seven unknowns without spherical joints are covered")
    if proved_modes(system, items(modes, 1))[1] != 1:
        raise Refused("mode 1: a real configuration is asked for")
    return 1
