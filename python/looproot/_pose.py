"""Poses of a body."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._arrays import Floats, shaped


@dataclass(frozen=True, init=False, eq=False)
class Pose:
    """A position and an orientation.

    Quaternions are never positional: give ``quat_wxyz=`` or ``quat_xyzw=`` (ROS and scipy write x, y, z, w).

    >>> Pose([0.1, 0.2, 0.3], quat_wxyz=[1, 0, 0, 0]).matrix[:3, 3]
    array([0.1, 0.2, 0.3])
    """

    matrix: Floats = field(repr=True)

    def __init__(self, xyz: Any, *, quat_wxyz: Any = None, quat_xyzw: Any = None) -> None:
        position = shaped(xyz, (3,), "xyz")
        if (quat_wxyz is None) == (quat_xyzw is None):
            found = "none" if quat_wxyz is None else "both"
            raise TypeError(f"found {found} of quat_wxyz and quat_xyzw, expected one of them")
        if quat_wxyz is not None:
            w, x, y, z = shaped(quat_wxyz, (4,), "quat_wxyz")
        else:
            x, y, z, w = shaped(quat_xyzw, (4,), "quat_xyzw")
        norm = float(np.sqrt(w * w + x * x + y * y + z * z))
        if abs(norm - 1.0) > 1e-3:
            raise ValueError(f"found a quaternion of norm {norm:.6f}, expected 1")
        w, x, y, z = (part / norm for part in (w, x, y, z))
        matrix = np.eye(4)
        matrix[:3, :3] = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
        matrix[:3, 3] = position
        object.__setattr__(self, "matrix", matrix)


def rotated(quaternion: Any, position: Any) -> Floats:
    """The matrix of a unit quaternion, w first, and a position."""
    return Pose(position, quat_wxyz=quaternion).matrix


def checked(value: Any, what: str) -> Floats:
    """A matrix of a pose; what is no rotation is said by the solver."""
    if isinstance(value, Pose):
        return value.matrix
    return shaped(value, (4, 4), what)
