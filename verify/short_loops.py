"""Theorem 11 of docs/certificate.md: which solutions of the longer loop are those of a loop of fewer than six unknowns."""
from flint import acb, acb_poly, arb, ctx, fmpq

from algebraic import Points
from closures import TURN, Chain, are_apart
from motions import along, inverse, times, turn
from quantities import by_half_tangent, require

PRECISION = 1408  # bits: coefficients of some 400 cancel
STEPS = 6  # of Newton's method, from 53 bits


def lengthened(system):
    """The loop with rotations about axes that nothing distinguishes behind its last link, up to six unknowns."""
    if system.size >= system.equations:
        return system
    parts = [part for pair in zip(system.kinds, system.links) for part in pair]
    for k in range(6 - system.size):
        about_x, about_y = turn(0, *by_half_tangent(fmpq(2 + k, 7))), turn(1, *by_half_tangent(fmpq(3, 5 + 2 * k)))
        frame = times(inverse(system.first), along(fmpq(k + 1, 3), fmpq(1, k + 2), 0), about_x, about_y)
        parts += [frame, TURN, inverse(frame)]
    return Chain(parts, system.spherical)


def own_modes(system, modes, item, *others):
    """Returns the modes of the loop itself among those of the longer one: there are as many as points of the second item, if there is one."""
    if system.size >= system.equations:
        require(not others, f"proof: found {1 + len(others)} items, where one bounds the number of solutions")
        return modes
    require(len(others) <= 1, f"proof: found {1 + len(others)} items, expected one or two")
    require(all(other["kind"] == "points" for other in others), "proof: points show which modes are those of the loop")
    points, is_own_bound = [Points(system, other) for other in others], item["kind"] == "own-eliminant"
    added = [TURN] * (6 - system.size)
    if is_own_bound and points:
        own = [mode for mode in modes if is_one_in(points[0], system, mode.centre, mode.radius)]
    else:  # the added rotations may be 0
        own = [mode for mode in modes if not are_apart(added, mode.centre[system.size:], [0] * len(added), mode.radius)]
    count = points[0].modulus.degree() if points else 0
    is_bound = not is_own_bound or item["value"] == count
    require(is_bound and len(own) == count, f"proof: points: they are {count}, and {len(own)} of the {len(modes)} modes may be solutions of the loop")
    return own


def is_one_in(points, system, centre, radius):
    """Whether a ball holds one of the points, with all further unknowns at 0."""
    before = ctx.prec
    ctx.prec = PRECISION
    try:
        here = system.parts(centre)
        root, modulus = points.weighed([x for own in here for x in own]).mid(), points.modulus
        step = lambda t: acb_poly(modulus)(t) / acb_poly(modulus.derivative())(t)
        for _ in range(STEPS):
            root = (root - step(root)).mid()
        off = arb(0, modulus.degree() * step(root).abs_upper())  # P'/P is the sum of 1/(t - root) over n roots
        root = acb(root.real + off, root.imag + off)
        values = [[acb_poly(part.value)(root) for part in own] for own in points.values]
        return all(map(lambda one, other: is_near(one, other, radius), values, here)) and all(
            x.abs_upper() < radius for x in centre[system.size:])
    finally:
        ctx.prec = before


def is_near(one, other, radius):
    if len(one) == 1:
        return (one[0] - other[0]).abs_upper() < radius
    # Cosine and sine of the difference, which is less than twice the sine if that is small and the cosine positive.
    (cos, sin), (c, s) = one, other
    return 2 * (sin * c - cos * s).abs_upper() < radius and (cos * c + sin * s).real > 0
