"""Models that follow a script: ``libgazelle_scripted_motion.so``, Gazelle's own.

The model becomes kinematic: it pushes others, nothing pushes it. Tags::

    <waypoint><time>SECONDS</time><pose>x y z roll pitch yaw</pose></waypoint>  (repeated)
    <trajectory tension="0" start="0"><waypoint/></trajectory>  splines instead of straight lines
    <loop>true</loop>
    <angular_velocity>x y z</angular_velocity>   turn about the model's origin instead
    <updateRate>10</updateRate>                  how often the pose is set [Hz]
"""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters, Pose
from gazelle.errors import SimulationError
from gazelle.native.paths import ModelPath, PosePath
from gazelle.native.system import System
from gazelle.plugins.splines import PoseSpline
from gazelle.simulation import ModelPlugin, PluginSystem, Robot

_XYZW = np.array([1, 2, 3, 0])  # columns of a quaternion (w, x, y, z)


class ScriptedMotion(ModelPlugin):
    """Moves a model along waypoints in the world frame, or turns it evenly.

    Waypoints are joined by straight lines, those of a ``<trajectory>`` by a spline as Gazebo's
    actors follow; several trajectories follow each other, each from its ``start`` on. Every
    world has a time of its own that starts at its reset.

    Attributes:
        robot: The model that moves.
        loop: Whether the script starts over at its end.
        spin: Turning rate about the model's origin, in its own frame [rad/s], shape (3,).
        times: Of the k waypoints [s], shape (k,).
        positions: Of the waypoints [m], shape (k, 3).
        quaternions: Of the waypoints, (x, y, z, w), shape (k, 4).
        splines: Starts [s] and paths of the trajectories, instead of waypoints.
        start: Position [m] and quaternion that the model was spawned with.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the script and take hold of the model."""
        self.robot, self.system = robot, ScriptSystem
        self.loop = parameters.get("loop", False)
        self.spin = np.asarray(parameters.numbers("angular_velocity", (0.0, 0.0, 0.0)))
        self.times, self.positions, self.quaternions = _waypoints(parameters)
        self.splines = [_spline(tag) for tag in parameters.find_all("trajectory")]
        self.update_rate = parameters.get("updateRate", 10.0)
        start = robot.description.pose
        self.start = np.asarray(start.position), np.asarray(start.quaternion)
        self._epoch = np.full(robot.simulation.nworld, robot.simulation.time)
        self._prepare(robot.simulation.nworld)
        robot.simulation.engine.make_kinematic(robot.name)

    def _prepare(self, nworld: int) -> None:
        """Make what finds poses for a given number of worlds."""
        self._begun = np.zeros(nworld)
        self._position, self._quaternion = np.empty((nworld, 3)), np.empty((nworld, 4))
        self._poses = PosePath(
            self._path(self._begun),
            self._position,
            self._quaternion,
            arm=np.zeros(3),
            turned=np.array([0.0, 0.0, 0.0, 1.0]),
            moved=np.zeros(1),
        )

    def bind(self) -> System | None:
        """Return what moves the model in the engine's steps; None where Python does."""
        engine = self.robot.simulation.engine
        if self.splines:
            return None
        return engine.models[self.robot.name].path(self._path(self._epoch))

    def _path(self, epoch: Floats) -> ModelPath:
        """Return the script without trajectories, begun at some times [s], shape (n,)."""
        path, start = (self.times, self.positions, self.quaternions), self.start
        return ModelPath(*path, *start, self.spin, self.loop, epoch)

    @property
    def period(self) -> float:
        """After how long the script starts again [s]; 0 if it never does."""
        if self.splines:
            last = self.splines[-1][0] + self.splines[-1][1].duration
            return float(last) if self.loop else 0.0
        if self.times.size:
            return float(self.times[-1]) if self.loop else 0.0
        rate = float(np.linalg.norm(self.spin))
        return 2.0 * np.pi / rate if rate > 0.0 else 0.0

    def begin_at(self, elapsed: Floats, worlds: Worlds) -> None:
        """Continue in these worlds as if the script had started so long ago [s], shape (n,)."""
        self._epoch[worlds] = self.robot.simulation.time - elapsed
        self.robot.simulation.engine.models[self.robot.name].set_placement(
            *self._placed(elapsed), worlds
        )

    def move(self, time: float) -> None:
        """Set the pose of the model to the script's at a time [s]."""
        self.robot.simulation.engine.models[self.robot.name].set_placement(
            *self._placed(time - self._epoch)
        )

    def _placed(self, elapsed: Floats) -> tuple[Floats, Floats]:
        """Return positions [m] and quaternions after some times, shapes (n, 3) and (n, 4)."""
        if self.splines:
            return self._on_splines(elapsed)
        count = len(elapsed)
        np.negative(elapsed, out=self._begun[:count])
        self._poses.update_from_python(0, count, 0)
        return self._position[:count], self._quaternion[:count].take(_XYZW, axis=1)

    def _on_splines(self, elapsed: Floats) -> tuple[Floats, Floats]:
        end = self.splines[-1][0] + self.splines[-1][1].duration
        moment = elapsed % end if self.loop and end > 0.0 else np.minimum(elapsed, end)
        starts = np.array([start for start, _ in self.splines[1:]])
        # A moment at which one ends and the next begins is the one's.
        chosen = np.searchsorted(starts, moment, side="left")
        position, quaternion = np.zeros((len(moment), 3)), np.zeros((len(moment), 4))
        for index, (start, spline) in enumerate(self.splines):
            rows = np.flatnonzero(chosen == index)
            position[rows], quaternion[rows] = spline.at(moment[rows] - start)
        return position, quaternion

    def reset(self, worlds: Worlds | None) -> None:
        """Start the script over."""
        rows = slice(None) if worlds is None else worlds
        self._epoch[rows] = self.robot.simulation.time

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the start of each world's script."""
        return {"epoch": self._epoch.copy()}

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._epoch[:] = state["epoch"]


class ScriptSystem(PluginSystem[ScriptedMotion]):
    """One script, which the engine follows where it can.

    Args:
        plugins: One.
    """

    single = True

    def __init__(self, plugins: Sequence[ScriptedMotion]) -> None:
        super().__init__(plugins)
        self.kernel = plugins[0].bind()

    def update(self, time: float) -> None:
        """Set the pose of the model to its script's."""
        self.plugins[0].move(time)


def _waypoints(parameters: Parameters) -> tuple[Floats, Floats, Floats]:
    """Return times (k,), positions (k, 3) and quaternions (k, 4), neighbours on the same half."""
    times, poses = [], []
    for waypoint in parameters.find_all("waypoint"):
        times.append(waypoint.require("time", float))
        poses.append(Pose(*waypoint.numbers("pose", (0.0,) * 6)))
    if any(late <= early for early, late in itertools.pairwise(times)):
        raise SimulationError("the times of waypoints must increase", source=parameters.source)
    quaternions = np.array([pose.quaternion for pose in poses]).reshape(-1, 4)
    for i in range(1, len(quaternions)):
        if quaternions[i] @ quaternions[i - 1] < 0.0:
            quaternions[i] *= -1.0
    positions = np.array([pose.position for pose in poses]).reshape(-1, 3)
    return np.asarray(times, np.float64), positions, quaternions


def _spline(tag: Parameters) -> tuple[float, PoseSpline]:
    """Return the start of a trajectory, and its path."""
    times, poses = [], []
    for waypoint in tag.find_all("waypoint"):
        times.append(waypoint.require("time", float))
        poses.append(Pose(*waypoint.numbers("pose", (0.0,) * 6)))
    if not times:
        raise SimulationError("a <waypoint> is required here", source=tag.source)
    numbers = (tag.attributes.get(name, "") or "0" for name in ("start", "tension"))
    try:
        start, tension = map(float, numbers)
        spline = PoseSpline(
            np.array(times),
            np.array([pose.position for pose in poses]),
            np.array([pose.quaternion for pose in poses]),
            tension,
        )
    except (SimulationError, ValueError) as error:
        raise SimulationError(f"wrong trajectory: {error}", source=tag.source) from None
    return start, spline
