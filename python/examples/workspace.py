"""A map of the workspace of an arm: how many solutions each of many poses has, on two worker processes of Dask.

    python workspace.py [poses] [folder] [--kill]

With --kill one of the workers is killed on the way: nothing is lost, and nothing is done twice. Whatever is stopped goes on where it was when
the same line is run again. Without a number there are a million poses. Needs numpy, dask and distributed.
"""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from pathlib import Path

import numpy as np

import looproot as lr

ARM = "ur5"
REACH = 1.1
CELLS = 60
# Side of a cell, and the margin for the numbers beside the map, in units of the picture.
SIDE, MARGIN = 8, 60


def poses(count: int, place: Path) -> None:
    """Writes poses: positions of the plane y = 0 through the axis of the arm, the tool in random directions."""
    if place.exists():
        return
    random = np.random.default_rng(1)
    x, z = random.uniform(-REACH, REACH, (2, count))
    w = random.normal(size=(count, 4))
    w /= np.linalg.norm(w, axis=1, keepdims=True)
    q, a, b, c = w.T
    matrices = np.zeros((count, 4, 4))
    matrices[:, 0, :3] = np.stack([1 - 2 * (b * b + c * c), 2 * (a * b - q * c), 2 * (a * c + q * b)], 1)
    matrices[:, 1, :3] = np.stack([2 * (a * b + q * c), 1 - 2 * (a * a + c * c), 2 * (b * c - q * a)], 1)
    matrices[:, 2, :3] = np.stack([2 * (a * c - q * b), 2 * (b * c + q * a), 1 - 2 * (a * a + b * b)], 1)
    matrices[:, 0, 3], matrices[:, 2, 3], matrices[:, 3, 3] = x, z, 1
    part = place.with_suffix(".part.npy")
    np.save(part, matrices)
    os.replace(part, place)


def kill_one(client: object, folder: Path) -> None:
    """Kills a worker when it and the other one have done three chunks."""
    done = lambda: len(list(folder.glob("chunk-*.npz")))  # noqa: E731
    before = done()
    while done() < before + 3:
        time.sleep(0.05)
    process = next(iter(client.run(os.getpid).values()))  # type: ignore[attr-defined]
    os.kill(process, signal.SIGKILL)
    print(f"worker {process} is killed")


def picture(place: Path, x: np.ndarray, z: np.ndarray, counts: np.ndarray) -> None:
    """Draws the mean number of solutions in every cell, to a half, as SVG: the darker, the more."""
    edges = np.linspace(-REACH, REACH, CELLS + 1)
    total = np.histogram2d(x, z, bins=(edges, edges), weights=counts)[0]
    number = np.histogram2d(x, z, bins=(edges, edges))[0]
    halves = np.rint(2 * np.divide(total, number, out=np.zeros_like(total), where=number > 0)).astype(int)
    most = max(int(halves.max()), 1)
    size = SIDE * CELLS
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{-MARGIN} {-MARGIN / 2} {size + 2.5 * MARGIN} {size + 1.5 * MARGIN}" role="img" '
        'shape-rendering="crispEdges" font-family="sans-serif" font-size="13" aria-label="Mean number of solutions over the plane y = 0">'
    ]
    for half in range(1, most + 1):
        # Neighbours in a row are one rectangle.
        pieces = []
        for j in range(CELLS):
            step = np.diff(np.concatenate([[0], halves[:, j] == half, [0]]).astype(int))
            for first, end in zip(np.flatnonzero(step == 1), np.flatnonzero(step == -1)):
                pieces.append(f"M{SIDE * first} {SIDE * (CELLS - 1 - j)}h{SIDE * (end - first)}v{SIDE}h{-SIDE * (end - first)}z")
        parts.append(f'<path fill="#1f4e79" fill-opacity="{half / most:.3f}" d="{"".join(pieces)}"/>')
        if half % 2 == 0:
            y = size - 10 * half
            parts.append(f'<rect x="{size + 20}" y="{y - 20}" width="16" height="20" fill="#1f4e79" fill-opacity="{half / most:.3f}"/>')
            parts.append(f'<text x="{size + 42}" y="{y - 5}">{half // 2}</text>')
    parts.append(f'<text x="{size + 20}" y="{size - 10 * most - 30}">solutions</text>')
    parts.append(f'<rect width="{size}" height="{size}" fill="none" stroke="#888"/>')
    for value in (-1.0, -0.5, 0.0, 0.5, 1.0):
        at = size * (value + REACH) / (2 * REACH)
        parts.append(f'<path stroke="#888" d="M{at:.1f} {size}v5M0 {size - at:.1f}h-5"/>')
        parts.append(f'<text x="{at:.1f}" y="{size + 20}" text-anchor="middle">{value}</text>')
        parts.append(f'<text x="-9" y="{size - at + 4:.1f}" text-anchor="end">{value}</text>')
    parts.append(f'<text x="{size / 2}" y="{size + 42}" text-anchor="middle">x [m]</text><text x="-9" y="{0.39 * size}" text-anchor="end">z [m]</text></svg>')
    place.write_text("\n".join(parts) + "\n")


def main() -> None:
    """Makes the poses, solves them, draws the map."""
    words = [word for word in sys.argv[1:] if not word.startswith("--")]
    count = int(words[0]) if words else 1_000_000
    folder = Path(words[1] if len(words) > 1 else "workspace")
    folder.mkdir(exist_ok=True)
    poses(count, folder / "poses.npy")
    job = lr.batch.Poses(ARM, str((folder / "poses.npy").resolve()), size=2500)

    from distributed import Client, LocalCluster

    # One thread a worker, and one for the solver in it: the processes share the cores.
    os.environ["RAYON_NUM_THREADS"] = "1"
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        if "--kill" in sys.argv:
            threading.Thread(target=kill_one, args=(client, folder / "answers"), daemon=True).start()
        print(lr.batch.run(job, job.chunks, folder / "answers", client))
    answer = lr.batch.joined(folder / "answers")
    matrices = np.load(folder / "poses.npy", mmap_mode="r")
    assert len(answer) == len(matrices), "every pose has one answer"
    assert set(answer.status) <= {"complete", "unreachable"}, "no list is doubtful"
    picture(folder / "map.svg", matrices[:, 0, 3], matrices[:, 2, 3], answer.counts)
    print(f"{answer}; the map is {folder / 'map.svg'}")


if __name__ == "__main__":
    main()
