"""A model in a running simulation: where it is, its links, joints, sensors and ports."""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gazelle.description import Link, Model, Pose
from gazelle.engines import Engine, Motion, Placement
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean
from gazelle.rotations import from_yaw, yaw_of
from gazelle.simulation.ports import Output, TwistInput
from gazelle.simulation.sensors import SensorUnit, sensor_model

if TYPE_CHECKING:
    from gazelle.simulation.simulation import Simulation

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]
T = TypeVar("T")


class Named(Mapping[str, T]):
    """A mapping whose misses say what there is."""

    def __init__(self, kind: str, items: dict[str, T]) -> None:
        self._kind = kind
        self._items = items

    def __getitem__(self, name: str) -> T:
        try:
            return self._items[name]
        except KeyError:
            raise SimulationError(
                f"there is no {self._kind} '{name}'", hint=did_you_mean(name, self._items)
            ) from None

    def __contains__(self, name: object) -> bool:
        return name in self._items

    def __iter__(self) -> Iterator[str]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)


class LinkHandle:
    """A link of a robot."""

    def __init__(self, engine: Engine, name: str, link: Link) -> None:
        self.name = name
        self.description = link
        self._engine = engine

    @property
    def pose(self) -> Pose:
        """Its pose in world 0."""
        place = self._engine.link_placement(self.name, np.array([0]))
        return Pose.from_quaternion(tuple(place.position[0]), tuple(place.quaternion[0]))

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Its pose in many worlds."""
        return self._engine.link_placement(self.name, worlds)

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Its velocity in many worlds, in the world frame."""
        return self._engine.link_motion(self.name, worlds)


class JointHandle:
    """A joint of a robot; values are of world 0 when read, of all worlds when set."""

    def __init__(self, engine: Engine, name: str) -> None:
        self.name = name
        self._engine = engine

    @property
    def position(self) -> float:
        """Position of the first axis [m or rad]; setting it teleports the joint."""
        return float(self._engine.joint_position(self.name, np.array([0]))[0, 0])

    @position.setter
    def position(self, value: ArrayLike) -> None:
        self._engine.set_joint_position(self.name, _column(value))

    @property
    def velocity(self) -> float:
        """Velocity of the first axis [m/s or rad/s]; setting it changes the state at once."""
        return float(self._engine.joint_velocity(self.name, np.array([0]))[0, 0])

    @velocity.setter
    def velocity(self, value: ArrayLike) -> None:
        self._engine.set_joint_velocity(self.name, _column(value))

    @property
    def effort(self) -> None:
        """Write only: effort applied until told otherwise [N or N m]."""
        raise SimulationError(f"the effort on joint '{self.name}' is measured by a force sensor")

    @effort.setter
    def effort(self, value: ArrayLike) -> None:
        self._engine.set_joint_effort(self.name, _column(value))

    def positions(self, worlds: Worlds | None = None) -> Floats:
        """Positions of all axes, shape (n, axes)."""
        return self._engine.joint_position(self.name, worlds)

    def velocities(self, worlds: Worlds | None = None) -> Floats:
        """Velocities of all axes, shape (n, axes)."""
        return self._engine.joint_velocity(self.name, worlds)

    def add_motor(self, max_effort: float) -> None:
        """Put a velocity motor of limited effort [N or N m] on it."""
        self._engine.add_motor(self.name, max_effort)

    def drive(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set what the motor holds [m/s or rad/s], shape () or (n,)."""
        self._engine.set_motor_velocity(self.name, velocity, worlds)


class Robot:
    """A model in a running simulation.

    Attributes:
        name: Its name in the world.
        namespace: Put before its topics.
        description: What it was made from.
        links: By name within the robot (``arm::hand`` for a nested model's).
        joints: Those that move, by name within the robot.
        sensors: By name.
        inputs: Ports that take commands.
        outputs: Ports that publish.
    """

    def __init__(self, simulation: Simulation, model: Model, namespace: str = "") -> None:
        self.simulation = simulation
        self.name = model.name
        self.namespace = namespace
        self.description = model
        self.inputs: dict[str, TwistInput] = {}
        self.outputs: dict[str, Output[Any]] = {}
        self._links = _link_handles(simulation.engine, model)
        own = f"in '{self.name}'"
        self.links: Mapping[str, LinkHandle] = Named(f"link {own}", self._links)
        self.joints: Mapping[str, JointHandle] = Named(
            f"moving joint {own}", _joint_handles(simulation.engine, model)
        )
        self.sensors: Mapping[str, SensorUnit] = Named(f"sensor {own}", _sensor_units(self, model))

    @property
    def pose(self) -> Pose:
        """Pose of the model frame in world 0."""
        place = self.placement(np.array([0]))
        return Pose.from_quaternion(tuple(place.position[0]), tuple(place.quaternion[0]))

    @property
    def twist(self) -> Motion:
        """Velocity of the model frame in world 0, in the world frame."""
        motion = self.motion(np.array([0]))
        return Motion(motion.linear[0], motion.angular[0])

    @property
    def position(self) -> Floats:
        """[m], shape (nworld, 3)."""
        return self.placement().position

    @property
    def quaternion(self) -> Floats:
        """(x, y, z, w), shape (nworld, 4)."""
        return self.placement().quaternion

    @property
    def yaw(self) -> Floats:
        """Heading [rad], shape (nworld,)."""
        return yaw_of(self.placement().quaternion)

    def placement(self, worlds: Worlds | None = None) -> Placement:
        """Pose of the model frame in many worlds."""
        return self.simulation.engine.model_placement(self.name, worlds)

    def motion(self, worlds: Worlds | None = None) -> Motion:
        """Velocity of the canonical link in many worlds, in the world frame."""
        first = next(iter(self._links.values()))
        return first.motion(worlds)

    def set_pose(
        self,
        position: ArrayLike,
        quaternion: ArrayLike | None = None,
        *,
        yaw: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Put the robot somewhere, at rest.

        Args:
            position: [m], shape (3,) or (n, 3).
            quaternion: (x, y, z, w), shape (4,) or (n, 4); upright if None.
            yaw: Heading [rad] instead of a quaternion, shape () or (n,).
            worlds: Which worlds; all if None.
        """
        if quaternion is None:
            quaternion = from_yaw(np.asarray(0.0 if yaw is None else yaw, np.float64))

        def work() -> None:
            engine = self.simulation.engine
            engine.set_model_placement(self.name, position, quaternion, worlds)
            engine.set_model_motion(self.name, np.zeros(3), np.zeros(3), worlds)

        self.simulation.requests.call(work)

    def set_twist(
        self, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give the robot a velocity in the world frame [m/s, rad/s], shape (3,) or (n, 3)."""
        engine = self.simulation.engine
        self.simulation.requests.call(
            lambda: engine.set_model_motion(self.name, linear, angular, worlds)
        )

    def frame(self, name: str) -> tuple[LinkHandle, Pose]:
        """The link that a frame moves with, and the frame's pose in it.

        Links that a URDF fixed to others live on as frames.

        Raises:
            SimulationError: There is no link or frame of that name.
        """
        if name in self._links:
            return self._links[name], Pose()
        for placed in self.description.walk():
            for frame in placed.model.frames:
                if frame.name == name and frame.attached_to in self._links:
                    return self._links[frame.attached_to], frame.pose
        known = [*self._links, *(f.name for f in self.description.frames)]
        raise SimulationError(
            f"'{self.name}' has no link or frame '{name}'", hint=did_you_mean(name, known)
        )


def _link_handles(engine: Engine, model: Model) -> dict[str, LinkHandle]:
    return {
        _inner(placed.scope, model.name, link.name): LinkHandle(
            engine, f"{placed.scope}::{link.name}", link
        )
        for placed in model.walk()
        for link in placed.model.links
    }


def _joint_handles(engine: Engine, model: Model) -> dict[str, JointHandle]:
    moving = set(engine.joint_names)
    return {
        _inner(placed.scope, model.name, joint.name): JointHandle(
            engine, f"{placed.scope}::{joint.name}"
        )
        for placed in model.walk()
        for joint in placed.model.joints
        if f"{placed.scope}::{joint.name}" in moving
    }


def _sensor_units(robot: Robot, model: Model) -> dict[str, SensorUnit]:
    units: dict[str, SensorUnit] = {}
    for placed in model.walk():
        for link in placed.model.links:
            for sensor in link.sensors:
                scoped = f"{placed.scope}::{link.name}"
                unit_name = f"{scoped}::{sensor.name}"
                made = sensor_model(robot, sensor, scoped, sensor.pose, unit_name)
                if made is None:
                    warnings.warn(
                        SimulationWarning(
                            f"sensor '{unit_name}' of type '{sensor.type}' is not measured yet"
                        ),
                        stacklevel=2,
                    )
                    continue
                units[sensor.name] = SensorUnit(robot, sensor, unit_name, made)
    return units


def _inner(scope: str, top: str, name: str) -> str:
    prefix = scope.removeprefix(top).removeprefix("::")
    return f"{prefix}::{name}" if prefix else name


def _column(value: ArrayLike) -> Floats:
    array = np.asarray(value, np.float64)
    return (
        array.reshape(-1, 1)
        if array.ndim == 1
        else array.reshape(1, -1)
        if array.ndim == 0
        else array
    )
