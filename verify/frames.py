"""Frames of the data: matrices that round a rotation, and axes of any direction."""
from math import gcd

from flint import arb, arb_mat, fmpq

from motions import IDENTITY, column, dot, of_quaternion
from quantities import Refused, Unreadable, is_exact


def placement(m):
    """A constant motion: an orthonormal matrix of exact numbers as it is, else the rotation nearest to it, as data round it."""
    if m[3] != IDENTITY[3]:
        raise Unreadable("found another last row of a matrix than 0 0 0 1")
    rotation, columns = [row[:3] for row in m[:3]], [column(m, j) for j in range(3)]
    off = [dot(columns[i], columns[j]) - int(i == j) for i in range(3) for j in range(3)]
    if not all(abs(arb(x)) < 0.01 for x in off) or not arb_mat(rotation).det() > 0:
        raise Refused("data: a matrix is no rotation")
    if not all(map(is_exact, rotation)) or any(x != 0 for x in off):
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
        power = (power * power / (power * power).trace()).mid()
    row = max(power.tolist(), key=lambda row: max(float(abs(x)) for x in row))
    norm = sum(x * x for x in row).sqrt()
    q = [fmpq((x / norm * 2**60 + 0.5).mid().floor().unique_fmpz()) for x in row]
    return [[x / sum(y * y for y in q) for x in line] for line in of_quaternion(*q)]


def frame_on(u, p, is_certificate):
    """A frame whose z axis goes through p in the direction u: moved by the half-turn about the line between both directions.

    In a certificate every number counts: a direction is of whole numbers without a common factor, and a point of the
    axis is the one nearest to the origin.
    """
    square, along_axis = dot(u, u), dot(u, p) / dot(u, u)
    is_plain = is_exact(u + p) and along_axis == 0 and all(x.q == 1 for x in u) and gcd(*(int(x.p) for x in u)) == 1
    if is_certificate and not is_plain:
        raise Refused("data: an axis is not written in the one form of certificates")
    is_square = is_exact([square]) and square.p.is_square() and square.q.is_square()
    length = fmpq(square.p.isqrt(), square.q.isqrt()) if is_square else arb(square).sqrt()
    half = [u[0], u[1], u[2] + length] if u[0] != 0 or u[1] != 0 or u[2] > 0 else [fmpq(1), fmpq(0), fmpq(0)]
    rows = of_quaternion(fmpq(0), *half)
    return [[*(y / dot(half, half) for y in row), x - along_axis * z] for row, x, z in zip(rows, p, u)] + [IDENTITY[3]]
