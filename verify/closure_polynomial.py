"""Theorem 10 of docs/certificate.md: the polynomial whose roots are the half-angle tangents of one unknown at all solutions."""
from flint import fmpq_poly

from closures import TURN, box_of, centre_of
from eliminants import Eliminant, check_lengths
from quantities import Refused, Unreadable, decimal, fields, is_exact, items, whole

LONGEST = 4000  # digits of a coefficient


def check_polynomial(system, modes, claim, item):
    """The modes are all solutions, and simple; P divides the eliminant, and what is left is not 0 at any of them."""
    _, aid = fields(item, ("kind", "aid"))
    unknown, first, hidden = whole(claim["unknown"]) - 1, *map(whole, fields(aid, ("first", "hidden")))
    if system.spherical or not is_exact(system.constants()) or unknown != (first + hidden) % 6 or system.kinds[unknown] != TURN:
        raise Refused("proof: membership: the unknown is not the angle of an eliminant over the rational numbers")
    check_lengths(system.links, decimal("0"))
    polynomial = fmpq_poly([integer(text) for text in items(claim["polynomial"])])
    is_whole = len(claim["polynomial"]) == polynomial.degree() + 1 == whole(claim["degree"]) + 1
    if not is_whole or polynomial[polynomial.degree()] <= 0 or polynomial.numer().content() != 1:
        raise Refused("claim: the polynomial is not of this degree, or has a common factor or another sign")
    rest, remainder = divmod(fmpq_poly(Eliminant(system.links, system.kinds, first, hidden).polynomial()), polynomial)
    tangents = [(box_of(*centre_of(system, mode))[unknown] / 2).tan() for mode in modes]
    if remainder != 0 or any(not value_at(rest, t).abs_lower() > 0 for t in tangents):
        raise Refused("proof: membership: the polynomial does not vanish at all solutions")
    if len(tangents) != polynomial.degree() or any(t.overlaps(u) for k, t in enumerate(tangents) for u in tangents[:k]):
        raise Refused("proof: membership: the solutions are other in number than the roots")


def integer(text):
    if not isinstance(text, str) or len(text) > LONGEST or not text.removeprefix("-").isascii() or not text.removeprefix("-").isdigit():
        raise Unreadable(f"found {str(text)[:40]!r}, expected the digits of a whole number as text")
    return int(text)


def value_at(polynomial, t):
    value = 0 * t
    for c in reversed(polynomial.coeffs()):
        value = value * t + c
    return value
