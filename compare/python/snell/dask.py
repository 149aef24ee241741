"""A study over the machines of a Dask cluster: needs ``pip install 'snell[dask]'``.

Every job of ``snell jobs`` is one task that runs ``snell run --job ID``. The store must be on a
disk that all machines see, and each needs this package. Start one worker per GPU, so that
what is timed has its machine to itself:

    dask scheduler
    dask worker SCHEDULER:8786 --nthreads 1 --resources "GPU=1 TIMING=1"
"""

import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import distributed

from snell.frame import Frame
from snell.process import SnellError, call
from snell.progress import reporter
from snell.scenes import Scene
from snell.studies import results, words_of


def study(
    scene: Scene | Iterable[Scene],
    client: distributed.Client,
    store: str | os.PathLike[str],
    *,
    out: str | os.PathLike[str],
    retries: int = 3,
    progress: bool | None = None,
    **asked: Any,
) -> Frame:
    """As :func:`snell.study`, over a cluster. Errors and counts are those of one process.

    Exact images are traced first, on all workers. Methods follow, each on a worker with
    the resources ``GPU`` and ``TIMING`` to itself, once nothing else runs beside them. A
    worker that dies costs the job that it did; what is in the store is not made again, so
    the same call goes on where another ended.

    Args:
        scene: As for :func:`snell.study`.
        client: Of the cluster.
        store: Folder of results by id, seen by every machine under this path.
        out: Folder for the report, the results and the images.
        retries: How often a job is tried again that ends with an error.
        progress: Show how far the work is. ``None``: in notebooks and on terminals.
        asked: ``methods``, ``sweep`` and the other arguments of :func:`snell.study`.

    Raises:
        SnellError: If a job cannot be done, or no worker has what it takes.
    """
    store, out = Path(store).absolute(), Path(out).absolute()
    listed = scene if isinstance(scene, (str, os.PathLike, Mapping)) else list(scene)
    words = words_of(listed, store, **asked)
    jobs = call("jobs", *words)
    timed = [job for job in jobs if job["resources"]]
    if timed:
        _offered(client, timed[0]["resources"])
    with reporter(progress) as report:
        done = 0
        # What is timed waits for all that would run beside it.
        for phase in ([job for job in jobs if not job["resources"]], timed):
            futures = [_submit(client, job, words, store, retries) for job in phase]
            for future in distributed.as_completed(futures):
                _raise(future)
                done += 1
                report(done / len(jobs), f"{done} of {len(jobs)} jobs")
    call("collect", store, "--out", out)
    return results(out)


def _submit(
    client: distributed.Client, job: Mapping[str, Any], words: list[str], store: Path, retries: int
) -> "distributed.Future[Any]":
    return client.submit(
        _run,
        [*words, "--job", job["id"], "--store", os.fspath(store)],
        key=f"snell-{job['id']}",
        resources=job["resources"],
        retries=retries,
    )


def _run(words: list[str]) -> list[dict[str, Any]]:
    """What a worker does: one job, whose result goes to the store."""
    return call("run", *words, progress=False)


def _offered(client: distributed.Client, wanted: Mapping[str, float]) -> None:
    """Without this, tasks that no worker can take would wait for ever."""
    workers = client.scheduler_info(n_workers=-1)["workers"].values()
    for worker in workers:
        offers = worker.get("resources", {})
        if all(offers.get(name, 0) >= count for name, count in wanted.items()):
            return
    needed = " ".join(f"{name}={count}" for name, count in wanted.items())
    raise SnellError(
        f"none of {len(workers)} workers offers {needed}, which a timed method takes\n"
        f'start workers with: dask worker SCHEDULER --nthreads 1 --resources "{needed}"'
    )


def _raise(future: "distributed.Future[Any]") -> None:
    error = future.exception()
    if isinstance(error, SnellError):
        raise error
    if error is not None:
        raise SnellError(f"{future.key}: {error}") from error
