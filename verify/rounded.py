"""The rotation that stands for a rounded one of a mechanism file (equations/README.md)."""
from flint import arb, arb_mat, fmpq

from motions import column, dot, of_quaternion
from quantities import require


def rotation_near(m):
    """An orthonormal matrix of rational numbers itself, or the rotation nearest to it."""
    off = [dot(column(m, i), column(m, j)) - int(i == j) for i in range(3) for j in range(3)]
    is_near = all(abs(x) < fmpq(1, 100) for x in off) and arb_mat([row[:3] for row in m]).det() > 0
    require(is_near, "file: a matrix is no rotation")
    return nearest_rotation(m) if any(x != 0 for x in off) else [row[:3] for row in m]


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
        power = (power * power / (power * power).trace()).mid()
    row = max(power.tolist(), key=lambda row: max(float(abs(x)) for x in row))
    norm = sum(x * x for x in row).sqrt()
    return rotation_of([fmpq((x / norm * 2**60 + 0.5).mid().floor().unique_fmpz()) for x in row])


def rotation_of(quaternion):
    """The rotation of a quaternion of any norm."""
    return [[x / sum(y * y for y in quaternion) for x in row] for row in of_quaternion(*quaternion)]
