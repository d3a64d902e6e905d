"""Joints of a model in a running simulation."""

from __future__ import annotations

from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Worlds
from gazelle.engines import Wrench
from gazelle.errors import SimulationError
from gazelle.simulation.inputs import FIRST_WORLD, chosen, finite, numbers, size_of
from gazelle.simulation.parameter_changes import set_parameters
from gazelle.simulation.running_state import RunningState
from gazelle.simulation.state_lock import between_steps


class JointHandle:
    """A joint of a robot; values are of world 0 when read, of all worlds when set."""

    def __init__(self, simulation: RunningState, name: str) -> None:
        self.name = name
        self._simulation = simulation
        self._lock = simulation.lock
        self._engine = simulation.engine
        self._row = simulation.engine.joints[name]

    @property
    def simulation(self) -> RunningState:
        """Simulation it is in."""
        return self._simulation

    @property
    @between_steps
    def position(self) -> float:
        """Position of the first axis [m or rad].

        Setting it teleports the joint, to its limits at most, as in Gazebo. It takes a number
        an axis, of a ball joint a quaternion (x, y, z, w).
        """
        return float(self._row.position(FIRST_WORLD)[0, 0])

    @position.setter
    @between_steps
    def position(self, value: ArrayLike) -> None:
        width = self.positions(FIRST_WORLD).shape[1]
        what = f"the position of joint '{self.name}'"
        self._row.set_position(finite(what, value, width, self._engine.nworld))

    @property
    @between_steps
    def velocity(self) -> float:
        """Velocity of the first axis [m/s or rad/s]; setting it changes the state at once."""
        return float(self._row.velocity(FIRST_WORLD)[0, 0])

    @velocity.setter
    @between_steps
    def velocity(self, value: ArrayLike) -> None:
        what, nworld = f"the velocity of joint '{self.name}'", self._engine.nworld
        given = finite(what, value, self.axes, nworld, alike=True)
        self._row.set_velocity(given)

    @property
    @between_steps
    def effort(self) -> None:
        """Write-only effort that acts until the next one [N or N m]; NaN ends its world."""
        raise SimulationError(f"the effort on joint '{self.name}' is measured by a force sensor")

    @effort.setter
    @between_steps
    def effort(self, value: ArrayLike) -> None:
        self._simulation.applied_wrenches.set_lasting(self.name, self._effort_of(value, None))

    @property
    @between_steps
    def axes(self) -> int:
        """Number of the joint's degrees of freedom: the length of a velocity or an effort."""
        return int(self._row.velocity(FIRST_WORLD).shape[1])

    @between_steps
    def apply_effort(
        self,
        effort: ArrayLike,
        *,
        start: float | None = None,
        duration: float | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Apply an effort for a time, added to other efforts.

        Args:
            effort: [N or N m], shape (), (n,) or (n, axes).
            start: Start in simulated time [s]; now if None or past.
            duration: Duration [s]; until cleared if None.
            worlds: Worlds; all if None.

        Raises:
            SimulationError: A value is not finite, or the duration is negative.
        """
        some = self._some(worlds)
        rows = self._effort_of(effort, some)
        self._simulation.applied_wrenches.turn(self.name, rows, start, duration, some)

    @between_steps
    def clear_efforts(self) -> None:
        """Remove all efforts from the joint, in all worlds."""
        self._simulation.applied_wrenches.clear_joint(self.name)

    def _some(self, worlds: Worlds | None) -> Worlds | None:
        return chosen(worlds, self._engine.nworld)

    def _effort_of(self, values: ArrayLike, worlds: Worlds | None) -> Floats:
        """Return efforts of the right shape.

        One that is not finite breaks its own world, no other.
        """
        count = size_of(worlds, self._engine.nworld)
        return numbers(f"the effort on joint '{self.name}'", values, self.axes, count, alike=True)

    @between_steps
    def positions(self, worlds: Worlds | None = None) -> Floats:
        """Return the positions of all axes, shape (n, axes).

        Quaternions of ball joints, shape (n, 4).
        """
        return self._row.position(self._some(worlds))

    @between_steps
    def velocities(self, worlds: Worlds | None = None) -> Floats:
        """Return the velocities of all axes, shape (n, axes)."""
        return self._row.velocity(self._some(worlds))

    @between_steps
    def set_position(self, position: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the position in some worlds (all if None).

        In m or rad, shape as `positions` or (axes,).
        """
        width, some = self.positions(FIRST_WORLD).shape[1], self._some(worlds)
        count = size_of(some, self._engine.nworld)
        what = f"the position of joint '{self.name}'"
        self._row.set_position(finite(what, position, width, count), some)

    @between_steps
    def set_velocity(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set the velocity in some worlds [m/s or rad/s], shape as `velocities` or (axes,)."""
        some = self._some(worlds)
        what, count = f"the velocity of joint '{self.name}'", size_of(some, self._engine.nworld)
        given = finite(what, velocity, self.axes, count, alike=True)
        self._row.set_velocity(given, some)

    @between_steps
    def wrench(self, worlds: Worlds | None = None) -> Wrench:
        """Return the wrench of child on parent, about the joint's origin, in the world frame."""
        return self._row.wrench(self._some(worlds))

    @between_steps
    def add_motor(self, max_effort: ArrayLike) -> None:
        """Add a velocity motor that holds the joint at rest until ``drive``.

        Args:
            max_effort: Of all axes or of each [N or N m], shape () or (axes,).

        Raises:
            EngineError: It has no axis that a motor could turn, or an effort is invalid.
        """
        self._engine.add_motor(self.name, max_effort)

    @between_steps
    def motor_effort(self, worlds: Worlds | None = None) -> Floats:
        """Return the largest efforts of the joint's motor [N or N m], shape (n, axes).

        Raises:
            EngineError: There is no motor on it.
        """
        return self._engine.parameter("motor_effort", self.name, self._some(worlds))

    @property
    @between_steps
    def has_motor(self) -> bool:
        """True if there is a velocity motor on it."""
        calls = (call for call in self._engine.history() if call.method == "add_motor")
        return any(call.arguments[0] == self.name for call in calls)

    @between_steps
    def drive(self, velocity: ArrayLike, worlds: Worlds | None = None) -> None:
        """Set what the motor holds [m/s or rad/s]: () or (n,), of several axes (n, axes).

        NaN, as a policy may command it, ends its world in the next step.
        """
        some = self._some(worlds)
        try:
            self._row.set_motor_velocity(velocity, some)
        except (TypeError, ValueError, OverflowError) as error:
            raise SimulationError(
                f"the velocity of the motor on '{self.name}' cannot be {velocity!r}: {error}",
                hint="give a number, one for each world, or a row of axes for each world",
            ) from None

    @between_steps
    def set_properties(
        self,
        *,
        damping: ArrayLike | None = None,
        friction: ArrayLike | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        motor_effort: ArrayLike | None = None,
        worlds: Worlds | None = None,
    ) -> None:
        """Set properties of the joint; those that are None stay.

        All shapes: (), (n,) or (n, axes).

        Args:
            damping: Viscous [N s/m or N m s/rad].
            friction: Static [N or N m].
            lower: Lower limit [m or rad]; minus infinity for none.
            upper: Upper limit [m or rad]; infinity for none.
            motor_effort: Largest effort of its motor [N or N m].
            worlds: Worlds; all if None.

        Raises:
            EngineError: A value is invalid, or there is no motor; nothing is changed.
            SimulationError: The lower limit would be above the upper.
        """
        given = {
            "joint_damping": damping,
            "joint_friction": friction,
            "joint_lower": lower,
            "joint_upper": upper,
            "motor_effort": motor_effort,
        }
        set_parameters(self._simulation, self.name, given, worlds)
