"""Studies as data frames."""

import csv
import json
import os
import signal
import subprocess
from pathlib import Path

import jsonschema
import numpy as np
import pandas as pd
import pytest
import snell
from snell import process as process_module

ETA = "scene.medium.glass.eta"


def test_columns_have_their_own_types(frame: snell.Frame) -> None:
    assert frame["value"].dtype == np.float64 and frame["positions"].dtype == np.int64
    assert set(frame[ETA]) == {1.2, 1.5}
    assert frame["software"].dtype == bool
    own = frame[frame["method"] == "two-interface"]
    assert set(own["param.back_select"]) == {"farthest"}
    assert frame[frame["method"] == "reference"]["param.samples"].dtype == np.float64


def test_a_pivot_has_the_numbers_of_wide_csv(frame: snell.Frame) -> None:
    pivot = frame.pivot_metrics()
    with open(frame.folder / "wide.csv", newline="") as file:
        wide = list(csv.DictReader(file))
    assert len(pivot) == len(wide)
    for metric in ("flip_hdr.object", "relmse_e1e-2", "time_wall_ms"):
        expected = [float(row[metric]) if row[metric] else np.nan for row in wide]
        np.testing.assert_allclose(pivot[metric], expected, rtol=1e-12)
    assert pivot.index.names == ["scene", "method", "positions", "param.cut", "param.samples", ETA] or (
        ETA in pivot.index.names
    )
    assert not pivot.index.duplicated().any()


def test_the_index_is_felt_by_light_that_bends_once(frame: snell.Frame) -> None:
    """A method that bends once is the more wrong the more the second surface bends."""
    error = {eta: frame.number("exit_angle_median_deg", method="one-interface", **{ETA: eta}) for eta in (1.2, 1.5)}
    assert error[1.2] < error[1.5]


def test_slices_stay_frames_and_parquet_brings_them_back(frame: snell.Frame, tmp_path: Path) -> None:
    errors = frame[frame["kind"] == "error"]
    assert isinstance(errors, snell.Frame) and errors.folder == frame.folder
    errors.to_parquet(tmp_path / "errors.parquet")
    back = pd.read_parquet(tmp_path / "errors.parquet")
    pd.testing.assert_frame_equal(back, pd.DataFrame(errors), check_dtype=False)


def test_a_number_is_one_number(frame: snell.Frame) -> None:
    with pytest.raises(snell.MetricError, match=r"4 rows .* they differ in .*method"):
        frame.number("flip_hdr")
    with pytest.raises(snell.MetricError, match="0 rows"):
        frame.number("flip_hdr", method="nobody")
    with pytest.raises(snell.MetricError, match="no row has the metric flip;"):
        frame.pivot_metrics("flip")


def test_a_row_that_is_invalid_raises_and_its_twin_does_not(frame: snell.Frame) -> None:
    asked = {"method": "two-interface", ETA: 1.5}
    assert frame.number("flip_hdr", **asked) > 0
    assert len(frame.pivot_metrics("flip_hdr"))
    broken = frame.copy()
    row = (broken["metric"] == "flip_hdr") & (broken["method"] == "two-interface") & (broken["mask"] == "all")
    broken.loc[row, ["status", "reason"]] = ["invalid", "candidate: NaN"]
    for ask in (lambda: broken.number("flip_hdr", **asked), lambda: broken.pivot_metrics("flip_hdr")):
        with pytest.raises(snell.MetricError, match="flip_hdr is invalid: candidate: NaN"):
            ask()


def test_rows_and_study_are_what_their_schemas_say(frame: snell.Frame) -> None:
    read = {name: snell.call("schema", name)[0] for name in ("result", "study", "measurement")}
    lines = (frame.folder / "results.jsonl").read_text().splitlines()
    row = json.loads(lines[0])
    check = jsonschema.Draft202012Validator(read["result"])
    for line in lines:
        check.validate(json.loads(line))
    # The controls differ from a row that passes in one field each.
    for wrong in ({**row, "positions": "4"}, {**row, "mask": "none"}, {**row, "schema": "snell.result/9"}):
        assert not check.is_valid(wrong)
    assert not check.is_valid({key: row[key] for key in row if key != "metric"})
    jsonschema.validate(frame.study, read["study"])
    image = frame.folder / frame.study["runs"][0]["image"]
    for line in snell.call("compare", image, image):
        jsonschema.validate(line, read["measurement"])


def test_a_scene_can_be_a_dictionary(cache: Path, tmp_path: Path) -> None:
    scene = {
        "name": "my ball",
        "camera": {
            "eye": (0, 0, 4),
            "target": np.zeros(3),
            "vertical_fov_deg": 35.0,
            "resolution_px": [16, 16],
        },
        "environment": {"radiance": [1.0, 1.0, 1.0]},
        "object": [
            {
                "shape": {"sphere": {"radius_m": np.float64(1.0)}},
                "surface": "dielectric",
                "medium": {"eta": 1.5},
            }
        ],
    }
    asked = {"methods": "undeviated", "positions": 1, "timing_s": 0, "quick": True, "resolution": 16, "cache": cache}
    frame = snell.study(scene, out=tmp_path / "out", **asked)
    assert set(frame["scene"]) == {"my ball"}
    assert frame.folder == tmp_path / "out"
    with pytest.raises(snell.SnellError, match="unknown field `objekt`"):
        snell.study({**scene, "objekt": 1}, **asked)
    with pytest.raises(snell.SnellError, match="no name of a scene"):
        snell.study({**scene, "name": "../x"}, **asked)


def test_what_the_program_refuses_is_raised_in_its_words() -> None:
    with pytest.raises(snell.SnellError, match="no built-in scene is called") as caught:
        snell.study("no-such-scene", progress=False)
    assert caught.value.exit_status == 2
    with pytest.raises(snell.SnellError, match="--no-such-option"):
        snell.call("scenes", "--no-such-option")
    with pytest.raises(snell.SnellError, match="holds no results"):
        snell.results("/no/such/folder")


def test_a_program_that_is_killed_raises_and_nothing_else_dies(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    script = tmp_path / "snell"
    script.write_text('#!/bin/sh\n[ "$1" = --version ] && exec "$REAL" --version\nkill -SEGV $$\n')
    script.chmod(0o755)
    monkeypatch.setenv("REAL", os.fspath(snell.program()))
    monkeypatch.setenv("SNELL", os.fspath(script))
    with pytest.raises(snell.SnellError, match="killed by signal 11") as caught:
        snell.call("scenes")
    assert caught.value.exit_status == -signal.SIGSEGV
    monkeypatch.undo()
    assert len(snell.call("scenes")) > 10


def test_a_program_of_another_version_is_refused(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    script = tmp_path / "snell"
    script.write_text("#!/bin/sh\necho snell 0.0.1\n")
    script.chmod(0o755)
    monkeypatch.setenv("SNELL", os.fspath(script))
    with pytest.raises(snell.SnellError, match=r"of version 0\.0\.1, and this package of"):
        snell.program()


def test_progress_is_told_and_an_interrupt_leaves_no_process(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    import contextlib

    told: list[float] = []
    started: list[subprocess.Popen[str]] = []

    @contextlib.contextmanager
    def interrupting(_: object):  # type: ignore[no-untyped-def]
        def report(share: float, work: str) -> None:
            told.append(share)
            raise KeyboardInterrupt

        yield report

    class Noted(subprocess.Popen):  # type: ignore[type-arg]
        def __init__(self, *words: object, **options: object) -> None:
            super().__init__(*words, **options)  # type: ignore[call-overload]
            started.append(self)

    monkeypatch.setattr(process_module, "reporter", interrupting)
    monkeypatch.setattr(process_module.subprocess, "Popen", Noted)
    with pytest.raises(KeyboardInterrupt):
        snell.call("reference", "ball", "-o", tmp_path / "a.exr", "--resolution", "512")
    assert told and started[-1].returncode == -signal.SIGKILL
    assert not (tmp_path / "a.exr").exists()
