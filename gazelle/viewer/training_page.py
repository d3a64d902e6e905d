"""Copies of a task that learn, live in a browser with their goals and the curve of the training."""

from __future__ import annotations

from functools import partial

from gazelle.simulation import Simulation
from gazelle.viewer.live import LiveView
from gazelle.viewer.page.goal_layer import GoalPlaces
from gazelle.viewer.page.training_panel import TrainingCurve, TrainingPanel
from gazelle_ros.base.closing import Closeable


class TrainingPage(Closeable):
    """Page of a training.

    Args:
        simulation: Runs the copies.
        goals: Function that returns their goals, see `LiveView`.
        port: Of the server; any free one if 0.

    Attributes:
        url: Address of the page.
    """

    def __init__(self, simulation: Simulation, goals: GoalPlaces, port: int) -> None:
        self._curve = TrainingCurve()
        self._view = LiveView(
            simulation,
            port=port,
            read_only=True,
            goals=goals,
            panels=(partial(TrainingPanel, curve=self._curve),),
        )
        self.url = self._view.url

    def note(self, done: int, total: int, summary: dict[str, float]) -> None:
        """Add a point to the curve; see `Progress`."""
        self._curve.total = total
        self._curve.add(done, summary)

    def close(self) -> None:
        """Stop showing it."""
        self._view.close()
