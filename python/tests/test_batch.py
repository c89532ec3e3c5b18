"""Chunks as files: nothing is lost, nothing is done twice, whatever is killed."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

import looproot as lr
from looproot import batch


def poses(folder: Path, count: int) -> Path:
    place = folder / "poses.npy"
    random = np.random.default_rng(3)
    np.save(place, lr.robot("ur5").fk(random.uniform(-3, 3, (count, 6))))
    return place


def same(found: lr.Batch, place: Path) -> None:
    whole = lr.robot("ur5").ik_batch(np.load(place))
    assert np.array_equal(found.q, whole.q) and np.array_equal(found.offsets, whole.offsets)
    assert list(found.status) == list(whole.status) and found.names == whole.names


def test_chunks_are_the_whole_and_errors_keep_their_index(tmp_path: Path) -> None:
    place = poses(tmp_path, 23)
    matrices = np.load(place)
    matrices[17] = np.nan
    np.save(place, matrices)
    job = batch.Poses("ur5", str(place), size=5)
    assert job.chunks == 5
    assert repr(batch.run(job, job.chunks, tmp_path / "out")) == "5 chunks: 5 done, 0 kept, 0 failed"
    found = batch.joined(tmp_path / "out")
    assert list(found.errors) == [17] and found.status[17] == "error"
    same(found, place)
    part = batch.read(tmp_path / "out" / "chunk-00000003.npz")
    assert list(part.errors) == [2] and np.array_equal(part[0], found[15])


def test_a_missing_chunk_is_done_again_and_a_half_written_one_does_not_count(tmp_path: Path) -> None:
    place = poses(tmp_path, 12)
    job = batch.Poses("ur5", str(place), size=4)
    batch.run(job, job.chunks, tmp_path / "out")
    (tmp_path / "out" / "chunk-00000001.npz").rename(tmp_path / "out" / ".chunk-00000001.npz.1.abc")
    with pytest.raises(ValueError, match="chunk-00000001"):
        batch.joined(tmp_path / "out")
    assert repr(batch.run(job, job.chunks, tmp_path / "out")) == "3 chunks: 1 done, 2 kept, 0 failed"
    same(batch.joined(tmp_path / "out"), place)


def test_an_array_of_jobs_shares_a_folder(tmp_path: Path) -> None:
    place = poses(tmp_path, 14)
    job = batch.Poses("ur5", str(place), size=2)
    reports = [batch.run(job, job.chunks, tmp_path / "out", part=(task, 3)) for task in range(3)]
    assert [report.done for report in reports] == [3, 2, 2]
    same(batch.joined(tmp_path / "out"), place)
    with pytest.raises(ValueError, match="0 <= k < n"):
        batch.run(job, job.chunks, tmp_path / "out", part=(3, 3))


def test_a_folder_belongs_to_one_job(tmp_path: Path) -> None:
    place = poses(tmp_path, 4)
    batch.run(batch.Poses("ur5", str(place), size=2), 2, tmp_path / "out")
    with pytest.raises(ValueError, match="found the results of"):
        batch.run(batch.Poses("puma560", str(place), size=2), 2, tmp_path / "out")


def test_what_fails_is_named_and_tried_again(tmp_path: Path) -> None:
    def job(chunk: int) -> dict[str, int]:
        if chunk == 1 and not (tmp_path / "mended").exists():
            raise RuntimeError("out of luck")
        return {"chunk": chunk}

    report = batch.run(job, 3, tmp_path / "out")
    assert report.failed == {1: "RuntimeError: out of luck"} and report.done == 2
    (tmp_path / "mended").touch()
    assert batch.run(job, 3, tmp_path / "out").done == 1


def test_bad_arguments(tmp_path: Path) -> None:
    np.save(tmp_path / "flat.npy", np.zeros((3, 7)))
    with pytest.raises(ValueError, match=r"expected \(n, 4, 4\)"):
        batch.Poses("ur5", str(tmp_path / "flat.npy"))
    with pytest.raises(ValueError, match="expected a number"):
        batch.run(lambda chunk: {}, -1, tmp_path / "out")
    with pytest.raises(TypeError, match="something with map"):
        batch.run(lambda chunk: {}, 1, tmp_path / "out", client="dask")


PROGRAM = """
import sys
from looproot import batch
job = batch.Poses("ur5", sys.argv[1], size=20)
if __name__ == "__main__":
    print(batch.run(job, job.chunks, sys.argv[2], client=int(sys.argv[3]) or None))
"""


@pytest.mark.parametrize("processes", [0, 2])
def test_a_run_that_was_killed_goes_on(tmp_path: Path, processes: int) -> None:
    place = poses(tmp_path, 4000)
    program = tmp_path / "program.py"
    program.write_text(PROGRAM)
    line = [sys.executable, str(program), str(place), str(tmp_path / "out"), str(processes)]
    first = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
    chunks = lambda: len(list((tmp_path / "out").glob("chunk-*.npz")))  # noqa: E731
    until = time.monotonic() + 60
    while chunks() < 3 and time.monotonic() < until:
        time.sleep(0.005)
    # The group: the run and its workers.
    os.killpg(first.pid, signal.SIGKILL)
    first.wait()
    before = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "out").glob("chunk-*.npz")}
    assert 3 <= len(before) < 200, "it was killed on the way"
    second = subprocess.run(line, capture_output=True, text=True, check=True)
    assert second.stdout.strip() == f"200 chunks: {200 - len(before)} done, {len(before)} kept, 0 failed"
    after = {path.name: path.stat().st_mtime_ns for path in (tmp_path / "out").glob("chunk-*.npz")}
    assert all(after[name] == time_ for name, time_ in before.items()), "nothing is done twice"
    same(batch.joined(tmp_path / "out"), place)


def test_dask_loses_nothing_with_a_killed_worker(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    example = Path(__file__).parents[1] / "examples" / "workspace.py"
    if not example.exists():
        pytest.skip("the examples are not here")
    # A tenth of what docs/howto/many_poses.md shows.
    line = [sys.executable, str(example), "100000", str(tmp_path / "map"), "--kill"]
    found = subprocess.run(line, capture_output=True, text=True, timeout=600)
    assert found.returncode == 0, found.stderr
    assert "is killed" in found.stdout and "40 chunks: " in found.stdout and "0 failed" in found.stdout
    assert "100000 poses" in found.stdout
    assert (tmp_path / "map" / "map.svg").read_text().count("h8v8") > 100
