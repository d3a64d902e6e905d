"""The class `Robot`: a model in a running simulation, with its links, joints, sensors and ports."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.control import ControllerManager
from gazelle.description import Joint, Model, Pose, Sensor
from gazelle.engines import Motion, Placement, Wrench
from gazelle.errors import SimulationError
from gazelle.rendering import LiveScene
from gazelle.sensors import SensorModel
from gazelle.simulation import model_handles
from gazelle.simulation.events import Events
from gazelle.simulation.inputs import FIRST_WORLD, chosen, finite, motion, placement, size_of
from gazelle.simulation.joints import JointHandle
from gazelle.simulation.links import LinkHandle, orientation_of
from gazelle.simulation.mappings import Named
from gazelle.simulation.parameters import WorldParameters
from gazelle.simulation.physics import PhysicsProperties
from gazelle.simulation.ports import Ports
from gazelle.simulation.running_state import RunningState, StepMaker
from gazelle.simulation.scheduled_plugin import ScheduledPlugin
from gazelle.simulation.sensor_models import mounts, sensor_model
from gazelle.simulation.sensors import SampledSensor
from gazelle.simulation.state_lock import between_steps

if TYPE_CHECKING:
    from gazelle.simulation.navigation import NavigationControl


class RobotHost(RunningState, Protocol):
    """The simulation that a robot is in, as it and plugins see it; see ``Simulation``.

    Attributes:
        paused: Whether ``run`` refuses to run.
        physics: Time step, gravity, solver and the like.
        parameters: Masses, friction and the like of each world.
        ports: Of the plugins of the world.
        events: Emitted on spawn, delete and reset.
        live_scene: Scene of the cameras.
    """

    paused: bool
    physics: PhysicsProperties
    parameters: WorldParameters
    ports: Ports
    events: Events
    live_scene: LiveScene

    @property
    def loop(self) -> StepMaker:
        """Step loop."""

    @property
    def robots(self) -> Mapping[str, Robot]:
        """All models by name."""

    @property
    def plugins(self) -> list[ScheduledPlugin]:
        """Plugins of the world and of all models."""

    @property
    def time(self) -> float:
        """Simulated time [s]."""

    def step(self, count: int = 1) -> None:
        """Advance by physics steps; not for plugins, which act in one."""

    def run(self, seconds: float, *, rate: float | None = None) -> None:
        """Advance by simulated time [s]; likewise."""

    def subscribe(self, listener: Callable[[], None]) -> Callable[[], None]:
        """Call a function after every step; returns what ends it."""

    def pause(self) -> None:
        """Make ``run`` fail until ``unpause``."""

    def unpause(self) -> None:
        """Allow ``run`` again."""

    def spawn(
        self,
        model: Model | str | Path,
        name: str | None = None,
        pose: Pose | None = None,
        namespace: str = "",
    ) -> Robot:
        """Add a model to every world."""

    def delete(self, name: str) -> None:
        """Delete a model from every world."""

    def reset(
        self, worlds: ArrayLike | None = None, *, seed: int | None = None, time: bool = True
    ) -> None:
        """Reset worlds to their initial state."""

    def attach(
        self,
        parent: LinkHandle,
        child: LinkHandle,
        worlds: Worlds | None = None,
        *,
        settling: float | None = None,
    ) -> None:
        """Attach two links to each other."""

    def detach(self, parent: LinkHandle, child: LinkHandle, worlds: Worlds | None = None) -> None:
        """Detach two links that ``attach`` holds together."""

    def set_light(self, name: str, **changes: Any) -> None:
        """Set properties of a light."""

    def load_plugin(self, filename: str) -> None:
        """Start a plugin that no file names."""


class Robot(Ports):
    """A model in a running simulation, with its ports.

    Attributes:
        name: Its name in the world.
        namespace: Put before its topics.
        description: Its description.
        links: By name within the robot (``arm::hand`` for a nested model's), its own before it or not.
        joints: Those that move, by name within the robot.
        sensors: By name.
        managers: Of its controllers, by namespace; one for each ``libgazebo_ros_control.so`` that it has.
    """

    def __init__(
        self,
        simulation: RobotHost,
        model: Model,
        namespace: str = "",
        sensors: Sequence[tuple[Sensor, SensorModel]] | None = None,
    ) -> None:
        super().__init__(simulation.lock, namespace)
        self.simulation = simulation
        self._lock = simulation.lock
        self.name = model.name
        self.description = model
        self.managers: dict[str, ControllerManager] = {}
        self._row = simulation.engine.models[model.name]
        self._links = model_handles.link_handles(simulation, model)
        self.links: Mapping[str, LinkHandle] = Named("link", self._links, self.name)
        self.joints: Mapping[str, JointHandle] = Named(
            "moving joint", model_handles.joint_handles(simulation, model), self.name
        )
        self.sensors: Mapping[str, SensorUnit] = Named(
            "sensor", _sensor_units(self, model, sensors), self.name
        )

    @property
    @between_steps
    def controllers(self) -> ControllerManager:
        """Its controllers: ``load``, ``start``, ``stop``, and each one's ports by its name.

        Without ``libgazebo_ros_control.so`` in its file each joint with one axis can be controlled,
        by effort, position and velocity. Of several managers it is the first; ``managers`` has all.
        """
        if not self.managers:
            from gazelle.simulation.control_loop import add_controllers  # it needs robots itself

            return add_controllers(self)
        return next(iter(self.managers.values()))

    def add_manager(self, namespace: str, manager: ControllerManager) -> None:
        """Add one more controller manager, and report it to the bridges."""
        self.managers[namespace] = manager
        self.simulation.events.managed.emit(self)

    @property
    @between_steps
    def navigation(self) -> NavigationControl:
        """Navigation of a robot with drive and laser: ``robot.navigation.go_to(2.0, 1.0)``.

        Raises:
            SimulationError: The robot has no drive or no laser.
        """
        from gazelle.simulation.navigation_plugin import navigation_of  # it needs robots itself

        return navigation_of(self)

    @property
    @between_steps
    def pose(self) -> Pose:
        """Pose of the model frame in world 0."""
        return self._row.pose(0)

    @property
    @between_steps
    def twist(self) -> Motion:
        """Velocity of the model frame in world 0, in the world frame."""
        motion = self.motion(FIRST_WORLD)
        return Motion(motion.linear[0], motion.angular[0])

    @property
    @between_steps
    def position(self) -> Floats:
        """Position [m], shape (nworld, 3)."""
        return self.placement().position

    @property
    @between_steps
    def quaternion(self) -> Floats:
        """(x, y, z, w), shape (nworld, 4)."""
        return self.placement().quaternion

    @property
    @between_steps
    def yaw(self) -> Floats:
        """Heading [rad], shape (nworld,)."""
        return self.planar_pose()[:, 2]

    @property
    def first_link(self) -> LinkHandle | None:
        """The canonical link, with which the model frame moves; None of a model without links."""
        return next(iter(self._links.values()), None)

    @between_steps
    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Return the pose of the model frame in many worlds."""
        return self._row.placement(self._some(worlds))

    @between_steps
    def planar_pose(self, worlds: Worlds | None = None) -> Floats:
        """Return x, y [m] and heading [rad] of the model frame in many worlds, shape (n, 3)."""
        return self._row.planar_pose(self._some(worlds))

    @between_steps
    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Return the velocity of the canonical link in many worlds, in the world frame.

        It is 0 without a link.
        """
        first = self.first_link
        if first is None:
            count = size_of(self._some(worlds), self.simulation.nworld)
            return Motion(np.zeros((count, 3)), np.zeros((count, 3)))
        return first.motion(worlds)

    @between_steps
    def set_pose(
        self,
        position: ArrayLike,
        quaternion: ArrayLike | None = None,
        *,
        yaw: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Set the pose of the robot, at rest.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4); upright if None.
            yaw: Heading [rad] instead of a quaternion, shape () or (n,).
            worlds: Worlds; all if None.

        Raises:
            SimulationError: A value is invalid, or both a quaternion and a heading are given.
        """
        engine = self.simulation.engine
        some, turned = chosen(worlds, engine.nworld), orientation_of(quaternion, yaw)
        place = placement(self.name, position, turned, size_of(some, engine.nworld))

        self._row.set_placement(*place, some)
        self._row.set_motion(np.zeros(3), np.zeros(3), some)

    @between_steps
    def set_twist(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity of the robot in the world frame [m/s, rad/s], shape (3,) or (n, 3).

        One without links has nothing that could move, and stays.

        Raises:
            SimulationError: A value is invalid.
        """
        engine = self.simulation.engine
        some = chosen(worlds, engine.nworld)
        twist = motion(self.name, linear, angular, size_of(some, engine.nworld))
        if self._links:
            self._row.set_motion(*twist, some)

    @between_steps
    def set_configuration(
        self,
        joints: Sequence[str],
        positions: ArrayLike,
        worlds: Worlds | None = None,
    ) -> None:
        """Set joint positions at rest, all at once, clipped to their limits as in Gazebo.

        Args:
            joints: Names within the robot, each of one axis.
            positions: [m or rad], in that order, shape (joints,) or (n, joints).
            worlds: Worlds; all if None.

        Raises:
            SimulationError: There is no such joint, one has several axes, or there are more or
                fewer positions.
        """
        engine = self.simulation.engine
        handles = [self.joints[joint] for joint in joints]
        for handle in handles:
            if handle.axes != 1:
                raise SimulationError(
                    f"joint '{handle.name}' has {handle.axes} axes; a configuration is of joints "
                    "with one"
                )
        some = chosen(worlds, engine.nworld)
        what = f"the positions of {', '.join(joints)}"
        values = finite(what, positions, len(joints), size_of(some, engine.nworld))

        for column, handle in enumerate(handles):
            engine.joints[handle.name].set_position(values[..., column, None], some)
            engine.joints[handle.name].set_velocity(np.zeros(1), some)

    @between_steps
    def wrench(self, joint: str, worlds: Worlds | None = None) -> Wrench:
        """Return the wrench of a joint's child on its parent, about the joint, in the world frame.

        Args:
            joint: Name within the robot; fixed joints have a wrench too.
            worlds: Worlds; all if None.

        Raises:
            SimulationError: There is no such joint.
            EngineError: The model does not move.
        """
        self.joint_description(joint)
        return self.simulation.engine.joints[f"{self.name}::{joint}"].wrench(self._some(worlds))

    def _some(self, worlds: Worlds | None) -> Worlds | None:
        return chosen(worlds, self.simulation.nworld)

    def joint_description(self, name: str) -> Joint:
        """Return the joint's description in the file, of fixed ones too.

        Raises:
            SimulationError: There is no joint of that name.
        """
        return model_handles.joint_description(self.description, name)

    def frame(self, name: str) -> tuple[LinkHandle, Pose]:
        """Return the link that a frame moves with, and the frame's pose in it.

        Links that a URDF fixed to others live on as frames.

        Raises:
            SimulationError: There is no link or frame of that name.
        """
        if name in self.links:
            return self.links[name], Pose()
        return model_handles.frame_of(self.description, self._links, name)


class SensorUnit(SampledSensor):
    """One sensor of one robot.

    It sleeps until it is read or subscribed to; then it measures at its ``update_rate``.

    Attributes:
        robot: The robot that it is on.
    """

    def __init__(self, robot: Robot, sensor: Sensor, name: str, model: SensorModel) -> None:
        super().__init__(robot.simulation, sensor, name, model)
        self.robot = robot


def _sensor_units(
    robot: Robot, model: Model, sensors: Sequence[tuple[Sensor, SensorModel]] | None
) -> dict[str, SensorUnit]:
    """Return the sensors by name: those that are given, else what the file says."""
    simulation = robot.simulation
    if sensors is not None:
        base = f"{model.name}::{model.links[0].name}"
        return {
            sensor.name: SensorUnit(robot, sensor, f"{base}::{sensor.name}", made)
            for sensor, made in sensors
        }
    units: dict[str, SensorUnit] = {}
    for mount in mounts(simulation.engine, simulation.live_scene, model, simulation.seed):
        made = sensor_model(mount)
        if made is not None:
            units[mount.sensor.name] = SensorUnit(robot, mount.sensor, mount.name, made)
    return units
