"""A slider for each joint of the selected model."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.live_input import LiveInput

_MOST = 40  # joints of one model
_TURN = math.pi


class JointSliders:
    """Shows where joints are, and puts them elsewhere.

    Sliders are used again for other models, since a page reports an error where one is removed at
    the moment that its value changes.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._folder = context.gui.add_folder("Joints", expand_by_default=False)
        with self._folder:
            self._hint = context.gui.add_markdown("Select a model with joints.")
        self._pool: list[LiveInput] = []
        self._sliders: dict[str, LiveInput] = {}
        self._model = ""
        context.listeners.append(self.renew)

    def read(self) -> dict[str, float]:
        """Return the positions of the joints [m or rad]."""
        robot = self._context.simulation.robots.get(self._model)
        if robot is None:
            return {}
        chosen = self._context.chosen
        found: dict[str, Floats] = {
            name: robot.joints[name].positions(chosen)
            for name in self._sliders
            if name in robot.joints
        }
        return {name: float(values[0, 0]) for name, values in found.items()}

    def show(self, state: dict[str, float]) -> None:
        """Move the sliders; those on wheels go round."""
        for name, value in state.items():
            if name not in self._sliders:
                continue
            live = self._sliders[name]
            slider = live.shown
            round_about = slider.max == _TURN and slider.min == -_TURN
            angle = math.remainder(value, 2.0 * math.pi) if round_about else value
            shown = round(min(max(angle, slider.min), slider.max), 3)
            if abs(slider.value - shown) >= slider.step:
                live.show(shown)

    def renew(self) -> None:
        """Use the sliders for the model that is selected now."""
        context = self._context
        robot = context.simulation.robots.get(context.selected)
        self._model = context.selected
        joints = [] if robot is None else [j for j in robot.joints.items() if j[1].axes == 1]
        self._hint.visible = not joints
        names = [name for name, _ in joints[:_MOST]]
        while len(self._pool) < len(names):
            self._pool.append(self._slider())
        self._sliders = dict(zip(names, self._pool, strict=False))
        for name, live in self._sliders.items():
            self._label(live, name)
        for live in self._pool[len(names) :]:
            live.shown.visible = False

    def _label(self, live: LiveInput, name: str) -> None:
        """Show a joint on a slider."""
        robot = self._context.simulation.robots[self._model]
        axis = robot.joint_description(name).axes[0]
        low, high = axis.lower, axis.upper
        if not (math.isfinite(low) and math.isfinite(high) and 0.0 < high - low < 100.0):
            low, high = -_TURN, _TURN
        slider = live.shown
        slider.label, slider.min, slider.max, slider.visible = name, low, high, True
        live.send(min(max(0.0, low), high))

    def _slider(self) -> LiveInput:
        context = self._context
        with self._folder:
            slider: Any = context.gui.add_slider("", -_TURN, _TURN, 0.001, 0.0)
        return LiveInput(context, slider, lambda value: self._put(slider, value))

    def _put(self, slider: Any, value: float) -> None:
        for name, each in self._sliders.items():
            if each.shown is slider:
                robot = self._context.simulation.robots[self._model]
                robot.set_configuration([name], np.array([value]), self._context.chosen)
