"""A service for the pose of each robot, of a type from the user."""

from __future__ import annotations

import math
from collections.abc import Callable

from gazelle.stage import StageFleet, StageRobot
from gazelle.stage.bridge.naming import Naming
from gazelle_ros import Node, load_service
from gazelle_ros.messages import InvalidDefinitionError, Message, ServiceDefinition
from gazelle_ros.messages.registry import package_names

USUAL_TYPE = "sim_agv/AgvPose"
"""Its response is float64 x, y [m] and angle [degrees]; the request is empty."""

_FIELDS, _NUMBERS = ("x", "y", "angle"), {"float64", "float32"}


class PoseServices:
    """``get_pose`` of every robot, until it is closed.

    The type is loaded by its name as any user's: from ``ROS_PACKAGE_PATH``, or from a text
    given to ``gazelle_ros.messages.register``.

    Args:
        simulation: Runs.
        node: On the graph.
        naming: Of services.
        world: World of a batch that the graph uses.
        kind: The type; empty for ``USUAL_TYPE`` where that is known, else for none.

    Raises:
        UnknownTypeError: There is no such type.
        InvalidDefinitionError: Its response has no x, y or angle that can hold a number.
    """

    def __init__(
        self, simulation: StageFleet, node: Node, naming: Naming, world: int, kind: str
    ) -> None:
        self._simulation, self._world = simulation, world
        service = _service(kind)
        self._servers = []
        if service is not None:
            for robot in simulation.robots:
                name = naming.topic(robot.index, "get_pose")
                self._servers.append(node.serve(name, service, self._answer(service, robot)))

    def _answer(
        self, service: type[ServiceDefinition], robot: StageRobot
    ) -> Callable[[object], Message]:
        response_class = service._response_class
        fields = set(response_class.__slots__)

        def answer(_request: object) -> Message:
            with self._simulation.lock:
                pose = self._simulation.poses[self._world, robot.index].tolist()
            values = {"x": pose[0], "y": pose[1], "angle": math.degrees(pose[2])}
            return response_class(**{name: v for name, v in values.items() if name in fields})

        return answer

    def close(self) -> None:
        """Close the services."""
        for server in self._servers:
            server.close()


def _service(kind: str) -> type[ServiceDefinition] | None:
    package, _, name = USUAL_TYPE.partition("/")
    if not kind and name not in package_names(package, "srv"):
        return None
    service = load_service(kind or USUAL_TYPE)
    response = service._response_class
    types = dict(zip(response.__slots__, response._slot_types, strict=True))
    wrong = [field for field in _FIELDS if types.get(field, "float64") not in _NUMBERS]
    if wrong or not types.keys() & set(_FIELDS):
        raise InvalidDefinitionError(
            f"the response of {kind or USUAL_TYPE} cannot hold a pose"
            + (f": {wrong[0]} is of type {types[wrong[0]]}" if wrong else ""),
            hint="write 'float64 x', 'float64 y' and 'float64 angle' below the line ---",
        )
    return service
