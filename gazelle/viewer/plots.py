"""Plots for papers and pages: curves of trainings, columns of tables, fields and paths of bags."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import FormatError, MissingExtraError, did_you_mean
from gazelle.viewer.limits import MOST_PANELS
from gazelle_ros.base.text_files import read_rows
from gazelle_ros.base.writing import replacing

if TYPE_CHECKING:
    from gazelle.description import OccupancyMap

PLOTS = (".png", ".svg", ".pdf")
Series = Mapping[str, tuple[Floats, Floats]]
"""Lines by name: values along the horizontal axis and along the vertical one, shapes (n,)."""

_CURVES = {
    "episodes/success_rate": "goals reached [share]",
    "episodes/return": "return of an episode",
}
_LARGEST = 1e100
_LONGEST_NAME = 80
_STYLES = ("-", "--", "-.", ":")  # distinguished in print, too


def plot_trainings(runs: Sequence[Path], file: Path) -> None:
    """Plot success and return over control steps of one training or several.

    Args:
        runs: Their folders.
        file: The picture; its suffix is one of `PLOTS`.

    Raises:
        FormatError: A folder has no ``progress.csv``, or nothing is in it.
        MissingExtraError: Matplotlib is not installed.
    """
    tables = {run.resolve().name: read_table(run / "progress.csv") for run in runs}
    figure = _figure(2)
    for axes, (column, label) in zip(figure.axes, _CURVES.items(), strict=True):
        lines = {
            name: (table["time/steps"], table[column])
            for name, table in tables.items()
            if column in table
        }
        draw_lines(axes, lines, "", label)
    figure.axes[0].set_ylim(-0.02, 1.02)
    figure.axes[-1].set_xlabel("control steps")
    _save(figure, file)


def plot_table(table: Path, columns: Sequence[str], file: Path) -> None:
    """Plot columns of a table of numbers over its first one, one above the other.

    Args:
        table: A ``.csv`` file, such as a performance analyser writes.
        columns: Their names; all that hold numbers if there are none.
        file: The picture.

    Raises:
        FormatError: There is no such column, or nothing to draw.
        MissingExtraError: Matplotlib is not installed.
    """
    found = read_table(table)
    first, *others = found or [""]
    for name in columns:
        if name not in found:
            hint = did_you_mean(name, others)
            raise FormatError(f"there is no column '{name}' of numbers", file=str(table), hint=hint)
    drawn = list(columns) or others
    if not drawn:
        number = "one" if found else "no"
        text = f"there is {number} column of numbers, and nothing to draw"
        raise FormatError(text, file=str(table))
    plot_series({name: (found[first], found[name]) for name in drawn}, first, file)


def plot_series(series: Series, horizontal: str, file: Path) -> None:
    """Plot lines one above the other over a common axis.

    Args:
        series: The lines; names with the same text before the last ``/`` share a panel.
        horizontal: Quantity of the common axis.
        file: The picture.

    Raises:
        FormatError: There are more than 50 panels.
        MissingExtraError: Matplotlib is not installed.
    """
    panels: dict[str, dict[str, tuple[Floats, Floats]]] = {}
    for name, line in series.items():
        panels.setdefault(name.rpartition("/")[0] or name, {})[name] = line
    if len(panels) > MOST_PANELS:
        raise FormatError(
            f"{len(panels)} columns are more than the {MOST_PANELS} that one picture has",
            hint="name those that matter: --field NAME",
        )
    figure = _figure(len(panels))
    for axes, (name, lines) in zip(figure.axes, panels.items(), strict=True):
        draw_lines(axes, lines, "", name if len(lines) > 1 else next(iter(lines)))
    figure.axes[-1].set_xlabel(_short(horizontal))
    _save(figure, file)


def plot_paths(paths: Mapping[str, Floats], grid: OccupancyMap | None, file: Path) -> None:
    """Plot paths in the plane, over a map if there is one.

    Args:
        paths: x and y [m] by name, shapes (n, 2).
        grid: The map, in the same frame.
        file: The picture.

    Raises:
        MissingExtraError: Matplotlib is not installed.
    """
    figure = _figure(1)
    (axes,) = figure.axes
    if grid is not None:
        _draw_map(axes, grid)
    for number, (name, path) in enumerate(paths.items()):
        style = _STYLES[number % len(_STYLES)]
        (line,) = axes.plot(*path.T, style, label=name, linewidth=1.5)
        axes.plot(*path[0], "o", color=line.get_color(), markersize=5)
        axes.plot(*path[-1], "s", color=line.get_color(), markersize=5)
    axes.set_aspect("equal")
    axes.set_xlabel("x [m]")
    axes.set_ylabel("y [m]")
    if paths:
        beside = {"loc": "upper left", "bbox_to_anchor": (1.02, 1.0)}
        axes.legend(fontsize="small", title="from dot to square", **beside)
    _save(figure, file)


def draw_lines(axes: Any, lines: Series, horizontal: str, vertical: str) -> None:
    """Draw lines into one panel; values beyond 1e100 are left out."""
    for number, (name, (x, y)) in enumerate(lines.items()):
        style = "o" if len(x) == 1 else _STYLES[number % len(_STYLES)]  # one point has no line
        axes.plot(_drawable(x), _drawable(y), style, label=_short(name), linewidth=1.5)
    axes.set_xlabel(_short(horizontal))
    axes.set_ylabel(_short(vertical))
    axes.grid(alpha=0.3)
    if len(lines) > 1:
        axes.legend(loc="best", fontsize="small")


def _drawable(values: Floats) -> Floats:
    """Return values with NaN where they are too large for the arithmetic of axes."""
    given = np.asarray(values, np.float64)
    return np.where(np.abs(given) <= _LARGEST, given, np.nan)


def _short(name: str) -> str:
    return name if len(name) <= _LONGEST_NAME else f"{name[:_LONGEST_NAME]}..."


def read_table(path: Path) -> dict[str, Floats]:
    """Read the columns of a ``.csv`` file that hold numbers; cells without one are NaN.

    Raises:
        FormatError: There is no such file, or no row in it.
    """
    try:
        rows = read_rows(path)[1]
    except OSError as error:
        raise FormatError(f"cannot read it: {error.strerror}", file=str(path)) from error
    if not rows:
        hint = "a training writes its first row after some updates"
        raise FormatError("the table has no rows", file=str(path), hint=hint)
    # Cells beyond the columns of the first row have no name.
    names = [name for name in rows[0] if name is not None]
    columns = {name: np.array([_number(row[name]) for row in rows]) for name in names}
    return {name: values for name, values in columns.items() if not np.isnan(values).all()}


def _number(text: str | None) -> float:
    try:
        return float(text or math.nan)
    except ValueError:
        return {"True": 1.0, "False": 0.0}.get(text or "", math.nan)


def _draw_map(axes: Any, grid: OccupancyMap) -> None:
    """Draw occupied cells dark, unknown ones grey."""
    shade = np.where(grid.data < 0, 0.8, 1.0 - np.clip(grid.data, 0, 100) / 100.0 * 0.75)
    x, y, _ = grid.origin.position
    width, height = grid.size
    axes.imshow(
        shade, cmap="gray", vmin=0.0, vmax=1.0, origin="lower", extent=(x, x + width, y, y + height)
    )


def _figure(panels: int) -> Any:
    """Return a figure with a given number of panels above each other."""
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise MissingExtraError("matplotlib", "plots") from None
    figure: Any = Figure(figsize=(7.0, max(4.0, 2.2 * panels)), layout="constrained")
    FigureCanvasAgg(figure)
    figure.subplots(panels, 1, sharex=panels > 1)
    return figure


def _save(figure: Any, file: Path) -> None:
    if file.suffix.lower() not in PLOTS:
        raise FormatError(
            f"a plot is written as {', '.join(PLOTS)}, not as '{file.suffix}'", file=str(file)
        )
    for text in figure.findobj(lambda artist: hasattr(artist, "set_parse_math")):
        text.set_parse_math(False)  # names of columns may have dollars
    try:
        with replacing(file) as draft:
            figure.savefig(draft, dpi=120)
    except OSError as error:
        raise FormatError(f"cannot write it: {error.strerror}", file=str(file)) from error
