"""What all plugins have in common, whatever they are loaded on."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.native.joint_system import JointSystem
from gazelle.native.system import System


@dataclass(frozen=True, slots=True)
class Carried:
    """What does a plugin's work within steps.

    Attributes:
        system: Brought by each of them; None while there is nothing to do.
        until_ns: When the plugin has to be updated from Python [ns]; infinite for never.
        lasting: Whether this holds, and ``catch_up`` may wait, until the plugin says otherwise
            (``CarriedPlugins.stir``). Else the plugin is asked again after some steps.
    """

    system: JointSystem | None
    until_ns: float
    lasting: bool = False


class BasePlugin:
    """What all plugins have in common.

    Attributes:
        update_rate: Calls of ``on_update`` a simulated second [Hz]; 0 means every physics
            step, None means never. Set it in the class or in ``load``.
        only_publishes: Whether ``active`` is true exactly while somebody listens to an output, so
            that it need not be asked at every step.
        handle: Name that the file gives it; known in ``load``.
        belongs_into: Tag of the element of a world that names plugins of this kind.
    """

    update_rate: float | None = None
    only_publishes: bool = False
    handle: str = ""
    belongs_into: ClassVar[str] = ""

    @property
    def active(self) -> bool:
        """Whether it needs its updates now; one that only publishes needs them when heard."""
        return True

    def system(self) -> System | None:
        """What does the same as ``on_update`` in native code; None if Python has a say in it.

        It is asked before steps are made, and then updated instead of this plugin. Only engines
        that run systems ask: ``Simulation.native``.
        """
        return None

    def carried(self) -> Carried | None:
        """What does the same as ``on_update`` within steps, and until when.

        It is asked before steps are made where ``Simulation.carrier`` is an engine; ``on_update`` is
        called instead where it is None, and from that time on. After the steps follows ``catch_up``.
        """
        return None

    def catch_up(self) -> None:
        """What ``carried`` gave made steps."""

    def kind(self) -> Hashable | None:
        """Equal for plugins of one class that ``together`` makes one of; None for none.

        It is asked when somebody subscribed to an output or ended that, and when models came or
        went, not between. What such plugins do must not depend on each other. Those that only
        publish are not put together: they are asked to ``measure_together`` and ``publish_measured``.
        """
        return None

    @classmethod
    def together(cls, plugins: Sequence[Any]) -> System | BasePlugin:
        """What does the work of plugins of one kind that are due together, in the place of each.

        A system, whose ``rows`` are the plugins, or a plugin, which is updated when they are due
        and ``active``, and asked for nothing else. What is to be reset, saved and restored stays
        with the plugins, such as in columns of arrays of all. One plugin is put together, too.

        Args:
            plugins: At least one, in the order they were loaded.
        """
        raise NotImplementedError(f"{cls.__name__} says kind() and lacks together()")

    @property
    def is_heard(self) -> bool:
        """Whether somebody listens to what it publishes beside what ``together`` does.

        Then ``publish_measured`` follows that. It may change when somebody subscribed.
        """
        return False

    @classmethod
    def measure_together(cls, plugins: Sequence[Any]) -> Sequence[Any]:
        """What each plugin's ``publish_measured`` is given: measured at once, after all acted.

        Where it fails, each is given None.
        """
        return [None] * len(plugins)

    def publish_measured(self, measured: Any) -> None:
        """Publish to those who listen, when it is time to.

        Args:
            measured: Its part of ``measure_together``.
        """

    def on_update(self, time: float) -> None:
        """Act; called at ``update_rate``.

        Args:
            time: Simulated time [s].
        """

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Use the random numbers of another seed from now on; a reset follows.

        Args:
            seed: Any int.
            worlds: Which worlds; all if None.
        """

    def reset(self, worlds: Worlds | None) -> None:
        """Forget everything about these worlds (all if None), as if just loaded."""

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Everything that changes, for a snapshot."""
        return {}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave."""
