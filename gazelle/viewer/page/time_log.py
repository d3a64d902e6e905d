"""A log of states, through which a slider moves the simulation back and forth."""

from __future__ import annotations

import bisect
import time
from typing import Any

from gazelle.errors import SimulationError
from gazelle.simulation import Replay
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.live_input import LiveInput

_EVERY = 0.05  # of a recording [s]
_PERIOD = 0.1  # wall time between two states [s]
_SHARE = 0.05  # of the time that taking states takes at most
_MOST = 600  # states; of more, every other one is left out
_STEP = 0.001  # of the slider [s]


class TimeLog:
    """Keeps states while it is switched on and a page is open, and restores them.

    A restored state is whole: physics, plugins, sensors and noise. A run that goes on from there is
    the same again, to the bit, unless something is changed.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._times: list[float] = []
        self._states: list[bytes] = []
        self._at: int | None = None  # the state that was restored
        self._playing = False
        self._next = 0.0
        gui = context.gui
        self._on = gui.add_checkbox("Keep a log", initial_value=False)
        slider = gui.add_slider("Time [s]", 0.0, 1.0, _STEP, 0.0, disabled=True)
        self._slider = LiveInput(context, slider, self._seek)
        self._play = gui.add_button("Play the log", disabled=True)
        self._info: Any = gui.add_markdown("")
        context.on_user_change(self._on, self._switch)
        self._play.on_click(lambda _event: context.guarded(self._replay))

    def read(self) -> tuple[float, float, float] | None:
        """Keep the present state if it is time; returns first, last and present time [s]."""
        simulation = self._context.simulation
        if self._playing:
            self._advance()
        elif self._at is not None and simulation.time != self._times[self._at]:
            del self._times[self._at + 1 :], self._states[self._at + 1 :]  # it goes on from there
            self._at = None
        elif self._times and simulation.time < self._times[-1] and self._at is None:
            self._forget()  # reset
        if self._on.value and self._at is None and time.monotonic() >= self._next:
            self._keep()
        if len(self._times) < 2:
            return None
        return self._times[0], self._times[-1], simulation.time

    def show(self, state: tuple[float, float, float] | None) -> None:
        """Show the times on the slider."""
        slider, empty = self._slider.shown, state is None
        if slider.disabled != empty:
            slider.disabled = self._play.disabled = empty
        text = f"{len(self._times)} states" if self._times else ""
        if self._info.content != text:
            self._info.content = text
        if state is None:
            return
        first, last, now = (round(each, 3) for each in state)
        if slider.max != last:
            slider.max = last
        if slider.min != first:
            slider.min = first
        if self._at is None or self._playing:
            self._slider.show(min(max(now, first), last))

    def renew(self) -> None:
        """Clear the log: its states are of other models."""
        self._forget()

    def fill(self, replay: Replay) -> None:
        """Run a recording to its end, and keep its states; before it is shown.

        Of a recording in which models come or go the last part is kept.

        Raises:
            SimulationError: The recording is damaged, or the run does not do the same again.
        """
        simulation = replay.simulation
        steps = max(1, round(_EVERY / simulation.engine.time_step))
        with simulation.lock:
            self._keep()
            while replay.step(steps):
                self._keep()
            simulation.pause()

    def _switch(self) -> None:
        if not self._on.value:
            with self._context.simulation.lock:
                self._forget()

    def _forget(self) -> None:
        self._times, self._states, self._at, self._playing = [], [], None, False

    def _keep(self) -> None:
        simulation, begin = self._context.simulation, time.monotonic()
        if self._times and simulation.time <= self._times[-1]:
            return
        self._states.append(simulation.snapshot())
        self._times.append(simulation.time)
        if len(self._times) > _MOST:
            del self._times[1::2], self._states[1::2]
        self._next = begin + max(_PERIOD, (time.monotonic() - begin) / _SHARE)

    def _seek(self, seconds: float) -> None:
        """Restore the state at the slider's time; the simulation is paused."""
        simulation = self._context.simulation
        with simulation.lock:
            simulation.pause()
            self._playing = False
            self._begin()
            self._restore(bisect.bisect_right(self._times, seconds + _STEP) - 1)

    def _replay(self) -> None:
        """Restore one state after the other, as fast as they were, from the first or the present one."""
        simulation = self._context.simulation
        with simulation.lock:
            simulation.pause()
            self._begin()
            if self._at is None or self._at >= len(self._times) - 1:
                self._restore(0)
            self._playing = True
            self._began = time.monotonic() - self._times[self._at or 0]

    def _begin(self) -> None:
        """Keep the present state too, so that nothing is lost."""
        if self._at is None:
            self._keep()

    def _advance(self) -> None:
        """Restore the state that is due; the last ends it."""
        due = bisect.bisect_right(self._times, time.monotonic() - self._began) - 1
        if due != self._at and due >= 0:
            self._restore(due)
        self._playing = due < len(self._times) - 1

    def _restore(self, which: int) -> None:
        which = min(max(which, 0), len(self._times) - 1)
        if which < 0:
            raise SimulationError("the log is empty")
        self._context.simulation.restore(self._states[which])
        self._at = which
