"""Episodes of an evaluation, live in a browser one by one."""

from __future__ import annotations

from gazelle.simulation import Simulation
from gazelle.viewer.live import LiveView
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.goal_layer import GoalPlaces
from gazelle.viewer.page.text_panel import TextPanel
from gazelle_ros.base.closing import Closeable


class EpisodesPage(Closeable):
    """Page with one of the worlds of an evaluation.

    Args:
        simulation: Runs all copies.
        goals: Function that returns their goals, see `LiveView`.
        port: Of the server; any free one if 0.

    Attributes:
        url: Address of the page.
    """

    def __init__(self, simulation: Simulation, goals: GoalPlaces, port: int) -> None:
        self._view = LiveView(
            simulation,
            port=port,
            worlds=1,
            only_looking=True,
            goals=goals,
            panels=(self._make_panel,),
        )
        self.url = self._view.url

    @property
    def watched(self) -> bool:
        """True while the page is open somewhere."""
        return self._view.watched

    def show(self, world: int, text: str) -> None:
        """Show a world, and a text about its episode in Markdown."""
        self._view.show_world(world)
        self._panel.text = text

    def close(self) -> None:
        """Stop showing it."""
        self._view.close()

    def _make_panel(self, context: PageContext) -> TextPanel:
        self._panel = TextPanel(context, "Episode")
        return self._panel
