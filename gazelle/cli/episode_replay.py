"""The flag ``--view`` of ``gazelle eval``: the episodes again, live in a browser."""

from __future__ import annotations

import sys
import time
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gazelle.cli.viewing import simulated
from gazelle.errors import TaskError

if TYPE_CHECKING:
    from gazelle.array_types import Floats
    from gazelle.training import Evaluation
    from gazelle.training.records import EpisodeRecord

_WAIT = 0.1  # time for a user to open the page [s]
_GONE = 10.0  # without a page after the last episode, until it is taken for closed [s]
_AT_END = 1.0  # for which the last moment of an episode stays on the page [s]


class _OtherEpisode(Exception):  # noqa: N818  nothing is wrong
    """Another episode was chosen while one is played."""


def show_episodes(result: Evaluation, port: int) -> None:
    """Play the episodes of an evaluation one by one on a page, failures first.

    Each is played in real time, and begins when the page is open. Users choose others on the page;
    after the last one it waits for that until the page is closed.

    Raises:
        TaskError: The task has no simulation, or workers played its episodes.
        MissingExtraError: The package that serves the page is not installed.
    """
    from gazelle.training.rerun import Rerun, worst_first
    from gazelle.viewer.episodes_page import EpisodesPage

    records = [(each, each.place) for each in worst_first(result) if each.place is not None]
    if not records:
        raise TaskError("episodes that workers played cannot be played again here")
    with Rerun(result) as rerun:
        owner = simulated(rerun.env)
        if owner is None:
            raise TaskError("there is nothing to view: the task has no simulation")
        nworld = owner.simulation.nworld
        if nworld == 1 < result.copies:
            hint = "add --num-envs 1"
            raise TaskError("each copy of this task has a simulation of its own", hint=hint)

        def goals() -> Floats | None:
            """Return the goals of all copies."""
            found: Floats | None = getattr(owner, "goal_places", None)
            return found

        titles = [f"{number}: {_brief(record)}" for number, (record, _) in enumerate(records, 1)]
        with EpisodesPage(owner.simulation, goals, port, titles) as page:
            sys.stdout.write(f"the episodes begin when the page is open\nview {page.url}\n")
            sys.stdout.flush()
            pace = _EpisodePace(page, rerun.period)
            number: int | None = 0
            while number is not None:
                record, place = records[number]
                text = f"{number + 1} of {len(records)}: {describe(record, rerun.period)}"
                page.show(place.copy * nworld // result.copies, number, text)
                with suppress(_OtherEpisode):
                    rerun.play(record, pace.wait)
                number = pace.following(number, len(records))


def describe(record: EpisodeRecord, period: float) -> str:
    """Return how an episode ended, in Markdown; the period is that of a step [s]."""
    return (
        f"**{record.outcome}** after {record.length} steps ({record.length * period:.1f} s), "
        f"return {record.sum_of_rewards:.4g}"
    )


def _brief(record: EpisodeRecord) -> str:
    return f"{record.outcome}, {record.length} steps"


class _EpisodePace:
    """Real time, which stands while no page is open; ended by the choice of an episode."""

    def __init__(self, page: Any, period: float) -> None:
        self._page, self._period = page, period
        self._due = 0.0

    def wait(self, left: int) -> None:
        """Wait for the time of the next step; longer before the last of an episode.

        Raises:
            _OtherEpisode: A user has chosen another one.
        """
        while not self._page.watched:
            time.sleep(_WAIT)
        if self._page.episodes.waiting:
            raise _OtherEpisode
        now = time.monotonic()
        time.sleep(max(0.0, self._due - now))
        if left == 1:
            time.sleep(_AT_END)
        self._due = max(self._due, now) + self._period

    def following(self, number: int, count: int) -> int | None:
        """Return the number of the next episode; None where the page is closed after the last."""
        chosen: int | None = self._page.episodes.take_choice()
        if chosen is None and number + 1 < count:
            return number + 1
        seen = time.monotonic()
        while chosen is None and time.monotonic() - seen < _GONE:
            time.sleep(_WAIT)
            if self._page.watched:
                seen = time.monotonic()
            chosen = self._page.episodes.take_choice()
        return chosen
