"""Images as arrays."""

from pathlib import Path

import numpy as np
import pytest
import snell


def path_of(frame: snell.Frame, method: str) -> Path:
    run = next(run for run in frame.study["runs"] if run["method"] == method)
    return frame.folder / run["image"]


def test_layers_have_their_shapes_and_meanings(frame: snell.Frame) -> None:
    path = path_of(frame, "reference")
    assert {"radiance": 3, "exit": 3, "coverage": 1}.items() <= snell.layers(path).items()
    radiance, exit_ws, coverage = (snell.read(path, layer) for layer in ("radiance", "exit", "coverage"))
    assert radiance.shape == exit_ws.shape == (24, 24, 3) and coverage.shape == (24, 24)
    length = np.linalg.norm(exit_ws, axis=-1)
    assert set(np.round(length, 4).ravel()) <= {0.0, 1.0}
    assert (length[coverage == 0] == 0).all() and (length[8:16, 8:16] > 0).all()
    # The sky is blue above: channels are not swapped, rows are from the top.
    assert radiance[0, 0, 2] > radiance[0, 0, 0]
    assert radiance[0].mean() != radiance[-1].mean()
    with pytest.raises(snell.SnellError, match="has no layer nothing; it has radiance"):
        snell.read(path, "nothing")
    with pytest.raises(snell.SnellError, match="cannot be read as OpenEXR"):
        snell.read(frame.folder / "study.json")


def test_an_image_tells_what_it_is_as_its_rows_do(frame: snell.Frame) -> None:
    for method in ("reference", "two-interface"):
        told = snell.attributes(path_of(frame, method))
        rows = frame[(frame["id"] == told["id"])]
        assert len(rows) and set(rows["method"]) == {told["method"]} == {method}
        for name, value in told.items():
            if name not in ("positions",):
                assert str(rows[name].iloc[0]) in (value, f"{value}.0"), name
    assert told["param.back_select"] == "farthest" and told["scene.medium.glass.eta"] == "1.2"


def test_arrays_and_files_are_compared_alike(frame: snell.Frame) -> None:
    files = [path_of(frame, method) for method in ("reference", "two-interface")]
    arrays = [snell.read(file) for file in files]
    found = snell.compare(*arrays).set_index("metric")["value"]
    named = snell.compare(*files)
    named = named[named["mask"] == "all"].set_index("metric")["value"]
    np.testing.assert_array_equal(found, named[found.index])
    mse = np.mean((arrays[1].astype(float) - arrays[0]) ** 2)
    assert found["mse"] == pytest.approx(mse, rel=1e-9)


def test_what_is_no_image_raises(frame: snell.Frame) -> None:
    image = snell.read(path_of(frame, "reference"))
    broken = image.copy()
    broken[3, 2, 0] = np.nan
    snell.compare(image, image)
    with pytest.raises(snell.SnellError, match=r"NaN or infinite, the first at pixel \(2, 3\)"):
        snell.compare(image, broken)
    with pytest.raises(snell.SnellError, match="no image; give linear radiance"):
        snell.compare(image, image[..., 0])


def test_the_viewer_shows_every_method_without_scripts(frame: snell.Frame) -> None:
    html = frame.view()._repr_html_()
    assert html.count('type="radio"') == 4 and "<script" not in html
    assert html.count("<img ") == 2 * (1 + 2 * 3)
    assert "two-interface" in html and "exit angle, degrees" in html
    with pytest.raises(snell.SnellError, match="of no study"):
        snell.Frame({"value": [1.0]}).view()
