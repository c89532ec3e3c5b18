"""Theorem 14 of docs/certificate.md: the branches and limit positions of a four-bar while its input makes a full turn."""
from math import gcd, lcm

from flint import arb, fmpq, fmpq_poly

import linkages
from closures import MOST_RADIUS
from motions import dot
from quantities import Refused, decimal, fields, is_exact, items, number, require

TRIGONOMETRIC = [fmpq_poly([1, 0, 1]), fmpq_poly([1, 0, -1]), fmpq_poly([0, 2])]  # 1, cos, sin times 1 + x^2
INSIDE = ("radius_squared", "offset_squared")  # squares that stand with the output
KINDS = [["coupler_squared", "radius_squared"], ["coupler_squared"], ["offset_squared"]]  # B circles, B slides, a plane turns


def written(crank, axis, place, **squares):
    """The data in the one form of certificates. The axis is given by whole numbers without a common factor, the first one positive that is
    not 0; a centre counts as it is, of a line the point nearest to the origin. Mirrored at the plane z = 0 all of it is as good."""
    require(any(x != 0 for x in axis), "data: an axis is 0")
    whole = [int(x * lcm(*(int(y.q) for y in axis))) for x in axis]
    axis = [fmpq(x // gcd(*whole)) for x in whole]
    name = "centre" if "radius_squared" in squares else "point"
    if name == "point":
        place = [x - u * dot(axis, place) / dot(axis, axis) for x, u in zip(place, axis)]
    first = next(x for x in axis if x != 0)
    if place[2] < 0 or place[2] == 0 and axis[2] * first < 0:
        axis, place = ([x, y, -z] for x, y, z in (axis, place))
    axis = [-x for x in axis] if next(x for x in axis if x != 0) < 0 else axis
    texts = lambda vector: [*map(str, vector)]
    texts_of = lambda keys: {key: str(x) for key, x in squares.items() if key in keys}
    output = {"axis": texts(axis), name: texts(place), **texts_of(("radius_squared", "offset_squared"))}
    return {"crank": texts(crank), **texts_of(("coupler_squared",)), "output": output}


class FourBar:
    """A turns about the z axis, at (*crank, 0) where the input is 0. B, at a constant distance from A, circles or slides along an axis; or A lies
    in a plane that turns at a constant distance from the axis."""
    size, equations, spherical = 0, 1, []

    def __init__(self, data):
        crank, output, coupler = fields(data, ("crank", "output"), ("coupler_squared",))
        axis, centre, point, *others = fields(output, ("axis",), ("centre", "point", *INSIDE))
        texts = {"coupler_squared": coupler, **dict(zip(INSIDE, others))}
        squares = {key: number(text) for key, text in texts.items() if text is not None}
        self.kinds = list(squares)
        require(self.kinds in KINDS, "data: a four-bar has an output that circles, slides or carries a plane")
        place = centre if "radius_squared" in squares else point
        crank, axis, place = ([number(x) for x in items(vector, n)] for vector, n in ((crank, 2), (axis, 3), (place, 3)))
        self.constants = [*crank, *axis, *place, *squares.values()]
        require(is_exact(self.constants) and all(x >= 0 for x in squares.values()), "data: a number is not rational, or a square is negative")
        require(written(crank, axis, place, **squares) == data, "data: the four-bar is not written in the one form of certificates")
        self.discriminant = discriminant([*crank, fmpq(0)], axis, place, **squares)

    def __getattr__(self, name):
        raise Refused("proof: four-bars whose input runs are covered by theorem 14 alone")


def system_of(data):
    """The closure equations of the mechanism."""
    return FourBar(data) if "crank" in data else linkages.system_of(data)


def discriminant(a, n, c, coupler_squared=0, radius_squared=None, offset_squared=None):
    """The polynomial D in the half-angle tangent of the input."""
    trigonometric = lambda *parts: sum((part * own for part, own in zip(parts, TRIGONOMETRIC)), fmpq_poly())
    # For V = A - c the square |V|^2 and the product V.n.
    side = trigonometric(dot(a, a) + dot(c, c), -2 * dot(a, c), 2 * (a[1] * c[0] - a[0] * c[1]))
    along = trigonometric(-dot(n, c), dot(a, n), a[0] * n[1] - a[1] * n[0])
    one = TRIGONOMETRIC[0]
    across = side * one - along * along / dot(n, n)
    if radius_squared is not None:
        return 4 * radius_squared * across - (side + (radius_squared - coupler_squared) * one) ** 2
    return across - offset_squared * one * one if offset_squared is not None else coupler_squared * one * one - across


def real_roots(polynomial):
    """The number of distinct real roots, by Sturm's theorem."""
    chain = [polynomial, polynomial.derivative()]
    while chain[-1] != 0:
        chain.append(-(chain[-2] % chain[-1]))
    # The signs of the chain far out to one side.
    ends = lambda side: [p[p.degree()] * side ** p.degree() for p in chain[:-1]]
    changes = lambda signs: sum(a * b < 0 for a, b in zip(signs, signs[1:]))
    return changes(ends(-1)) - changes(ends(1))


def swept(system, data, claim, modes, item, *others):
    """The branches over a full turn of the input."""
    is_one = isinstance(system, FourBar) and item["kind"] == "discriminant" and not others
    require(is_one, "proof: the branches of a four-bar are shown by one discriminant")
    _, polynomial = fields(item, ("kind", "polynomial"))
    items(modes, 0)
    own = system.discriminant
    require(own.degree() == 4, "proof: discriminant: it has a root at half a turn of the input, or is 0")
    # Without limit positions nothing else would tell these data from others.
    require(items(polynomial) == [*map(str, own.coeffs())], "proof: discriminant: that of the data is another one")
    roots = real_roots(own)
    require(real_roots(own.gcd(own.derivative())) == 0, "proof: discriminant: a real root is a multiple one")
    limits = items(claim["limits"])
    require(len(limits) == roots, f"claim: {len(limits)} limit positions, where the discriminant has {roots} real roots")
    end = -arb.pi()
    for at, limit in enumerate(limits, 1):
        centre, radius = map(decimal, fields(limit, ("centre", "radius")))
        require(0 < radius <= MOST_RADIUS, f"limit {at}: the radius is not above 0 and at most 1/1000")
        low, high = arb(centre - radius), arb(centre + radius)
        require(low > end and high < arb.pi(), f"limit {at}: the limits are not apart, in ascending order, between -pi and pi")
        require(value(own, low) * value(own, high) < 0, f"limit {at}: no root of the discriminant is proved within the radius")
        end = high
    # Without limit positions two branches close in themselves, or there are none.
    circuits = roots // 2 or (2 if own[4] > 0 else 0)
    branches = roots or circuits
    return {"status": "complete" if branches else "unreachable", "branches": branches, "circuits": circuits, "limits": limits}


def value(polynomial, angle):
    """The discriminant at an angle, times a positive number: a form in cosine and sine of its half."""
    cos, sin = (angle / 2).cos(), (angle / 2).sin()
    return sum((polynomial[k] * cos ** (4 - k) * sin**k for k in range(5)), arb(0))
