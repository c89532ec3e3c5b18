"""Rigid motions: rows of 4 x 4 matrices over exact numbers, balls, algebraic numbers or power series alike."""
from flint import fmpq

IDENTITY = [[fmpq(int(i == j)) for j in range(4)] for i in range(4)]


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def difference(u, v):
    return [x - y for x, y in zip(u, v)]


def column(m, j):
    return [m[0][j], m[1][j], m[2][j]]


def times(product, *motions):
    for motion in motions:
        columns = [column(motion, j) for j in range(4)]
        product = [[*(dot(row, c) for c in columns[:3]), dot(row, columns[3]) + row[3]] for row in product[:3]] + [IDENTITY[3]]
    return product


def inverse(m):
    rows = [column(m, i) for i in range(3)]
    return [[*row, -dot(row, column(m, 3))] for row in rows] + [IDENTITY[3]]


def turn(axis, cos, sin):
    """A rotation about the axis x, y or z: 0, 1 or 2."""
    i, j = (axis + 1) % 3, (axis + 2) % 3
    rows = [list(row) for row in IDENTITY]
    rows[i][i], rows[i][j], rows[j][i], rows[j][j] = cos, -sin, sin, cos
    return rows


def along(x, y, z):
    return [[*IDENTITY[i][:3], part] for i, part in enumerate((x, y, z))] + [IDENTITY[3]]


def of_quaternion(w, x, y, z):
    """The matrix of the rotation times the square of the norm."""
    return [[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]]
