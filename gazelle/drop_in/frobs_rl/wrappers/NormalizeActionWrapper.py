"""Actions between -1 and 1."""

from __future__ import annotations

from typing import Any

import gymnasium
from numpy.typing import NDArray

from gazelle.drop_in.frobs_rl.wrappers.modern import EitherGymApi
from gazelle.drop_in.frobs_rl.wrappers.unit_boxes import UnitBox


class NormalizeActionWrapper(EitherGymApi, gymnasium.ActionWrapper[Any, Any, Any]):
    """Actions between -1 and 1 stand for those of the whole box.

    Args:
        env: With a box of actions.

    Raises:
        TaskError: Its actions are no box.
    """

    def __init__(self, env: Any) -> None:
        super().__init__(env)
        self._box = UnitBox(self.env.action_space, "actions")
        self.low, self.high = self._box.low, self._box.high
        self.action_space = self._box.space

    def rescale_action(self, scaled_action: Any) -> NDArray[Any]:
        """Return the action of one scaled to between -1 and 1."""
        return self._box.stretched(scaled_action)

    def action(self, action: Any) -> NDArray[Any]:
        """Return the rescaled action."""
        return self.rescale_action(action)
