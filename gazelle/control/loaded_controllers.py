"""The controllers that a manager has loaded, by name: all of them updated, reset, kept and put back."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.control.control_law import ControlLaw
from gazelle.control.switching import LoadedController
from gazelle.errors import ControlError, ControlWarning, did_you_mean


class LoadedControllers(dict[str, LoadedController]):
    """Controllers by name, in the order in which they were loaded; for one thread at a time.

    Raises:
        ControlError: There is no controller of the name that is looked up.
    """

    def __missing__(self, name: str) -> NoReturn:
        raise ControlError(f"there is no controller '{name}'", hint=did_you_mean(name, self))

    @property
    def running(self) -> list[LoadedController]:
        """Running controllers."""
        return [each for each in self.values() if each.controller.running]

    def control(self, now_ns: int, period: float, restart: Worlds | None) -> None:
        """Update those that run; one that raises is aborted.

        Args:
            now_ns: Time [ns].
            period: Since the last update [s].
            restart: Worlds in which they start again first.
        """
        _check_period(period)
        time = now_ns * 1e-9
        for entry in self.running:
            controller = entry.controller
            controller.now_ns = now_ns
            try:
                if restart is not None and len(restart) < controller.nworld:
                    controller.reset(restart)
                elif restart is not None:
                    controller.stopping(time)
                    controller.starting(time)
                controller.update(time, period)
            except Exception as error:  # noqa: BLE001  one controller's fault is not the others'
                controller.running, entry.state = False, "aborted"
                text = f"controller '{controller.name}' failed and is aborted: {error}"
                warnings.warn(ControlWarning(text), stacklevel=3)

    def laws(self) -> list[ControlLaw] | None:
        """Return the native laws of running controllers, in order; None if Python has to update one."""
        found = []
        for entry in self.values():
            if entry.controller.running:
                if entry.law is None:
                    return None
                found.append(entry.law)
        return found

    def wake_ns(self) -> float:
        """Return the time [ns] at which one must be updated although all are native code."""
        soonest = math.inf
        for entry in self.values():
            if entry.controller.running:
                soonest = min(soonest, entry.controller.wake_ns())
        return soonest

    @property
    def deferrable(self) -> bool:
        """True if ``catch_up`` of all running controllers may be delayed."""
        return all(entry.controller.deferrable for entry in self.running)

    def catch_up(self, now_ns: int, updates: int, period: float) -> None:
        """Update the state after native updates; see ``ControllerManager.catch_up``."""
        _check_period(period)
        for entry in self.values():
            if entry.controller.running:
                entry.controller.now_ns = now_ns
                entry.controller.catch_up(updates, period)

    def reset(self, now_ns: int, worlds: Worlds | None) -> None:
        """Reset the controllers in these worlds; all if None."""
        for entry in self.values():
            entry.controller.now_ns = now_ns
            entry.controller.reset(worlds)

    def states(self) -> dict[str, NDArray[np.generic]]:
        """Return all mutable state, for a snapshot."""
        return {
            f"{name}/{key}": value
            for name, entry in self.items()
            for key, value in {
                **entry.controller.state(),
                "running": np.array(entry.controller.running),
            }.items()
        }

    def restore(self, now_ns: int, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``states`` returned; controllers loaded since stay as they are."""
        for name, entry in self.items():
            own = {
                k.removeprefix(f"{name}/"): v for k, v in state.items() if k.startswith(f"{name}/")
            }
            if own:
                entry.controller.now_ns = now_ns
                running = bool(own.pop("running"))
                entry.controller.running = running
                if running or entry.state == "running":
                    entry.state = "running" if running else "stopped"
                entry.controller.restore(own)


def _check_period(period: float) -> None:
    """Check the time between two updates: integrals of controllers would be NaN for ever.

    Raises:
        ControlError: It is not a finite number of 0 or more.
    """
    if not 0.0 <= period < math.inf:
        raise ControlError(f"a period must be a finite number of 0 s or more, not {period!r:.60}")
