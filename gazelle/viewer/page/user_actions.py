"""Actions of users on a page: errors become notices."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle.errors import Error

if TYPE_CHECKING:
    from viser import ViserServer

_log = logging.getLogger("gazelle.viewer")


class UserActions:
    """Calls of functions for users of a page.

    Attributes:
        page: viser's server.
    """

    page: ViserServer

    def notify(self, title: str, text: str) -> None:
        """Show a notice on every page."""
        for client in self.page.get_clients().values():
            client.add_notification(title, text, auto_close_seconds=6.0)

    def on_user_change(self, handle: Any, work: Callable[[], None]) -> None:
        """Call a function when a user, and not this program, changes an input of the panel."""

        def changed(event: Any) -> None:
            if event.client is not None:
                self.guarded(work)

        handle.on_update(changed)

    def on_user_click(self, button: Any, work: Callable[[], None]) -> None:
        """Call a function when a user clicks a button."""
        button.on_click(lambda _event: self.guarded(work))

    def guarded(self, work: Callable[[], None]) -> None:
        """Call a function for a user; its errors are shown on the page and stop nothing."""
        try:
            work()
        except Error as error:
            self.notify("This cannot be done", str(error))
        except Exception as error:  # noqa: BLE001  whatever it is, the program continues
            _log.exception("an action on a page failed")
            self.notify("This failed", f"{type(error).__name__}: {error}")
