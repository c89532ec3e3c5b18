"""Modes: each ball holds exactly one solution, balls hold different solutions, real ones are real."""
from flint import acb, acb_mat, arb

from quantities import Refused, Unreadable, about, count, decimal, fields, items

MOST_RADIUS = arb(1) / 1000


def modes_of(values, size):
    """[(centre, radius, real)]; every mode counts once."""
    modes = []
    for at, value in enumerate(items(values), 1):
        centre, radius, real, multiplicity = fields(value, ("centre", "radius", "real", "multiplicity"))
        if not isinstance(real, bool):
            raise Unreadable(f"mode {at}: found {str(real)[:20]!r} as `real`, expected true or false")
        point = []
        for part in items(centre, size):
            re, im = items(part, 2) if isinstance(part, list) else (part, "0")
            point.append(acb(arb(decimal(re)), arb(decimal(im))))
        radius = arb(decimal(radius))
        if not (radius > 0 and radius < MOST_RADIUS):
            raise Refused(f"mode {at}: the radius is not between 0 and 1/1000")
        if count(multiplicity) != 1:
            raise Refused(f"mode {at}: multiplicity {multiplicity}, where a ball of an isolated simple solution counts 1")
        modes.append((point, radius, real))
    return modes


def prove(at, system, point, radius, real):
    """Theorem 1 of docs/certificate.md."""
    size = len(point)
    box = [about(x, radius) for x in point]
    value, slope = system.values(point), system.jacobian(box)
    try:
        inverse = acb_mat(size, size, [x.mid() for x in system.jacobian(point).entries()]).inv()
    except ZeroDivisionError:
        raise Refused(f"mode {at}: the derivative has no inverse") from None
    inverse = acb_mat(size, size, [x.mid() for x in inverse.entries()])
    step = inverse * acb_mat(size, 1, value)
    rest = acb_mat(size, size, [int(i == j) for i in range(size) for j in range(size)]) - inverse * slope
    for i in range(size):
        bend = sum((rest[i, j].abs_upper() for j in range(size)), arb(0))
        if not (step[i, 0].abs_upper() + bend * radius < radius and bend < 1):
            raise Refused(f"mode {at}: no solution is proved within the radius")
    system.check_solution(at, box)
    if real and not all(x.imag == 0 for x in point):
        raise Refused(f"mode {at}: said to be real, but its centre is not")
    if not real and not any(x.imag.abs_lower() > radius for x in point):
        raise Refused(f"mode {at}: said not to be real, but its ball holds real points")


def prove_all(system, modes):
    for at, (point, radius, real) in enumerate(modes, 1):
        prove(at, system, point, radius, real)
    for j, (one, r, _) in enumerate(modes):
        for i, (other, s, _) in enumerate(modes[:j]):
            if not system.apart(one, other, r + s):
                raise Refused(f"modes {i + 1} and {j + 1}: they may be the same solution")
