"""Episodes of an evaluation, live in a browser one by one."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.simulation import Simulation
from gazelle.viewer.live import LiveView
from gazelle.viewer.page.context import PageContext
from gazelle.viewer.page.episode_panel import EpisodePanel
from gazelle.viewer.page.goal_layer import GoalPlaces
from gazelle_ros.base.closing import Closeable


class EpisodesPage(Closeable):
    """Page with one of the worlds of an evaluation.

    Args:
        simulation: Runs all copies.
        goals: Function that returns their goals, see `LiveView`.
        port: Of the server; any free one if 0.
        titles: Of the episodes, in the order in which they are played.

    Attributes:
        url: Address of the page.
        episodes: Shows the episode, and has what users choose.
    """

    def __init__(
        self, simulation: Simulation, goals: GoalPlaces, port: int, titles: Sequence[str]
    ) -> None:
        self._titles = titles
        self._view = LiveView(
            simulation,
            port=port,
            worlds=1,
            read_only=True,
            goals=goals,
            panels=(self._make_panel,),
        )
        self.url = self._view.url

    @property
    def watched(self) -> bool:
        """True while the page is open somewhere."""
        return self._view.watched

    def show(self, world: int, number: int, text: str) -> None:
        """Show a world, the number of its episode, and a text about it in Markdown."""
        self._view.show_world(world)
        self.episodes.begin(number, text)

    def close(self) -> None:
        """Stop showing it."""
        self._view.close()

    def _make_panel(self, context: PageContext) -> EpisodePanel:
        self.episodes = EpisodePanel(context, self._titles)
        return self.episodes
