"""Actions between -1 and 1."""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from gazelle.compat.frobs_rl.wrappers.modern import EitherInterface
from gazelle.errors import TaskError


class NormalizeActionWrapper(EitherInterface, gymnasium.ActionWrapper[Any, Any, Any]):
    """Actions between -1 and 1 stand for those of the whole box.

    Args:
        env: With a box of actions.

    Raises:
        TaskError: Its actions are no box.
    """

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        space = self.env.action_space
        if not isinstance(space, Box):
            raise TaskError(f"this wants a box of actions, not {space}")
        self.low, self.high = space.low, space.high
        self.action_space = Box(-1.0, 1.0, space.shape, np.float32)

    def rescale_action(self, scaled_action: Any) -> NDArray[Any]:
        """The action that one between -1 and 1 stands for."""
        rescaled: NDArray[Any] = self.low + 0.5 * (scaled_action + 1.0) * (self.high - self.low)
        return rescaled

    def action(self, action: Any) -> NDArray[Any]:
        """The same."""
        return self.rescale_action(action)
