"""Physical parameters that each world of a batch can have of its own."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.description import Model
from gazelle.engines import PARAMETERS
from gazelle.errors import SimulationError, did_you_mean
from gazelle.sensors import LidarModel
from gazelle.simulation.inputs import VECTORS, chosen, finite, numbers, placement, size_of
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.state_lock import between_steps
from gazelle.streams import Stream


class Parameter:
    """One kind of parameter, by name: ``link_mass["robot::base"] = array(nworld)``.

    Reading gives the values of all worlds, shape (nworld,), or (nworld, width) for vectors.
    """

    def __init__(self, simulation: RunningState, kind: str) -> None:
        self._simulation = simulation
        self._lock = simulation.lock
        self._kind = kind

    @between_steps
    def __getitem__(self, name: str) -> Floats:
        values = self._simulation.engine.parameter(self._kind, name)
        return values[:, 0] if values.shape[1] == 1 else values

    @between_steps
    def __setitem__(self, name: str, values: ArrayLike) -> None:
        self.set(name, values)

    @between_steps
    def set(self, name: str, values: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the parameter in some worlds (all if None).

        Args:
            name: Scoped name.
            values: One for all, or one a world: shape (), (n,), (width,) or (n, width).
            worlds: Worlds; all if None.

        Raises:
            EngineError: There is nothing of that name, or a value is invalid.
            SimulationError: There are more or fewer values.
        """
        engine = self._simulation.engine

        some = chosen(worlds, engine.nworld)
        width = engine.parameter(self._kind, name, np.array([0])).shape[1]
        what, count = f"the {self._kind} of '{name}'", size_of(some, engine.nworld)
        given = numbers(what, values, width, count, alike=self._kind not in VECTORS)
        engine.set_parameter(self._kind, name, given, some)


class Measured(Protocol):
    """A sensor; see ``SensorUnit``."""

    name: str

    @property
    def model(self) -> object:
        """Model that measures it."""


class ModelWithSensors(Protocol):
    """A model with sensors; see ``Robot``."""

    description: Model

    @property
    def sensors(self) -> Mapping[str, Measured]:
        """Sensors by name."""


class PopulatedState(RunningState, Protocol):
    """A simulation with its models."""

    @property
    def robots(self) -> Mapping[str, ModelWithSensors]:
        """Robots by name."""


class SensorNoise:
    """Standard deviation of the white noise of lidars, by scoped name [m]."""

    def __init__(self, simulation: PopulatedState) -> None:
        self._simulation = simulation
        self._lock = simulation.lock

    @between_steps
    def __getitem__(self, name: str) -> Floats:
        return self._model(name).noise.stddev

    @between_steps
    def __setitem__(self, name: str, values: ArrayLike) -> None:
        what, nworld = f"the noise of '{name}'", self._simulation.nworld
        spread = np.broadcast_to(finite(what, values, 1, nworld)[..., 0], (nworld,))
        if not (spread >= 0.0).all():
            raise SimulationError(f"{what} must not be negative")
        self._model(name).noise.stddev = spread

    def _model(self, name: str) -> LidarModel:
        lidars = {
            unit.name: unit.model
            for robot in self._simulation.robots.values()
            for unit in robot.sensors.values()
            if isinstance(unit.model, LidarModel)
        }
        if name not in lidars:
            raise SimulationError(f"there is no lidar '{name}'", hint=did_you_mean(name, lidars))
        return lidars[name]


class InitialPoses:
    """Initial poses of models after a reset, by name: arrays (nworld, 7) of x, y, z and quaternion."""

    def __init__(self, simulation: PopulatedState) -> None:
        self._simulation = simulation
        self._lock = simulation.lock
        self._poses: dict[str, Floats] = {}

    @between_steps
    def __getitem__(self, name: str) -> Floats:
        if name in self._poses:
            return self._poses[name].copy()
        pose = self._simulation.robots[name].description.pose
        return np.tile((*pose.position, *pose.quaternion), (self._simulation.nworld, 1))

    @between_steps
    def __setitem__(self, name: str, values: ArrayLike) -> None:
        count, width = self[name].shape
        given = finite(f"the initial poses of '{name}'", values, width, count)
        placement(name, given[..., :3], given[..., 3:], count)
        self._poses[name] = np.array(np.broadcast_to(given, (count, width)))

    @between_steps
    def apply(self, worlds: Worlds | None) -> None:
        """Place the models at their initial poses; part of a reset."""
        rows = slice(None) if worlds is None else worlds
        for name, poses in self._poses.items():
            self._simulation.engine.models[name].set_placement(
                poses[rows, :3], poses[rows, 3:], worlds
            )

    @between_steps
    def forget(self, model: str) -> None:
        """Remove those of a deleted model."""
        self._poses.pop(model, None)

    @between_steps
    def state(self) -> dict[str, Floats]:
        """Return everything that was set."""
        return {name: poses.copy() for name, poses in self._poses.items()}

    @between_steps
    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore what ``state`` returned."""
        self._poses = dict(state)


class WorldParameters:
    """Parameters that each world has of its own, for domain randomisation.

    Nothing is drawn at random unless ``randomize`` is called. What is set lasts: a reset
    keeps it, a snapshot holds it, spawning and deleting other models do not touch it.

    Attributes:
        link_mass: [kg], by ``model::link``. The inertia stays; see ``scale_mass``.
        link_inertia: About the centre of mass, in the link's axes [kg m²]: xx, yy, zz, xy, xz,
            yz; shape (nworld, 6).
        link_centre: Centre of mass in the link frame [m], shape (nworld, 3).
        link_gravity: Share of gravity that acts on it, 0 to 1.
        joint_damping: [N s/m or N m s/rad], by ``model::joint``.
        joint_friction: [N or N m].
        joint_lower: [m or rad].
        joint_upper: [m or rad].
        motor_effort: Largest effort of a joint's motor [N or N m].
        friction: Coefficient of a collision, by ``model::link::collision``.
        lidar_noise: Standard deviation [m], by ``model::link::sensor``.
        pose: Poses of models after a reset, by model.
    """

    def __init__(self, simulation: PopulatedState) -> None:
        self._simulation = simulation
        self._lock = simulation.lock
        self.link_mass = Parameter(simulation, "link_mass")
        self.link_inertia = Parameter(simulation, "link_inertia")
        self.link_centre = Parameter(simulation, "link_centre")
        self.link_gravity = Parameter(simulation, "link_gravity")
        self.joint_damping = Parameter(simulation, "joint_damping")
        self.joint_friction = Parameter(simulation, "joint_friction")
        self.joint_lower = Parameter(simulation, "joint_lower")
        self.joint_upper = Parameter(simulation, "joint_upper")
        self.motor_effort = Parameter(simulation, "motor_effort")
        self.friction = Parameter(simulation, "collision_friction")
        self.lidar_noise = SensorNoise(simulation)
        self.pose = InitialPoses(simulation)
        self._streams: dict[str, Stream] = {}

    @property
    @between_steps
    def gravity(self) -> Floats:
        """Gravity of each world [m/s²], shape (nworld, 3); settable."""
        return self._simulation.engine.parameter("gravity", "")

    @gravity.setter
    @between_steps
    def gravity(self, values: ArrayLike) -> None:
        self._simulation.engine.set_parameter("gravity", "", values)

    @between_steps
    def scale_mass(self, link: str, factor: ArrayLike) -> None:
        """Multiply mass and inertia of a link, as if it were made of another material.

        Args:
            link: Scoped name.
            factor: Shape () or (nworld,).

        Raises:
            SimulationError: It is not finite, or of another shape.
        """
        count = self._simulation.nworld
        by = np.broadcast_to(finite("the factor of a mass", factor, 1, count)[..., 0], (count,))
        self.link_mass[link] = self.link_mass[link] * by
        self.link_inertia[link] = self.link_inertia[link] * by[:, None]

    @between_steps
    def stream(self, name: str) -> Stream:
        """Return random numbers for one purpose.

        World i's depend on the seed, the name and i alone.
        """
        if name not in self._streams:
            seed, nworld = self._simulation.seed, self._simulation.nworld
            self._streams[name] = Stream(seed, f"parameters/{name}", nworld)
        return self._streams[name]

    @between_steps
    def randomize(
        self,
        kind: str,
        name: str,
        low: ArrayLike,
        high: ArrayLike,
        worlds: Worlds | None = None,
    ) -> Floats:
        """Sample a parameter uniformly between two bounds in each world.

        Args:
            kind: Such as ``link_mass``, ``friction`` or ``gravity``: an attribute of this class.
            name: Scoped name; empty for gravity.
            low: Lower bound, shape () or (width,).
            high: Upper bound, shape () or (width,).
            worlds: Worlds; all if None.

        Returns:
            What was drawn, shape (n, width).

        Raises:
            SimulationError: There is no such parameter.
            EngineError: There is nothing of that name.
        """
        engine_kind = {"friction": "collision_friction"}.get(kind, kind)
        if engine_kind not in PARAMETERS or engine_kind == "attachment":
            kinds = [*(k for k in PARAMETERS if k != "attachment"), "friction"]
            raise SimulationError(
                f"there is no parameter '{kind}' to draw", hint=did_you_mean(kind, kinds)
            )
        engine = self._simulation.engine
        some = chosen(worlds, engine.nworld)
        width = engine.parameter(engine_kind, name, np.array([0])).shape[1]
        share = self.stream(f"{engine_kind}/{name}").uniform(width, some)
        least, most = (
            finite(f"a bound of {kind} of '{name}'", bound, width, len(share), alike=True)
            for bound in (low, high)
        )
        drawn: Floats = least + share * (most - least)
        engine.set_parameter(engine_kind, name, drawn, some)
        return drawn

    @between_steps
    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the random numbers."""
        for stream in self._streams.values():
            stream.reseed(seed, worlds)

    @between_steps
    def state(self) -> dict[str, Any]:
        """Return the state that is not the engine's, for a snapshot."""
        streams = {n: (s.keys.copy(), s.counters.copy()) for n, s in self._streams.items()}
        return {"pose": self.pose.state(), "streams": streams}

    @between_steps
    def restore(self, state: Mapping[str, Any]) -> None:
        """Restore what ``state`` returned."""
        self.pose.restore(state["pose"])
        self._streams = {}
        for name, (keys, counters) in state["streams"].items():
            stream = self.stream(name)
            stream.keys[:], stream.counters[:] = keys, counters
