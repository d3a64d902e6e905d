"""Light and dark theme of a page."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.viewer.page.server import PageServer

# Names of joints are too long to stand before a slider.
_ASK = """
<style>.mantine-Flex-root:has(> div > div > .mantine-Slider-root) {flex-wrap: wrap}
.mantine-Flex-root:has(> div > div > .mantine-Slider-root) > :first-child {width: 100% !important}</style>
<img alt="" style="display:none" src="data:," onerror="if(!window.gazelleTheme){window.gazelleTheme=1;
 fetch('theme?dark='+(matchMedia('(prefers-color-scheme: dark)').matches?1:0)).catch(()=>0)}">
"""


class ThemeSwitch:
    """A box for the dark theme; the first browser's preference is where it begins.

    Args:
        server: Of the page.
    """

    def __init__(self, server: PageServer) -> None:
        self._server = server
        self._box: Any = server.viser.gui.add_checkbox("Dark", initial_value=False)
        self._box.on_update(lambda event: server.use_theme(dark=event.target.value))
        self._asking: Any = server.viser.gui.add_html(_ASK)
        self._answered = False
        server.handlers["theme"] = self._prefer

    def _prefer(self, query: Mapping[str, str]) -> None:
        """Take what the first browser prefers; on the server's thread."""
        if not self._answered:
            self._answered = True
            self._box.value = query.get("dark") == "1"
