"""Scenes as names, files or dictionaries."""

import os
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeAlias

import tomli_w

from snell.process import SnellError

#: The name of a built-in scene, a scene file or study file, or what a scene file says: its
#: tables as dictionaries, and the key ``name``.
Scene: TypeAlias = str | os.PathLike[str] | Mapping[str, Any]


def word(scene: Scene, folder: Path) -> str:
    """The scene as a word of the command line. A dictionary is written to
    ``folder/scenes/NAME.toml``; files that it names are relative to the folder of this
    process.

    Raises:
        SnellError: If a dictionary has a value that no scene file can hold, or no
            usable name.
    """
    if not isinstance(scene, Mapping):
        return os.fspath(scene)
    name = scene.get("name", "scene")
    if not isinstance(name, str) or not re.fullmatch(r"\w[\w .-]*", name):
        raise SnellError(f"name = {name!r} is no name of a scene; write letters, digits, - and _")
    try:
        text = tomli_w.dumps(_plain({key: value for key, value in scene.items() if key != "name"}))
    except TypeError as error:
        raise SnellError(f"the scene {name} cannot be written: {error}") from error
    path = folder / "scenes" / f"{name}.toml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return os.fspath(path)


def _plain(value: Any, key: str = "") -> Any:
    """The value in types that TOML has, with files from the root."""
    if isinstance(value, Mapping):
        return {str(name): _plain(inner, str(name)) for name, inner in value.items()}
    if isinstance(value, os.PathLike) or (key in _FILES and isinstance(value, str)):
        return os.path.abspath(value)
    if hasattr(value, "tolist"):  # NumPy's numbers and arrays.
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return [_plain(inner) for inner in value]
    return value


#: Keys of a scene file whose values are files.
_FILES = ("obj", "map")
