"""Proofs that no solution is missing: each is an upper bound on the number of isolated solutions that the modes meet."""
from chains import inverse
from eliminants import eliminant
from quantities import Refused, Unreadable, count, fields


def check_proof(system, modes, proof):
    if len(proof) != 1:
        raise Refused(f"proof: found {len(proof)} items, expected one that bounds the number of solutions")
    item = proof[0]
    kind = item.get("kind") if isinstance(item, dict) else None
    if kind not in KINDS:
        raise Unreadable(f"proof: found the kind {str(kind)[:40]!r}, expected one of {', '.join(KINDS)}")
    bound, value = KINDS[kind](system, item), count(fields(item, ("kind", "value"), ("aid",))[1])
    if bound is None or value != bound:
        raise Refused(f"proof: {kind}: the value is {value}, where the bound is {'not known' if bound is None else bound}")
    if len(modes) != bound:
        raise Refused(f"proof: {kind}: at most {bound} solutions, and {len(modes)} modes are proved")


def general(system, item):
    """Theorem 2: what mechanisms of this kind can have at all."""
    fields(item, ("kind", "value"))
    letters, slides = system.letters, system.letters.count("P")
    if letters == "platform":
        return 40
    if "S" not in letters and len(letters) == 6:
        return {0: 16, 1: 16, 2: 8, 3: 2}.get(slides)
    return {0: 4, 1: 4, 2: 2, 3: 1}.get(slides) if letters.count("S") == 1 and len(letters) == 4 else None


def geometry(system, item):
    """Theorem 3: what the incidences of axes or points allow."""
    fields(item, ("kind", "value"))
    if system.letters == "platform":
        return 16 if system.exact and any(map(three_meet, system.exact)) or system.exact and any(map(in_pairs, system.exact)) else None
    return min(filter(None, (of_triple(system, first) for first in range(6))), default=None)


def of_triple(system, first):
    """Three neighbouring axes through a point, or parallel."""
    if "S" in system.letters or not all(system.turns[(first + k) % 6] for k in range(3)):
        return None
    slides = sum(not system.turns[(first + k) % 6] for k in range(3, 6))
    pair = system.links[first], system.links[(first + 1) % 6]
    exact = all(link.exact is not None for link in system.links)
    before, behind = (link.exact if exact else link.balls for link in pair)
    along = lambda m: m[0][2] == 0 and m[1][2] == 0
    if along(before) and along(behind):
        return {0: 8, 1: 4}.get(slides)
    on_axis = lambda m: m[0][3] == 0 and m[1][3] == 0
    one, other = crossing(inverse(before)), crossing(behind)
    if on_axis(before) and on_axis(behind) and behind[2][3] == 0 or one and other and one[0] * other[1] - other[0] * one[1] == 0:
        return 2 * {0: 4, 1: 4, 2: 2, 3: 1}[slides]
    return None


def crossing(m):
    """Where on the z axis its image under a link crosses it, as a quotient."""
    (x, u), (y, v), (z, w) = ((row[3], row[2]) for row in m[:3])
    square = u * u + v * v
    return (z * square - (x * u + y * v) * w, square) if x * v - y * u == 0 and square != 0 else None


def three_meet(points):
    return any(points.count(point) >= 3 for point in points)


def in_pairs(points):
    if any(points.count(point) != 2 for point in points):
        return False
    a, b, c = set(points)
    (x, y, z), (u, v, w) = ([p - q for p, q in zip(other, a)] for other in (b, c))
    return any(e != 0 for e in (y * w - z * v, z * u - x * w, x * v - y * u))


KINDS = {"general-bound": general, "geometry-bound": geometry, "eliminant": eliminant}
