"""Theorems 5 to 7 of docs/certificate.md: whether a closed loop moves, and in how many dimensions."""
from flint import fmpq

from algebraic import Series, points
from closures import TURN, proved_modes, six
from eliminants import check_lengths, most_solutions
from mechanism import Reader
from motions import IDENTITY, about_z, along, times
from bounds import general
from quantities import Refused, by_half_tangent, fields, is_exact, items, whole

MOST = 16  # the multiplicity of an isolated configuration and those of its conjugates are no greater together


def immobile(data, item, modes):
    """Theorem 5: the solutions of the longer loop are finitely many, and those of the loop are among them."""
    system, = Reader(data, True).systems(False)
    if system.size > 6:
        raise Refused("proof: only loops of at most 6 unknowns are covered")
    longer, is_general = system.longer(), item["kind"] == "general-bound"
    _, stated = fields(item, ("kind", "value" if is_general else "aid"))
    bound = general(longer) if is_general else most_solutions(longer, stated)
    found = len(proved_modes(longer, modes))
    if found < 1 or is_general and not bound == whole(stated) == found:
        raise Refused(f"modes: {found} solutions of the longer loop are proved, where {bound or 'no number of them'} would prove it")
    return 0


def curve(data, item, modes):
    """Theorem 6: the closure equations hold to the order that decides along the only motion of the first order."""
    items(modes, 0)
    system, = Reader(data, True).systems(False)
    if system.size > 6 or system.spherical or not is_exact(system.constants()):
        raise Refused("proof: curve: only loops of at most 6 unknowns with rational constants and without spherical joints are covered")
    check_lengths(system.links, fmpq(0))
    (modulus, point, _), size = points(item, system.kinds), system.size
    if all(root.imag != 0 for root, _ in modulus.complex_roots()):
        raise Refused("proof: curve: none of the points is real")
    if system.around(point) != IDENTITY:
        raise Refused("proof: curve: the loop is not closed there")
    standing = [about_z(*own) if kind == TURN else along(0, 0, *own) for kind, own in zip(system.kinds, point)]
    links = [times(*both) for both in zip(standing, system.links)]

    def values(x, order):
        """The six equations, for half-angle tangents and distances beyond the point."""
        product = IDENTITY
        for kind, terms, link in zip(system.kinds, x, links):
            t = Series([*terms, *[fmpq(0)] * order][:order + 1])
            product = times(times(product, about_z(*by_half_tangent(t)) if kind == TURN else along(0, 0, t)), link)
        return [Series([0 * point[0][0]] * (order + 1)) + f for f in six(product)]

    unit = lambda k, count: [fmpq(int(i == k)) for i in range(count)]
    screws = [[f.terms[1] for f in values([[fmpq(0), x] for x in unit(k, size)], 1)] for k in range(size)]
    pivots, rows = reduced([[*(screw[i] for screw in screws), *unit(i, 6)] for i in range(6)], size)
    if len(pivots) != size - 1:
        raise Refused(f"proof: curve: the joint screws have the rank {len(pivots)}, expected {size - 1}")
    along_it = [[fmpq(0), fmpq(int(k not in pivots.values()))] for k in range(size)]
    for order in range(1, MOST // min(factor.degree() for factor, _ in modulus.factor()[1]) + 1):
        found = [f.terms[order] for f in values(along_it, order)]
        for i, row in enumerate(rows):
            value = sum((x * y for x, y in zip(row[size:], found)), 0 * found[0])
            if i in pivots:
                along_it[pivots[i]][order:] = [-value]
            elif value != 0:
                raise Refused("proof: curve: the loop opens along the motion")
        along_it = [own if len(own) > order else [*own, fmpq(0)] for own in along_it]
    return 1


def reduced(rows, count):
    """Gauss's algorithm on the first columns: {row: column} of the pivots, and the rows then."""
    pivots = {}
    for j in range(count):
        i = next((i for i in range(len(rows)) if i not in pivots and rows[i][j] != 0), None)
        if i is not None:
            pivots[i], scale = j, rows[i][j].inverse()
            rows[i] = [x * scale for x in rows[i]]
            rows = [row if k == i else [x - row[j] * y for x, y in zip(row, rows[i])] for k, row in enumerate(rows)]
    return pivots, rows


def regular(data, item, modes):
    """Theorem 7: with one unknown of seven held a real solution is simple."""
    _, held = fields(item, ("kind", "held"))
    system, = Reader({**data, "input": [held]}, True).systems()
    if system.size != 6:
        raise Refused("proof: regular: only loops of seven unknowns are covered")
    if [is_real for *_, is_real in proved_modes(system, items(modes, 1))] != [True]:
        raise Refused("mode 1: a real configuration is asked for")
    return 1
