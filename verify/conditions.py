"""Theorem 12 of docs/certificate.md: all families of loops of four rotations that move."""
import functools
import itertools
import math

from quantities import Refused, fields, items, whole
from symbols import A, D, ONE, T, X, ZERO, around, determinant, insert, minors, never_zero, parts, polynomial, screw

FIRST, FOURTH = 12, 15  # the places of x1 and x4 among the variables
EVEN = [(2, 2), (2, 0), (0, 2), (0, 0), (1, 1)]  # the exponents of x1 and x4 in f, and those of its coefficients A, B, C, E, M
ODD = {(1, 0), (1, 2), (0, 1), (2, 1)}  # those of offsets in g
# Pairs of A, B, C, E that are 0 where f has a factor x1, x4, or one of those at infinity, and what moves f to the odd multiple of the rest.
FOLDS = {("A", "C"): (0, 1), ("B", "E"): (0, -1), ("A", "B"): (1, 0), ("C", "E"): (-1, 0)}
ISOGRAMS, DELTOIDS = [((0, 2), (1, 3))], [((0, 1), (2, 3)), ((0, 3), (1, 2))]  # pairs of links


def require(holds, what):
    if not holds:
        raise Refused(f"proof: families: {what}")


def closure():
    """f and g: the axes of joints 2 and 3, as all links but the second leave them, have its twist and its length."""
    link, joint, t = (lambda k: screw(1, (T[k], ONE), A[k])), (lambda k: screw(3, (X[k], ONE), D[k])), T[1]
    (p, q, r, s), (u, v, w, z) = around(link(2), joint(3), link(3), joint(0), link(0))
    f = t * t * (p * p + s * s) - q * q - r * r
    g = 2 * t * t * (p * u + s * z) - 2 * (q * v + r * w) + A[1] * t * (p * p + q * q + r * r + s * s)
    return f // math.gcd(*map(int, f.coeffs())), g


def in_general(f, g, slopes):
    """Points 1 and 2 of the proof: what f and g are, and f without factors."""
    require(sum((p * x for p, x in zip(slopes, (*A, D[0], D[3]))), ZERO) == g, "g is not linear in lengths and offsets")
    curve, *lengths, d1, d4 = (parts(p, FIRST, FOURTH) for p in (f, *slopes))
    are_even = all(set(own) <= set(EVEN) for own in (curve, *lengths))
    require(are_even and {*d1, *d4} <= ODD, "f or g have other terms")
    a, b, c, e, m = (curve[powers] for powers in EVEN)
    square = (m * m - 4 * a * e - 4 * b * c) ** 2 - 64 * a * b * c * e
    require(never_zero(m) and never_zero(square), "f may have factors of another kind")
    rows = [[own[powers] for own in (*lengths, curve)] for powers in EVEN]
    require(never_zero(determinant(rows)), "f may have multiples with lengths")
    rows = [[own[1, 0] - own[1, 2], own[0, 1] - own[2, 1]] for own in (d1, d4)]
    require(never_zero(determinant(rows)), "f may have multiples with offsets")
    return {"A": a, "B": b, "C": c, "E": e}


def sines(coefficients):
    """Point 3: A, B, C, E are products of two sines of half a sum of the twists, other ones each."""
    found = {name: {} for name in coefficients}
    for signs in itertools.product([1], *[[1, -1]] * 3):
        sin, cos = ZERO, ONE
        for sign, t in zip(signs, T):
            sin, cos = sin + sign * t * cos, cos - sign * t * sin
        for name in (name for name, p in coefficients.items() if p % sin == 0):
            found[name][signs] = sin
    require(all(never_zero(p, math.prod(found[name].values())) for name, p in coefficients.items()), "f has other coefficients")
    for (name, own), (second, others) in itertools.combinations(found.items(), 2):
        for one, other in itertools.product(own, others):
            unlike = {k for k in range(4) if one[k] != other[k]}
            is_isogram = len(unlike) % 2 or unlike in ({0, 2}, {1, 3})
            require(unlike and (is_isogram or name + second not in ("AE", "BC")), "coefficients vanish together elsewhere")


def related(pairings):
    """Twists of the second links of two pairs: t_j = +-t_i for both, or +-1/t_i for both; and the relations."""
    for pairs, one, other, is_inverse in itertools.product(pairings, (1, -1), (1, -1), (False, True)):
        signs = list(zip((one, other), pairs))
        twists = {j: (sign * ONE, T[i]) if is_inverse else (sign * T[i], ONE) for sign, (i, j) in signs}
        yield twists, [T[i] * T[j] - sign if is_inverse else T[i] - sign * T[j] for sign, (i, j) in signs]


def on_deltoids(f, slopes):
    """Point 4: what is left of f behind a factor has only the multiple f without offsets, and one that is odd, with neither."""
    for twists, _ in related(DELTOIDS):
        curve, d1, d4 = (parts(insert(p, twists), FIRST, FOURTH) for p in (f, *slopes[4:]))
        zeros = tuple(name for name, powers in zip("ABCE", EVEN) if curve[powers] == 0)
        require(zeros in FOLDS, "f has other factors")
        moved = {(i + FOLDS[zeros][0], j + FOLDS[zeros][1]): p for (i, j), p in curve.items() if p != 0}
        turn = (lambda i, j: (i, j)) if FOLDS[zeros][0] == 0 else (lambda i, j: (j, i))
        row = lambda own: [own.get(turn(1, 0), ZERO), own.get(turn(1, 2), ZERO),
                           own.get(turn(0, 1), ZERO) - own.get(turn(2, 1), ZERO)]
        require(never_zero(determinant([row(own) for own in (d1, d4, moved)])), "a deltoid may have offsets")


def on_isograms(f, slopes, families):
    """Point 5: f is the product of the curves of two families, and on each of them g is 0 for their lengths only."""
    for twists, relations in related(ISOGRAMS):
        own, rest = [family for family in families if family[0][:2] == relations], insert(f, twists)
        for conditions, motion in own:
            require(rest % motion[2] == 0, "a curve is no factor of f")
            rest //= motion[2]
            on_curve(slopes, twists, conditions[2:5], motion)
        require(len(own) == 2 and never_zero(rest), "an isogram has other than two curves")


def only_in(p, *places):
    return all(n == 0 or k in places for powers in p.monoms() for k, n in enumerate(powers))


def on_curve(slopes, twists, conditions, motion):
    table = [[p.derivative(k) for k in range(4, 8)] for p in conditions]
    are_linear = all(sum((x * a for x, a in zip(row, A)), ZERO) == p for row, p in zip(table, conditions))
    require(are_linear and all(only_in(x, 0, 1) for row in table for x in row), "the conditions of lengths are not linear")
    lengths, angles = minors(table, 4), [(X[0], ONE)]
    require(any(map(never_zero, lengths)), "the lengths are not determined")
    for x, p in zip(X[1:], motion):
        cos = p.derivative(str(x))
        angles.append((cos * x - p, cos))
        follows = all(only_in(part, 0, 1, FIRST) for part in angles[-1]) and cos.gcd(angles[-1][0]) == 1
        require(follows, "an angle does not follow from the first one")
    require(set(parts(motion[2], FIRST, FOURTH)) in ({(1, 1), (0, 0)}, {(1, 0), (0, 1)}), "a curve may have factors")
    columns = [parts(insert(p, {**twists, FOURTH: angles[3]}), FIRST) for p in slopes]
    rows, others = ([[own[power] for own in some] for power in sorted(set().union(*some))] for some in (columns[:4], columns[4:]))
    require(all(sum((x * a for x, a in zip(row, lengths)), ZERO) == 0 for row in rows), "the lengths are others")
    require(len(rows) == 3 and any(never_zero(p, math.prod(angles[3])) for p in minors(rows, 4)), "there may be other lengths")
    require(len(others) == 2 and never_zero(determinant(others), math.prod(angles[3])), "there may be offsets")
    tangents = [twists.get(k, (T[k], ONE)) for k in range(4)]
    motions = [screw(*part) for x, t, a in zip(angles, tangents, lengths) for part in ((3, x, ZERO), (1, t, a * A[0]))]
    (_, *vector), dual = around(*motions)
    require(all(p == 0 for p in (*vector, *dual)), "the loop opens")


def family(table, shape):
    """The polynomials of its conditions, and those of its motion."""
    kind, *lists = fields(table, ("class", "conditions", "motion"))
    require(kind == shape[0], f"found the class {str(kind)[:40]!r}")
    return [[polynomial(text) for text in items(texts, count)] for texts, count in zip(lists, shape[1:])]


@functools.cache
def checked_closure():
    """f, and the coefficients of lengths and offsets in g: points 1 to 4 of the proof hold, which depend on no family."""
    f, g = closure()
    slopes = [g.derivative(k) for k in (4, 5, 6, 7, 8, 11)]
    sines(in_general(f, g, slopes))
    on_deltoids(f, slopes)
    return f, slopes


def four_joints(system, data, claim, modes, item, *others):
    """All families of loops of four rotations of which no twist is a multiple of pi and joints 1 and 4 move."""
    fields(item, ("kind",))
    items(modes, 0)
    require(item["kind"] == "families" and not others and whole(*fields(data, ("joints",))) == 4, "only loops of four joints have such a proof")
    *bennett, spherical = map(family, items(claim["families"], 17), [("bennett", 9, 3)] * 16 + [("spherical", 8, 1)])
    f, slopes = checked_closure()
    require(spherical == [[*A, *D], [f]], "the last family is not that of axes through one point")
    require(all(conditions[5:] == [*D] for conditions, _ in bennett), "offsets are not 0")
    on_isograms(f, slopes, bennett)
    return {"status": "complete", "families": claim["families"], "oblique_links": [1, 2, 3, 4], "moving_joints": [1, 4]}
