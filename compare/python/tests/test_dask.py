"""A study over a cluster, one worker of which is killed."""

import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import distributed
import pytest
import snell
import snell.dask

ASKED = {
    "methods": ["one-interface", "undeviated"],
    "sweep": {"camera.orbit_deg": [0, 40]},
    "resolution": 24,
    "positions": 2,
    "timing_s": 0,
    "quick": True,
}
WORKER = ["--nthreads", "1", "--no-nanny", "--no-dashboard"]


def start(*words: str) -> subprocess.Popen[bytes]:
    return subprocess.Popen(
        [sys.executable, "-m", "distributed.cli.dask_" + words[0], *words[1:]],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )


def stored(store: Path) -> set[str]:
    return {path.name for path in store.glob("*") if len(path.name) == 32 and path.is_dir()}


def lasting(frame: snell.Frame) -> list[dict[str, object]]:
    """What does not depend on when it was measured."""
    rows = frame[(frame["kind"] != "time") & (frame["metric"] != "timed_frames")]
    return rows.astype(object).where(rows.notna(), None).to_dict("records")


@pytest.fixture
def cluster(tmp_path: Path):  # type: ignore[no-untyped-def]
    """A scheduler and three worker processes, by process."""
    file = tmp_path / "scheduler.json"
    processes = [start("scheduler", "--port", "0", "--no-dashboard", "--scheduler-file", str(file))]
    offers = ["--resources", "GPU=1 TIMING=1", "--scheduler-file", str(file)]
    processes += [start("worker", *WORKER, *offers, "--local-directory", str(tmp_path)) for _ in range(3)]
    try:
        with distributed.Client(scheduler_file=str(file), timeout=60) as client:
            client.wait_for_workers(3, timeout=60)
            yield client, processes[1:]
    finally:
        for process in processes:
            process.kill()
            process.wait()


def test_a_killed_worker_costs_its_time_and_nothing_else(cluster, cache, tmp_path):  # type: ignore[no-untyped-def]
    client, workers = cluster
    store = tmp_path / "store"
    killed: list[int] = []

    def kill() -> None:
        while len(stored(store)) < 1:
            time.sleep(0.02)
        killed.append(len(stored(store)))
        os.kill(workers[0].pid, signal.SIGKILL)

    killer = threading.Thread(target=kill, daemon=True)
    killer.start()
    scenes = ["ball", "box"]
    frame = snell.dask.study(scenes, client, store, out=tmp_path / "many", **ASKED)
    killer.join(timeout=5)
    assert workers[0].wait(timeout=5) == -signal.SIGKILL
    ids = {job["id"] for job in snell.call("jobs", *snell.studies.words_of(scenes, store, **ASKED))}
    assert len(ids) == 12 and killed[0] < 12, "it was killed too late"
    assert stored(store) == ids

    one = snell.study(scenes, out=tmp_path / "one", cache=cache, **ASKED)
    many, alone = lasting(frame), lasting(one)
    assert len(many) == len(alone) and many == alone


def test_workers_without_what_a_job_takes_are_refused_at_once(tmp_path: Path) -> None:
    with (
        distributed.LocalCluster(n_workers=1, processes=False, dashboard_address=None) as local,
        distributed.Client(local) as client,
        pytest.raises(snell.SnellError, match="none of 1 workers offers GPU=1 TIMING=1"),
    ):
        snell.dask.study("ball", client, tmp_path / "store", out=tmp_path / "out", **ASKED)
