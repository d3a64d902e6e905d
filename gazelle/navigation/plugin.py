"""A mobile robot that drives to goals: ``libgazelle_go_to_goal.so``."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Worlds
from gazelle.description import Parameters
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.navigation.following import Pose2
from gazelle.navigation.limits import BaseLimits
from gazelle.navigation.seeker import GoalSeeker
from gazelle.navigation.values import GoalPose, Path
from gazelle.rotations import conjugate, rotate, yaw_of
from gazelle.sensors import LaserScan, ScanningModel
from gazelle.simulation import (
    Input,
    ModelPlugin,
    Odometry,
    Output,
    Robot,
    SensorUnit,
    absolute,
    namespace_of,
)

_SHOW_EVERY = 1.0  # between two paths while it goes [s]


class GoToGoal(ModelPlugin):
    """Drives the model that it is on to goals, around what its laser sees.

    It uses the model's own ports, as a node on a graph would: the scans of its laser, its
    odometry and its drive's ``cmd_vel``; it commands only while there is a goal. Each world
    of a batch has a map and a path of its own, so worlds are gone through one by one, and
    only those with a goal: right for some worlds, not for thousands.

    Tags and defaults: ``goalTopic`` move_base_simple/goal, ``pathTopic`` path, ``laser`` (name
    of the sensor; the one with the most rays side by side), ``updateRate`` 20 Hz, ``robotRadius`` 0.2 m, ``clearance``
    0.05 m, ``maxSpeed`` 0.6 m/s, ``maxTurn`` 1.5 rad/s, ``maxAcceleration`` 0.8 m/s²,
    ``tolerance`` 0.1 m, ``yawTolerance`` 0.1 rad, ``resolution`` 0.05 m,
    ``globalFrame`` map (another name for the odometry's frame, as there is no drift to mend).
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, open the ports for goals and for the path."""
        self._robot, self._parameters = robot, parameters
        self._nworld = robot.simulation.nworld
        self.update_rate = parameters.get("updateRate", 20.0)
        self._global = parameters.get("globalFrame", "map")
        self._limits = _limits(parameters)
        self._unit, laser = laser_of(robot, parameters)
        self._laser_pose = laser
        self._seekers: dict[int, GoalSeeker] = {}
        self._scan: LaserScan | None = None
        self._sleep: Callable[[], None] | None = None
        self._shown_at = -math.inf
        self._shown = -1
        namespace = namespace_of(robot, parameters)
        goal = absolute(namespace, parameters.get("goalTopic", "move_base_simple/goal"))
        robot.inputs["goal"] = Input(goal, GoalPose, self.set_goal, forget=self._forget)
        path = absolute(namespace, parameters.get("pathTopic", "path"))
        robot.outputs["path"] = self._path = Output(path, Path, self._read_path)

    @property
    def active(self) -> bool:
        """True if any world has a goal."""
        return any(seeker.goal is not None for seeker in self._seekers.values())

    @property
    def arrived(self) -> NDArray[np.bool_]:
        """True for worlds that have reached their last goal, shape (nworld,)."""
        seekers = (self._seekers.get(world) for world in range(self._nworld))
        return np.array([seeker is not None and seeker.arrived for seeker in seekers])

    def set_goal(self, goal: GoalPose, worlds: Worlds | None = None) -> None:
        """Set a goal.

        Args:
            goal: In the frame of the odometry.
            worlds: Worlds; all if None.

        Raises:
            SimulationError: A number of the goal is not finite, or there is nothing to drive with.
        """
        if "cmd_vel" not in self._robot.inputs or "odom" not in self._robot.outputs:
            raise SimulationError(
                f"'{self._robot.name}' has no drive to go to goals with",
                source=self._parameters.source,
                hint="add a plugin with cmd_vel and odom, such as libgazebo_ros_diff_drive.so",
            )
        numbers = (goal.x, goal.y) if goal.yaw is None else (goal.x, goal.y, goal.yaw)
        if not np.isfinite(numbers).all():
            raise SimulationError(f"the goal of '{self._robot.name}' is not finite: {goal}")
        frame = goal.frame.strip("/")
        if frame not in ("", self._global, self._odometry().frame.strip("/")):
            warnings.warn(
                SimulationWarning(
                    f"the goal of '{self._robot.name}' is in the frame '{goal.frame}' and is "
                    f"left out; give it in '{self._odometry().frame}' or '{self._global}'"
                ),
                stacklevel=2,
            )
            return
        for world in self._chosen(worlds):
            self._seeker(world).set_goal(numbers)
        if self._sleep is None:
            self._sleep = self._unit.subscribe(self._receive_scan)

    def on_update(self, time: float) -> None:
        """Command all worlds that have a goal."""
        if self._sleep is None:
            self._sleep = self._unit.subscribe(self._receive_scan)
        poses = self._poses(time)
        for world, seeker in self._seekers.items():
            if seeker.goal is not None:
                forward, turning = seeker.update(poses[world], self._scan_of(world), time)
                command = self._robot.inputs["cmd_vel"]
                command.send(forward, turning, np.array([world]))
        self._show(time)
        if not self.active:
            self._disable_laser()

    def _show(self, time: float) -> None:
        """Publish the path when it is new or has got old."""
        plans = sum(seeker.plans for seeker in self._seekers.values())
        if plans != self._shown or time - self._shown_at >= _SHOW_EVERY or not self.active:
            self._shown, self._shown_at = plans, time
            self._path.publish()

    def _receive_scan(self, unit: SensorUnit) -> None:
        self._scan = unit.reading(unit.current())

    def _disable_laser(self) -> None:
        """Disable the laser while there is no goal."""
        if self._sleep is not None:
            self._sleep()
            self._sleep = None
        self._scan = None

    def _scan_of(self, world: int) -> LaserScan | None:
        """Return one world's scan: the middle row, if there are several."""
        scan = self._scan
        if scan is None:
            return None
        rows = self._unit.model.rows
        ranges = scan.ranges[world].reshape(rows, -1)[rows // 2]
        return LaserScan(
            scan.stamp,
            ranges,
            scan.angle_min,
            scan.angle_max,
            scan.angle_increment,
            scan.range_min,
            scan.range_max,
        )

    def _odometry(self) -> Odometry:
        odometry: Odometry = self._robot.outputs["odom"].last
        return odometry

    def _poses(self, time: float) -> list[Pose2]:
        """Return x, y and heading in every world: the last odometry, advanced to now."""
        odometry = self._odometry()
        since = time - odometry.stamp / 1e9
        place = odometry.position + since * rotate(odometry.quaternion, odometry.linear)
        yaw = yaw_of(odometry.quaternion) + since * odometry.angular[:, 2]
        found = np.column_stack((place[:, :2], yaw)).tolist()
        return [(x, y, heading) for x, y, heading in found]

    def _read_path(self) -> Path:
        paths = []
        for world in range(self._nworld):
            seeker = self._seekers.get(world)
            points = np.zeros((0, 2)) if seeker is None else seeker.path
            ahead = np.diff(points, axis=0, append=points[-1:])
            headings = np.arctan2(ahead[:, 1], ahead[:, 0])
            if len(points) > 1:
                headings[-1] = headings[-2]
            paths.append(np.column_stack((points, headings)))
        now = self._robot.simulation.clock.now_ns
        return Path(now, self._odometry().frame, tuple(paths))

    def _seeker(self, world: int) -> GoalSeeker:
        if world not in self._seekers:
            self._seekers[world] = GoalSeeker(
                self._limits,
                laser=self._laser_pose,
                resolution=self._parameters.get("resolution", 0.05),
                tolerance=self._parameters.get("tolerance", 0.1),
                yaw_tolerance=self._parameters.get("yawTolerance", 0.1),
            )
        return self._seekers[world]

    def _chosen(self, worlds: Worlds | None) -> list[int]:
        return list(range(self._nworld)) if worlds is None else worlds.tolist()

    def _forget(self, worlds: Worlds | None) -> None:
        for world in self._chosen(worlds):
            self._seekers.pop(world, None)

    def reset(self, worlds: Worlds | None) -> None:
        """Clear goals and maps."""
        self._forget(worlds)
        self._shown_at = -math.inf
        if not self.active:
            self._disable_laser()

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return goals, maps and paths of the worlds that had a goal."""
        held: dict[str, NDArray[np.generic]] = {
            f"{world}/{name}": values
            for world, seeker in self._seekers.items()
            for name, values in seeker.state().items()
        }
        if self._scan is not None:
            held["ranges"] = self._scan.ranges.copy()
            held["stamp"] = np.array(self._scan.stamp)
        return held

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._seekers.clear()
        parts: dict[int, dict[str, NDArray[np.generic]]] = {}
        for name, values in state.items():
            world, _, part = name.partition("/")
            if part:
                parts.setdefault(int(world), {})[part] = values
        for number, held in parts.items():
            self._seeker(number).restore(held)
        self._disable_laser()
        if "ranges" in state:
            ranges = np.array(state["ranges"], np.float64)
            self._scan = self._unit.model.reading(ranges, int(state["stamp"]))
        self._shown_at = -math.inf


def _limits(parameters: Parameters) -> BaseLimits:
    usual = BaseLimits()
    return BaseLimits(
        radius=parameters.get("robotRadius", usual.radius),
        clearance=parameters.get("clearance", usual.clearance),
        linear=parameters.get("maxSpeed", usual.linear),
        angular=parameters.get("maxTurn", usual.angular),
        linear_acceleration=parameters.get("maxAcceleration", usual.linear_acceleration),
    )


def laser_of(robot: Robot, parameters: Parameters) -> tuple[Any, Pose2]:
    """Return the laser to use, and its pose in the model.

    Of several it is the one with the most rays side by side, so that it is no sonar; of equals the first.

    Raises:
        SimulationError: The model has none of that name, or none at all.
    """
    wished = parameters.get("laser", "")
    units = [robot.sensors[wished]] if wished else list(robot.sensors.values())
    scanning = [(unit, model) for unit in units if isinstance(model := unit.model, ScanningModel)]
    if not scanning:
        raise SimulationError(
            f"'{robot.name}' has no laser to see obstacles with",
            source=parameters.source or robot.description.source,
            hint="add a sensor of type 'ray', or to a model of Stage a 'ranger'",
        )
    unit, _ = max(scanning, key=lambda each: each[1].samples // max(each[1].rows, 1))
    link = next(
        link for link in robot.links.values() if unit.description in link.description.sensors
    )
    base, place = robot.placement(np.array([0])), link.placement(np.array([0]))
    back = conjugate(base.quaternion)
    mount = unit.description.pose
    offset = rotate(place.quaternion, np.array([mount.position]))
    at = rotate(back, place.position + offset - base.position)[0]
    turned = float(yaw_of(place.quaternion)[0] - yaw_of(base.quaternion)[0]) + mount.yaw
    return unit, (float(at[0]), float(at[1]), turned)
