"""Protocol of physics engines, which simulate many copies of one world.

All state is in arrays with a leading axis over worlds. ``worlds`` arguments name some
of them by index, shape (n,), sorted and unique; None means all, n = nworld. Positions are in
metres, velocities in m/s and rad/s, both in the world frame; quaternions are (x, y, z, w).
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import Protocol

from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Indices, Worlds
from gazelle.description import Model, World
from gazelle.engines.history import Call
from gazelle.engines.range_rays import RangeRays, RangeTable
from gazelle.engines.reactions import ContactTable
from gazelle.engines.state import JointRow, JointRows, LinkRow, LinkRows, ModelRow, ModelRows
from gazelle.engines.table import Table
from gazelle.errors import EngineError
from gazelle.native.system import System


class DivergenceError(EngineError):
    """The state of some worlds became infinite or undefined; the others went on.

    Attributes:
        worlds: Indices of those worlds, shape (k,).
        before: Their states before the steps that failed, shape (k, size).
        steps: Number of steps that failed, in which no system was updated between two steps.
        made: Number of steps of the call, these included; no more were made.
    """

    def __init__(self, message: str, worlds: Worlds, before: Floats, steps: int, made: int) -> None:
        super().__init__(
            message, hint="take a smaller physics step, or check masses, inertias and gains"
        )
        self.worlds = worlds
        self.before = before
        self.steps, self.made = steps, made


# Kinds of physical parameters that each world can have of its own: what they belong to, the
# number of values, and the unit. Tensors are xx, yy, zz, xy, xz, yz about the centre of mass.
# Joints have as many values as axes. An attachment is named ``parent>child``; it is where the
# child is held in the frame of the parent, position and quaternion (x, y, z, w). Wheels, links
# on a revolute joint, slip along their axle and about it by a velocity for each force.
PARAMETERS: dict[str, tuple[str, int, str]] = {
    "attachment": ("attachment", 7, "m"),
    "collision_contact": ("collision", 1, "0 where nothing touches it, else 1"),
    "collision_friction": ("collision", 1, ""),
    "gravity": ("world", 3, "m/s²"),
    "joint_damping": ("joint", 1, "N s/m or N m s/rad"),
    "joint_friction": ("joint", 1, "N or N m"),
    "joint_lower": ("joint", 1, "m or rad"),
    "joint_upper": ("joint", 1, "m or rad"),
    "link_centre": ("link", 3, "m"),
    "link_gravity": ("link", 1, "share of gravity, 0 to 1"),
    "link_inertia": ("link", 6, "kg m²"),
    "link_mass": ("link", 1, "kg"),
    "motor_effort": ("motor", 1, "N or N m"),
    "wheel_slip": ("link", 2, "m/s/N and rad/s/(N m)"),
}


class Engine(Protocol):
    """A batch of copies of one world, all made of the same models."""

    @property
    def nworld(self) -> int:
        """Number of worlds."""

    @property
    def time_step(self) -> float:
        """Physics step [s]."""

    @property
    def world(self) -> World:
        """The simulated world, with spawned and without deleted models."""

    @property
    def links(self) -> Table[LinkRow, LinkRows]:
        """Links of all models, by scoped name, ``model::link``."""

    @property
    def joints(self) -> Table[JointRow, JointRows]:
        """Joints of all models that can move, by scoped name, ``model::joint``."""

    @property
    def models(self) -> Table[ModelRow, ModelRows]:
        """Models, by name."""

    @property
    def revision(self) -> int:
        """Count of changes of models; systems have to be bound to the state again after one."""

    def prepare(self) -> None:
        """Compile the world with everything requested, so that the next step is one like others.

        An engine may put that off until motors and kinematic models are known.

        Raises:
            EngineError: The world cannot be simulated.
        """

    def step(self, count: int = 1, systems: Sequence[System] = (), now_ns: int = 0) -> None:
        """Advance every world by ``count`` physics steps, and update systems that are due.

        Args:
            count: Number of steps.
            systems: In the order in which they act. They may write velocities that motors hold,
                and poses of kinematic models, in their own worlds.
            now_ns: Simulated time [ns].

        Raises:
            DivergenceError: The state of some worlds became infinite or undefined. They are
                back in their initial state; all others made ``made`` steps.
        """

    def update(self, system: System, now_ns: int = 0) -> None:
        """Update a system now, whatever its rate; one of joints reads them and acts on them."""

    def reset(self, worlds: Worlds | None = None) -> None:
        """Reset worlds to their initial state: poses, rest, no forces."""

    def contacts(self, sets: Sequence[Sequence[str]], worlds: Worlds | None = None) -> ContactTable:
        """Return the points where collisions touch others now, set by set and world by world.

        A contact between two collisions of a set is listed once, for the one that is named first.
        Forces are those of the next physics step; nothing moves.

        Args:
            sets: Scoped names, ``model::link::collision``, of each set.
            worlds: Worlds, in this order; all if None.

        Raises:
            EngineError: There is no such collision, or the engine knows no contacts.
        """

    def add_motor(self, joint: str, max_effort: ArrayLike) -> None:
        """Add a motor to a joint that holds a velocity, zero at first, with limited effort.

        A joint that has one keeps its velocity and gets the effort, in all worlds.

        Args:
            joint: Scoped name.
            max_effort: Of all axes or of each [N or N m], shape () or (axes,); zero is a motor
                that is off.

        Raises:
            EngineError: The joint has no axis that a motor could turn, or an effort is invalid.
        """

    def make_kinematic(self, model: str) -> None:
        """Make a model kinematic: ``ModelRow.set_placement`` moves it, nothing pushes it."""

    def attach(
        self,
        parent: str,
        child: str,
        worlds: Worlds | None = None,
        settling: float | None = None,
    ) -> None:
        """Attach two links at their present relative pose, until ``detach`` or a reset.

        Args:
            parent: Scoped name of the link that is held to.
            child: Scoped name of the link that is held.
            worlds: Worlds.
            settling: Time constant with which they come together again [s], critically damped,
                where something drew them apart; None for as stiff as can be.
        """

    def detach(self, parent: str, child: str, worlds: Worlds | None = None) -> None:
        """Detach two links that ``attach`` holds together."""

    def parameter(self, kind: str, name: str, worlds: Worlds | None = None) -> Floats:
        """Return a physical parameter, shape (n, width).

        Args:
            kind: One of ``PARAMETERS``.
            name: Scoped name of the link, joint or collision it is of; empty for the world.
            worlds: Worlds.
        """

    def set_parameter(
        self, kind: str, name: str, values: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set a physical parameter, shape (width,) or (n, width); a reset does not undo it.

        Raises:
            EngineError: There is no such parameter, or a value is invalid.
        """

    def update_world(self, world: World) -> None:
        """Update all of a world but its models: physics, gravity, air, lights, scene.

        Every state stays as it is. Gravity that worlds have of their own is forgotten.

        Raises:
            EngineError: A value is invalid; nothing is changed.
        """

    def range_kind(self, rays: RangeRays) -> Hashable | None:
        """Return a key that is equal for rays that ``range_table`` can cast together, or None."""

    def range_table(self, rays: Sequence[RangeRays]) -> RangeTable:
        """Return a table of range finders of one kind, or of a single one."""

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is.

        Raises:
            EngineError: The name is taken, or the model cannot be simulated; nothing is changed.
        """

    def delete(self, model: str) -> None:
        """Delete a model from every world; all else stays as it is."""

    def snapshot(self) -> Floats:
        """Return the whole dynamic state, shape (nworld, size)."""

    def peek(self) -> Floats:
        """Return the state like ``snapshot`` without a copy.

        It must be read at once and not kept.
        """

    def write_state(self, places: Indices, values: Floats) -> None:
        """Set entries of the state, as links, joints and models do that are set.

        Args:
            places: In ``peek``, flattened.
            values: Values to set, of the same shape.
        """

    def restore(self, state: Floats) -> None:
        """Restore what ``snapshot`` returned; the models must be the same.

        Raises:
            EngineError: The state does not fit the models that run now.
        """

    def history(self) -> list[Call]:
        """Return the calls that make a new engine of this ``world`` like this one.

        The state is not included.
        """

    def adopt(self, history: Sequence[Call]) -> None:
        """Replay the calls of a ``history`` on this world; ``restore`` fits then."""

    def close(self) -> None:
        """Free threads and memory."""
