"""An update that runs in a thread of its own while the next rollout is played.

The policy that plays keeps its weights meanwhile: an update works on a copy of them, and hands the
result over when the rollout is there. So what comes out does not depend on which of the two takes
longer, and no reader of the policy sees it half done. Each rollout is played by weights that are one
update old, exactly one, and PPO's ratios account for that.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from typing import Any

import torch

from gazelle.training.learners.ppo_dense_update import DenseUpdate


class OverlappedUpdate:
    """An update under way, or done and not handed over yet.

    Args:
        update: Of which policy; it must have no other user.
        learn: The work: what the curves show of it.
    """

    def __init__(self, update: DenseUpdate, learn: Callable[[], list[float]]) -> None:
        self._update = update
        self._learn = learn
        self._figures: list[float] = []
        self._error: BaseException | None = None
        self._thread: threading.Thread | None = None

    def start(self) -> None:
        """Start the update."""
        # A second interrupt does not wait for it.
        self._thread = threading.Thread(target=self._run, name="ppo_update", daemon=True)
        self._thread.start()

    def wait(self) -> None:
        """Return when it is done; what went wrong in it is raised here, once."""
        if self._thread is not None:
            self._thread.join()
            self._thread = None
        if self._error is not None:
            error, self._error = self._error, None
            raise error

    def apply(self) -> list[float]:
        """Wait, and copy the new weights to the policy.

        Returns what the curves show of the update.
        """
        self.wait()
        self._update.finish()
        return self._figures

    def get_state(self) -> dict[str, Any]:
        """Wait; what `from_state` continues with."""
        self.wait()
        return {**self._update.get_state(), "figures": self._figures}

    @classmethod
    def from_state(cls, update: DenseUpdate, state: Mapping[str, Any]) -> OverlappedUpdate:
        """Return a finished update, from what `get_state` returned."""
        update.set_state(state)
        found = cls(update, list)
        found._figures = [float(value) for value in state["figures"]]
        return found

    def _run(self) -> None:
        try:
            with torch.no_grad():
                self._figures = self._learn()
        except BaseException as error:  # noqa: BLE001  the waiting thread gets it
            self._error = error
