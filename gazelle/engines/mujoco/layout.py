"""Indices of each named thing in MuJoCo's arrays."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

import mujoco

from gazelle.description import Pose, Vector3
from gazelle.engines.mujoco.compiler.geom_names import geom_ids
from gazelle.engines.mujoco.compiler.motors import MotorSlot, motor_slots
from gazelle.engines.mujoco.compiler.spec import Compiled
from gazelle.engines.mujoco.compiler.wheel_slip import SlipSlot, slip_slot
from gazelle.engines.mujoco.effort_limits import EffortLimits, effort_limits
from gazelle.errors import EngineError, did_you_mean
from gazelle.kinematics.tree import Closure, RootKind, TreeLink

T = TypeVar("T")

_WIDTHS = {
    mujoco.mjtJoint.mjJNT_FREE: (7, 6),
    mujoco.mjtJoint.mjJNT_BALL: (4, 3),
    mujoco.mjtJoint.mjJNT_SLIDE: (1, 1),
    mujoco.mjtJoint.mjJNT_HINGE: (1, 1),
}


@dataclass(frozen=True, slots=True)
class Slot:
    """Columns of one MuJoCo joint in ``qpos`` and ``qvel``."""

    position: slice
    velocity: slice


@dataclass(frozen=True, slots=True)
class LinkSlot:
    """One link.

    Attributes:
        body: MuJoCo's body index; the world's for a static link.
        root: Motion of a root of a tree.
        free: Columns of its free joint, if it has one.
        mocap: Row in ``mocap_pos``, if it is kinematic.
        pose: Its pose in the world in the initial state, if it is a root.
        carrier: Scoped name of its root link, its own for a root.
    """

    body: int
    root: RootKind | None
    free: Slot | None
    mocap: int | None
    pose: Pose
    carrier: str


@dataclass(frozen=True, slots=True)
class ReactionSlot:
    """One joint that holds a body, fixed ones too.

    Attributes:
        body: MuJoCo's index of the child body.
        anchor: Origin of the joint in the child's frame [m].
    """

    body: int
    anchor: Vector3


@dataclass(frozen=True, slots=True)
class LoopSlot:
    """One joint that closes a loop.

    Attributes:
        body: MuJoCo's index of the child body.
        anchor: Origin of the joint in the child's frame [m].
        equalities: MuJoCo's indices of the constraints that hold it.
    """

    body: int
    anchor: Vector3
    equalities: tuple[int, ...]


@dataclass(frozen=True, slots=True)
class ModelSlot:
    """One top-level model.

    Attributes:
        roots: Scoped names of the root links.
        canonical: Scoped name of the link that the model's pose follows.
        offset: The model frame in the canonical link's frame.
        back: The canonical link in the model frame; None if they agree.
        free: Whether all roots can be placed as they are.
        joints: Scoped names of its joints that move.
    """

    roots: tuple[str, ...]
    canonical: str
    offset: Pose
    back: Pose | None
    free: bool
    joints: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class MujocoLayout:
    """Names to places.

    Attributes:
        links: By scoped name.
        joints: Those that move, by scoped name.
        models: By name.
        motors: By scoped joint name.
        collisions: Indices of MuJoCo's geoms by scoped name, ``model::link::collision``.
        attachments: Indices of MuJoCo's equality constraints by name, ``parent>child``.
        reactions: Joints that hold a body, by scoped name.
        loops: Joints that close a loop, by scoped name.
        limits: Of efforts on joints.
        windy: MuJoCo's bodies of the links that wind pushes, by scoped name.
        springs: Indices of MuJoCo's contact pairs that are springs.
        slip_links: Of the links that may slip, by scoped name.
    """

    links: Mapping[str, LinkSlot]
    joints: Mapping[str, tuple[Slot, ...]]
    models: Mapping[str, ModelSlot]
    motors: Mapping[str, MotorSlot]
    collisions: Mapping[str, list[int]]
    attachments: Mapping[str, int]
    reactions: Mapping[str, ReactionSlot]
    loops: Mapping[str, LoopSlot]
    limits: EffortLimits
    windy: Mapping[str, int]
    springs: Sequence[int]
    slip_links: Mapping[str, SlipSlot]

    def link(self, name: str) -> LinkSlot:
        """Return the slot of a link.

        Raises:
            EngineError: There is none of that name.
        """
        return look_up("link", name, self.links)

    def joint(self, name: str) -> tuple[Slot, ...]:
        """Return the slots of a joint, one an axis.

        Raises:
            EngineError: There is none of that name.
        """
        return look_up("joint", name, self.joints)

    def model(self, name: str) -> ModelSlot:
        """Return the slot of a model.

        Raises:
            EngineError: There is none of that name.
        """
        return look_up("model", name, self.models)

    def motor(self, joint: str) -> MotorSlot:
        """Return the slot of a joint's motor.

        Raises:
            EngineError: The joint has no motor.
        """
        return look_up("motor on joint", joint, self.motors)


def look_up(kind: str, name: str, known: Mapping[str, T]) -> T:
    """Return the entry of a name.

    Raises:
        EngineError: There is none of that name.
    """
    try:
        return known[name]
    except KeyError:
        raise EngineError(f"there is no {kind} '{name}'", hint=did_you_mean(name, known)) from None


def layout_of(compiled: Compiled, attachments: Iterable[str] = ()) -> MujocoLayout:
    """Find everything of a compiled world."""
    model = compiled.model
    links: dict[str, LinkSlot] = {}
    joints: dict[str, tuple[Slot, ...]] = {}
    models: dict[str, ModelSlot] = {}
    reactions: dict[str, ReactionSlot] = {}
    for name, bodies in compiled.bodies.items():
        for body in bodies:
            above = None if body.parent is None else links[body.parent]
            links[body.name] = _link_slot(model, body, above)
            if body.joint is not None:
                anchor = body.joint.pose.position
                reactions[body.joint_name] = ReactionSlot(links[body.name].body, anchor)
            if body.joint is not None and body.joint.type != "fixed":
                joints[body.joint_name] = _joint_slots(model, body.joint_name)
        if bodies:  # a model may have no links, only plugins
            models[name] = _model_slot(bodies, joints)
    motors = motor_slots(compiled.motors)
    ids = geom_ids(model)
    collisions = {n: [ids[geom] for geom in geoms] for n, geoms in compiled.geoms.items()}
    held = {name: model.equality(name).id for name in attachments}
    columns = {name: tuple(slot.velocity for slot in slots) for name, slots in joints.items()}
    every = list(itertools.chain.from_iterable(compiled.bodies.values()))
    limits = effort_limits(every, columns)
    windy = {
        body.name: links[body.name].body
        for body in every
        if body.link.enable_wind and body.root not in ("static", "kinematic")
    }
    loops = {
        closure.name: _loop_slot(model, closure, links[closure.joint.child])
        for closure in compiled.closures
        if closure.joint.type != "gearbox"
    }
    return MujocoLayout(
        links,
        joints,
        models,
        motors,
        collisions,
        held,
        reactions,
        loops,
        limits,
        windy,
        compiled.springs,
        {b.name: slot for b in every if (slot := slip_slot(model, b.name)) is not None},
    )


def _link_slot(model: mujoco.MjModel, body: TreeLink, above: LinkSlot | None) -> LinkSlot:
    index = 0 if body.root == "static" else model.body(body.name).id
    free = _slot(model, int(model.body_jntadr[index])) if body.root == "free" else None
    mocap = int(model.body_mocapid[index]) if body.root == "kinematic" else None
    carrier = body.name if above is None else above.carrier
    return LinkSlot(index, body.root, free, mocap, body.pose, carrier)


def _loop_slot(model: mujoco.MjModel, closure: Closure, child: LinkSlot) -> LoopSlot:
    names = (closure.name, f"{closure.name}#1")
    ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_EQUALITY, name) for name in names]
    held = tuple(each for each in ids if each >= 0)
    return LoopSlot(child.body, closure.pose.position, held)


def _joint_slots(model: mujoco.MjModel, name: str) -> tuple[Slot, ...]:
    names = [name, f"{name}#1", f"{name}#2"]
    ids = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, each) for each in names]
    return tuple(_slot(model, joint) for joint in ids if joint >= 0)


def _slot(model: mujoco.MjModel, joint: int) -> Slot:
    nq, nv = _WIDTHS[mujoco.mjtJoint(int(model.jnt_type[joint]))]
    q, v = int(model.jnt_qposadr[joint]), int(model.jnt_dofadr[joint])
    return Slot(slice(q, q + nq), slice(v, v + nv))


def _model_slot(bodies: list[TreeLink], joints: Mapping[str, tuple[Slot, ...]]) -> ModelSlot:
    roots = tuple(body.name for body in bodies if body.parent is None)
    canonical = bodies[0]
    offset = canonical.link.pose.inverse()
    own = tuple(body.joint_name for body in bodies if body.joint_name in joints)
    back = None if canonical.link.pose == Pose() else canonical.link.pose
    kinds = {body.root for body in bodies if body.parent is None}
    free = kinds <= {"free", "kinematic"}
    return ModelSlot(roots, canonical.name, offset, back, free, own)
