"""Large batches in chunks, each a file: whatever is killed, nothing that is done is lost or done twice.

A job is a function from the number of a chunk, from 0, to named arrays. Its result is written whole or not at all, under a temporary name
that is changed at the end, and a chunk whose file is there is not run again. So every engine may run it, one that repeats work among
them, and a run that was killed goes on where it stopped.

>>> import numpy as np, tempfile
>>> def squares(chunk):
...     return {"squares": (10 * chunk + np.arange(10)) ** 2}
>>> folder = tempfile.mkdtemp()
>>> run(squares, 3, folder)
3 chunks: 3 done, 0 kept, 0 failed
>>> run(squares, 3, folder)
3 chunks: 0 done, 3 kept, 0 failed
>>> int(np.concatenate([part["squares"] for part in results(folder)])[-1])
841
"""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np

from ._answers import Batch
from ._arm import Arm, from_file, robot
from ._functions import names

__all__ = ["Poses", "Report", "alone", "joined", "read", "results", "run"]

Job = Callable[[int], Mapping[str, Any]]

_LABEL = "batch.json"


@dataclass(frozen=True)
class Report:
    """What a run has done."""

    chunks: int
    done: int
    kept: int
    """Chunks whose files were there before."""
    failed: dict[int, str] = field(default_factory=dict)
    """What a job raised, by the number of the chunk: these are tried again by the next run."""

    def __repr__(self) -> str:
        return f"{self.chunks} chunks: {self.done} done, {self.kept} kept, {len(self.failed)} failed"


def _place(folder: Path, chunk: int) -> Path:
    return folder / f"chunk-{chunk:08d}.npz"


def _one(job: Job, folder: str, chunk: int) -> tuple[int, str]:
    """Runs one chunk, if its file is not there: its number, and ``done``, ``kept`` or what went wrong."""
    place = _place(Path(folder), chunk)
    if place.exists():
        return chunk, "kept"
    try:
        found = job(chunk)
    except Exception as error:  # noqa: BLE001
        return chunk, f"{type(error).__name__}: {error}"
    # A name that no other worker has, in the same folder: it is changed in one step or not at all.
    part = place.with_name(f".{place.name}.{os.getpid()}.{uuid.uuid4().hex}")
    try:
        with open(part, "wb") as file:
            np.savez(file, **{name: np.asarray(value) for name, value in found.items()})  # type: ignore[arg-type, unused-ignore]
            file.flush()
            os.fsync(file.fileno())
        os.replace(part, place)
    finally:
        part.unlink(missing_ok=True)
    return chunk, "done"


def run(
    job: Job, chunks: int, folder: str | os.PathLike[str], client: Any = None, *, part: tuple[int, int] | None = None
) -> Report:
    """Runs ``job(0)`` to ``job(chunks - 1)`` and keeps each result as a file of ``folder``.

    Parameters
    ----------
    job
        A function of the number of a chunk that returns named arrays, always the same ones for the same number. For a client it must be
        one that can be pickled. With an attribute ``label`` (any text), the folder remembers it, and refuses another job.
    chunks
        How many there are.
    folder
        Where the files are. It is made if it is not there.
    client
        None for this process, a number of processes, or anything with ``map``: a Dask client, an executor of ``concurrent.futures``,
        ``mpi4py.futures`` or ``executorlib``.
    part
        ``(k, n)`` runs every n-th chunk, from chunk k on: task k of an array of n jobs on a shared folder. The report is about these.

    Returns
    -------
    Report
        How many chunks were done, were there already, or failed.
    """
    if not isinstance(chunks, int) or isinstance(chunks, bool) or chunks < 0:
        raise ValueError(f"found {chunks!r} chunks, expected a number that is not negative")
    own = Path(folder)
    own.mkdir(parents=True, exist_ok=True)
    _labelled(own, chunks, getattr(job, "label", None))
    wanted = _part(chunks, part)
    missing = [chunk for chunk in wanted if not _place(own, chunk).exists()]
    one = partial(_one, job, str(own.resolve()))
    done, failed, kept = 0, {}, len(wanted) - len(missing)
    for chunk, word in _mapped(one, missing, client):
        if word == "done":
            done += 1
        elif word == "kept":
            kept += 1
        else:
            failed[chunk] = word
    return Report(len(wanted), done, kept, failed)


def _part(chunks: int, part: tuple[int, int] | None) -> range:
    if part is None:
        return range(chunks)
    if len(part) != 2 or not 0 <= part[0] < part[1]:
        raise ValueError(f"found the part {part!r}, expected (k, n) with 0 <= k < n")
    return range(part[0], chunks, part[1])


def _labelled(folder: Path, chunks: int, label: str | None) -> None:
    """A folder belongs to one job."""
    wanted = {"chunks": chunks, "label": label}
    place = folder / _LABEL
    if place.exists():
        found = json.loads(place.read_text(encoding="utf-8"))
        if found != wanted:
            raise ValueError(f"found the results of {found} in {folder}, expected a folder of {wanted} or an empty one")
        return
    part = folder / f".{_LABEL}.{uuid.uuid4().hex}"
    part.write_text(json.dumps(wanted), encoding="utf-8")
    os.replace(part, place)


def _mapped(one: Callable[[int], tuple[int, str]], chunks: list[int], client: Any) -> Iterable[tuple[int, str]]:
    if client is None:
        return map(one, chunks)
    if isinstance(client, int) and not isinstance(client, bool):
        return _pooled(one, chunks, client)
    if not hasattr(client, "map"):
        raise TypeError(f"found {type(client).__name__} as client, expected None, a number of processes, or something with map")
    found = client.map(one, chunks)
    # Dask hands out promises.
    return client.gather(found) if hasattr(client, "gather") else found  # type: ignore[no-any-return]


def _pooled(one: Callable[[int], tuple[int, str]], chunks: list[int], processes: int) -> Iterator[tuple[int, str]]:
    if processes < 1:
        raise ValueError(f"found {processes} processes, expected 1 at least")
    # These take longer to import than the rest of the package.
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    # A process that is forked may hold locks of threads that it does not have.
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn"), initializer=alone) as pool:
        yield from pool.map(one, chunks)


def alone() -> None:
    """Makes the solver of this process work on one core, where several processes share a machine; called before it first solves."""
    os.environ.setdefault("RAYON_NUM_THREADS", "1")


def results(folder: str | os.PathLike[str]) -> Iterator[dict[str, Any]]:
    """The arrays of every chunk, in order. A chunk that is missing is a ValueError that names it."""
    own = Path(folder)
    chunks = json.loads((own / _LABEL).read_text(encoding="utf-8"))["chunks"]
    for chunk in range(chunks):
        place = _place(own, chunk)
        if not place.exists():
            raise ValueError(f"found no {place.name} in {own}, expected {chunks} chunks: run it again")
        with np.load(place, allow_pickle=False) as found:
            yield dict(found)


@lru_cache(maxsize=8)
def _arm(name: str) -> Arm:
    """An arm is prepared once in every process."""
    return robot(name) if name in names() else from_file(name)


@dataclass(frozen=True)
class Poses:
    """The job of solving the poses of a file, ``size`` in a chunk.

    >>> job = Poses("ur5", "poses.npy", size=2500)         # doctest: +SKIP
    >>> run(job, job.chunks, "answers", client=2)          # doctest: +SKIP
    >>> joined("answers")                                  # doctest: +SKIP
    """

    arm: str
    """A file, or an arm of the library."""
    poses: str
    """A file of numpy (``.npy``) with an array (n, 4, 4)."""
    size: int = 2500

    def __post_init__(self) -> None:
        if self.size < 1:
            raise ValueError(f"found {self.size} poses in a chunk, expected 1 at least")
        shape = self._all().shape
        if len(shape) != 3 or shape[1:] != (4, 4):
            raise ValueError(f"found the shape {shape} in {self.poses}, expected (n, 4, 4)")

    def _all(self) -> Any:
        return np.load(self.poses, mmap_mode="r", allow_pickle=False)

    @property
    def chunks(self) -> int:
        """Returns the number of chunks."""
        return -(-len(self._all()) // self.size)

    @property
    def label(self) -> str:
        """What the folder of the results remembers."""
        return f"{self.size} poses each of {len(self._all())} in {Path(self.poses).name}, arm {self.arm}"

    def __call__(self, chunk: int) -> dict[str, Any]:
        """The answer to one chunk: the arrays of a :class:`looproot.Batch`."""
        arm = _arm(self.arm)
        found = arm.ik_batch(np.array(self._all()[chunk * self.size : (chunk + 1) * self.size]))
        within = found.within_limits
        return {
            "q": found.q,
            "offsets": found.offsets,
            "certified": found.certified,
            "near": found.near,
            "within_limits": np.zeros(0, dtype=bool) if within is None else within,
            "has_limits": np.array(within is not None),
            "status": found.status,
            "proof": found.proof,
            "self_motion": found.self_motion,
            "failed": np.array(sorted(found.errors), dtype=np.int64),
            "errors": np.array([found.errors[index] for index in sorted(found.errors)], dtype=np.str_),
            "names": np.array(found.names, dtype=np.str_),
        }


def joined(folder: str | os.PathLike[str]) -> Batch:
    """The results of :class:`Poses` as one batch, in the order of the poses."""
    parts = list(results(folder))
    if not parts:
        raise ValueError(f"found no chunks in {folder}, expected some")
    return _batch(parts)


def read(path: str | os.PathLike[str]) -> Batch:
    """The answers that ``looproot solve ARM --poses poses.npy -o answers.npz`` has written, or one chunk of :class:`Poses`."""
    with np.load(path, allow_pickle=False) as found:
        return _batch([dict(found)])


def _batch(parts: list[dict[str, Any]]) -> Batch:
    def together(name: str) -> Any:
        return np.concatenate([part[name] for part in parts])

    poses = np.cumsum([0, *(len(part["status"]) for part in parts)])
    rows = np.cumsum([0, *(len(part["q"]) for part in parts)])
    offsets = np.concatenate([[0], *(part["offsets"][1:] + row for part, row in zip(parts, rows))]).astype(np.int64)
    errors = {
        int(index) + int(first): str(text)
        for part, first in zip(parts, poses)
        for index, text in zip(part["failed"], part["errors"])
    }
    within = together("within_limits") if bool(parts[0]["has_limits"]) else None
    return Batch(
        together("q"), offsets, together("certified"), together("near"), within, together("status"), together("proof"),
        errors, together("self_motion"), [str(name) for name in parts[0]["names"]],
    )  # fmt: skip
