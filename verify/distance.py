"""Theorem 8 of docs/certificate.md: nothing is in reach."""
from flint import arb

from closures import TURN, Platform, proved_modes
from motions import column, difference, dot
from quantities import fields, require


def distance(system, modes, item):
    """Theorem 8: no real solution, where one side of a closed polygon would be longer than the others together."""
    fields(item, ("kind",))
    if isinstance(system, Platform):
        between = lambda points, i, j: length(difference(points[i], points[j]))
        legs, pairs = [arb(x).sqrt() for x in system.squares], [(i, j) for i in range(6) for j in range(i)]
        is_open = any(square < 0 for square in system.squares) or any(exceeds(
            [legs[i], legs[j], between(system.base, i, j), between(system.plate, i, j)]) for i, j in pairs)
    else:
        is_open = all(kind == TURN for kind in system.kinds) and exceeds([length(column(link, 3)) for link in system.links])
    require(is_open, "proof: distance: no length exceeds the others together")
    return real_modes(system, modes, 0)


def real_modes(system, values, most):
    """The real modes, as many as there are at most. Where there are none one other solution shows that the data are these."""
    modes = proved_modes(system, values)
    real = [mode for mode in modes if mode.is_real]
    holds = len(real) == most and len(modes) == max(most, 1)
    require(holds, f"modes: of {len(modes)} {len(real)} are real, where at most {most} real solutions exist")
    return real


def length(vector):
    return arb(dot(vector, vector)).sqrt()


def exceeds(sides):
    return any(side > sum(sides[:k] + sides[k + 1:], arb(0)) for k, side in enumerate(sides))
