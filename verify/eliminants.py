"""Theorem 4 of docs/certificate.md: an upper bound on the number of solutions of a loop by an eliminant in one unknown."""
from flint import acb, fmpq, fmpq_mat, fmpq_mpoly_ctx, fmpq_poly

from chains import IDENTITY, chain, inverse, times
from quantities import Refused, count, decimal, fields

SYMBOLS = fmpq_mpoly_ctx.get(["c0", "s0", "c1", "s1", "c2", "s2"], "lex")
ONE = (0,) * 6
HALVES = {(0, 0): (1, 0, 1), (1, 0): (1, 0, -1), (0, 1): (0, 2, 0)}  # 1, cos, sin times 1 + t^2
POWERS = {(0, 0): (1, 0, 0), (1, 0): (0, 1, 0), (2, 0): (0, 0, 1)}  # of a distance
COLUMNS = [(i, j) for i in range(4) for j in range(3)]
LONGEST = 512  # bits of a number of a link


def eliminant(system, item):
    """The number of solutions that the eliminant allows."""
    if system.letters == "platform" or "S" in system.letters or any(link.exact is None for link in system.links):
        raise Refused("proof: eliminant: only loops of rotations and translations with rational constants have one")
    return bound([link.exact for link in system.links], system.turns, fields(item, ("kind", "value", "aid"))[2])


def bound(links, turns, aid):
    first, hidden, shift = (read(x) for read, x in zip((count, count, decimal), fields(aid, ("first", "hidden", "shift"))))
    if not (first < 6 and hidden < 3):
        raise Refused("proof: eliminant: no such unknown")
    if any(max(fmpq(x).height_bits(), shift.height_bits()) > LONGEST for link in links for row in link for x in row):
        raise Refused("proof: eliminant: the numbers are too long")
    links, turns = [*links[first:], *links[:first]], [*turns[first:], *turns[:first]]
    if not turns[3]:
        raise Refused("proof: eliminant: the fourth unknown is no rotation")
    if turns[hidden]:  # its angle is counted from another place, so that it is pi at no solution
        c, s = (1 - shift**2) / (1 + shift**2), 2 * shift / (1 + shift**2)
        links[hidden] = times([[c, -s, 0, 0], [s, c, 0, 0], *IDENTITY[2:]], links[hidden])
    rows = matrix(equations(links, turns), turns, hidden)
    return sum(solutions_at(rows, root) for root in roots(rows, turns[hidden]))


def moved(k, is_turn, back=1):
    c, s = SYMBOLS.gens()[2 * k], back * SYMBOLS.gens()[2 * k + 1]
    return [[c, -s, 0, 0], [s, c, 0, 0], *IDENTITY[2:]] if is_turn else [*IDENTITY[:2], [0, 0, 1, back * c], IDENTITY[3]]


def fourteen(m, turns):
    """What the image (p, l) of the z axis and its origin gives, in normal form: p, l, p.p, p.l, p x l, (p.p) l - 2 (p.l) p."""
    p, l = ([SYMBOLS.constant(0) + row[k] for row in m[:3]] for k in (3, 2))
    dot = lambda u, v: u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
    square, along = dot(p, p), dot(p, l)
    across = [p[1] * l[2] - p[2] * l[1], p[2] * l[0] - p[0] * l[2], p[0] * l[1] - p[1] * l[0]]
    return [normal(x, turns) for x in (*p, *l, square, along, *across, *(square * y - 2 * along * x for x, y in zip(p, l)))]


def normal(x, turns):
    """The coefficients after cos^2 = 1 - sin^2."""
    for k, is_turn in enumerate(turns):
        c, s = SYMBOLS.gens()[2 * k:2 * k + 2]
        while is_turn and (high := {e: v for e, v in x.to_dict().items() if e[2 * k] > 1}):
            part = SYMBOLS.from_dict(high)
            x += divmod(part, c * c)[0] * (1 - s * s - c * c)
    return x.to_dict()


def equations(links, turns):
    """The combinations of the fourteen equations that are free of the last two unknowns."""
    front = chain([part for k in range(3) for part in (moved(k, turns[k]), links[k])])
    back = chain([inverse(links[5]), moved(1, turns[5], -1), inverse(links[4]), moved(0, turns[4], -1), inverse(links[3])])
    left, right = fourteen(front, turns[:3]), fourteen(back, turns[4:])
    terms = sorted({e for row in right for e in row} - {ONE})
    own = [(1, 0, 0, 0, 0, 0), (0, 0, 1, 0, 0, 0)] + [(0, 1, 0, 0, 0, 0)] * turns[4] + [(0, 0, 0, 1, 0, 0)] * turns[5]
    table = fmpq_mat([[row.get(e, fmpq(0)) for e in terms] + [fmpq(int(i == j)) for j in range(14)] for i, row in enumerate(right)])
    reduced = table.rref()[0]
    lead = [next((k for k in range(table.ncols()) if reduced[i, k] != 0), None) for i in range(14)]
    if not set(own) <= set(terms) or lead[:len(terms)] != list(range(len(terms))):
        raise Refused("proof: eliminant: the other unknowns do not follow from three of them")
    found = []
    for i in range(len(terms), 14):
        total = {}
        for weight, one, other in zip([reduced[i, len(terms) + k] for k in range(14)], left, right):
            for e, v in one.items():
                total[e] = total.get(e, 0) + weight * v
            total[ONE] = total.get(ONE, 0) - weight * other.get(ONE, 0)
        found.append(total)
    return found


def matrix(found, turns, hidden):
    """The equations times 1 + t^2 of every rotation, once and times the first other unknown u: rows of polynomials in the
    hidden one for the columns u^i v^j."""
    others, rows = [k for k in range(3) if k != hidden], []
    for total in found:
        row = {column: [fmpq(0)] * 3 for column in COLUMNS}
        for e, value in total.items():
            parts = [(HALVES if is_turn else POWERS).get(e[2 * k:2 * k + 2]) for k, is_turn in enumerate(turns[:3])]
            if value != 0 and None in parts:
                raise Refused("proof: eliminant: an equation is of another form")
            for i in range(3):
                for j in range(3):
                    scale = value * parts[others[0]][i] * parts[others[1]][j] if value != 0 else 0
                    if scale != 0:
                        row[i, j] = [x + scale * y for x, y in zip(row[i, j], parts[hidden])]
        rows.append([row[column] for column in COLUMNS])
        rows.append([[fmpq(0)] * 3] * 3 + rows[-1][:9])
    return rows


def at(rows, t):
    return [[a + b * t + c * t * t for a, b, c in row] for row in rows]


def roots(rows, is_turn):
    """The roots of a minor that is not 0, other than i and -i where the unknown is an angle."""
    reduced, rank = fmpq_mat(at(rows, fmpq(17, 5))).transpose().rref() if rows else (None, 0)
    if rank < 12:
        raise Refused("proof: eliminant: it is 0")
    chosen = [rows[next(k for k in range(len(rows)) if reduced[i, k] != 0)] for i in range(12)]
    points = [fmpq(k) for k in range(-12, 13)]
    values = fmpq_mat(25, 1, [fmpq_mat(at(chosen, t)).det() for t in points])
    solved = fmpq_mat([[t**k for k in range(25)] for t in points]).solve(values)
    minor, circle = fmpq_poly([solved[k, 0] for k in range(25)]).numer(), fmpq_poly([1, 0, 1]).numer()
    if is_turn and minor.degree() < 24:
        raise Refused("proof: eliminant: an angle of pi is a root")
    while is_turn and minor.degree() > 1 and divmod(minor, circle)[1] == 0:
        minor = divmod(minor, circle)[0]
    return [root for root, _ in minor.complex_roots()] if minor.degree() > 0 else []


def solutions_at(rows, root):
    """The number of solutions that a root allows: the corank, and none where the one vector of the kernel is no u^i v^j."""
    left, entries, steps, columns = list(range(len(rows))), at(rows, root), [], list(range(12))
    while columns:
        size, i, j = max((entries[i][j].abs_lower(), i, j) for i in left for j in columns) if left else (0, 0, 0)
        if not size > 0:
            break
        left.remove(i), columns.remove(j), steps.append((i, j))
        for k in left:
            factor = entries[k][j] / entries[i][j]
            for column in columns:
                entries[k][column] -= factor * entries[i][column]
    if len(columns) > 2:
        raise Refused("proof: eliminant: too many solutions may have one value")
    if len(columns) != 1:
        return len(columns)
    vector = {columns[0]: acb(1)}
    for i, j in reversed(steps):
        vector[j] = -sum((entries[i][k] * x for k, x in vector.items()), acb(0)) / entries[i][j]
    minors = [vector[3 * i + j] * vector[3 * k + l] - vector[3 * i + l] * vector[3 * k + j]
              for i in range(4) for k in range(i) for j in range(3) for l in range(j)]
    curves = [vector[3 * i + j] * vector[3 * k + l] - vector[3 * (i + 1) + j] * vector[3 * (k - 1) + l]
              for i in range(3) for k in range(1, 4) for j in range(3) for l in range(3)]
    curves += [vector[3 * i] * vector[3 * k + 2] - vector[3 * i + 1] * vector[3 * k + 1] for i in range(4) for k in range(4)]
    return int(all(x.contains(0) for x in minors + curves))
