"""The laws of a running world: time step, gravity, solver, air."""

from __future__ import annotations

import math
import operator
import warnings
from dataclasses import replace
from typing import Any

from gazelle.description import Atmosphere, Physics, Vector3, World
from gazelle.engines.laws import with_profile
from gazelle.errors import SimulationError, SimulationWarning, did_you_mean
from gazelle.simulation.inputs import finite
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.state_lock import between_steps

# Names here, and where the description has them: in the world, its profile, or ODE's terms.
_OF_WORLD = {name: name for name in ("gravity", "magnetic_field", "wind", "atmosphere")}
_OF_PROFILE = {
    "time_step": "max_step_size",
    "update_rate": "real_time_update_rate",
    "real_time_factor": "real_time_factor",
    "max_contacts": "max_contacts",
    "auto_disable": "auto_disable",
    "speculative_contacts": "speculative_contacts",
    "integrator": "integrator",
    "contacts": "contacts",
}
_OF_SOLVER = {
    "iterations": "iters",
    "precon_iterations": "precon_iters",
    "sor": "sor",
    "friction_model": "friction_model",
    "erp": "erp",
    "cfm": "cfm",
    "contact_surface_layer": "contact_surface_layer",
    "contact_max_correcting_velocity": "contact_max_correcting_vel",
}
_NAMES = (*_OF_WORLD, *_OF_PROFILE, *_OF_SOLVER)

# What the engine has no use for: it is kept and reported. Joints have no error to reduce, and
# contacts the stiffness that their surfaces define, whatever ODE's solver would make of them;
# docs/explanation/physics.md says more.
_WITHOUT_EFFECT = ("sor", "precon_iterations", "max_contacts", "erp", "cfm")

_FRICTION_MODELS = ("pyramid_model", "box_model", "cone_model")

_CONTACTS = ("exact", "fast")

# Ints among the properties.
_WHOLE = ("iterations", "max_contacts", "precon_iterations")

_POSITIVE = ("time_step", "iterations")
_NOT_NEGATIVE = (
    "update_rate",
    "real_time_factor",
    "max_contacts",
    "erp",
    "cfm",
    "sor",
    "contact_surface_layer",
    "contact_max_correcting_velocity",
)


class PhysicsProperties:
    """Physics properties of a whole running world, readable and settable in the middle of a run.

    Every change keeps all states. Changing several things by ``set`` is done at once.

    Args:
        simulation: The run.
    """

    def __init__(self, simulation: RunningState) -> None:
        self._simulation = simulation
        self._lock = simulation.lock

    def __setattr__(self, name: str, value: Any) -> None:
        """Reject an unknown property, which would have no effect."""
        if not name.startswith("_") and not hasattr(type(self), name):
            here = [own for own, theirs in (_OF_PROFILE | _OF_SOLVER).items() if theirs == name]
            hint = f"it is called {here[0]} here" if here else did_you_mean(name, _NAMES)
            raise SimulationError(f"sim.physics has no '{name}'", hint=hint)
        object.__setattr__(self, name, value)

    # -- what there is -----------------------------------------------------------------

    @property
    def profile(self) -> Physics:
        """The physics profile in use."""
        return self._simulation.world.profile

    @property
    def presets(self) -> tuple[str, ...]:
        """Names of the physics profiles that the world's file has."""
        return tuple(each.name for each in self._simulation.world.physics)

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self.profile.max_step_size

    @time_step.setter
    def time_step(self, value: float) -> None:
        self.set(time_step=value)

    @property
    def update_rate(self) -> float:
        """Physics steps a wall second to aim at [Hz]; 0 means as fast as possible."""
        return self.profile.real_time_update_rate

    @update_rate.setter
    def update_rate(self, value: float) -> None:
        self.set(update_rate=value)

    @property
    def real_time_factor(self) -> float:
        """Simulated seconds a wall second to aim at."""
        return self.profile.real_time_factor

    @real_time_factor.setter
    def real_time_factor(self, value: float) -> None:
        self.set(real_time_factor=value)

    @property
    def target_rate(self) -> float | None:
        """Real-time factor of the file; None means as fast as possible.

        As in Gazebo classic it is the update rate times the time step, whatever
        ``real_time_factor`` says, and an update rate of 0 does not hold anything back. A server
        that runs in real time gives it to ``Simulation.run`` as ``rate``; Python's own
        default is as fast as possible.
        """
        profile = self.profile
        return profile.real_time_update_rate * profile.max_step_size or None

    @property
    def gravity(self) -> Vector3:
        """Gravity of all worlds [m/s²]; ``Simulation.parameters`` has that of each."""
        return self._simulation.world.gravity

    @gravity.setter
    def gravity(self, value: Vector3) -> None:
        self.set(gravity=value)

    @property
    def magnetic_field(self) -> Vector3:
        """Magnetic field [T]."""
        return self._simulation.world.magnetic_field

    @magnetic_field.setter
    def magnetic_field(self, value: Vector3) -> None:
        self.set(magnetic_field=value)

    @property
    def wind(self) -> Vector3:
        """Velocity of the air [m/s]."""
        return self._simulation.world.wind

    @wind.setter
    def wind(self, value: Vector3) -> None:
        self.set(wind=value)

    @property
    def atmosphere(self) -> Atmosphere:
        """Air: temperature, its gradient, pressure."""
        return self._simulation.world.atmosphere

    @atmosphere.setter
    def atmosphere(self, value: Atmosphere) -> None:
        self.set(atmosphere=value)

    @property
    def iterations(self) -> int:
        """Iterations of the solver after which it gives up; it stops when it is exact."""
        return self.profile.ode.iters

    @iterations.setter
    def iterations(self, value: int) -> None:
        self.set(iterations=value)

    @property
    def precon_iterations(self) -> int:
        """ODE's preconditioning iterations: kept, without effect."""
        return self.profile.ode.precon_iters

    @precon_iterations.setter
    def precon_iterations(self, value: int) -> None:
        self.set(precon_iterations=value)

    @property
    def sor(self) -> float:
        """ODE's successive over-relaxation, w: kept, without effect."""
        return self.profile.ode.sor

    @sor.setter
    def sor(self, value: float) -> None:
        self.set(sor=value)

    @property
    def friction_model(self) -> str | None:
        """``cone_model``: alike in all directions; others: a pyramid; None leaves it to the engine."""
        return self.profile.ode.friction_model

    @friction_model.setter
    def friction_model(self, value: str | None) -> None:
        self.set(friction_model=value)

    @property
    def erp(self) -> float:
        """Share of a constraint's error that ODE reduces in a step: kept, without effect."""
        return self.profile.ode.erp

    @erp.setter
    def erp(self, value: float) -> None:
        self.set(erp=value)

    @property
    def cfm(self) -> float:
        """ODE's constraint force mixing: kept, without effect."""
        return self.profile.ode.cfm

    @cfm.setter
    def cfm(self, value: float) -> None:
        self.set(cfm=value)

    @property
    def contact_surface_layer(self) -> float:
        """Overlap that is not under penetration recovery, but left to the contact [m]."""
        return self.profile.ode.contact_surface_layer

    @contact_surface_layer.setter
    def contact_surface_layer(self, value: float) -> None:
        self.set(contact_surface_layer=value)

    @property
    def contact_max_correcting_velocity(self) -> float:
        """Largest velocity with which penetration recovery resolves overlaps [m/s]."""
        return self.profile.ode.contact_max_correcting_vel

    @contact_max_correcting_velocity.setter
    def contact_max_correcting_velocity(self, value: float) -> None:
        self.set(contact_max_correcting_velocity=value)

    @property
    def max_contacts(self) -> int:
        """Contact points between two collisions at most: kept, without effect."""
        return self.profile.max_contacts

    @max_contacts.setter
    def max_contacts(self, value: int) -> None:
        self.set(max_contacts=value)

    @property
    def auto_disable(self) -> bool | None:
        """True if free bodies at rest go to sleep; None: where there are many."""
        return self.profile.auto_disable

    @auto_disable.setter
    def auto_disable(self, value: bool | None) -> None:
        self.set(auto_disable=value)

    @property
    def speculative_contacts(self) -> bool | None:
        """True if contacts of fast bodies are predicted; None: where a body needs it."""
        return self.profile.speculative_contacts

    @speculative_contacts.setter
    def speculative_contacts(self, value: bool | None) -> None:
        self.set(speculative_contacts=value)

    @property
    def integrator(self) -> str | None:
        """``euler``, as ODE, or ``rk4``; None: Euler with gyroscopic forces at mid-step, docs/explanation/physics.md."""
        return self.profile.integrator

    @integrator.setter
    def integrator(self, value: str | None) -> None:
        self.set(integrator=value)

    @property
    def contacts(self) -> str | None:
        """Presets of contacts: ``exact``, without creep, for manipulation; ``fast`` for driving robots.

        None leaves it to ``friction_model``, or else to the engine: exact where something
        is free. Friction is the same cone or pyramid as with ``friction_model``, which this
        goes before. See docs/explanation/physics.md.
        """
        return self.profile.contacts

    @contacts.setter
    def contacts(self, value: str | None) -> None:
        self.set(contacts=value)

    # -- change ------------------------------------------------------------------------

    @between_steps
    def set(self, /, **values: Any) -> None:
        """Set several properties at once, by the names of this class's attributes.

        Raises:
            SimulationError: There is no such property, or a value is invalid.
            EngineError: The engine cannot do it; nothing is changed.
        """
        for name, value in values.items():
            _check(name, value)
        self._apply(values)

    @between_steps
    def use(self, preset: str) -> None:
        """Select another of the physics profiles in the world's file.

        Raises:
            SimulationError: There is none of that name.
        """
        if preset not in self.presets:
            raise SimulationError(
                f"there is no physics profile '{preset}'", hint=did_you_mean(preset, self.presets)
            )
        world = self._simulation.world
        chosen = tuple(replace(each, default=each.name == preset) for each in world.physics)
        self._change(replace(world, physics=chosen))

    def _apply(self, values: dict[str, Any]) -> None:
        world = self._simulation.world
        solver = {_OF_SOLVER[k]: v for k, v in values.items() if k in _OF_SOLVER}
        profile = {_OF_PROFILE[k]: v for k, v in values.items() if k in _OF_PROFILE}
        of_world: dict[str, Any] = {
            k: tuple(float(x) for x in v) if k != "atmosphere" else v
            for k, v in values.items()
            if k in _OF_WORLD
        }
        for name in _WITHOUT_EFFECT:
            if name in values and values[name] != getattr(self, name):
                warnings.warn(
                    SimulationWarning(f"the physics property '{name}' has no effect here"),
                    stacklevel=4,
                )
        if solver or profile:
            used = world.profile
            changed = replace(used, ode=replace(used.ode, **solver), **profile)
            world = with_profile(world, changed)
        self._change(replace(world, **of_world))

    def _change(self, world: World) -> None:
        simulation = self._simulation
        simulation.engine.update_world(world)
        simulation.clock.set_step(simulation.engine.time_step)


def _check(name: str, value: Any) -> None:
    if name not in _NAMES:
        raise SimulationError(
            f"there is no physics property '{name}'", hint=did_you_mean(name, _NAMES)
        )
    if name in (*_POSITIVE, *_NOT_NEGATIVE):
        _check_number(name, value)
    if name in _POSITIVE and not value > 0:
        raise SimulationError(f"the physics property '{name}' must be positive, not {value}")
    if name in _NOT_NEGATIVE and not value >= 0:
        raise SimulationError(f"the physics property '{name}' must not be negative, not {value}")
    if name == "friction_model" and value not in (None, *_FRICTION_MODELS):
        raise SimulationError(
            f"there is no friction model '{value}'", hint=did_you_mean(str(value), _FRICTION_MODELS)
        )
    if name == "contacts" and value not in (None, *_CONTACTS):
        raise SimulationError(
            f"there are no contacts '{value}'", hint=did_you_mean(str(value), _CONTACTS)
        )
    if name in ("gravity", "magnetic_field", "wind"):
        finite(f"the physics property '{name}'", value, 3, 1)


def _check_number(name: str, value: Any) -> None:
    try:
        possible = math.isfinite(operator.index(value) if name in _WHOLE else value)
    except (TypeError, OverflowError):
        possible = False
    if not possible:
        expected = "an int" if name in _WHOLE else "a finite number"
        raise SimulationError(f"the physics property '{name}' must be {expected}, not {value!r}")
