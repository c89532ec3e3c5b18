"""What needs no object."""

from __future__ import annotations

import json
import os

from . import _core
from ._answers import Document
from ._arm import Arm, _text, from_file
from ._closed import Loop, Platform
from ._linkage import Linkage


def names() -> list[str]:
    """The names of the library."""
    return _core.robots()


def load(name: str | os.PathLike[str]) -> Arm | Loop | Platform | Linkage:
    """An arm, a loop, a platform or a linkage of a file or of the library.

    >>> load("ur5")
    Arm('Universal Robots UR5', 6 joints: q1, q2, q3, q4, q5, q6)
    """
    text = _text(name, "name")
    kind = _core.kind(text, None, None)
    if kind == "arm":
        return from_file(text)
    if kind == "linkage":
        return Linkage(text)
    return Loop(text) if kind == "loop" else Platform.load(text)


def mobility(name: str | os.PathLike[str]) -> Document:
    """Whether a loop, an arm, a platform, a linkage or a framework moves, as ``looproot mobility --json`` says it.

    >>> mobility("bennett_a")["mobility"]
    1
    """
    read: Document = json.loads(_core.mobility(_text(name, "name")))
    return read


def conditions(name: str | os.PathLike[str]) -> Document:
    """For which parameters a loop moves, as ``looproot conditions --json`` says it: ``4R``, a file or a name."""
    read: Document = json.loads(_core.conditions(_text(name, "name")))
    return read
