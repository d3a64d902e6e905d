"""One warning of the inputs that navigation waits for, and of their usual senders."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable

from gazelle.errors import GazelleWarning
from gazelle_ros.clock import SimulatedClock
from gazelle_ros.node import Node

_PATIENCE_S = 5.0
"""Of wall time; a graph that begins has all of it by then, or says why not."""


class NavigationWarning(GazelleWarning):
    """A navigation node waits for something that never comes."""


class StartDiagnosis:
    """Warns once when a node has waited for long.

    Args:
        node: On the graph.
        what: Missing parts, one entry each; empty when all is there.
        patience: Longest time [s of wall time].
    """

    def __init__(
        self, node: Node, what: Callable[[], list[str]], patience: float = _PATIENCE_S
    ) -> None:
        self._node, self._what, self._patience = node, what, patience
        self._since = time.monotonic()
        self._reported = False

    def check(self, *, waiting: bool) -> str | None:
        """Warn if it is time; returns the warning.

        Args:
            waiting: Whether the node waits for something now.
        """
        if not waiting:
            self._since = time.monotonic()
            return None
        if self._reported or time.monotonic() - self._since < self._patience:
            return None
        missing = self._what()
        clock = self._node.clock
        if isinstance(clock, SimulatedClock) and clock.now() == 0:
            missing.insert(
                0, "/clock (use_sim_time is set: a simulation sends it, or unset the parameter)"
            )
        if not missing:
            return None
        self._reported = True
        text = f"{self._node.name} waits for: {'; '.join(missing)}"
        warnings.warn(NavigationWarning(text), stacklevel=2)
        return text
