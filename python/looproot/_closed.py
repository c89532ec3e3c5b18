"""Closed loops and Stewart platforms."""

from __future__ import annotations

import os
from typing import Any

import numpy as np

from . import _core
from ._answers import Derivation, Document, Solutions, Sweep, of_document
from ._arm import _text, derivation
from ._arrays import Floats, shaped
from ._certificate import Certificate, read
from ._pose import checked


def _number(value: Any, what: str) -> float:
    return float(shaped(value, (), what))


class Loop:
    """A closed loop of a file or of the library.

    >>> Loop("rrsrr").solve(input=2.5).verdict.status
    'complete'
    """

    def __init__(self, name: str | os.PathLike[str]) -> None:
        self._core = _core.Loop(_text(name, "name"))
        self.names: list[str] = self._core.names
        self.input: tuple[int, bool] = self._core.input
        """The number of the joint that is given, from 1, and whether its value is an angle."""

    @property
    def title(self) -> str:
        """One line that names the loop."""
        return self._core.title

    def solve(self, *, input: float) -> Solutions:
        """All assembly modes at this value of the input, radians or metres."""
        return of_document(self._core.solve(_number(input, "input"), False))

    def sweep(self, start: float, end: float, steps: int = 360) -> Sweep:
        """All branches while the input runs from start to end. Ctrl-C ends it with what is done."""
        if isinstance(steps, bool) or not isinstance(steps, (int, np.integer)):
            raise TypeError(f"found {type(steps).__name__} as steps, expected an integer")
        if not 1 <= steps <= 100_000:
            raise ValueError(f"found {steps} steps, expected 1 to 100000")
        return Sweep.of(self._core.sweep(_number(start, "start"), _number(end, "end"), int(steps)))

    def derive(self, *, input: float) -> Derivation:
        """The closure equations at this value of the input, and the polynomial behind the list."""
        return derivation(self._core.derive(_number(input, "input")))

    def certificate(self, *, input: float) -> Certificate:
        """The proof of the list at this value of the input. An answer of which there is none is an UnsupportedError."""
        return read(self._core.certificate(_number(input, "input")))

    def mobility(self) -> Document:
        """Whether the loop moves when no joint is held, as ``looproot mobility --json`` says it."""
        import json

        read: Document = json.loads(self._core.mobility())
        return read

    def __repr__(self) -> str:
        return f"Loop({self.title!r}, {', '.join(self.names)})"


class Platform:
    """A Stewart platform: six points of a base and six points of a plate, each in its own frame.

    >>> p = Platform.load("dietmaier_40real")
    >>> p.title
    "Dietmaier's platform with 40 real postures"
    """

    def __init__(self, base: Any, plate: Any) -> None:
        self._core = _core.Platform.from_points(shaped(base, (6, 3), "base"), shaped(plate, (6, 3), "plate"))

    @classmethod
    def load(cls, name: str | os.PathLike[str]) -> Platform:
        """A platform of a file or of the library."""
        made = cls.__new__(cls)
        made._core = _core.Platform.load(_text(name, "name"))
        return made

    @property
    def title(self) -> str:
        """One line that names the platform."""
        return self._core.title

    def solve(self, *, legs: Any) -> Solutions:
        """All poses with legs of these lengths; ``matrix`` has them as (k, 4, 4)."""
        return of_document(self._core.solve(list(shaped(legs, (6,), "legs")), False))

    def legs(self, pose: Any) -> Floats:
        """The lengths of the legs at a pose of the plate."""
        return np.array(self._core.legs(checked(pose, "pose")))

    def derive(self, *, legs: Any) -> Derivation:
        """The closure equations for legs of these lengths, and the polynomial behind the list."""
        return derivation(self._core.derive(list(shaped(legs, (6,), "legs"))))

    def certificate(self, *, legs: Any) -> Certificate:
        """The proof of the list for legs of these lengths. An answer of which there is none is an UnsupportedError."""
        return read(self._core.certificate(list(shaped(legs, (6,), "legs"))))

    def __repr__(self) -> str:
        return f"Platform({self.title!r})"
