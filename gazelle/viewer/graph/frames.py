"""Frames of the graph as axes with names, as RViz's display TF."""

from __future__ import annotations

from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.graph.context import GraphContext
from gazelle_ros.tf import TransformException

_LENGTH_M, _MOST = 0.2, 100
_APART_M = 0.1  # frames nearer to each other share a label


class FrameAxes:
    """Axes at all frames that tf connects with the fixed one; off at first.

    Args:
        context: Of the page.
    """

    def __init__(self, context: GraphContext) -> None:
        self._context = context
        self._axes: Any = None
        self._labels: dict[str, Any] = {}  # by their texts
        self._names: list[str] = []
        self.box: Any = context.gui.add_checkbox("Frames", initial_value=False)

    def draw(self, fixed: str) -> None:
        """Move the axes to their frames."""
        places = self._places(fixed) if self.box.value else {}
        labels = _labels_of({name: place for name, (place, _) in places.items()})
        if [*places, *labels] != self._names:
            self._renew(places, labels)
        if not places:
            return
        at = np.array([place for place, _ in places.values()], np.float32)
        self._axes.batched_positions = at
        self._axes.batched_wxyzs = np.array([turn for _, turn in places.values()], np.float32)
        for text, place in labels.items():
            self._labels[text].position = place

    def _places(self, fixed: str) -> dict[str, tuple[Floats, Floats]]:
        """Return position [m] and quaternion (w, x, y, z) of each frame by name."""
        found = {}
        for name in self._context.tree.names()[:_MOST]:
            try:
                transform = self._context.tree.lookup(fixed, name)
            except TransformException:
                continue
            turned = np.roll(np.array(transform.rotation), 1)
            found[name] = (np.array(transform.translation), turned)
        return found

    def _renew(self, places: dict[str, tuple[Floats, Floats]], labels: dict[str, Floats]) -> None:
        """Make axes and names for other frames."""
        scene = self._context.scene
        for each in (self._axes, *self._labels.values()):
            if each is not None:
                each.remove()
        self._axes, self._labels, self._names = None, {}, [*places, *labels]
        if not places:
            return
        at = np.array([place for place, _ in places.values()])
        turned = np.array([turn for _, turn in places.values()])
        self._axes = scene.add_batched_axes(
            "/frames", turned, at, axes_length=_LENGTH_M, axes_radius=0.04 * _LENGTH_M
        )
        self._labels = {
            text: scene.add_label(f"/frame_names/{number}", text, position=place)
            for number, (text, place) in enumerate(labels.items())
        }


def _labels_of(places: dict[str, Floats]) -> dict[str, Floats]:
    """Return places of labels by their texts [m]: a line for each frame that is there."""
    groups: list[tuple[list[str], Floats]] = []
    for name, place in places.items():
        near = (names for names, at in groups if np.linalg.norm(at - place) < _APART_M)
        found = next(near, None)
        if found is None:
            groups.append(([name], place))
        else:
            found.append(name)
    return {"\n".join(names): place for names, place in groups}
