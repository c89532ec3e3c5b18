"""Theorem 9 of docs/certificate.md: the real solutions of a loop belong to the real zeros of an eliminant in one angle."""
from flint import arb, arb_mat, arb_poly, fmpq

from closures import Chain
from distance import real_modes
from eliminant import Eliminant, at
from quantities import Refused, fields, require, whole

END = fmpq(97, 89)  # the tangents of the half angle are searched up to it, and their inverses up to its inverse
NARROW = fmpq(1, 2**100)  # zeros that are nearer than this are not told apart
PLACES = [arb(11 * k + 1) / 64 for k in range(-12, 13)]  # from -2 to 2, so that few digits are lost, and none of them special
ASIDE = fmpq(1, 37)  # intervals are divided beside the middle, where zeros of special data may be


def real_zeros(system, modes, item):
    """As many real solutions as the eliminant has real zeros, which are simple: no more exist."""
    _, stated, aid = fields(item, ("kind", "value", "aid"))
    most = most_real(system, *map(whole, fields(aid, ("first", "hidden"))))
    require(most == whole(stated), f"proof: real-zeros: the bound is {most}, and {stated} is stated")
    return real_modes(system, modes, most)


def most_real(system, first, hidden):
    """The number of real zeros of the eliminant."""
    if not isinstance(system, Chain) or system.size != 6 or system.spherical:
        raise Refused("proof: real-zeros: only loops of six rotations and translations have an eliminant")
    links = [[[arb(x) for x in row] for row in link] for link in system.links]  # long rational numbers would take long
    eliminant = Eliminant(links, system.kinds, first, hidden)
    if not eliminant.is_angle:
        raise Refused("proof: real-zeros: the unknown is no angle")
    minor = arb_poly.interpolate(PLACES, [arb_mat(at(eliminant.chosen, t)).det() for t in PLACES])
    values = [minor[k] for k in range(25)]
    return zeros(arb_poly(values), -END, END) + zeros(arb_poly(values[::-1]), -1 / END, 1 / END)


def zeros(f, low, high):
    """The number of zeros of f between two places at which it is not 0; all are simple."""
    ends = f(arb(low)), f(arb(high))
    if any(0 in end for end in ends):
        raise Refused("proof: real-zeros: a zero is too near to the end of an interval")
    middle, half = (low + high) / 2, (high - low) / 2
    value, slope, *rest = [abs(c) for c in f(arb_poly([middle, half])).coeffs()]
    if value > slope + sum(rest, arb(0)):
        return 0
    if slope > sum((k * c for k, c in enumerate(rest, 2)), arb(0)):  # f is monotone
        return int((ends[0] > 0) != (ends[1] > 0))
    if half < NARROW:
        raise Refused("proof: real-zeros: two zeros may be one")
    between = middle + half * ASIDE
    return zeros(f, low, between) + zeros(f, between, high)
