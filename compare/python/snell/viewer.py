"""The images of a study in a notebook: one file of HTML without scripts."""

import base64
import html
import uuid
from pathlib import Path

from snell.frame import Frame
from snell.process import SnellError

#: Places of a study that are shown.
MOST = 8


class Viewer:
    """Exact and approximate images of a study, side by side, with maps of their errors.

    A notebook shows it where it is the last value of a cell. Choosing a method shows its
    image beside the exact one, the map of FLIP (0 to 1, what a person sees), and of the exit
    angle in degrees.
    """

    def __init__(self, frame: Frame) -> None:
        if frame.folder is None:
            raise SnellError("this frame is of no study; look at what snell.study returned")
        self._pictures = frame.folder / "pictures"
        self._exact = sorted(self._pictures.glob("*-exact.png"))
        if not self._exact:
            raise SnellError(f"{frame.folder} holds no pictures; its images were not kept")
        self._adapter = str(frame.study.get("adapter", ""))

    def _repr_html_(self) -> str:
        name = f"snell-{uuid.uuid4().hex[:8]}"
        places = [self._place(path, f"{name}-{i}") for i, path in enumerate(self._exact[:MOST])]
        rest = len(self._exact) - len(places)
        more = f"<p>{rest} more places are in {html.escape(str(self._pictures))}.</p>" if rest else ""
        return f'<div class="{name}">{_style(name)}{"".join(places)}{more}</div>'

    def _place(self, exact: Path, name: str) -> str:
        """A scene: the exact image, and a choice of methods."""
        stem = exact.name.removesuffix("-exact.png")
        shown = [_figure(exact, "exact")]
        choices, panels = [], []
        for index, path in enumerate(self._methods(stem)):
            method = path.stem.removeprefix(f"{stem}-")
            checked = " checked" if index == 0 else ""
            choices.append(
                f'<input type="radio" name="{name}" id="{name}-{index}"{checked}>'
                f'<label for="{name}-{index}">{html.escape(method)}</label>'
            )
            maps = [(path.with_name(f"{path.stem}-{kind}.png"), kind) for kind in ("flip", "angle")]
            figures = [_figure(path, method)]
            figures += [_figure(map_, _MEANING[kind]) for map_, kind in maps if map_.is_file()]
            panels.append(f'<div class="panel p{index}">{"".join(figures)}</div>')
        title = f"<h4>{html.escape(stem.replace('_', ' '))}</h4>"
        pictures = f'<div class="row">{"".join(shown)}{"".join(panels)}</div>'
        return f'<section>{title}{"".join(choices)}{pictures}</section>'

    def _methods(self, stem: str) -> list[Path]:
        """Images of methods, each of which has a map of its error."""
        own = self._pictures.glob(f"{_literal(stem)}-*.png")
        return sorted(path for path in own if path.with_name(f"{path.stem}-flip.png").is_file())


_MEANING = {"flip": "FLIP, 0 to 1", "angle": "exit angle, degrees"}


def _literal(text: str) -> str:
    return "".join(f"[{c}]" if c in "*?[" else c for c in text)


def _figure(path: Path, caption: str) -> str:
    data = base64.b64encode(path.read_bytes()).decode()
    text = html.escape(caption)
    return (
        f'<figure><img alt="{text}" src="data:image/png;base64,{data}">'
        f"<figcaption>{text}</figcaption></figure>"
    )


def _style(name: str) -> str:
    chosen = ", ".join(
        f".{name} input:nth-of-type({i + 1}):checked ~ .row .p{i}" for i in range(32)
    )
    return (
        f"<style>.{name} .row, .{name} .panel {{ display: flex; gap: 8px; }}"
        f".{name} .panel {{ display: none; }} {chosen} {{ display: flex; }}"
        f".{name} figure {{ margin: 0; }} .{name} figcaption {{ font-size: 85%; }}"
        f".{name} img {{ min-width: 160px; max-width: 240px; image-rendering: pixelated; }}"
        f".{name} label {{ margin: 0 12px 0 4px; }}</style>"
    )
