"""A map of the workspace of an arm: how many solutions each of many poses has, on two worker processes of Dask.

    python workspace.py [poses] [folder] [--kill]

With --kill one of the workers is killed on the way: nothing is lost, and nothing is done twice. Whatever is stopped goes on where it was when
the same line is run again. Needs numpy, dask and distributed.
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

ARM = "puma560"
CELLS = 60


def poses(count: int, place: Path) -> None:
    """Writes poses above and around the arm: positions of a plane through its axis, the tool in random directions."""
    if place.exists():
        return
    random = np.random.default_rng(1)
    reach = 1.2
    x, z = random.uniform(-reach, reach, (2, count))
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
    """Kills a worker when some chunks are done."""
    while len(list(folder.glob("chunk-*.npz"))) < 3:
        time.sleep(0.05)
    process = next(iter(client.run(os.getpid).values()))  # type: ignore[attr-defined]
    print(f"worker {process} is killed")
    os.kill(process, signal.SIGKILL)


def picture(place: Path, x: np.ndarray, z: np.ndarray, counts: np.ndarray) -> None:
    """Draws the mean number of solutions in every cell, as SVG."""
    edges = np.linspace(-1.2, 1.2, CELLS + 1)
    total = np.histogram2d(x, z, bins=(edges, edges), weights=counts)[0]
    number = np.histogram2d(x, z, bins=(edges, edges))[0]
    mean = np.divide(total, number, out=np.zeros_like(total), where=number > 0)
    cells = [
        f'<rect x="{8 * i}" y="{8 * (CELLS - 1 - j)}" width="8.2" height="8.2" fill="#2f6fb0" fill-opacity="{mean[i, j] / max(mean.max(), 1):.3f}"/>'
        for i in range(CELLS)
        for j in range(CELLS)
        if mean[i, j] > 0
    ]
    size = 8 * CELLS
    place.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size} {size}" role="img" aria-label="Mean number of solutions">'
        + "".join(cells)
        + "</svg>\n"
    )


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
    picture(folder / "map.svg", matrices[:, 0, 3], matrices[:, 2, 3], answer.counts)
    print(f"{answer}; the map is {folder / 'map.svg'}")


if __name__ == "__main__":
    main()
