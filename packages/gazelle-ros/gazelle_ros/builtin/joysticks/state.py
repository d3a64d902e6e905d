"""Axes and buttons of a joystick from its events."""

from __future__ import annotations

from dataclasses import dataclass, field

from gazelle_ros.builtin.joysticks.device import JoystickEvent

FULL_SCALE = 32767.0
"""Greatest raw value of an axis."""


@dataclass(slots=True)
class JoystickState:
    """Axes and buttons.

    Attributes:
        deadzone: Part of an axis around its middle that counts as the middle, 0 to 0.9.
        sticky_buttons: A press toggles a button, and its release does nothing.
        default_trig_val: Take the first values of axes; otherwise they are 0 until moved.
        axes: -1 to 1; left and up are positive.
        buttons: 0 or 1.
    """

    deadzone: float = 0.05
    sticky_buttons: bool = False
    default_trig_val: bool = False
    axes: list[float] = field(default_factory=list)
    buttons: list[int] = field(default_factory=list)

    def take(self, event: JoystickEvent) -> bool:
        """Handle an event; returns whether it is to be published at once."""
        if event.is_axis:
            self.axes += [0.0] * (event.number + 1 - len(self.axes))
            if self.default_trig_val or not event.is_initial:
                self.axes[event.number] = self.scaled(event.value)
            return False
        self.buttons += [0] * (event.number + 1 - len(self.buttons))
        if not self.sticky_buttons:
            self.buttons[event.number] = 1 if event.value else 0
        elif event.value == 1:
            self.buttons[event.number] = 1 - self.buttons[event.number]
        return not event.is_initial

    def scaled(self, value: int) -> float:
        """Return an axis from a raw value: 0 in the dead zone, and from there on linear to 1."""
        dead = self.deadzone * FULL_SCALE
        beyond = max(abs(value) - dead, 0.0) / (FULL_SCALE - dead)
        return -beyond if value > 0 else beyond
