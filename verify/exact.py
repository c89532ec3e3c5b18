"""Numbers of mechanism files (equations/README.md), exact where they are rational, or angles with a rational half-angle tangent."""
from math import gcd, lcm

from flint import arb, fmpq

from quantities import expect

MOST_TIMES = 256  # larger multiples of an angle count as irrational: their coordinates are long
EIGHTHS = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]  # directions of the multiples of an eighth of a turn


class Value:
    """A real number in a ball, and what is known of it exactly: the number itself, its ratio to pi, its direction as an angle."""

    def __init__(self, ball, rational=None, of_pi=None, direction=None):
        self.ball, self.rational, self.of_pi, self.direction = arb(ball), rational, of_pi, direction

    def plus(self, other):
        if known(self.rational, other.rational):
            return rational(self.rational + other.rational)
        if known(self.of_pi, other.of_pi):
            return part_of_pi(self.of_pi + other.of_pi)
        return Value(self.ball + other.ball, direction=turned(self.direction, other.direction))

    def times(self, other):
        if known(self.rational, other.rational):
            return rational(self.rational * other.rational)
        if self.rational is not None:
            return other.times(self)
        if other.rational is None:
            return Value(self.ball * other.ball)
        if self.of_pi is not None:
            return part_of_pi(self.of_pi * other.rational)
        return Value(self.ball * arb(other.rational), direction=self.multiple(other.rational))

    def multiple(self, factor):
        """The direction of a whole multiple, or of half of one if that is between half a turn and minus half a turn."""
        count, own = int(factor.p), self.direction
        if own is None or abs(count) > MOST_TIMES or factor.q > 2:
            return None
        one, whole = (own if count > 0 else (own[0], -own[1])), (1, 0)
        for _ in range(abs(count)):
            whole = turned(whole, one)
        size = length(whole) if abs(self.ball * count) < arb.pi() else None
        return whole if factor.q == 1 else primitive(size + whole[0], whole[1]) if size else None

    def over(self, other):
        expect(other.ball != 0 and not other.ball.contains(0), "a division by zero", "a number")
        if other.rational is not None:
            return self.times(rational(1 / other.rational))
        return rational(self.of_pi / other.of_pi) if known(self.of_pi, other.of_pi) else Value(self.ball / other.ball)

    def sqrt(self):
        own = root(self.rational) if known(self.rational) else None
        return rational(own) if known(own) else Value(self.ball.sqrt())

    def cos(self):
        if size := length(self.direction):
            return rational(self.direction[0] / size)
        # Beside right angles only multiples of a third of pi have a rational cosine [Niven].
        thirds = fmpq(1, 2) if self.of_pi is None else self.of_pi * 3
        return rational((fmpq(1), fmpq(1, 2), fmpq(-1, 2))[min(int(thirds) % 6, -int(thirds) % 6)]) if thirds.q == 1 else Value(self.ball.cos())

    def sin(self):
        return part_of_pi(fmpq(1, 2)).plus(self.times(rational(fmpq(-1)))).cos()

    def tan(self):
        return rational(fmpq(self.direction[1], self.direction[0])) if self.direction and self.direction[0] else self.sin().over(self.cos())

    def acos(self):
        if self.rational is None:
            return Value(self.ball.acos())
        if abs(self.rational) <= 1 and (2 * self.rational).q == 1:
            return part_of_pi(fmpq((0, 2, 3, 4, 6)[int(2 - 2 * self.rational)], 6))
        sine = root(1 - self.rational**2)
        return Value(self.ball.acos(), direction=None if sine is None else primitive(self.rational, sine))

    def asin(self):
        return part_of_pi(fmpq(1, 2)).plus(self.acos().times(rational(fmpq(-1))))

    def atan(self):
        return self.atan2(rational(fmpq(1)))

    def atan2(self, x):
        if not known(self.rational, x.rational):
            return Value(arb.atan2(self.ball, x.ball))
        own = primitive(x.rational, self.rational)
        return part_of_pi(fmpq((EIGHTHS.index(own) + 3) % 8 - 3, 4)) if own in EIGHTHS else Value(arb.atan2(self.ball, x.ball), direction=own)

    def half_tangent(self):
        """The tangent of half the angle, if it is rational; `inf` of half a turn."""
        if size := length(self.direction):
            return "inf" if size + self.direction[0] == 0 else self.direction[1] / (size + self.direction[0])


def known(*parts):
    return all(part is not None for part in parts)


def rational(x):
    return part_of_pi(fmpq(0)) if x == 0 else Value(x, rational=fmpq(x))


def part_of_pi(x):
    eighths = 4 * x
    return Value(arb.pi() * x, fmpq(0) if x == 0 else None, x, EIGHTHS[int(eighths) % 8] if eighths.q == 1 else None)


def primitive(x, y):
    """The whole numbers without a common factor in the same direction."""
    x, y = map(fmpq, (x, y))
    x, y = (int(c * lcm(int(x.q), int(y.q))) for c in (x, y))
    expect(x or y, "the direction 0, 0", "an angle")
    return x // gcd(x, y), y // gcd(x, y)


def turned(one, other):
    if known(one, other):
        return primitive(one[0] * other[0] - one[1] * other[1], one[0] * other[1] + one[1] * other[0])


def length(direction):
    """The length of a direction, if it is rational."""
    return root(direction[0] ** 2 + direction[1] ** 2) if direction else None


def root(square):
    """The square root, if it is rational."""
    square = fmpq(square)
    return fmpq(square.p.isqrt(), square.q.isqrt()) if square >= 0 and square.p.is_square() and square.q.is_square() else None
