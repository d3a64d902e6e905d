"""Picture of failed episodes of an evaluation, on the floor plan of their world."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from gazelle.array_types import Picture
from gazelle.errors import TaskError

if TYPE_CHECKING:
    from gazelle.training import EpisodeRecord, Evaluation

Point = tuple[float, float]
Colour = tuple[int, int, int]

_COLOURS: dict[str, Colour] = {
    "collision": (206, 62, 52),
    "time-out": (225, 150, 40),
    "other": (150, 90, 165),
}
_PAPER, _WALL, _INK, _PALE = (250, 250, 248), (60, 60, 66), (40, 40, 44), (205, 210, 218)
_SIDE = 800  # longer side of the plan [pixel]
_FINER = 2  # drawn larger by this factor, then reduced: smooth edges
_HEAD, _EDGE = 70, 30  # of the picture: room for the legend, and around the plan [pixel]


def draw_failures(evaluation: Evaluation) -> Picture:
    """Draw the world with each failed episode: from its start over its end to its goal.

    A dot is where the episode ended, in the colour of its outcome, a cross its goal, and a
    small ring its start.

    Args:
        evaluation: Of a task that reports ``position`` or ``goal`` (x, y) [m] in its info.

    Returns:
        Shape (height, width, 3).

    Raises:
        TaskError: The task reports no places.
    """
    places = [point for record in evaluation.records for point in _points(record).values()]
    if not places:
        raise TaskError(
            "there are no places to draw: the task reports neither position nor goal",
            hint='give "position" and "goal" (x, y) in its info, or save a .csv',
        )
    plan = evaluation.floor_plan
    corners = np.array(places)
    if plan is not None:
        discs = plan.discs
        ends = [discs[:, :2] - discs[:, 2:], discs[:, :2] + discs[:, 2:]]
        corners = np.vstack((corners, plan.segments.reshape(-1, 2), *ends))
    canvas = _Canvas(corners.min(axis=0), corners.max(axis=0))
    if plan is not None:
        for x0, y0, x1, y1 in plan.segments:
            canvas.line((x0, y0), (x1, y1), _WALL, 2)
        for x, y, radius in plan.discs:
            canvas.disc((x, y), canvas.pixels(radius), _WALL)
    for record in evaluation.failures:
        _draw(canvas, record)
    canvas.legend(evaluation)
    return canvas.finished()


def _points(record: EpisodeRecord) -> dict[str, Point]:
    """Return start, end and goal of an episode, as far as known [m]."""
    values_by_name = {
        name: record.info[name] for name in ("position", "goal") if name in record.info
    }
    points: dict[str, Point] = {
        name: (values[0], values[1]) for name, values in values_by_name.items() if len(values) >= 2
    }
    if {"start_x", "start_y"} <= record.scenario.keys():
        points["start"] = (record.scenario["start_x"], record.scenario["start_y"])
    return points


def _draw(canvas: _Canvas, record: EpisodeRecord) -> None:
    colour = _COLOURS[record.outcome]
    points = _points(record)
    route = [points[name] for name in ("start", "position", "goal") if name in points]
    for here, there in itertools.pairwise(route):
        canvas.line(here, there, _PALE, 1)
    if "start" in points:
        canvas.ring(points["start"], 3.0, colour)
    if "goal" in points:
        canvas.cross(points["goal"], 4.0, colour)
    if "position" in points:
        canvas.disc(points["position"], 4.0, colour)


class _Canvas:
    """Draws in metres, x to the right and y up."""

    def __init__(self, low: NDArray[np.float64], high: NDArray[np.float64]) -> None:
        extent = np.maximum(high - low, 1e-3)
        self._scale = _SIDE / float(extent.max())
        self._low, self._high = low, high
        width, height = np.ceil(extent * self._scale).astype(int) + 2 * _EDGE
        self._size = (max(int(width), 420), int(height) + _HEAD)
        large = (self._size[0] * _FINER, self._size[1] * _FINER)
        self._image = Image.new("RGB", large, _PAPER)
        self._pen = ImageDraw.Draw(self._image)

    def pixels(self, length: float) -> float:
        """Return a length [m] in pixels."""
        return length * self._scale

    def line(self, here: Point, there: Point, colour: Colour, width: int) -> None:
        self._pen.line((self._at(here), self._at(there)), fill=colour, width=width * _FINER)

    def disc(self, middle: Point, radius: float, colour: Colour) -> None:
        self._pen.ellipse(self._box(middle, radius), fill=colour)

    def ring(self, middle: Point, radius: float, colour: Colour) -> None:
        self._pen.ellipse(self._box(middle, radius), outline=colour, width=_FINER)

    def cross(self, middle: Point, radius: float, colour: Colour) -> None:
        left, top, right, bottom = self._box(middle, radius)
        self._pen.line((left, top, right, bottom), fill=colour, width=2 * _FINER)
        self._pen.line((left, bottom, right, top), fill=colour, width=2 * _FINER)

    def legend(self, evaluation: Evaluation) -> None:
        """Draw a legend above the plan."""
        font = ImageFont.load_default(15.0 * _FINER)
        failed = evaluation.failures
        self._pen.text(
            (_EDGE * _FINER, 8 * _FINER),
            f"{evaluation.task}: {len(failed)} of {evaluation.episodes} episodes failed",
            fill=_INK,
            font=font,
        )
        small = ImageFont.load_default(12.0 * _FINER)
        x, y = float(_EDGE * _FINER), 36.0 * _FINER
        for outcome, colour in _COLOURS.items():
            count = sum(record.outcome == outcome for record in failed)
            if count:
                self._pen.ellipse((x, y + 4, x + 8 * _FINER, y + 4 + 8 * _FINER), fill=colour)
                text = f"{outcome} ({count})"
                self._pen.text((x + 13 * _FINER, y), text, fill=_INK, font=small)
                x += self._pen.textlength(text, font=small) + 30 * _FINER
        self._pen.text((x, y), "o start   x goal", fill=_INK, font=small)

    def finished(self) -> Picture:
        return np.asarray(self._image.resize(self._size, Image.Resampling.BOX), np.uint8)

    def _at(self, point: Point) -> tuple[float, float]:
        x = _EDGE + (point[0] - self._low[0]) * self._scale
        y = _HEAD + _EDGE + (self._high[1] - point[1]) * self._scale
        return float(x) * _FINER, float(y - _EDGE / 2) * _FINER

    def _box(self, middle: Point, radius: float) -> tuple[float, float, float, float]:
        x, y = self._at(middle)
        reach = radius * _FINER
        return x - reach, y - reach, x + reach, y + reach
