"""The services of a Stage world on a ROS graph: stage_ros's, and those it never had."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from gazelle.bridges.pacing import ACCEPTED, read_factor
from gazelle.errors import SimulationError
from gazelle.simulation import Simulation
from gazelle.stage import stage_of
from gazelle.stage.bridge.robot import heading_of
from gazelle_ros import Node, Time
from gazelle_ros.messages import ServiceDefinition
from gazelle_ros.msgs import gazelle_msgs, std_srvs

Answer = dict[str, Any]

_MOST_STEPS = 10_000_000


class StageClock(Protocol):
    """Clock and topics, as the services command them."""

    rate: float | None

    def now(self) -> Time:
        """Return the simulated time as a time of the graph."""

    def publish(self) -> None:
        """Publish the current values."""

    def rewind(self) -> None:
        """Start over, time too."""


class Services:
    """Offers the services until it is closed.

    Args:
        simulation: Runs.
        node: On the graph.
        interface: Publishes.
        world: World of a batch that the graph uses.
    """

    def __init__(
        self, simulation: Simulation, node: Node, interface: StageClock, world: int
    ) -> None:
        self._simulation, self._interface, self._world = simulation, interface, world
        self._stage = stage_of(simulation)
        self._servers = []
        handlers: tuple[tuple[str, type[ServiceDefinition], Callable[[Any], Answer]], ...] = (
            ("reset_positions", std_srvs.srv.Empty, self.reset_positions),
            ("/gazelle/reset", std_srvs.srv.Empty, self.reset),
            ("/gazelle/pause", std_srvs.srv.Empty, self.pause),
            ("/gazelle/unpause", std_srvs.srv.Empty, self.unpause),
            ("/gazelle/step", gazelle_msgs.srv.Step, self.step),
            ("/gazelle/set_pose", gazelle_msgs.srv.SetPose, self.set_pose),
            ("/gazelle/set_real_time_factor", gazelle_msgs.srv.SetRealTimeFactor, self.set_rate),
        )
        for name, service, handler in handlers:
            self._servers.append(node.serve(name, service, self._between(service, handler)))

    def _between(
        self, service: type[ServiceDefinition], handler: Callable[[Any], Answer]
    ) -> Callable[[Any], Any]:
        """Return a handler that answers between two steps."""
        response = service._response_class
        answer = self._simulation.lock.wrap(handler)
        return lambda request: response(**answer(request))

    def reset_positions(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Reset the robots to their initial poses, at rest, odometry and stall cleared.

        Time continues.
        """
        self._stage.reset_positions(np.array([self._world]))
        self._interface.publish()
        return {}

    def reset(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Reset everything, time too."""
        self._interface.rewind()
        self._interface.publish()
        return {}

    def pause(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Pause: no step is made once this is answered."""
        self._simulation.pause()
        return {}

    def unpause(self, _request: std_srvs.srv.EmptyRequest) -> Answer:
        """Unpause the world."""
        self._simulation.unpause()
        return {}

    def step(self, request: gazelle_msgs.srv.StepRequest) -> Answer:
        """Step a paused world; answers when it is done."""
        if not self._simulation.paused:
            return self._done("Step: the simulation is not paused", success=False)
        if request.steps > _MOST_STEPS:
            return self._done(f"Step: more than {_MOST_STEPS} steps", success=False)
        self._simulation.step(request.steps)
        return self._done("Step: done")

    def _done(self, text: str, *, success: bool = True) -> Answer:
        return {"success": success, "status_message": text, "time": self._interface.now()}

    def set_pose(self, request: gazelle_msgs.srv.SetPoseRequest) -> Answer:
        """Set the pose of a robot, by its name in the file or its prefix ``robot_N``."""
        pose = request.pose
        where = (pose.position.x, pose.position.y, heading_of(pose.orientation))
        if not all(map(math.isfinite, where)):
            return {"success": False, "status_message": "SetPose: the pose is not finite"}
        try:
            index = self._find(request.name)
        except SimulationError as error:
            return {"success": False, "status_message": f"SetPose: {error}"}
        self._stage.set_pose_of(index, where, np.array([self._world]))
        self._interface.publish()
        return {"success": True, "status_message": "SetPose: done"}

    def _find(self, name: str) -> int:
        known, plain = self._stage.named, name.strip("/")
        count, number = len(self._stage.robots), plain.removeprefix("robot_")
        if name in known or not (number != plain and number.isdecimal()):
            return self._stage.robot(name).index
        if int(number) >= count:
            hint = f"there are robot_0 to robot_{count - 1}" if count else "there are no robots"
            raise SimulationError(f"there is no robot '{name}'", hint=hint)
        return int(number)

    def set_rate(self, request: gazelle_msgs.srv.SetRealTimeFactorRequest) -> Answer:
        """Set the real-time factor: a number, or ``max``."""
        rate = read_factor(request.real_time_factor)
        if rate is None:
            said = f"expected {ACCEPTED}, not '{request.real_time_factor}'"
            return {"success": False, "status_message": f"SetRealTimeFactor: {said}"}
        self._interface.rate = rate if math.isfinite(rate) else None
        return {"success": True, "status_message": "SetRealTimeFactor: done"}

    def close(self) -> None:
        """Close the services."""
        for server in self._servers:
            server.close()
