"""Time on the page: run, pause, step, start over, how fast."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.live_input import LiveInput
from gazelle.viewer.page.pace_meter import PaceMeter

_SPEEDS = ("0.1", "0.25", "0.5", "1", "2", "5", "10", "max")


@dataclass(frozen=True, slots=True)
class ClockState:
    """State of the clock.

    Attributes:
        time: Simulated [s].
        paused: Whether it stands.
        speed: Real-time factor that is aimed at; None for as fast as possible.
    """

    time: float
    paused: bool
    speed: float | None


class RunControls:
    """Buttons and display of the clock.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._meter = PaceMeter()
        self._speed_before: float | None = None
        self._status_text = ""
        gui, guarded = context.gui, context.guarded
        self._status = gui.add_markdown("")
        self._speed: LiveInput | None = None
        if context.read_only:
            return
        with gui.add_folder("Run"):
            self._run = gui.add_button_group("Clock", ("run", "pause", "step", "reset"))
            self._steps = gui.add_number("Steps", 1, min=1, max=1_000_000, step=1)
            speeds = gui.add_dropdown("Speed", _SPEEDS, initial_value="1")
        self._speed = LiveInput(context, speeds, self._pace)
        self._run.on_click(lambda event: guarded(lambda: self.do(event.target.value)))

    def read(self) -> ClockState:
        """Return the clock now."""
        simulation = self._context.simulation
        return ClockState(simulation.time, simulation.paused, simulation.physics.target_rate)

    def show(self, state: ClockState) -> None:
        """Show the clock."""
        if self._speed is not None and not self._speed.pending:
            speed = _name(state.speed)
            if speed not in self._speed.shown.options:
                self._speed.shown.options = (*_SPEEDS, speed)
            self._speed.show(speed)
        if state.paused or state.speed != self._speed_before:
            self._meter.forget()
        self._speed_before = state.speed
        factor = self._meter.factor(state.time)
        mode = "paused" if state.paused else _reached(factor)
        self._set_status(f"**{state.time:.{self._decimals()}f} s** &nbsp; {mode}")

    def renew(self) -> None:
        """Do nothing: the clock does not depend on models."""

    def _decimals(self) -> int:
        """Return as many decimals of a second as show a single step, at least two."""
        step = self._context.simulation.physics.time_step
        return max(2, math.ceil(-math.log10(step) - 1e-9))

    def _set_status(self, text: str) -> None:
        if text != self._status_text:
            self._status.content = self._status_text = text

    def do(self, word: str) -> None:
        """Execute ``run``, ``pause``, ``step`` or ``reset``."""
        simulation = self._context.simulation
        match word:
            case "run":
                simulation.unpause()
            case "pause":
                simulation.pause()
            case "step":
                simulation.pause()
                simulation.step(int(self._steps.value))
            case _:
                simulation.reset()

    def _pace(self, speed: str) -> None:
        set_speed(self._context.simulation, speed)


def set_speed(simulation: Any, speed: str) -> None:
    """Set a real-time factor, or ``max`` for as fast as possible."""
    factor = 0.0 if speed == "max" else float(speed)
    physics = simulation.physics
    physics.update_rate = factor / physics.time_step


def _reached(factor: float | None) -> str:
    """Return the text for a real-time factor: three digits."""
    if factor is None:
        return "not stepping"
    return f"real-time factor {factor:.{max(0, 2 - math.floor(math.log10(factor)))}f}"


def _name(speed: float | None) -> str:
    return "max" if speed is None else f"{speed:.3g}"
