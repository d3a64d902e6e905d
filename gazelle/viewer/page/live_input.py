"""An input of the panel that follows the simulation, and that users change."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from gazelle.viewer.page.user_actions import UserActions


class LiveInput:
    """Shows a value that changes by itself, but not over one that was just entered.

    A picture may come between the moment that a user changes an input and the call of the function
    that sets the value; it must not show the old value then, which would be set instead.

    Args:
        actions: Of the page.
        shown: The input.
        work: Called with a value that a user entered.

    Attributes:
        shown: Likewise.
    """

    def __init__(self, actions: UserActions, shown: Any, work: Callable[[Any], None]) -> None:
        self.shown, self._work, self._sent = shown, work, shown.value
        actions.on_user_change(shown, self._changed)

    @property
    def pending(self) -> bool:
        """True between a user's change and its effect."""
        return bool(self.shown.value != self._sent)

    def show(self, value: Any) -> None:
        """Show a value, unless another one was just entered."""
        if not self.pending and value != self._sent:
            self.send(value)

    def send(self, value: Any) -> None:
        """Show a value, whatever was entered."""
        self.shown.value = value
        self._sent = self.shown.value  # as the input keeps it

    def _changed(self) -> None:
        value = self.shown.value
        try:
            self._work(value)
        finally:
            self._sent = value
