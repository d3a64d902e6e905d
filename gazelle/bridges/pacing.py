"""Pacing of a simulation by its physics properties, while others steer it."""

from __future__ import annotations

import math
import threading
import time

from gazelle.simulation import Simulation

ACCEPTED = "a positive number or max"
"""Description of the values that ``read_factor`` takes."""

# Wall time between two looks at the clock, and at the pause [s].
_SLICE = 0.002
_REST = 0.002


def read_factor(text: str) -> float | None:
    """Return a real-time factor; infinity for ``max`` or ``inf``, None for an invalid text.

    >>> read_factor(" max "), read_factor("0.5"), read_factor("-1"), read_factor("fast")
    (inf, 0.5, None, None)
    """
    try:
        factor = math.inf if text.strip() == "max" else float(text)
    except ValueError:
        return None
    return factor if factor > 0.0 else None


class Pacer:
    """Runs a simulation until it is stopped.

    The pace is ``physics.update_rate`` steps a second of wall time, as in Gazebo; 0 means as
    fast as possible. It can be changed while running.

    Args:
        simulation: Runs on the thread that calls ``run``.
    """

    def __init__(self, simulation: Simulation) -> None:
        self._simulation = simulation
        self._stop = threading.Event()

    def run(self, seconds: float | None = None) -> None:
        """Run until ``stop`` is called.

        Args:
            seconds: Simulated time after which to end; None for never. A reset of the time
                starts it over.
        """
        simulation = self._simulation
        while not self._stop.is_set():
            if simulation.paused:
                self._stop.wait(_REST)
                continue
            if seconds is not None and simulation.time >= seconds - 1e-9:
                return
            self._run_piece(seconds)

    def stop(self) -> None:
        """Stop ``run``; from any thread."""
        self._stop.set()

    def _run_piece(self, seconds: float | None) -> None:
        """Run at one pace, until it changes or there is a pause."""
        simulation, physics = self._simulation, self._simulation.physics
        rate, step = physics.update_rate, physics.time_step
        factor = physics.target_rate or 0.0
        start, done = time.monotonic(), 0.0
        while not (self._stop.is_set() or simulation.paused):
            if (physics.update_rate, physics.time_step) != (rate, step):
                return
            piece = _SLICE * factor if factor > 0.0 else self._fast_piece(step)
            piece = max(piece, step)
            if seconds is not None:
                piece = min(piece, seconds - simulation.time)
                if piece < step / 2.0:
                    return
            simulation.run(piece)
            done += max(1, round(piece / step)) * step
            if factor <= 0.0:
                continue
            ahead = done / factor - (time.monotonic() - start)
            if ahead > 0.0:
                time.sleep(ahead)
            elif ahead < -0.1:
                # Too slow to keep the pace: do not run after it in bursts later.
                return

    @staticmethod
    def _fast_piece(step: float) -> float:
        """Advance until the pause is worth checking; requests are served in between anyway."""
        return 20.0 * step
