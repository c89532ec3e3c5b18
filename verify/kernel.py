"""Theorem 13 of docs/certificate.md: a linkage in the plane has no other solutions, by a matrix of its equations times monomials."""
from itertools import combinations, islice

from flint import acb, acb_mat, arb, fmpq_mat, nmod, nmod_mat

from closures import TURN, proved_modes
from linkages import Linkage, system_of
from quantities import fields, require, whole

PRIME = 2147483629  # 2^31 - 19, a prime that is 1 modulo 4
ROOT = nmod(2, PRIME) ** ((PRIME - 1) // 4)  # of -1, as 2 is no square
MOST_COLUMNS, MOST_LOOPS, MOST_EXPONENT = 3000, 3, 60
SOME = 3  # times as many rows as columns: so many have the full rank in most cases


def kernel(system, values, item):
    """The modes, where they are as many as the kernel of the matrix has dimensions, and their vectors are independent."""
    require(isinstance(system, Linkage), "proof: kernel: only linkages in the plane have such a matrix")
    _, stated, aid = fields(item, ("kind", "value", "aid"))
    bounds = [*map(whole, fields(aid, ("up", "down", "each", "slides")))]
    require(max(bounds) <= MOST_EXPONENT, f"proof: kernel: a bound above {MOST_EXPONENT}")
    require(system.loops.nrows() <= 2 * MOST_LOOPS, f"proof: kernel: more than {MOST_LOOPS} loops")
    require(whole(stated) == len(values) > 0, f"proof: kernel: {whole(stated)} is stated, and there are {len(values)} modes")
    modes, chosen = proved_modes(system, values), [*islice(monomials(system, *bounds), MOST_COLUMNS + 1)]
    require(len(chosen) <= MOST_COLUMNS, f"proof: kernel: more than {MOST_COLUMNS} monomials")
    most = len(chosen) - rank(shortest(system), chosen, len(chosen) - len(modes))
    require(most == len(modes), f"proof: kernel: it has dimension {most}, and {len(modes)} modes are proved")
    require(are_independent(system, modes, chosen), "proof: kernel: the vectors of the modes may be dependent")
    return modes


def monomials(system, up, down, each, slides, start=()):
    """The exponents of all unknowns: those of angles sum up to `up` at most where positive, to `down` where negative, and none is larger
    than `each`; those of distances are not negative, and sum up to `slides` at most."""
    if len(start) == system.size:
        yield start
        return
    is_turn = system.kinds[len(start)] == TURN
    for own in range(-min(down, each), min(up, each) + 1) if is_turn else range(slides + 1):
        left = (up - max(own, 0), down + min(own, 0), each, slides) if is_turn else (up, down, each, slides - own)
        yield from monomials(system, *left, (*start, own))


def shortest(system):
    """The combinations of the equations of the loops with fewest columns, modulo the prime: lists of exponents and coefficients."""
    count, columns = system.loops.nrows() // 2, system.columns()
    found = {}
    for gone in combinations(range(len(columns)), count - 1):
        order = [*gone, *(k for k in range(len(columns)) if k not in gone)]
        table = system.loops.tolist()
        rows, full = fmpq_mat([[row[2 * k + part] for k in order for part in (0, 1)] for row in table]).rref()
        require(full == 2 * count, "proof: kernel: loops depend on each other")
        if count > 1 and rows[2 * count - 4, 2 * count - 4] != 1:
            continue  # the columns that are gone depend on each other: others take their place
        last = {k: (rows[2 * count - 2, 2 * at], rows[2 * count - 1, 2 * at]) for at, k in enumerate(order)}
        last = {k: value for k, value in last.items() if value != (0, 0)}
        found[tuple(sorted(last))] = last
    modulo = lambda x: nmod(int(x.p), PRIME) / nmod(int(x.q), PRIME)
    mirrored = lambda e: [-k if kind == TURN else k for k, kind in zip(e, system.kinds)]
    both = [[(columns[k], modulo(a) + ROOT * modulo(b)) for k, (a, b) in own.items()] for own in found.values()]
    return both + [[(mirrored(columns[k]), modulo(a) - ROOT * modulo(b)) for k, (a, b) in own.items()] for own in found.values()]


def rank(equations, chosen, enough):
    """The rank, modulo the prime, of all equations times monomials of which all monomials are among the chosen ones. Where some of the
    rows, taken at equal distances, have a rank that is enough, the others are left out."""
    places, rows = {own: at for at, own in enumerate(chosen)}, []
    for equation in equations:
        first, values = equation[0][0], [value for _, value in equation]
        for own in chosen:
            by = [x - y for x, y in zip(own, first)]
            at = [places.get(tuple(map(int.__add__, by, term))) for term, _ in equation]
            if None not in at:
                rows.append([*zip(at, values)])
    some = rows[::max(len(rows) // (SOME * len(chosen)), 1)]
    return found if (found := rank_of(some, len(chosen))) >= enough else rank_of(rows, len(chosen))


def rank_of(rows, count):
    table = nmod_mat(len(rows), count, PRIME)  # filled in place: lists of all its zeros would take more memory than it
    for k, row in enumerate(rows):
        for place, value in row:
            table[k, place] = value
    return table.rank()


def are_independent(system, modes, chosen):
    """Whether the values of those monomials at the modes are independent that may be multiplied by every unknown."""
    among = set(chosen)
    inner = [own for own in chosen if all((*own[:k], own[k] + 1, *own[k + 1:]) in among for k in range(system.size))]
    require(inner, "proof: kernel: no monomial may be multiplied by every unknown")
    table = []
    for centre, radius, *_ in modes:
        x = [z + acb(arb(0, radius), arb(0, radius)) for z in centre]
        table.append([value(own, x, system.classes - 1) for own in inner])
    for at in range(len(table)):
        pivot = max(range(len(inner)), key=lambda k: table[at][k].abs_lower())
        if not table[at][pivot].abs_lower() > 0:
            return False
        for row in table[at + 1:]:
            factor = row[pivot] / table[at][pivot]
            row[:] = [x - factor * y for x, y in zip(row, table[at])]
            row[pivot] = acb(0)
    return True


def value(exponents, x, turns):
    """The value of a monomial, whose first unknowns are angles."""
    product = (acb(0, 1) * sum((k * angle for k, angle in zip(exponents, x[:turns])), acb(0))).exp()
    for power, distance in zip(exponents[turns:], x[turns:]):
        product *= distance ** power
    return product
