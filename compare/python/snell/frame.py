"""Results as a data frame: one number per row."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import pandas as pd

if TYPE_CHECKING:
    from snell.viewer import Viewer

#: What tells one run from another.
_KEYS = ("scene", "method", "positions", "width_px", "height_px", "frame", "id")
_USABLE = ("ok", "identical")


class MetricError(ValueError):
    """A number was asked for that is not there, or that its row says not to use."""


class Frame(pd.DataFrame):
    """Rows of ``results.jsonl``: one number per row, its unit in the column ``unit``.

    ``snell schema result`` says what every column means. Columns that only some rows have
    (``param.a``, ``scene.medium.glass.eta``) are NaN elsewhere. A row without a value says
    why in ``status`` and ``reason``.

    Attributes:
        folder: The folder of the results, with its report and images.
        study: What ``study.json`` holds: adapter, driver, command, plans, what was left out.
    """

    _metadata: ClassVar[list[str]] = ["folder", "study"]
    folder: Path | None = None
    study: Mapping[str, Any] = {}

    @property
    def _constructor(self) -> type[Frame]:
        return Frame

    @property
    def left_out(self) -> pd.DataFrame:
        """What was asked for and not done (``what``), and why (``reason``)."""
        return pd.DataFrame(self.study.get("left_out", []), columns=["what", "reason"])

    def pivot_metrics(self, metrics: Iterable[str] | None = None) -> pd.DataFrame:
        """One row per run and number of positions, one column per metric.

        The index says which run it is: scene, method, positions (k of the k x k in each
        pixel), and what differs among the runs of a method. Columns have the names of
        ``wide.csv``: a metric over the object's pixels only ends in ``.object``. Errors stand
        where ``positions`` is that of the study; times (``time_wall_ms``) where it is what
        a timed frame draws, beside the error that such a frame has against the pixel's
        integral.

        Args:
            metrics: Which columns, in this order. ``None``: all.

        Raises:
            MetricError: If a metric is in no row, or a row of one says that its input
                was not finite.
        """
        name = self["metric"].where(self["mask"] == "all", self["metric"] + ".object")
        if metrics is not None:
            metrics = [metrics] if isinstance(metrics, str) else list(metrics)
            if missing := [metric for metric in metrics if metric not in set(name)]:
                known = ", ".join(sorted(set(name)))
                raise MetricError(f"no row has the metric {missing[0]}; there are {known}")
            self._usable(self[name.isin(metrics)])
        keys = [key for key in _KEYS if key in self]
        keys += [name for name in map(str, self) if name.startswith(("param.", "scene."))]
        run = pd.Series(list(self[["id", "scene", "positions"]].itertuples(index=False)), self.index)
        runs = pd.DataFrame(self[keys]).groupby(run, sort=False).first()
        values = self["value"].groupby([run, name], sort=False).first().unstack()
        values = values[metrics if metrics is not None else list(dict.fromkeys(name))]
        values = values.reindex(runs.index).dropna(how="all")
        runs = runs.loc[values.index]
        values.index = pd.MultiIndex.from_frame(runs[_telling(runs)])
        values.columns.name = None
        return pd.DataFrame(values)

    def number(self, metric: str, mask: str = "all", /, **where: object) -> float:
        """The one number of a metric, in the unit that the metric's name or ``unit`` says.

        Args:
            metric: Such as ``exit_angle_median_deg`` or ``time_wall_ms``.
            mask: ``all`` pixels, or those of the ``object``.
            where: Values of columns, such as ``method="blended"``; names with dots as
                ``**{"scene.medium.glass.eta": 1.5}``.

        Raises:
            MetricError: If there is no such row or more than one, or the row says that
                its value cannot be used.
        """
        asked = {"metric": metric, "mask": mask, **where}
        rows = self
        for column, value in asked.items():
            if column not in rows:
                raise MetricError(f"there is no column {column}")
            rows = rows[rows[column] == value]
        if len(rows) != 1:
            differs = [str(c) for c in rows if len(rows) and rows[c].astype(str).nunique() > 1]
            hint = f"; they differ in {', '.join(differs)}" if differs else ""
            raise MetricError(f"{len(rows)} rows have {asked}{hint}")
        self._usable(rows)
        return float(rows["value"].iloc[0])

    @staticmethod
    def _usable(rows: pd.DataFrame) -> None:
        """Raises for the first row that is invalid, or alone and without a value."""
        bad = rows[~rows["status"].isin(_USABLE)]
        if len(rows) > 1:
            bad = bad[bad["status"] == "invalid"]
        if len(bad):
            row = bad.iloc[0]
            raise MetricError(
                f"{row['scene']}, {row['method']}: {row['metric']} is {row['status']}: {row['reason']}"
            )

    def view(self) -> Viewer:
        """The images of the study, exact and approximate, to look at in a notebook.

        Raises:
            SnellError: If this is no whole study, or its folder is gone.
        """
        from snell.viewer import Viewer

        return Viewer(self)


def _telling(runs: pd.DataFrame) -> list[str]:
    """Columns that tell the runs apart: what differs among those of one method."""
    of_method = runs.groupby(["scene", "method"], sort=False)
    differs = [
        key
        for key in map(str, runs)
        if key not in (*_KEYS[:3], "id") and (of_method[key].nunique(dropna=False) > 1).any()
    ]
    telling = [*_KEYS[:3], *differs]
    return [*telling, "id"] if runs[telling].duplicated().any() else telling
