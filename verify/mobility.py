"""Theorems 5 to 7 of docs/certificate.md: whether a closed loop moves, and in how many dimensions."""
from flint import ctx, fmpq, fmpq_mat, fmpq_series

from chains import Chain, IDENTITY, chain, inverse, times
from eliminants import LONGEST, bound
from isolation import modes_of, prove_all
from quantities import Refused, Unreadable, count, decimal, fields, items, rational

MOST = 16  # the multiplicity of an isolated configuration is no greater
ctx.cap = MOST + 1


def check_mobility(data, claim, modes, proof):
    _, status, word, freedoms = fields(claim, ("verb", "status", "proof", "mobility"))
    if word != "proved":
        raise Refused("claim: only proved answers are covered")
    if not isinstance(data, dict) or "input" in data or not isinstance(data.get("mechanism"), dict) or data["mechanism"].get("kind") != "loop":
        raise Refused("data: whether it moves is proved of a loop without input")
    item = items(proof, 1)[0]
    kind = item.get("kind") if isinstance(item, dict) else None
    if kind not in KINDS:
        raise Unreadable(f"proof: found the kind {str(kind)[:40]!r}, expected one of {', '.join(KINDS)}")
    found = KINDS[kind](data, item, modes)
    if count(freedoms) != found or status != ("mobile" if found else "immobile"):
        raise Refused(f"claim: found {str(status)[:20]!r} of dimension {freedoms}, where dimension {found} is proved")
    return f"{status}, of dimension {found}: proved"


def loop(data, most):
    """A loop of at most so many unknowns with rational constants and without spherical joints."""
    system = Chain(data)
    if system.size > most or "S" in system.letters or any(link.exact is None for link in system.links):
        raise Refused(f"proof: only loops of at most {most} unknowns with rational constants are covered")
    return [link.exact for link in system.links], list(system.turns)


def none(modes):
    if items(modes):
        raise Refused("modes: none are asked for here")


def immobile(data, item, modes):
    """Theorem 5: the longer loop has finitely many solutions, and those of the loop are among them."""
    none(modes)
    links, turns = loop(data, 6)
    _, aid = fields(item, ("kind", "aid"))
    for k in range(6 - len(links)):  # more rotations, about axes that nothing distinguishes
        t, u = fmpq(2 + k, 7), fmpq(3, 5 + 2 * k)
        about = lambda t: ((1 - t * t) / (1 + t * t), 2 * t / (1 + t * t))
        (c, s), (d, e) = about(t), about(u)
        frame = times([[1, 0, 0, fmpq(k + 1, 3)], [0, c, -s, fmpq(1, k + 2)], [0, s, c, 0], IDENTITY[3]],
                      [[d, 0, e, 0], [0, 1, 0, 0], [-e, 0, d, 0], IDENTITY[3]])
        links[-1:] = [times(links[-1], frame), inverse(frame)]
        turns.append(True)
    bound(links, turns, aid)
    return 0


def turned(t):
    """The rotation about z, or the translation along it, by a series."""
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    return [[c, -s, 0, 0], [s, c, 0, 0], *IDENTITY[2:]]


def moved(is_turn, t):
    return turned(t) if is_turn else [*IDENTITY[:2], [0, 0, 1, t], IDENTITY[3]]


def curve(data, item, modes):
    """Theorem 6: the closure equations hold to the order 16 along the only motion of the first order."""
    none(modes)
    links, turns = loop(data, 6)
    _, point = fields(item, ("kind", "point"))
    for k, text in enumerate(items(point, len(links))):
        is_half_turn = turns[k] and text == "inf"
        value = rational("0" if is_half_turn else text)
        if value is None:
            raise Unreadable("proof: curve: found a number that is not rational")
        here = [[-1, 0, 0, 0], [0, -1, 0, 0], *IDENTITY[2:]] if is_half_turn else moved(turns[k], value)
        links[k] = times(here, links[k])
    if any(fmpq(x).height_bits() > LONGEST for link in links for row in link for x in row):
        raise Refused("proof: curve: the numbers are too long")
    if [[fmpq(x) for x in row] for row in chain(links)] != [[fmpq(x) for x in row] for row in IDENTITY]:
        raise Refused("proof: curve: the loop is not closed there")
    size, small = len(links), fmpq_series([0, 1])
    screws = [[fmpq(f[1]) for f in equations(links, turns, [small * int(i == k) for i in range(size)])] for k in range(size)]
    reduced, rank = fmpq_mat(screws).rref()
    if rank != size - 1:
        raise Refused(f"proof: curve: the joint screws have the rank {rank}, expected {size - 1}")
    # The equations at the pivots are independent; all unknowns but one follow from them.
    rows = [next(i for i in range(6) if reduced[k, i] != 0) for k in range(rank)]
    for free in range(size):
        others = [k for k in range(size) if k != free]
        square = fmpq_mat([[screws[k][i] for k in others] for i in rows])
        if square.det() != 0:
            break
    step, point = square.inv(), [small * int(k == free) for k in range(size)]
    for _ in range(MOST):
        value = equations(links, turns, point)
        for a, k in enumerate(others):
            point[k] = point[k] - sum((value[i] * step[a, b] for b, i in enumerate(rows)), fmpq_series([0]))
    if any(f[order] != 0 for f in equations(links, turns, point) for order in range(MOST + 1)):
        raise Refused("proof: curve: the loop opens along the motion")
    return 1


def equations(links, turns, point):
    """What is not 0 where the loop is open: six series."""
    m = chain([part for link, is_turn, t in zip(links, turns, point) for part in (moved(is_turn, t), link)])
    return [fmpq_series([0]) + x for x in
            (m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1], m[0][3], m[1][3], m[2][3])]


def regular(data, item, modes):
    """Theorem 7: with one unknown of seven held a real solution is simple."""
    _, held = fields(item, ("kind", "held"))
    system = Chain({**data, "input": [held]})
    if system.size != 6 or "S" in system.letters:
        raise Refused("proof: regular: only loops of seven unknowns without spherical joints are covered")
    balls = modes_of(items(modes, 1), 6)
    if not balls[0][2]:
        raise Refused("mode 1: a real configuration is asked for")
    prove_all(system, balls)
    return 1


KINDS = {"eliminant": immobile, "curve": curve, "regular": regular}
