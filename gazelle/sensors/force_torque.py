"""Force and torque in a joint, in the frame and direction of SDF."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Floats, Worlds
from gazelle.description import Noise, Parameters, Pose
from gazelle.engines import Engine
from gazelle.errors import FormatError, SimulationError
from gazelle.formats.sdf.noise import read_noise
from gazelle.rotations import conjugate, multiply, rotate
from gazelle.sensors.model import NoisySensor
from gazelle.sensors.noise import NO_NOISE

_FRAMES = ("child", "parent", "sensor")
_DIRECTIONS = ("child_to_parent", "parent_to_child")
_AXES = tuple(f"{part}/{axis}" for part in ("force", "torque") for axis in "xyz")


@dataclass(frozen=True, slots=True)
class ForceTorque:
    """Settings of a force-torque sensor.

    Attributes:
        frame: Frame of the values: ``child``, ``parent`` or ``sensor``.
        direction: ``child_to_parent``: what the child exerts on the parent; or the reverse.
        noises: On force [N] and torque [N m], by ``force/x`` to ``torque/z``.
    """

    frame: str = "child"
    direction: str = "child_to_parent"
    noises: dict[str, Noise] = field(default_factory=dict)

    @classmethod
    def read(cls, settings: Parameters) -> ForceTorque:
        """Read the ``settings`` of a sensor, which hold ``<force_torque>``.

        Raises:
            FormatError: There is no such frame or direction.
        """
        inner = settings.find("force_torque")
        if inner is None:
            return cls()
        frame = _one_of(inner, "frame", _FRAMES)
        direction = _one_of(inner, "measure_direction", _DIRECTIONS)
        noises = {axis: read_noise(inner.find(f"{axis}/noise")) for axis in _AXES}
        return cls(frame, direction, noises)


def _one_of(node: Parameters, tag: str, known: tuple[str, ...]) -> str:
    text = node.get(tag, known[0])
    if text not in known:
        raise FormatError(
            f"<{tag}> is one of {', '.join(known)}, found '{text}'", source=node.source
        )
    return text


@dataclass(frozen=True, slots=True)
class WrenchReading:
    """One measurement of a force-torque sensor.

    Attributes:
        stamp: Simulated time [ns].
        force: [N], shape (..., 3).
        torque: About the joint's origin [N m], shape (..., 3).
    """

    stamp: int
    force: Floats
    torque: Floats


@checked(SimulationError, after=True)
class ForceTorqueModel(NoisySensor):
    """Measures one joint's force and torque in every world, as Gazebo's sensor does.

    The torque is about the origin of the joint in every frame: as in Gazebo, the pose of the
    sensor turns the axes and does not move the point.

    Args:
        settings: Settings of the file.
        engine: Knows the forces.
        joint: Scoped name of the joint, a fixed one too.
        links: Scoped names of its parent and child; the parent may be ``world``.
        pose: The sensor frame in the child's frame.
        seed: The run's seed.
        name: Scoped name of the sensor; names its random streams.
    """

    def __init__(
        self,
        settings: ForceTorque,
        engine: Engine,
        joint: str,
        links: tuple[str, str],
        pose: Pose,
        seed: int,
        name: str,
    ) -> None:
        noises = {axis: settings.noises.get(axis, NO_NOISE) for axis in _AXES}
        super().__init__(noises, seed, name, engine.nworld)
        self.settings = settings
        self._engine = engine
        self._joint = joint
        self._links = links
        self._turn = np.asarray(pose.quaternion)

    def measure(self, worlds: Worlds | None = None, interval: float = 0.0) -> Floats:
        """Return force and torque in the coming physics step, shape (n, 6).

        Args:
            worlds: Worlds; all if None.
            interval: Time since the last measurement [s].
        """
        wrench = self._engine.joints[self._joint].wrench(worlds)
        force, torque = wrench.force, wrench.torque
        axes = self._axes(worlds)
        if axes is not None:
            back = conjugate(axes)
            force, torque = rotate(back, force), rotate(back, torque)
        values = np.concatenate((force, torque), axis=1)
        if self.settings.direction == "parent_to_child":
            values = -values
        return self.noisy(values, interval, worlds)

    def _axes(self, worlds: Worlds | None) -> Floats | None:
        """Return the orientation of the frame of the values; None for the world's."""
        parent, child = self._links
        if self.settings.frame == "parent":
            if parent == "world":
                return None
            return self._engine.links[parent].placement(worlds).quaternion
        orientation = self._engine.links[child].placement(worlds).quaternion
        return multiply(orientation, self._turn) if self.settings.frame == "sensor" else orientation

    def reading(self, values: Floats, stamp: int) -> WrenchReading:
        """Return a measurement by name."""
        return WrenchReading(stamp, values[..., :3], values[..., 3:])
