"""Theorem 10 of docs/certificate.md: the polynomial whose roots are the half-angle tangents of one unknown at all solutions."""
from flint import acb, arb, fmpq_poly

from closures import TURN
from eliminant import Eliminant, check_rational
from quantities import Refused, Unreadable, decimal, fields, items, require, whole

LONGEST = 4000  # digits of a coefficient


def derived(solved, system, data, claim, modes, bound, *others):
    """What is claimed of the polynomial. The modes are all solutions, and simple; the polynomial divides the eliminant, and what is
    left is not 0 at any of them."""
    require([other.get("kind") for other in others] == ["membership"], "proof: the roots of a polynomial are proved by a bound and a membership")
    found = solved(system, data, claim, modes, bound)
    require("complex" in found, "proof: the roots of a polynomial are proved by all solutions")
    _, aid = fields(others[0], ("kind", "aid"))
    unknown, first, hidden = whole(claim["unknown"]) - 1, *map(whole, fields(aid, ("first", "hidden")))
    check_rational(system)
    if system.size != 6 or unknown != (first + hidden) % 6 or system.kinds[unknown] != TURN:
        raise Refused("proof: membership: the unknown is not the angle of an eliminant")
    polynomial = fmpq_poly([integer(text) for text in items(claim["polynomial"])])
    if polynomial[polynomial.degree()] <= 0 or polynomial.numer().content() != 1:
        raise Refused("claim: the polynomial has a common factor or another sign")
    rest, remainder = divmod(fmpq_poly(Eliminant(system.links, system.kinds, first, hidden).polynomial()), polynomial)
    tangents = [(ball(mode, unknown) / 2).tan() for mode in modes]
    if remainder != 0 or any(not value_at(rest, t).abs_lower() > 0 for t in tangents):
        raise Refused("proof: membership: the polynomial does not vanish at all solutions")
    if len(tangents) != polynomial.degree() or any(t.overlaps(u) for k, t in enumerate(tangents) for u in tangents[:k]):
        raise Refused("proof: membership: the solutions are other in number than the roots")
    return {**found, "unknown": unknown + 1, "degree": polynomial.degree(), "polynomial": [str(c.p) for c in polynomial.coeffs()]}


def ball(mode, unknown):
    part, off = mode["centre"][unknown], arb(0, decimal(mode["radius"]))
    re, im = part if isinstance(part, list) else (part, "0")
    return acb(decimal(re) + off, decimal(im) + off)


def integer(text):
    if not isinstance(text, str) or len(text) > LONGEST or not text.removeprefix("-").isascii() or not text.removeprefix("-").isdigit():
        raise Unreadable(f"found {str(text)[:40]!r}, expected the digits of a whole number as text")
    return int(text)


def value_at(polynomial, t):
    value = 0 * t
    for c in reversed(polynomial.coeffs()):
        value = value * t + c
    return value
