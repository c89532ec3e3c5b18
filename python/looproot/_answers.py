"""What is found, and what is known of it."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass, field
from functools import cached_property
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Callable, Iterator, NoReturn

import numpy as np

from . import _core
from ._arrays import Floats, shaped
from ._pose import rotated

if TYPE_CHECKING:
    from numpy.typing import NDArray

Document = dict[str, Any]


@dataclass(frozen=True)
class Verdict:
    """Is the list complete, and what that rests on. The words are those of the command line."""

    status: str
    proof: str
    code: str
    reason: str
    real: int
    complex: int | None
    complex_complete: bool
    self_motion: int
    certified: int
    near: int = 0
    probability_of_error: float | None = None
    seed: int | None = None

    @property
    def proved(self) -> bool:
        """Whether a theorem holds of the data as they are."""
        return self.proof == "proved"

    @staticmethod
    def of(document: Document) -> Verdict:
        """The verdict of a document."""
        return Verdict(**{key: document[key] for key in Verdict.__dataclass_fields__ if key in document})


@dataclass(frozen=True)
class Family:
    """Solutions that form a curve or more."""

    dimension: int
    moving: list[int]
    distance: float
    sample: Floats
    samples: Floats


def _refuse(name: str) -> NoReturn:
    raise TypeError(f"the truth of {name} is ambiguous: ask .reachable or .complete")


def _drawn(document: Document, path: str | os.PathLike[str] | None, svg: bool) -> str:
    text = _core.page(json.dumps(document), svg)
    if path is not None:
        with open(os.fspath(path), "w", encoding="utf-8") as file:
            file.write(text)
    return text


class Solutions:
    """The real solutions of one question, an array for each of their properties, made when it is asked for."""

    names: list[str]
    """The joints, in the order of the columns of ``q``."""
    _answer: Any
    _document: Callable[[], Document] | None

    def __init__(self, answer: Any, names: list[str], document: Callable[[], Document] | None = None) -> None:
        # What cannot be set is set here.
        own = self.__dict__
        own["names"] = names
        own["_answer"] = answer
        own["_document"] = document

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"found an assignment to {name} of solutions, which do not change")

    @cached_property
    def q(self) -> Floats:
        """(k, n): joint values, in the order of ``names``."""
        found: Floats = self._answer.q
        return found

    @cached_property
    def certified(self) -> NDArray[np.bool_]:
        """Whether a solution is proved to exist, and to be the only one within its radius."""
        found: NDArray[np.bool_] = self._answer.certified
        return found

    @cached_property
    def radius(self) -> Floats:
        """Error bound of every joint value."""
        found: Floats = self._answer.radius
        return found

    @cached_property
    def condition(self) -> Floats:
        """How many times an error of the data is greater in a solution."""
        found: Floats = self._answer.condition
        return found

    @cached_property
    def within_limits(self) -> NDArray[np.bool_] | None:
        """None where there are no limits."""
        found: NDArray[np.bool_] | None = self._answer.within_limits
        return found

    @cached_property
    def near(self) -> NDArray[np.bool_]:
        """Whether a solution reaches the pose within the tolerance but not exactly."""
        found: NDArray[np.bool_] = self._answer.near
        return found

    @cached_property
    def verdict(self) -> Verdict:
        """Is the list complete, and what that rests on."""
        return Verdict.of(self._answer.verdict)

    @cached_property
    def families(self) -> list[Family]:
        """Solutions that are not isolated."""
        return [
            Family(one["dimension"], one["moving"], one["distance"], np.array(one["sample"]), np.array(one["samples"]))
            for one in self._answer.families
        ]

    @cached_property
    def warnings(self) -> list[str]:
        """What is noted about the data, a sentence each."""
        found: list[str] = self._answer.warnings
        return found

    @cached_property
    def matrix(self) -> Floats | None:
        """(k, 4, 4): poses of the plate of a platform."""
        return getattr(self._answer, "matrix", None)

    @cached_property
    def bodies(self) -> dict[str, Floats] | None:
        """Of a linkage for every body (k, 3): angle and position in the plane, (k, 4): quaternions, w first, on the sphere, or (k, 7):
        quaternions and positions in space."""
        return getattr(self._answer, "bodies", None)

    def __len__(self) -> int:
        return len(self.q)

    def __iter__(self) -> Iterator[Floats]:
        return iter(self.q)

    def __bool__(self) -> bool:
        _refuse("solutions")

    @property
    def reachable(self) -> bool:
        """Whether a real solution was found, alone or in a family."""
        return len(self.q) > 0 or bool(self.families)

    @property
    def complete(self) -> bool:
        """Whether every isolated real solution is listed, and that is proved."""
        return self.verdict.status in ("complete", "unreachable") and self.verdict.proved

    def _taken(self, order: Any) -> Solutions:
        within, matrix, bodies = self.within_limits, self.matrix, self.bodies
        answer = SimpleNamespace(
            q=self.q[order],
            certified=self.certified[order],
            radius=self.radius[order],
            condition=self.condition[order],
            within_limits=None if within is None else within[order],
            near=self.near[order],
            verdict=self._answer.verdict,
            families=self._answer.families,
            warnings=self.warnings,
            matrix=None if matrix is None else matrix[order],
            bodies=None if bodies is None else {name: places[order] for name, places in bodies.items()},
        )
        return type(self)(answer, self.names, self._document)

    def nearest(self, q0: Any) -> Solutions:
        """The same, the solution nearest to q0 first; angles are compared modulo full turns."""
        start = shaped(q0, (self.q.shape[1],), "near")
        turn = np.abs((self.q - start + np.pi) % (2 * np.pi) - np.pi)
        order = np.argsort(np.linalg.norm(turn, axis=1), kind="stable")
        return self._taken(order)

    def document(self) -> Document:
        """What ``looproot solve --json --scene`` prints."""
        if self._document is None:
            raise ValueError("found no document of these solutions, expected those of a single question")
        return self._document()

    def view(self, path: str | os.PathLike[str] | None = None) -> str:
        """The page of these solutions, written to a file where one is named."""
        return _drawn(self.document(), path, False)

    def svg(self, path: str | os.PathLike[str] | None = None) -> str:
        """Stick figures of these solutions."""
        return _drawn(self.document(), path, True)

    def __repr__(self) -> str:
        lines = [f"{len(self)} real solutions, {self.verdict.status}, {self.verdict.proof}"]
        shown = min(len(self), 40)
        for index in range(shown):
            sign = "certified" if self.certified[index] else ""
            lines.append(f"{index:4d}  " + " ".join(f"{x:10.5f}" for x in self.q[index]) + f"  {sign}")
        if shown < len(self):
            lines.append(f"      and {len(self) - shown} more")
        return "\n".join(lines)

    def _repr_html_(self) -> str:
        # Notebooks alone need it.
        from html import escape

        heads = "".join(f"<th>{escape(name)}</th>" for name in ["#", *self.names, "certified"])
        rows = []
        for index, row in enumerate(self.q):
            cells = "".join(f"<td>{x:.5f}</td>" for x in row)
            rows.append(f"<tr><th>{index}</th>{cells}<td>{'✓' if self.certified[index] else '–'}</td></tr>")
        verdict = f"{len(self)} real solutions: {self.verdict.status}, {self.verdict.proof}"
        picture = ""
        if self._document is not None and 0 < len(self) <= 40:
            picture = f'<div style="max-width: 60em">{self.svg()}</div>'
        return f"<p><b>{escape(verdict)}</b></p>{picture}<table><tr>{heads}</tr>{''.join(rows)}</table>"


def of_document(text: str) -> Solutions:
    """The solutions of a document with one result."""
    document: Document = json.loads(text)
    result = document["results"][0]
    real = [mode for mode in result["modes"] if mode["real"]]
    is_platform = document["kind"] == "platform"
    names = ["qw", "qx", "qy", "qz", "x", "y", "z"] if is_platform else [v["label"] for v in document["joint_variables"]]
    rows = [mode["quaternion"] + mode["position"] if is_platform else mode["q"] for mode in real]
    q = np.array(rows, dtype=np.float64).reshape(len(real), len(names))
    matrix = None
    if is_platform:
        matrix = np.array([rotated(row[:4] / np.linalg.norm(row[:4]), row[4:]) for row in q]).reshape(-1, 4, 4)

    def column(key: str, missing: float) -> Floats:
        return np.array([missing if mode.get(key) is None else mode[key] for mode in real], dtype=np.float64)

    limits = [mode.get("within_limits") for mode in real]
    within = np.array(limits, dtype=np.bool_) if limits and all(limit is not None for limit in limits) else None

    def family(one: Document) -> Document:
        def numbers(sample: Document) -> list[float]:
            return list(sample["q"] if "q" in sample else sample["quaternion"] + sample["position"])

        return {
            "dimension": one["dimension"],
            "moving": [joint - 1 for joint in one["joints"]],
            "distance": one["distance"] or 0.0,
            "sample": numbers(one["sample"]),
            "samples": [numbers(sample) for sample in one["samples"]],
        }

    answer = SimpleNamespace(
        q=q,
        certified=np.array([mode["certified"] for mode in real], dtype=np.bool_),
        radius=column("radius", np.inf),
        condition=column("condition", np.inf),
        within_limits=within,
        near=np.array([mode.get("near", False) for mode in real], dtype=np.bool_),
        verdict=result["verdict"],
        families=[family(one) for one in result["families"]],
        warnings=list(result["warnings"]),
        matrix=matrix,
        bodies=_places(document, real) if document["kind"] == "linkage" else None,
    )
    return Solutions(answer, names, lambda: document)


def _places(document: Document, modes: list[Document]) -> dict[str, Floats]:
    def of(name: str) -> Floats:
        bodies = [mode["bodies"][name] for mode in modes]
        rows = [[*body.get("quaternion", [body.get("angle")]), *body.get("position", [])] for body in bodies]
        width = {"plane": 3, "sphere": 4, "space": 7}[document["mechanism"]["space"]]
        return np.array(rows, dtype=np.float64).reshape(len(modes), width)

    return {name: of(name) for name in document["mechanism"]["bodies"]}


@dataclass(frozen=True, eq=False)
class Batch:
    """The solutions of many poses. Those of pose i are ``q[offsets[i]:offsets[i + 1]]``."""

    q: Floats
    offsets: NDArray[np.int64]
    certified: NDArray[np.bool_]
    near: NDArray[np.bool_]
    within_limits: NDArray[np.bool_] | None
    status: NDArray[np.str_]
    """The status of every pose, ``error`` for one that could not be solved."""
    proof: NDArray[np.str_]
    errors: dict[int, str]
    self_motion: NDArray[np.int64]
    names: list[str]

    def __len__(self) -> int:
        return len(self.status)

    def __bool__(self) -> bool:
        _refuse("a batch")

    def __getitem__(self, index: int) -> Floats:
        """The (k, n) joint values of one pose."""
        size = len(self)
        if not -size <= index < size:
            raise IndexError(f"found the pose {index}, expected {-size} to {size - 1}")
        at = index % size
        return self.q[self.offsets[at] : self.offsets[at + 1]]

    def __iter__(self) -> Iterator[Floats]:
        return (self[index] for index in range(len(self)))

    @property
    def counts(self) -> NDArray[np.int64]:
        """How many solutions every pose has."""
        return np.diff(self.offsets)

    def padded(self, k: int | None = None) -> Floats:
        """(n, k, joints), NaN behind the last solution of a pose."""
        counts = self.counts
        most = int(counts.max()) if len(counts) else 0
        width = most if k is None else k
        if width < most:
            raise ValueError(f"found room for {width} solutions, expected {most} at least")
        out = np.full((len(self), width, len(self.names)), np.nan)
        pose = np.repeat(np.arange(len(self)), counts)
        out[pose, np.arange(len(self.q)) - self.offsets[pose]] = self.q
        return out

    def __repr__(self) -> str:
        words, counts = np.unique(self.status, return_counts=True)
        parts = ", ".join(f"{count} {word}" for word, count in zip(words, counts))
        return f"{len(self)} poses, {len(self.q)} solutions: {parts}"


@dataclass(frozen=True)
class Polynomial:
    """A closure polynomial in one unknown, with integer coefficients, from the constant on."""

    variable: str
    coefficients: list[int]
    roots: list[float]

    @property
    def degree(self) -> int:
        """The degree."""
        return len(self.coefficients) - 1

    def sympy(self) -> Any:
        """A ``sympy.Poly``."""
        import sympy  # type: ignore[import-untyped, unused-ignore]

        return sympy.Poly(list(reversed(self.coefficients)), sympy.Symbol(self.variable))


@dataclass(frozen=True)
class Derivation:
    """The closure equations of one question, and the polynomial behind its list."""

    document: Document = field(repr=False)
    polynomial: Polynomial | None
    proved: bool

    @property
    def roots(self) -> list[float]:
        """The real roots of the polynomial."""
        return [] if self.polynomial is None else self.polynomial.roots


@dataclass(frozen=True)
class Sweep:
    """The branches of a loop while its input runs through a range."""

    document: Document = field(repr=False)
    status: str
    proof: str
    names: list[str]
    branches: list[Floats]
    """(rows, joints) each; the input is among the joints."""
    limits: Floats
    """(limits, joints): the limit positions."""

    @staticmethod
    def of(text: str) -> Sweep:
        """The sweep of a document."""
        document: Document = json.loads(text)
        names = [variable["label"] for variable in document["joint_variables"]]

        def rows(list_: list[Document]) -> Floats:
            return np.array([row["q"] for row in list_], dtype=np.float64).reshape(len(list_), len(names))

        verdict = document["verdict"]
        branches = [rows(branch["rows"]) for branch in document["branches"]]
        return Sweep(document, verdict["status"], verdict["proof"], names, branches, rows(document["limits"]))

    def view(self, path: str | os.PathLike[str] | None = None) -> str:
        """The page of this sweep, written to a file where one is named."""
        return _drawn(self.document, path, False)
