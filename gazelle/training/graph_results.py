"""The progress of a training on a ROS 1 graph, as turtlebot3_machine_learning publishes it."""

from __future__ import annotations

import math
import os
from typing import Any

import numpy as np
from stable_baselines3.common.callbacks import BaseCallback
from stable_baselines3.common.logger import KVWriter

from gazelle.errors import TaskError
from gazelle.training.deploy.messages import floats_message
from gazelle.training.export import export_actor
from gazelle_ros import Node
from gazelle_ros.msgs import std_msgs

_RETURN = "episodes/return"


class GraphResults(BaseCallback):  # type: ignore[misc]  # untyped base
    """Publishes ``result`` (``std_msgs/Float32MultiArray``: score, max_q) while a policy learns.

    ``gazelle train TASK --callback gazelle.training.graph_results:GraphResults`` uses it with any task and
    algorithm. There is a message for each point of the curves, some 200 a training: the mean return of
    the latest episodes, and the largest output of the policy's network for what is seen then (of DQN
    the value of an action); NaN where there is none such. The node is ``gazelle_training_...``, in the
    namespace ``ROS_NAMESPACE``, on the master ``ROS_MASTER_URI``.

    Raises:
        MasterUnreachableError: There is no master.
    """

    def __init__(self) -> None:
        super().__init__()
        self._node: Node | None = None

    def _on_training_start(self) -> None:
        namespace = os.environ.get("ROS_NAMESPACE", "/")
        self._node = Node("gazelle_training", namespace=namespace, anonymous=True)
        kind = std_msgs.msg.Float32MultiArray
        publisher = self._node.advertise("result", kind, 10)
        self.logger.output_formats.append(_ResultWriter(self.model, publisher, self._node))

    def _on_step(self) -> bool:
        return True


class _ResultWriter(KVWriter):  # type: ignore[misc]  # untyped base
    """Logger output that publishes curves as messages; closed with its logger."""

    def __init__(self, model: Any, publisher: Any, node: Node) -> None:
        self._model, self._publisher, self._node = model, publisher, node

    def write(
        self, key_values: dict[str, Any], key_excluded: dict[str, Any], step: int = 0
    ) -> None:
        """Publish a point of the curves with episodes."""
        del key_excluded, step
        if _RETURN in key_values:
            values = [float(key_values[_RETURN]), self._largest_output()]
            self._publisher.publish(floats_message(["score", "max_q"], values))

    def close(self) -> None:
        """Close the node."""
        self._node.close()

    def _largest_output(self) -> float:
        seen = self._model._last_obs  # noqa: SLF001  # where Stable-Baselines3 keeps it
        if not isinstance(seen, np.ndarray):
            return math.nan
        try:
            outputs = export_actor(self._model.policy).outputs(seen.astype(np.float32))
        except TaskError:  # no multi-layer perceptron, or one with a memory
            return math.nan
        return float(outputs.max())
