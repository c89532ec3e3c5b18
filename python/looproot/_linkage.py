"""Linkages of any graph of bodies and joints, in the plane, on the sphere and in space."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np

from . import _core
from ._answers import Document, Solutions, Sweep, of_document
from ._arm import _text
from ._certificate import Certificate, read
from ._closed import _number


class Linkage:
    """A linkage of a file or of the library.

    >>> linkage = Linkage("linkage/jansen")
    >>> linkage.solve(input={"O": 0.5}).verdict.real
    8
    """

    def __init__(self, name: str | os.PathLike[str]) -> None:
        self._core = _core.Linkage(_text(name, "name"))
        joints = self._core.joints
        self.names: list[str] = [joint for joint, _ in joints]
        """The joints that have a value, in the order of every ``q``."""
        self.angles: list[bool] = [is_angle for _, is_angle in joints]
        """Whether the value of each is an angle, else a distance."""
        self.bodies: list[str] = self._core.bodies

    @property
    def title(self) -> str:
        """One line that names the linkage."""
        return self._core.title

    def _given(self, input: Mapping[str, float] | None) -> list[tuple[str, float]]:
        if input is None:
            return []
        if not isinstance(input, Mapping):
            raise TypeError(f"found {type(input).__name__} as input, expected a mapping from joints to values")
        for name in input:
            if name not in self.names:
                raise ValueError(f"found the unknown joint {name!r}, expected one of {', '.join(self.names)}")
        return [(name, _number(value, f"input[{name!r}]")) for name, value in input.items()]

    def solve(self, *, input: Mapping[str, float] | None = None) -> Solutions:
        """All assembly modes with these values of joints, radians or metres, in place of those of the file or beside them;
        ``bodies`` of the answer says where every body stands."""
        return of_document(self._core.solve(self._given(input), False))

    def certificate(self, *, input: Mapping[str, float] | None = None) -> Certificate:
        """The proof of the answer to these values of joints, radians or metres, in place of those of the file or beside them.

        It covers linkages in the plane with rational numbers; without a proof, and for the angles of most floats, whose half-angle tangent
        is irrational, there is an UnsupportedError that says why.
        """
        return read(self._core.certificate(self._given(input)))

    def sweep(self, joint: str, start: float, end: float, steps: int = 360, *, trace: str | None = None) -> Sweep:
        """All branches while a joint runs from start to end; ``trace="BODY.POINT"`` follows a point."""
        if isinstance(steps, bool) or not isinstance(steps, (int, np.integer)):
            raise TypeError(f"found {type(steps).__name__} as steps, expected an integer")
        if not 1 <= steps <= 100_000:
            raise ValueError(f"found {steps} steps, expected 1 to 100000")
        span = (_number(start, "start"), _number(end, "end"), int(steps))
        point = None if trace is None else _text(trace, "trace")
        return Sweep.of(self._core.sweep(_text(joint, "joint"), span, point))

    def derive(self, *, input: Mapping[str, float] | None = None) -> Document:
        """The closure polynomials of the groups, as ``looproot derive --json`` says them."""
        return _read(self._core.derive(self._given(input)))

    def trace(self, point: str) -> Document:
        """The curve of a point ``BODY.POINT`` as a polynomial, as ``looproot derive --trace --json`` says it."""
        return _read(self._core.trace(_text(point, "point")))

    def mobility(self) -> Document:
        """Whether the linkage moves, as ``looproot mobility --json`` says it."""
        return _read(self._core.mobility())

    def __repr__(self) -> str:
        return f"Linkage({self.title!r}, {len(self.bodies)} bodies, {', '.join(self.names)})"


def _read(text: str) -> Document:
    read: Any = json.loads(text)
    document: Document = read
    return document
