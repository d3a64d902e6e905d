"""Common base of all plugins, whatever they are loaded on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.simulation.plugin_system import PluginSystem, Published


class BasePlugin:
    """Base class of all plugins.

    Attributes:
        update_rate: Calls of ``on_update`` a simulated second [Hz]; 0 means every physics
            step, None means never. Set it in the class or in ``load``.
        system: Class that updates all plugins that name it and are due together, in place of their
            ``on_update``; None for none. Set it in the class or in ``load``.
        published: Outputs that the system publishes.
        handle: Name that the file gives it; known in ``load``.
        belongs_into: Tag of the element of a world that names plugins of this kind.
    """

    update_rate: float | None = None
    system: type[PluginSystem[Any]] | None = None
    published: Sequence[Published] = ()
    handle: str = ""
    belongs_into: ClassVar[str] = ""

    @property
    def active(self) -> bool:
        """True if it needs its updates now; without subscribers, one that only publishes does not."""
        return True

    def on_update(self, time: float) -> None:
        """Update the plugin; called at ``update_rate``.

        Args:
            time: Simulated time [s].
        """

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers; a reset follows.

        Args:
            seed: Any int.
            worlds: Worlds; all if None.
        """

    def reset(self, worlds: Worlds | None) -> None:
        """Reset these worlds (all if None) to the state after loading."""

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
