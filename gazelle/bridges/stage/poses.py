"""A service for each robot that says where it is, of a type that the user brings."""

from __future__ import annotations

import math
from typing import Any

from gazelle.bridges.stage.naming import Naming
from gazelle.ros import Node, load_service
from gazelle.ros.messages import UnknownTypeError
from gazelle.simulation.stage import StageRobot, StageSimulation

USUAL_TYPE = "sim_agv/AgvPose"
"""Its response is float64 x, y [m] and angle [degrees]; the request is empty."""


class PoseServices:
    """``get_pose`` of every robot, until it is closed.

    The type is loaded by its name as any user's: from ``ROS_PACKAGE_PATH``, or from a text
    given to ``gazelle.ros.messages.register``.

    Args:
        simulation: Runs.
        node: On the graph.
        naming: Of services.
        world: Which world of a batch the graph sees.
        kind: The type; empty for ``USUAL_TYPE`` where that is known, else for none.

    Raises:
        UnknownTypeError: There is no such type.
    """

    def __init__(
        self, simulation: StageSimulation, node: Node, naming: Naming, world: int, kind: str
    ) -> None:
        self._simulation, self._world = simulation, world
        service = _service(kind)
        self._servers = []
        if service is not None:
            for robot in simulation.robots:
                name = naming.topic(robot.index, "get_pose")
                self._servers.append(node.serve(name, service, self._answer(service, robot)))

    def _answer(self, service: Any, robot: StageRobot) -> Any:
        response_class = service._response_class  # noqa: SLF001  # genpy's names
        fields = set(response_class.__slots__)

        def answer(_request: Any) -> Any:
            view = self._simulation.poses[self._world, robot.index]
            pose = self._simulation.requests.call(view.tolist)
            values = {"x": pose[0], "y": pose[1], "angle": math.degrees(pose[2])}
            return response_class(**{name: v for name, v in values.items() if name in fields})

        return answer

    def close(self) -> None:
        """Offer them no longer."""
        for server in self._servers:
            server.close()


def _service(kind: str) -> Any:
    if kind:
        return load_service(kind)
    try:
        return load_service(USUAL_TYPE)
    except UnknownTypeError:
        return None
