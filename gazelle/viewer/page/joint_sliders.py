"""A slider for each joint of the selected model."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.viewer.page.context import PageContext

_MOST = 40  # joints of one model
_TURN = math.pi


class JointSliders:
    """Shows where joints are, and puts them elsewhere.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._folder = context.gui.add_folder("Joints", expand_by_default=False, visible=False)
        self._sliders: dict[str, Any] = {}
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
            slider = self._sliders.get(name)
            if slider is None:
                continue
            round_about = slider.max == _TURN and slider.min == -_TURN
            angle = math.remainder(value, 2.0 * math.pi) if round_about else value
            shown = round(min(max(angle, slider.min), slider.max), 3)
            if abs(slider.value - shown) >= slider.step:
                slider.value = shown

    def renew(self) -> None:
        """Make sliders for the model that is selected now."""
        context = self._context
        robot = context.simulation.robots.get(context.selected)
        self._model = context.selected
        for slider in self._sliders.values():
            slider.remove()
        self._sliders = {}
        joints = [] if robot is None else [j for j in robot.joints.items() if j[1].axes == 1]
        self._folder.visible = bool(joints)
        with self._folder:
            for name, _ in joints[:_MOST]:
                self._sliders[name] = self._slider(name)

    def _slider(self, name: str) -> Any:
        robot = self._context.simulation.robots[self._model]
        axis = robot.joint_description(name).axes[0]
        low, high = axis.lower, axis.upper
        if not (math.isfinite(low) and math.isfinite(high) and 0.0 < high - low < 100.0):
            low, high = -_TURN, _TURN
        slider = self._context.gui.add_slider(name, low, high, 0.001, min(max(0.0, low), high))
        slider.on_update(self._setter(name))
        return slider

    def _setter(self, name: str) -> Callable[[Any], None]:
        context, model = self._context, self._model

        def put(event: Any) -> None:
            if event.client is None:
                return
            value, chosen = np.array([event.target.value]), context.chosen

            def work() -> None:
                context.simulation.robots[model].set_configuration([name], value, chosen)

            context.careful(work)

        return put
