"""Studies and their results."""

import atexit
import json
import os
import shutil
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeAlias

import pandas as pd

from snell import scenes
from snell.frame import Frame
from snell.process import SnellError, call, words

#: What varies: ``a`` or ``multi.peel_px`` for a method's parameter, ``medium.glass.eta`` for a
#: number of the scene; one value, several, or a range as text, ``"1.05:2.4:0.15"``.
Sweep: TypeAlias = Mapping[str, object]
#: Width and height in pixels, or one number for both.
Size: TypeAlias = int | tuple[int, int]

#: First steps of the paths to numbers in a scene file.
_SECTIONS = (
    "camera environment surroundings medium shape object light sequence judgement".split()
)


def study(
    scene: scenes.Scene | Sequence[scenes.Scene] | None = None,
    *,
    methods: Iterable[str] = (),
    sweep: Sweep | None = None,
    method_files: Iterable[str | os.PathLike[str]] = (),
    obj: str | os.PathLike[str] | None = None,
    map: str | os.PathLike[str] | None = None,
    eta: float | None = None,
    resolution: Size | Sequence[Size] | None = None,
    supersampling: Iterable[int] = (),
    positions: int | None = None,
    cut: float | None = None,
    timing_s: float | None = None,
    budget_ms: float | None = None,
    quick: bool = False,
    images: Mapping[str, str | os.PathLike[str]] | None = None,
    times_ms: Mapping[str, float] | None = None,
    adapter: str | int | None = None,
    cache: str | os.PathLike[str] | None = None,
    out: str | os.PathLike[str] | None = None,
    progress: bool | None = None,
) -> Frame:
    """Renders scenes exactly and approximately, and says how far apart they are and what
    each costs: ``snell study``.

    Args:
        scene: One or several: names, files, dictionaries (see :data:`snell.Scene`); or one
            study file. ``None``: the default scenes, or the mesh ``obj``.
        methods: Which approximations. None named: all.
        sweep: What varies; all combinations are studied. ``{"medium.glass.eta": [1.3, 1.5],
            "a": "0:1:0.25"}``.
        method_files: Approximations of your own, files of WGSL.
        obj: A closed mesh to judge in place of a scene, its camera fitted.
        map: Lat-long environment in place of the scene's own, linear.
        eta: Absolute index of refraction in place of the scene's own.
        resolution: Pixels, one side or (width, height), or several of these.
        supersampling: k of the k x k positions per pixel that a timed frame draws. [1]
        positions: k of the k x k positions per pixel on both sides. [4]
        cut: Weight, of 1 per camera ray, below which a branch of the exact tree is cut. [1e-4]
        timing_s: Seconds for which each method is timed. [0.5]
        budget_ms: Say which method is best within this many milliseconds per frame.
        quick: As ``--quick``: smaller and sooner.
        images: Images of others by name, judged too; ``"SCENE:NAME"`` for one scene.
        times_ms: Milliseconds of their frames, by the same names.
        adapter: GPU: index or part of its name. [the fastest kind]
        cache: Folder of exact images. [the user's cache]
        out: Folder of the results. ``None``: a temporary one, gone when Python ends.
        progress: Show how far the work is. ``None``: in notebooks and on terminals.

    Returns:
        All numbers, one per row.

    Raises:
        SnellError: If something is wrong with what was asked, in the program's words, or
            nothing could be done. A method that cannot show a scene is in ``left_out``.
    """
    folder = _temporary() if out is None else Path(out)
    asked = words_of(
        scene, folder, methods=methods, sweep=sweep, method_files=method_files, obj=obj, map=map,
        eta=eta, resolution=resolution, supersampling=supersampling, positions=positions, cut=cut,
        timing_s=timing_s, budget_ms=budget_ms, quick=quick, images=images, times_ms=times_ms,
    )  # fmt: skip
    asked += ["--out", os.fspath(folder)]
    asked += _option("--adapter", adapter) + _option("--cache", cache)
    call("study", *asked, progress=progress)
    return results(folder)


def words_of(
    scene: scenes.Scene | Sequence[scenes.Scene] | None,
    folder: Path,
    *,
    methods: Iterable[str] = (),
    sweep: Sweep | None = None,
    method_files: Iterable[str | os.PathLike[str]] = (),
    obj: str | os.PathLike[str] | None = None,
    map: str | os.PathLike[str] | None = None,
    eta: float | None = None,
    resolution: Size | Sequence[Size] | None = None,
    supersampling: Iterable[int] = (),
    positions: int | None = None,
    cut: float | None = None,
    timing_s: float | None = None,
    budget_ms: float | None = None,
    quick: bool = False,
    images: Mapping[str, str | os.PathLike[str]] | None = None,
    times_ms: Mapping[str, float] | None = None,
) -> list[str]:
    """What a study is asked, as words for ``snell study``, ``jobs`` and ``run``. Scenes that
    are dictionaries are written below the folder."""
    one = scene is None or isinstance(scene, (str, os.PathLike, Mapping))
    several: Sequence[Any] = ([] if scene is None else [scene]) if one else scene  # type: ignore[assignment]
    said = [scenes.word(each, folder) for each in several]
    if len(set(said)) < len(said):
        raise SnellError("two scenes have one name; give each dictionary a `name` of its own")
    said += words("--method", [methods] if isinstance(methods, str) else methods)
    said += words("--method-file", (os.fspath(path) for path in method_files))
    for key, values in (sweep or {}).items():
        of_scene = "." in key and key.split(".")[0] in _SECTIONS
        said += ["--set" if of_scene else "--param", f"{key}={_values(key, values)}"]
    sizes = [resolution] if isinstance(resolution, (int, tuple)) else resolution or []
    said += words("--resolution", (s if isinstance(s, int) else f"{s[0]}x{s[1]}" for s in sizes))
    said += words("--supersampling", supersampling)
    said += words("--image", (f"{name}={os.fspath(path)}" for name, path in (images or {}).items()))
    said += words("--time", (f"{name}={time!r}" for name, time in (times_ms or {}).items()))
    said += _option("--obj", obj) + _option("--map", map) + _option("--eta", eta)
    said += _option("--positions", positions) + _option("--cut", cut)
    said += _option("--timing", timing_s) + _option("--budget-ms", budget_ms)
    return said + (["--quick"] if quick else [])


def _option(name: str, value: object) -> list[str]:
    return [] if value is None else [name, str(value)]


def _values(key: str, values: object) -> str:
    """A value, a list of them, or a range that is text already."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        return str(values)
    if not (listed := [str(value) for value in values]):
        raise SnellError(f"{key}: there are no values to sweep over")
    return ",".join(listed)


def _temporary() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="snell-"))
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    return folder


def results(folder: str | os.PathLike[str]) -> Frame:
    """The results that ``snell study`` or ``snell collect`` left in a folder.

    Raises:
        SnellError: If there are none, or they are of another major version.
    """
    folder = Path(folder)
    try:
        lines = (folder / "results.jsonl").read_text(encoding="utf-8").splitlines()
        told = json.loads((folder / "study.json").read_text(encoding="utf-8"))
        rows = [json.loads(line) for line in lines if line.strip()]
    except (OSError, ValueError) as error:
        raise SnellError(f"{folder} holds no results: {error}; `snell study` writes them") from error
    _known(told.get("schema"), "snell.study/1", folder)
    for row in rows:
        _known(row.get("schema"), "snell.result/2", folder)
    frame = Frame(rows)
    for column in ("value", "ci_lo", "ci_hi"):
        frame[column] = frame[column].astype("float64")
    frame["seed"] = pd.array(frame["seed"].tolist(), dtype="UInt64")
    frame.folder, frame.study = folder.absolute(), told
    return frame


def _known(found: object, expected: str, folder: Path) -> None:
    if found != expected:
        raise SnellError(f"{folder}: schema {found}, but this package reads {expected}")
