"""The MuJoCo engine: a batch of worlds stepped on native threads."""

from __future__ import annotations

import os
from dataclasses import replace

import mujoco
import numpy as np
from mujoco.batch import Batch, SimulationError
from numpy.typing import ArrayLike

from gazelle.description import Model, Pose, World
from gazelle.engines.engine import Floats, Hits, Motion, Placement, Worlds
from gazelle.engines.mujoco.compiler import COLLISION_GROUP, Motor, Recipe, compile_world
from gazelle.engines.mujoco.layout import Layout, LinkSlot, ModelSlot, Slot, layout_of
from gazelle.engines.mujoco.order import wxyz_from_xyzw, xyzw_from_wxyz
from gazelle.engines.mujoco.transfer import carry_over
from gazelle.engines.mujoco.views import StateViews
from gazelle.errors import EngineError, did_you_mean
from gazelle.rotations import conjugate, cross, multiply, rotate

_GROUPS = np.array([group == COLLISION_GROUP for group in range(6)], dtype=np.uint8)
_VELOCITY_STAGE = mujoco.mjtStage.mjSTAGE_VEL.value


def _quiet() -> None:
    """Keep MuJoCo from writing a log file into the working directory: faults are raised."""
    config = mujoco.MjLogConfig.get()
    config.logto_file = False
    config.logto_console = False
    config.set()


class MujocoEngine:
    """Many copies of one world in MuJoCo; see ``gazelle.engines.engine.Engine``.

    Args:
        world: What to simulate.
        nworld: Number of copies.
        time_step: Physics step [s]; the world's ``max_step_size`` if None.
        threads: Native threads; all processors if None. The results do not depend on it.

    Raises:
        EngineError: The world cannot be simulated.
    """

    def __init__(
        self,
        world: World,
        nworld: int = 1,
        *,
        time_step: float | None = None,
        threads: int | None = None,
    ) -> None:
        _quiet()
        step = world.profile.max_step_size if time_step is None else time_step
        if nworld < 1:
            raise EngineError(f"nworld must be at least 1, not {nworld}")
        if not step > 0.0:
            raise EngineError(f"the physics step must be positive, not {step:g} s")
        self._nworld = nworld
        self._threads = min(threads or os.cpu_count() or 1, nworld)
        self._recipe = Recipe(world, step)
        self._batch, self._layout = self._build(self._recipe)
        self._state = StateViews.of(self._batch)
        self._batch.forward(stage=_VELOCITY_STAGE)
        self._initial = self._batch.state[0].copy()
        self._stale = False
        self._pending: Recipe | None = None

    def _build(self, recipe: Recipe) -> tuple[Batch, Layout]:
        compiled = compile_world(recipe)
        batch = Batch(compiled.model, self._nworld, self._threads)
        for name in ("xpos", "xquat", "cvel", "subtree_com"):
            batch.bind(name)
        return batch, layout_of(compiled)

    # -- what runs ---------------------------------------------------------------------

    @property
    def nworld(self) -> int:
        """Number of worlds."""
        return self._nworld

    @property
    def time_step(self) -> float:
        """Physics step [s]."""
        return self._recipe.time_step

    @property
    def world(self) -> World:
        """The world that runs, with what was spawned and without what was deleted."""
        return (self._pending or self._recipe).world

    @property
    def link_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::link``."""
        return tuple(self._now().links)

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Scoped names, ``model::joint``, of joints that can move."""
        return tuple(self._now().joints)

    # -- time --------------------------------------------------------------------------

    def step(self, count: int = 1) -> None:
        """Advance every world by ``count`` physics steps."""
        self._now()
        self._stale = True
        try:
            self._batch.step(nstep=count)
        except SimulationError as error:
            raise EngineError(f"the physics broke down: {error}") from error
        self._check_finite()

    def _check_finite(self) -> None:
        # MuJoCo resets a simulation whose state became bad and counts a warning.
        bad = self._state.faults
        if bad.any():
            worlds = np.flatnonzero(bad.any(axis=1))
            self._batch.warning[worlds] = 0
            raise EngineError(
                f"the state of {len(worlds)} of {self._nworld} worlds became infinite "
                f"(first: world {worlds[0]})",
                hint="take a smaller physics step, or check masses, inertias and gains",
            )

    def reset(self, worlds: Worlds | None = None) -> None:
        """Put worlds back to their initial state: poses, rest, no forces."""
        self._now()
        self._batch.state[_rows(worlds)] = self._initial
        self._stale = True

    # -- links -------------------------------------------------------------------------

    def link_placement(self, link: str, worlds: Worlds | None = None) -> Placement:
        """Where a link is."""
        slot = self._now().link(link)
        rows = _rows(worlds)
        if slot.free is not None:
            q = self._state.qpos[rows, slot.free.position]
            return Placement(q[:, :3].copy(), xyzw_from_wxyz(q[:, 3:]))
        if slot.mocap is not None:
            position = self._state.mocap_pos[rows, slot.mocap].copy()
            q = self._state.mocap_quat[rows, slot.mocap]
            return Placement(position, xyzw_from_wxyz(q))
        if slot.root == "static":
            count = self._nworld if worlds is None else len(worlds)
            return Placement(
                np.tile(slot.pose.position, (count, 1)), np.tile(slot.pose.quaternion, (count, 1))
            )
        self._refresh()
        position = self._batch.xpos[rows, slot.body].copy()
        return Placement(position, xyzw_from_wxyz(self._batch.xquat[rows, slot.body]))

    def link_motion(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link moves."""
        slot = self._now().link(link)
        rows = _rows(worlds)
        if slot.free is not None:
            v = self._state.qvel[rows, slot.free.velocity]
            turned = rotate(self.link_placement(link, worlds).quaternion, v[:, 3:])
            return Motion(v[:, :3].copy(), turned)
        if slot.root is not None:
            still = np.zeros((self._nworld if worlds is None else len(worlds), 3))
            return Motion(still, still.copy())
        self._refresh()
        # MuJoCo's cvel is about the centre of mass of the whole tree.
        spatial = self._batch.cvel[rows, slot.body]
        root = int(self._batch.model.body_rootid[slot.body])
        arm = self._batch.xpos[rows, slot.body] - self._batch.subtree_com[rows, root]
        angular = spatial[:, :3].copy()
        return Motion(spatial[:, 3:] + cross(angular, arm), angular)

    def link_acceleration(self, link: str, worlds: Worlds | None = None) -> Motion:
        """How a link's motion changes in the next physics step [m/s², rad/s²]."""
        before = self.link_motion(link, worlds)
        state, warnings = self._batch.state.copy(), self._batch.warning.copy()
        self._batch.step(ids=worlds)
        self._stale = True
        after = self.link_motion(link, worlds)
        self._batch.state[:], self._batch.warning[:] = state, warnings
        self._stale = True
        rate = 1.0 / self.time_step
        return Motion(
            (after.linear - before.linear) * rate, (after.angular - before.angular) * rate
        )

    # -- models ------------------------------------------------------------------------

    def model_placement(self, model: str, worlds: Worlds | None = None) -> Placement:
        """Where a model's frame is: it moves with the canonical link."""
        slot = self._now().model(model)
        link = self.link_placement(slot.canonical, worlds)
        offset = np.asarray(slot.offset.position), np.asarray(slot.offset.quaternion)
        position = link.position + rotate(link.quaternion, offset[0])
        return Placement(position, multiply(link.quaternion, offset[1]))

    def set_model_placement(
        self, model: str, position: ArrayLike, quaternion: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Move a model rigidly, joints as they are; a static model becomes kinematic for it."""
        slot = self._now().model(model)
        if any(self._layout.link(root).root == "static" for root in slot.roots):
            self.make_kinematic(model)
            slot = self._now().model(model)
        fixed = [root for root in slot.roots if self._layout.link(root).root is None]
        if fixed:
            raise EngineError(
                f"model '{model}' is fixed to the world by a joint and cannot be moved",
                hint=f"the joint that holds '{fixed[0]}' would have to go",
            )
        count = self._nworld if worlds is None else len(worlds)
        goal_p = np.broadcast_to(np.asarray(position, np.float64), (count, 3))
        goal_q = np.broadcast_to(np.asarray(quaternion, np.float64), (count, 4))
        if len(slot.roots) == 1:
            self._put_only(slot, goal_p, goal_q, worlds)
        else:
            self._put_all(model, slot, goal_p, _unit(goal_q), worlds)
        self._stale = True

    def _put_only(
        self, slot: ModelSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        """Place a model that one link carries: no need to know where it was."""
        if slot.offset != Pose():
            back = slot.offset.inverse()
            quaternion = _unit(quaternion)
            position = position + rotate(quaternion, np.asarray(back.position))
            quaternion = multiply(quaternion, np.asarray(back.quaternion))
        self._put(self._layout.link(slot.roots[0]), position, quaternion, worlds)

    def _put_all(
        self,
        model: str,
        slot: ModelSlot,
        goal_p: Floats,
        goal_q: Floats,
        worlds: Worlds | None,
    ) -> None:
        """Place a model that several links carry, keeping them as they are to each other."""
        before = self.model_placement(model, worlds)
        turn = multiply(goal_q, conjugate(before.quaternion))
        for root in slot.roots:
            link = self.link_placement(root, worlds)
            moved = goal_p + rotate(turn, link.position - before.position)
            self._put(self._layout.link(root), moved, multiply(turn, link.quaternion), worlds)

    def _put(
        self, slot: LinkSlot, position: Floats, quaternion: Floats, worlds: Worlds | None
    ) -> None:
        rows = _rows(worlds)
        # Normalised, or rounding errors would grow with every relative move.
        wxyz = wxyz_from_xyzw(_unit(quaternion))
        if slot.mocap is not None:
            self._state.mocap_pos[rows, slot.mocap] = position
            self._state.mocap_quat[rows, slot.mocap] = wxyz
        elif slot.free is not None:
            self._state.qpos[rows, slot.free.position] = np.concatenate((position, wxyz), axis=1)

    def set_model_motion(
        self, model: str, linear: ArrayLike, angular: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give all links of a model the velocity of one rigid body, joints at rest."""
        slot = self._now().model(model)
        rows = _rows(worlds)
        origin = self.model_placement(model, worlds)
        v = np.broadcast_to(np.asarray(linear, np.float64), origin.position.shape)
        w = np.broadcast_to(np.asarray(angular, np.float64), origin.position.shape)
        for root in slot.roots:
            free = self._layout.link(root).free
            if free is None:
                continue
            link = self.link_placement(root, worlds)
            at_link = v + cross(w, link.position - origin.position)
            local = rotate(conjugate(link.quaternion), w)
            self._state.qvel[rows, free.velocity] = np.concatenate((at_link, local), axis=1)
        for joint in slot.joints:
            for each in self._layout.joint(joint):
                self._state.qvel[rows, each.velocity] = 0.0
        self._stale = True

    # -- joints ------------------------------------------------------------------------

    def joint_position(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Position [m or rad], shape (n, axes)."""
        slots = self._now().joint(joint)
        return np.concatenate([self._state.qpos[_rows(worlds), s.position] for s in slots], axis=1)

    def joint_velocity(self, joint: str, worlds: Worlds | None = None) -> Floats:
        """Velocity [m/s or rad/s], shape (n, axes)."""
        slots = self._now().joint(joint)
        return np.concatenate([self._state.qvel[_rows(worlds), s.velocity] for s in slots], axis=1)

    def set_joint_position(
        self, joint: str, position: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Put a joint somewhere [m or rad], shape (axes,) or (n, axes)."""
        slots = self._now().joint(joint)
        self._write(self._state.qpos, [s.position for s in slots], position, worlds)

    def set_joint_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Give a joint a velocity [m/s or rad/s], shape (axes,) or (n, axes)."""
        slots = self._now().joint(joint)
        self._write(self._state.qvel, [s.velocity for s in slots], velocity, worlds)

    def set_joint_effort(self, joint: str, effort: ArrayLike, worlds: Worlds | None = None) -> None:
        """Apply an effort [N or N m] until told otherwise, shape (axes,) or (n, axes)."""
        slots = self._now().joint(joint)
        self._write(self._state.qfrc_applied, [s.velocity for s in slots], effort, worlds)

    def _write(
        self, array: Floats, columns: list[slice], values: ArrayLike, worlds: Worlds | None
    ) -> None:
        given = np.atleast_1d(np.asarray(values, np.float64))
        start = 0
        for column in columns:
            width = column.stop - column.start
            array[_rows(worlds), column] = given[..., start : start + width]
            start += width
        self._stale = True

    # -- motors ------------------------------------------------------------------------

    def add_motor(self, joint: str, max_effort: float) -> None:
        """Give a joint of one axis a motor that holds a velocity with limited effort [N or N m]."""
        slots = self._layout.joint(joint)  # motors do not change the layout of joints
        if len(slots) != 1 or _width(slots[0]) != 1:
            raise EngineError(f"a motor needs a joint of one axis; '{joint}' has more")
        if not max_effort > 0.0:
            raise EngineError(f"the largest effort of a motor must be positive, not {max_effort:g}")
        recipe = self._pending or self._recipe
        motors = {**recipe.motors, joint: Motor(joint, max_effort)}
        self._pending = replace(recipe, motors=motors)

    def set_motor_velocity(
        self, joint: str, velocity: ArrayLike, worlds: Worlds | None = None
    ) -> None:
        """Set the velocity that a joint's motor holds [m/s or rad/s], shape () or (n,)."""
        column = self._now().motor(joint)
        self._state.ctrl[_rows(worlds), column] = velocity

    # -- sensing -----------------------------------------------------------------------

    def cast_rays(
        self, link: str, origins: Floats, directions: Floats, worlds: Worlds | None = None
    ) -> Hits:
        """Follow rays to the nearest collision shape; see the protocol."""
        place = self.link_placement(link, worlds)
        turn = place.quaternion[:, None, :]
        start = place.position[:, None, :] + rotate(turn, origins[None])
        along = rotate(turn, directions[None])
        distance, _, normal = self._batch.ray(
            start, along, geomgroup=_GROUPS, ids=worlds, normal=True
        )
        from_inside = np.einsum("ijk,ijk->ij", normal, along) > 0.0
        return Hits(np.where(distance < 0.0, np.inf, distance), from_inside)

    # -- change ------------------------------------------------------------------------

    def spawn(self, model: Model) -> None:
        """Add a model to every world, at rest at its ``pose``; all else stays as it is."""
        recipe = self._pending or self._recipe
        names = {each.name for each in recipe.world.models}
        if model.name in names:
            raise EngineError(f"there is a model '{model.name}' already", source=model.source)
        world = replace(recipe.world, models=(*recipe.world.models, model))
        self._change(replace(recipe, world=world))

    def delete(self, model: str) -> None:
        """Take a model out of every world; all else stays as it is."""
        recipe = self._pending or self._recipe
        names = [each.name for each in recipe.world.models]
        if model not in names:
            raise EngineError(f"there is no model '{model}'", hint=did_you_mean(model, names))
        kept = tuple(each for each in recipe.world.models if each.name != model)
        motors = {n: m for n, m in recipe.motors.items() if not n.startswith(f"{model}::")}
        world = replace(recipe.world, models=kept)
        kinematic = recipe.kinematic - {model}
        self._change(replace(recipe, world=world, motors=motors, kinematic=kinematic))

    def make_kinematic(self, model: str) -> None:
        """Let a model move only by ``set_model_placement``; it pushes, nothing pushes it."""
        recipe = self._pending or self._recipe
        self._now().model(model)
        self._change(replace(recipe, kinematic=recipe.kinematic | {model}))

    def _now(self) -> Layout:
        """The layout of what runs, once pending changes have been made."""
        if self._pending is not None:
            recipe, self._pending = self._pending, None
            self._change(recipe)
        return self._layout

    def _change(self, recipe: Recipe) -> None:
        batch, layout = self._build(recipe)
        batch.forward(stage=_VELOCITY_STAGE)
        initial = batch.state[:1].copy()
        carry_over(self._batch, self._layout, batch, layout)
        self._initial = initial[0]
        self._batch, self._layout, self._recipe = batch, layout, recipe
        self._state = StateViews.of(batch)
        self._pending = None
        self._stale = True

    # -- saving ------------------------------------------------------------------------

    def snapshot(self) -> Floats:
        """The whole dynamic state, shape (nworld, size)."""
        self._now()
        state: Floats = self._batch.state.copy()
        return state

    def restore(self, state: Floats) -> None:
        """Put back what ``snapshot`` gave; the models must be the same."""
        self._now()
        if state.shape != self._batch.state.shape:
            raise EngineError(
                f"the saved state has the shape {state.shape}, the worlds that run need "
                f"{self._batch.state.shape}",
                hint="restore into a simulation with the same models and number of worlds",
            )
        self._batch.state[:] = state
        self._stale = True

    def close(self) -> None:
        """Free threads and memory; the engine must not be used any more."""
        self._pending = None
        del self._batch, self._state

    def _refresh(self) -> None:
        """Compute the placement and motion of links that are not roots."""
        if self._stale:
            self._batch.forward(stage=_VELOCITY_STAGE)
            self._stale = False


def _rows(worlds: Worlds | None) -> slice | Worlds:
    return slice(None) if worlds is None else worlds


def _unit(q: Floats) -> Floats:
    """Quaternions normalised; zero becomes the identity, as in Gazebo."""
    norm: Floats = np.linalg.norm(q, axis=-1, keepdims=True)
    unit: Floats = q / np.where(norm > 0.0, norm, 1.0)
    if not norm.all():
        unit[norm[..., 0] == 0.0] = (0.0, 0.0, 0.0, 1.0)
    return unit


def _width(slot: Slot) -> int:
    width: int = slot.velocity.stop - slot.velocity.start
    return width
