"""Panel with a text that changes."""

from __future__ import annotations

from typing import Any

from gazelle.viewer.page.context import PageContext


class TextPanel:
    """Shows a text in Markdown, set between two steps or by any thread.

    Args:
        context: Of the page.
        title: Of the panel.

    Attributes:
        text: The text.
    """

    def __init__(self, context: PageContext, title: str) -> None:
        self.text = ""
        with context.gui.add_folder(title):
            self._shown: Any = context.gui.add_markdown("")

    def read(self) -> str:
        """Return the text."""
        return self.text

    def show(self, state: str) -> None:
        """Show the text."""
        if self._shown.content != state:
            self._shown.content = state

    def renew(self) -> None:
        """Do nothing: models do not matter here."""
