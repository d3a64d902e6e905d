"""Joints along waypoints: what ``libgazebo_ros_joint_pose_trajectory.so`` does."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError
from gazelle.simulation import Input, ModelPlugin, Robot, Service, absolute, namespace_of
from gazelle.simulation.values import JointPath, PathRequest, ServiceOutcome


@dataclass(slots=True)
class _Play:
    """A path on its way in some worlds; ``done`` waypoints are behind it."""

    path: JointPath
    start_ns: int
    worlds: Worlds
    done: int = 0


class JointPoseTrajectory(ModelPlugin):
    """Puts joints at the waypoints of a path at their times; a new path ends the old one."""

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open the ports."""
        self._robot, self._clock = robot, robot.simulation.clock
        self._plays: list[_Play] = []
        self.update_rate = parameters.get("updateRate", 0.0)
        namespace = namespace_of(robot, parameters)
        name = "set_joint_trajectory"
        robot.inputs[name] = Input(
            absolute(namespace, parameters.get("topicName", name)),
            JointPath,
            self._begin,
            forget=self.reset,
            queue_size=100,
        )
        robot.services[name] = Service(
            absolute(namespace, parameters.get("serviceName", name)),
            PathRequest,
            ServiceOutcome,
            self._answer,
        )

    @property
    def active(self) -> bool:
        """True if a path is being followed."""
        return bool(self._plays)

    def on_update(self, time: float) -> None:  # noqa: ARG002  it counts in nanoseconds
        """Set the joints to the last due waypoint."""
        for play in self._plays:
            elapsed = (self._clock.now_ns - play.start_ns) * 1e-9
            # A waypoint is due on the step nearest to it.
            slack = self._clock.step_ns * 0.5e-9
            due = int(np.searchsorted(play.path.times, elapsed + slack, side="right"))
            if due > play.done:
                play.done = due
                self._robot.set_configuration(
                    play.path.names, play.path.positions[due - 1], play.worlds
                )
        self._plays = [play for play in self._plays if play.done < len(play.path.times)]

    def _begin(self, path: JointPath, worlds: Worlds | None) -> None:
        """Start a path.

        Raises:
            SimulationError: There is no such joint, or positions do not fit the joints.
        """
        for name in path.names:
            self._robot.joints[name]
        if path.positions.shape != (len(path.times), len(path.names)):
            raise SimulationError(
                f"a path of {len(path.times)} points of {len(path.names)} joints needs as many "
                f"positions, not {path.positions.shape}"
            )
        self.reset(worlds)
        start = max(self._clock.now_ns, path.start_ns)
        everywhere = np.arange(self._robot.simulation.nworld)
        self._plays.append(_Play(path, start, everywhere if worlds is None else worlds))

    def _answer(self, request: PathRequest, worlds: Worlds | None) -> ServiceOutcome:
        try:
            self._begin(request.path, worlds)
        except SimulationError as error:
            return ServiceOutcome(success=False, text=str(error))
        if request.position is not None:
            self._robot.set_pose(request.position, request.quaternion, worlds=worlds)
        return ServiceOutcome(success=True, text="SetJointTrajectory: trajectory set")

    def reset(self, worlds: Worlds | None) -> None:
        """End all paths in these worlds."""
        if worlds is None:
            self._plays = []
        for play in self._plays:
            play.worlds = np.setdiff1d(play.worlds, worlds if worlds is not None else play.worlds)
        self._plays = [play for play in self._plays if play.worlds.size]

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the active paths."""
        state: dict[str, NDArray[np.generic]] = {}
        for i, play in enumerate(self._plays):
            state[f"{i} names"] = np.asarray(play.path.names, np.str_)
            state[f"{i} times"] = play.path.times
            state[f"{i} positions"] = play.path.positions
            state[f"{i} worlds"] = play.worlds
            state[f"{i} start"] = np.array([play.start_ns, play.done])
        return state

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._plays = []
        for i in range(len(state) // 5):
            path = JointPath(
                tuple(str(name) for name in state[f"{i} names"]),
                np.asarray(state[f"{i} times"], np.float64),
                np.asarray(state[f"{i} positions"], np.float64),
            )
            start, done = (int(value) for value in state[f"{i} start"])
            worlds = np.asarray(state[f"{i} worlds"], np.intp)
            self._plays.append(_Play(path, start, worlds, done))
