"""Arms."""

from __future__ import annotations

import json
import os
from typing import Any

import numpy as np

from . import _core
from ._answers import Batch, Derivation, Document, Polynomial, Solutions, _drawn
from ._arrays import Floats, finite, floats, shaped
from ._certificate import Certificate, read
from ._pose import Pose, checked

CONVENTIONS = {"dh": False, "modified-dh": True}


class Arm:
    """An arm: a geometry without a pose. Make one by :func:`robot`, :func:`from_urdf`, :func:`from_dh` and their like."""

    def __init__(self, core: _core.Arm) -> None:
        self._core = core
        self.names: list[str] = core.names
        """What the file calls the joints, in the order of every ``q``."""
        bounds = core.limits
        self.limits: Floats | None = bounds if len(bounds) else None
        """(n, 2), or None without limits."""

    @property
    def title(self) -> str:
        """One line that names the arm."""
        return self._core.title

    @property
    def poses(self) -> Floats:
        """(n, 4, 4): the poses that the file of the arm asks for."""
        return self._core.poses()

    def _values(self, q: Any) -> tuple[Floats, bool]:
        values = floats(q, "q")
        count = len(self.names)
        if values.ndim not in (1, 2) or values.shape[-1] != count:
            raise ValueError(f"found the shape {values.shape} of q, expected ({count},) or (n, {count})")
        return finite(values, "q").reshape(-1, count), values.ndim == 1

    def fk(self, q: Any) -> Floats:
        """The pose of the tool, (4, 4) or (n, 4, 4)."""
        values, single = self._values(q)
        poses = self._core.fk(values)
        return poses[0] if single else poses

    def jacobian(self, q: Any) -> Floats:
        """(6, n): the velocity of the origin of the tool, then its angular velocity, in the frame of the base."""
        values, single = self._values(q)
        found = self._core.jacobian(values)
        return found[0] if single else found

    def body_poses(self, q: Any) -> Floats:
        """(bodies, 7): quaternion, w first, and position of every body from the ground to the tool."""
        return self._core.body_poses(list(shaped(q, (len(self.names),), "q")))

    def ik(self, pose: Any, *, near: Any = None) -> Solutions:
        """Every joint position that reaches a pose, the nearest to ``near`` first.

        A pose out of reach is an answer: ``s.verdict.status`` is ``unreachable`` then.
        """
        matrix = checked(pose, "pose")
        start = None if near is None else shaped(near, (len(self.names),), "near")
        answer = Solutions(self._core.ik(matrix), self.names, lambda: self._document(matrix))
        return answer if start is None else answer.nearest(start)

    def _document(self, matrix: Floats) -> Document:
        document: Document = json.loads(self._core.document(matrix[None], False))
        return document

    def ik_batch(self, poses: Any) -> Batch:
        """The same for many poses, (n, 4, 4), on all cores and without the interpreter's lock.

        A bad pose is reported by its index in ``errors``, the others are solved. Ctrl-C ends it with what is done.
        """
        if isinstance(poses, (list, tuple)) and any(isinstance(pose, Pose) for pose in poses):
            poses = np.array([checked(pose, f"poses[{index}]") for index, pose in enumerate(poses)])
        values = floats(poses, "poses")
        if values.ndim != 3 or values.shape[1:] != (4, 4):
            raise ValueError(f"found the shape {values.shape} of poses, expected (n, 4, 4)")
        q, offsets, certified, near, within, status, proof, errors, motion = self._core.ik_batch(values)
        bounded = None if self.limits is None else within == 1
        words = np.array(status, dtype=np.str_), np.array(proof, dtype=np.str_)
        return Batch(q, offsets, certified, near, bounded, *words, errors, motion, self.names)

    def derive(self, pose: Any) -> Derivation:
        """The closure equations at a pose, and the polynomial behind the list."""
        return derivation(self._core.derive(checked(pose, "pose")))

    def certificate(self, pose: Any) -> Certificate:
        """The proof of the list at a pose. An answer of which there is none is an UnsupportedError that says why."""
        return read(self._core.certificate(checked(pose, "pose")))

    def view(self, poses: Any, path: str | os.PathLike[str] | None = None) -> str:
        """The page of the solutions of one pose or of several."""
        values = np.array([checked(poses, "pose")]) if np.ndim(_matrix(poses)) == 2 else shaped(poses, (None, 4, 4), "poses")
        return _drawn(json.loads(self._core.document(values, False)), path, False)

    def __repr__(self) -> str:
        return f"Arm({self.title!r}, {len(self.names)} joints: {', '.join(self.names)})"


def _matrix(pose: Any) -> Any:
    return pose.matrix if isinstance(pose, Pose) else pose


def derivation(text: str) -> Derivation:
    """A derivation by its document."""
    document: Document = json.loads(text)
    found = document["polynomial"]
    polynomial = None
    if found is not None:
        roots = [root["value"] for root in document["roots"]]
        polynomial = Polynomial(found["variable"], [int(number) for number in found["coefficients"]], roots)
    return Derivation(document, polynomial, bool(document.get("proved", False)))


def _text(value: Any, what: str) -> str:
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"found {type(value).__name__} as {what}, expected a text or a path")
    return os.fspath(value) if isinstance(value, str) else str(os.fspath(value))


def robot(name: str) -> Arm:
    """An arm of the library; :func:`looproot.names` lists it. An unknown name is a KeyError.

    >>> robot("puma560").names
    ['q1', 'q2', 'q3', 'q4', 'q5', 'q6']
    """
    return Arm(_core.Arm.robot(_text(name, "name")))


def from_file(path: str | os.PathLike[str]) -> Arm:
    """An arm of a mechanism file (TOML, JSON), or of a DH table as CSV."""
    return Arm(_core.Arm.load(_text(path, "path"), None, None))


def from_urdf(path: str | os.PathLike[str], *, tip_link: str | None = None, base_link: str | None = None) -> Arm:
    """The chain between two links of a robot description; without names the only one there is."""
    return Arm(_core.Arm.load(_text(path, "path"), tip_link, base_link))


def from_dh(table: Any, *, convention: str, joints: str = "RRRRRR", limits: Any = None) -> Arm:
    """An arm by rows ``(a, alpha, d[, theta0])``.

    ``convention`` is ``"dh"`` or ``"modified-dh"``: there is no default, and nothing is guessed.

    >>> import math
    >>> quarter = math.pi / 2
    >>> rows = [[0, quarter, 0.4], [0.25, 0, 0], [0.02, quarter, 0], [0, -1, 0.22], [0, 1, 0.08], [0, 0, 0.09]]
    >>> arm = from_dh(rows, convention="dh")
    >>> arm.ik(arm.fk([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])).complete
    True
    """
    if convention not in CONVENTIONS:
        raise ValueError(f"found the convention {convention!r}, expected 'dh' or 'modified-dh'")
    rows = floats(table, "table")
    if rows.ndim != 2 or rows.shape[1] not in (3, 4):
        raise ValueError(f"found the shape {rows.shape} of table, expected (n, 3) or (n, 4)")
    if rows.shape[1] == 3:
        rows = np.column_stack([rows, np.zeros(len(rows))])
    rows = np.ascontiguousarray(finite(rows, "table"))
    return Arm(_core.Arm.from_dh(rows, _letters(joints, len(rows)), CONVENTIONS[convention], _bounds(limits, len(rows))))


def from_screws(axes: Any, points: Any, home: Any, *, joints: str = "RRRRRR", limits: Any = None) -> Arm:
    """An arm by the axes of its joints, points on them, and the pose of its flange, all joint values zero."""
    directions = shaped(axes, (None, 3), "axes")
    places = shaped(points, (len(directions), 3), "points")
    letters = _letters(joints, len(directions))
    return Arm(_core.Arm.from_screws(directions, places, checked(home, "home"), letters, _bounds(limits, len(directions))))


def _letters(joints: Any, count: int) -> str:
    letters = _text(joints, "joints").upper()
    if len(letters) != count:
        raise ValueError(f"found {len(letters)} letters in joints, expected {count}")
    return letters


def _bounds(limits: Any, count: int) -> Floats | None:
    return None if limits is None else shaped(limits, (count, 2), "limits")
