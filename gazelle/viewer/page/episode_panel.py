"""Panel with the list of episodes, the one that is played, and how it ended."""

from __future__ import annotations

import threading
from collections.abc import Sequence
from typing import Any

from gazelle.viewer.page.context import PageContext

_STEPS = {"previous": -1, "again": 0, "next": 1}


class EpisodePanel:
    """Lets users choose among episodes.

    Args:
        context: Of the page.
        titles: Of the episodes, in their order.

    Attributes:
        text: About the present episode, in Markdown; set by any thread.
    """

    def __init__(self, context: PageContext, titles: Sequence[str]) -> None:
        self.text = ""
        self._titles = tuple(titles)
        self._number = 0
        self._chosen: int | None = None
        self._lock = threading.Lock()
        gui = context.gui
        with gui.add_folder("Episode"):
            self._list: Any = gui.add_dropdown("Episode", self._titles)
            buttons = gui.add_button_group("Play", tuple(_STEPS))
            self._shown: Any = gui.add_markdown("")
        context.on_user_change(self._list, self._choose_title)
        buttons.on_click(lambda event: self._choose(self._number + _STEPS[event.target.value]))

    @property
    def waiting(self) -> bool:
        """True if a user has chosen an episode that was not taken yet."""
        return self._chosen is not None

    def begin(self, number: int, text: str) -> None:
        """Show the number of the episode that is played, and a text about it."""
        with self._lock:
            self._number, self.text = number, text
            self._list.value = self._titles[number]

    def take_choice(self) -> int | None:
        """Return the number of the episode that a user has chosen, once."""
        with self._lock:
            chosen, self._chosen = self._chosen, None
        return chosen

    def read(self) -> str:
        """Return the text."""
        return self.text

    def show(self, state: str) -> None:
        """Show the text."""
        if self._shown.content != state:
            self._shown.content = state

    def renew(self) -> None:
        """Do nothing: models do not matter here."""

    def _choose_title(self) -> None:
        self._choose(self._titles.index(self._list.value))

    def _choose(self, number: int) -> None:
        with self._lock:
            self._chosen = min(max(number, 0), len(self._titles) - 1)
