"""Images as arrays, and how far apart they are."""

import os
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

import numpy as np
import OpenEXR
import pandas as pd
from numpy.typing import NDArray

from snell.process import SnellError, call, words

#: A file, or linear radiance as an array, height x width x 3.
Image: TypeAlias = str | os.PathLike[str] | NDArray[np.floating[Any]]

#: Channels of a layer in their order: of light, and of directions and positions.
_ORDER = "RGBAXYZW"


def _open(path: str | os.PathLike[str]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Header and channels of the first part of a file."""
    try:
        file = OpenEXR.File(os.fspath(path), separate_channels=True)
        return dict(file.header()), dict(file.channels())
    except Exception as error:  # The library raises what it likes.
        raise SnellError(f"{os.fspath(path)}: it cannot be read as OpenEXR: {error}") from error


def _grouped(channels: Mapping[str, Any]) -> dict[str, list[str]]:
    """Names of layers, each with the names of its channels in order."""
    found: dict[str, list[str]] = {}
    for channel in channels:
        layer, dot, _ = channel.rpartition(".")
        found.setdefault(layer if dot else "radiance", []).append(channel)
    for names in found.values():
        names.sort(key=lambda name: _ORDER.find(name.rpartition(".")[2]))
    return found


def layers(path: str | os.PathLike[str]) -> dict[str, int]:
    """Layers of an OpenEXR file, each with its number of channels."""
    return {name: len(channels) for name, channels in _grouped(_open(path)[1]).items()}


def attributes(path: str | os.PathLike[str]) -> dict[str, str]:
    """What an OpenEXR file of this program tells of itself: ``scene``, ``method``, ``id``,
    ``param.…``, under the names that the columns of results have."""
    ours = ((name.partition("snell:"), value) for name, value in _open(path)[0].items())
    return {name: str(value) for (_, mark, name), value in ours if mark}


def read(path: str | os.PathLike[str], layer: str = "radiance") -> NDArray[np.float32]:
    """A layer of an OpenEXR file.

    ``radiance`` is linear, in the unit of the scene's lights; ``exit`` the unit direction in
    world space in which each ray leaves the glass, zero where none does; ``hit2`` and
    ``exit_position`` are metres; ``coverage`` is a share, 0 to 1. ``snell methods`` lists those
    of each method.

    Returns:
        Height x width, or height x width x channels (R, G, B or X, Y, Z); rows from the top.

    Raises:
        SnellError: If the file cannot be read or has no such layer.
    """
    _, channels = _open(path)
    names = _grouped(channels).get(layer)
    if names is None:
        there = ", ".join(_grouped(channels))
        raise SnellError(f"{os.fspath(path)} has no layer {layer}; it has {there}")
    planes = [np.asarray(channels[name].pixels, dtype=np.float32) for name in names]
    return planes[0] if len(planes) == 1 else np.stack(planes, axis=-1)


def compare(
    reference: Image,
    test: Image,
    *,
    flip_exposures: tuple[float, float, int] | None = None,
    alpha: str | None = None,
    display_ev: float | None = None,
) -> pd.DataFrame:
    """Measures how far an image is from a reference: ``snell compare``.

    Args:
        reference: What is taken as true: a file, or linear radiance, height x width x 3.
        test: What is judged.
        flip_exposures: Of HDR-FLIP: first and last in stops, and how many. [from the reference]
        alpha: What transparent pixels lie over: ``over-black``, ``over-white``, ``ignore``.
        display_ev: Compare as display images, at this exposure in stops.

    Returns:
        One metric per row: ``metric``, ``mask``, ``value``, ``unit``, ``n`` (pixels),
        ``status``, ``reason``, ``formula``, and the 95 % interval ``ci_lo`` to ``ci_hi`` where the
        noise of the reference is known.

    Raises:
        SnellError: If the two cannot be compared, or hold NaN or infinity.
    """
    with tempfile.TemporaryDirectory(prefix="snell-") as folder:
        files = [
            _file(image, Path(folder) / name)
            for image, name in ((reference, "reference.exr"), (test, "test.exr"))
        ]
        options: list[str] = []
        if flip_exposures is not None:
            options += ["--flip-exposures", ",".join(str(part) for part in flip_exposures)]
        options += words("--alpha", [] if alpha is None else [alpha])
        options += [] if display_ev is None else [f"--display=ev={display_ev}"]
        answer = call("compare", *files, *options)
    frame = pd.DataFrame(answer).drop(columns=["schema", "warnings"])
    numbers = ["value", "ci_lo", "ci_hi"]
    frame[numbers] = frame[numbers].astype("float64")
    return frame


def _file(image: Image, place: Path) -> str:
    if not isinstance(image, np.ndarray):
        return os.fspath(image)
    if image.ndim != 3 or image.shape[2] != 3 or not np.issubdtype(image.dtype, np.floating):
        raise SnellError(
            f"an array of {image.dtype}, {' x '.join(map(str, image.shape))}, is no image; give "
            "linear radiance, height x width x 3, or the name of a file"
        )
    planes = np.ascontiguousarray(image, dtype=np.float32)
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"RGB": planes}) as file:
        file.write(os.fspath(place))
    return os.fspath(place)
