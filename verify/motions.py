"""Rigid motions: rows of 4 x 4 matrices over exact numbers, balls or power series alike."""
from flint import arb, arb_mat, fmpq

from quantities import Refused, Unreadable, is_exact

IDENTITY = [[fmpq(int(i == j)) for j in range(4)] for i in range(4)]
QUARTER = [[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]]  # takes z to x


def dot(u, v):
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]


def cross(u, v):
    return [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]


def column(m, j):
    return [m[0][j], m[1][j], m[2][j]]


def turned(m, v):
    return [dot(row, v) for row in m[:3]]


def times(a, b):
    columns, last = [column(b, j) for j in range(4)], (0, 0, 0, 1)
    return [[dot(row, c) + row[3] * e for c, e in zip(columns, last)] for row in a[:3]] + [IDENTITY[3]]


def chain(motions):
    product = IDENTITY
    for motion in motions:
        product = times(product, motion)
    return product


def inverse(m):
    rows = [column(m, i) for i in range(3)]
    return [[*row, -dot(row, column(m, 3))] for row in rows] + [IDENTITY[3]]


def about_z(cos, sin):
    return [[cos, -sin, 0, 0], [sin, cos, 0, 0], *IDENTITY[2:]]


def about_x(cos, sin):
    return [IDENTITY[0], [0, cos, -sin, 0], [0, sin, cos, 0], IDENTITY[3]]


def along(x, y, z):
    return [[*IDENTITY[i][:3], part] for i, part in enumerate((x, y, z))] + [IDENTITY[3]]


def of_quaternion(w, x, y, z, norm=None):
    """The rotation matrix of a quaternion, of which the square of the norm may be known."""
    n = w * w + x * x + y * y + z * z if norm is None else norm
    return [[1 - 2 * (y * y + z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
            [2 * (x * y + w * z) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - w * x) / n],
            [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, 1 - 2 * (x * x + y * y) / n]]


def placement(m):
    """A constant motion: an orthonormal matrix of exact numbers as it is, else the rotation nearest to it, as data round it."""
    if m[3] != IDENTITY[3]:
        raise Unreadable("found another last row of a matrix than 0 0 0 1")
    rotation, columns = [row[:3] for row in m[:3]], [column(m, j) for j in range(3)]
    off = [dot(columns[i], columns[j]) - int(i == j) for i in range(3) for j in range(3)]
    if not all(abs(arb(x)) < 0.01 for x in off) or not arb_mat(rotation).det() > 0:
        raise Refused("data: a matrix is no rotation")
    if not all(is_exact(row) for row in rotation) or any(x != 0 for x in off):
        rotation = nearest_rotation(rotation)
    return [[*row, m[i][3]] for i, row in enumerate(rotation)] + [IDENTITY[3]]


def nearest_rotation(m):
    """Its quaternion q is the eigenvector to the largest eigenvalue of the symmetric matrix that is 4 q q' for rotations [Horn1987].
    It is rounded to four integers over 2^60."""
    low, high = (lambda i, j: m[i][j] - m[j][i]), (lambda i, j: m[i][j] + m[j][i])
    a, b, c = m[0][0], m[1][1], m[2][2]
    power = arb_mat([[1 + a + b + c, low(2, 1), low(0, 2), low(1, 0)],
                     [low(2, 1), 1 + a - b - c, high(0, 1), high(0, 2)],
                     [low(0, 2), high(0, 1), 1 - a + b - c, high(1, 2)],
                     [low(1, 0), high(0, 2), high(1, 2), 1 - a - b + c]])
    for _ in range(9):  # the other eigenvalues are less than 1/10 of it: their powers are nothing in the end
        power = power * power
        power = arb_mat(4, 4, [(x / power.trace()).mid() for x in power.entries()])
    rows = power.tolist()
    row = max(range(4), key=lambda k: float(rows[k][k]))
    norm = sum(x * x for x in rows[row]).sqrt()
    return of_quaternion(*(fmpq((x / norm * 2**60 + 0.5).mid().floor().unique_fmpz()) for x in rows[row]))

