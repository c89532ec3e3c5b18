"""The six legs of a platform: |p + R b - a|^2 = l^2 and |x|^2 = 1 for the quaternion x of R, in seven unknowns x, p."""
from flint import acb, acb_mat

from quantities import fields, items, number


class Platform:
    letters, size = "platform", 7

    def __init__(self, data):
        _, base, plate, squares = fields(fields(data, ("mechanism",))[0], ("kind", "base", "plate", "legs_squared"))
        points = lambda rows: [[number(x)[0] for x in items(row, 3)] for row in items(rows, 6)]
        self.base, self.plate = points(base), points(plate)
        self.squares = [number(x)[0] for x in items(squares, 6)]
        exact = [[tuple(number(x)[1] for x in row) for row in rows] for rows in (base, plate)]
        self.exact = exact if all(x is not None for rows in exact for row in rows for x in row) else None

    def values(self, x):
        return self.equations(x)[0]

    def jacobian(self, x):
        return acb_mat(7, 7, [entry for row in self.equations(x)[1] for entry in row])

    def equations(self, x):
        """With |x| = 1: p.p + b.b + a.a + 2 (p - a).R b - 2 a.p - l^2, and its derivatives."""
        (w, i, j, k), p = x[:4], x[4:]
        rows = [[w * w + i * i - j * j - k * k, 2 * (i * j - w * k), 2 * (i * k + w * j)],
                [2 * (i * j + w * k), w * w - i * i + j * j - k * k, 2 * (j * k - w * i)],
                [2 * (i * k - w * j), 2 * (j * k + w * i), w * w - i * i - j * j + k * k]]
        slopes = [[[w, -k, j], [k, w, -i], [-j, i, w]], [[i, j, k], [j, -i, -w], [k, w, -i]],
                  [[-j, i, w], [i, j, k], [-w, k, -j]], [[-k, -w, i], [w, -k, j], [i, j, k]]]
        dot = lambda u, v: u[0] * v[0] + u[1] * v[1] + u[2] * v[2]
        turned = lambda m, v: [dot(row, v) for row in m]
        values = [w * w + i * i + j * j + k * k - 1]
        jacobian = [[2 * w, 2 * i, 2 * j, 2 * k, acb(0), acb(0), acb(0)]]
        for a, b, square in zip(self.base, self.plate, self.squares):
            moved, gap = turned(rows, b), [u - v for u, v in zip(p, a)]
            values.append(dot(p, p) + dot(b, b) + dot(a, a) + 2 * dot(gap, moved) - 2 * dot(a, p) - square)
            jacobian.append([4 * dot(gap, turned(slope, b)) for slope in slopes] + [2 * (u + v) for u, v in zip(gap, moved)])
        return values, jacobian

    def check_solution(self, at, box):
        """Every solution of the seven equations is a pose."""

    def apart(self, one, other, radius):
        """A quaternion and its negative are one pose."""
        far = lambda sign: any((one[k] - (sign * other[k] if k < 4 else other[k])).abs_lower() > radius for k in range(7))
        return far(1) and far(-1)
