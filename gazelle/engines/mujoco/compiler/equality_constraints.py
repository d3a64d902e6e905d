"""Couplings of joints and closed loops, as MuJoCo equality constraints.

Mimic joints, screws and gearboxes tie one coordinate to another; joints that close a loop
hold two bodies together at points.
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import mujoco
import numpy as np

from gazelle.description import Inertial, Joint, Mimic, Pose
from gazelle.engines.mujoco.compiler.inertia import inertia_of, possible
from gazelle.engines.mujoco.compiler.joints import add_joint
from gazelle.errors import EngineError, EngineWarning, did_you_mean, located
from gazelle.kinematics.mimics import leaders_of, mimic_cycles, refuse_cycle
from gazelle.kinematics.tree import Closure, TreeLink, lost_in_loop

# Time constant of a coupling, in physics steps, and its damping ratio.
_STEPS, _DAMPING_RATIO = 3.0, 1.0

# Distance of the second point that keeps a hinge's axis in line [m].
_ARM = 0.1

# Mass of a link that a joint needs to close a loop, as a share of the child's: so much is the
# child harder to move. With MuJoCo's largest impedance the two are apart by one part in a hundred
# of what the child would be without the joint.
_LIGHTER, _RIGID = 0.01, [0.9999, 0.9999, 0.001, 0.5, 2.0]


def add_couplings(spec: mujoco.MjSpec, bodies: Iterable[TreeLink], time_step: float) -> None:
    """Add equality constraints for the screws and mimics of a model.

    Raises:
        EngineError: A screw has no thread, or a mimic nothing to follow but itself.
    """
    bodies = list(bodies)
    axes = {body.joint_name: len(body.joint.axes) for body in bodies if body.joint is not None}
    joints = ((body.joint_name, body.joint) for body in bodies if body.joint is not None)
    cycles = mimic_cycles(leaders_of(joints))
    for body in bodies:
        joint = body.joint
        if joint is None:
            continue
        if joint.type == "screw":
            _tie_screw(spec, body.joint_name, joint, time_step)
        for index, axis in enumerate(joint.axes):
            if axis.mimic is not None:
                mimic = axis.mimic
                _require_leader(body.joint_name, joint, mimic, axes)
                refuse_cycle(body.joint_name, joint, cycles, EngineError)
                follower = _coordinate(body.joint_name, index)
                leader = _coordinate(mimic.joint, mimic.axis)
                start = mimic.offset - mimic.multiplier * mimic.reference
                _tie(spec, follower, leader, (start, mimic.multiplier), time_step)


def _tie_screw(spec: mujoco.MjSpec, name: str, joint: Joint, time_step: float) -> Any:
    """Return couple translation and rotation of a screw.

    SDF's pitch is in rad/m and left-handed.
    """
    pitch = joint.thread_pitch
    if pitch == 0.0:
        raise EngineError(
            f"screw joint '{name}' has a thread pitch of 0",
            source=joint.source,
            hint="give it a <thread_pitch> [rad/m], or make it prismatic",
        )
    return _tie(spec, f"{name}#1", name, (0.0, -1.0 / pitch), time_step)


def _require_leader(name: str, joint: Joint, mimic: Mimic, axes: Mapping[str, int]) -> None:
    others = {other: count for other, count in axes.items() if other != name and count > 0}
    if mimic.joint not in others:
        raise EngineError(
            f"joint '{name}' mimics '{mimic.joint}', which is no other joint that moves a link",
            source=joint.source,
            hint=did_you_mean(mimic.joint, others),
        )
    if not 0 <= mimic.axis < others[mimic.joint]:
        raise EngineError(
            f"joint '{name}' mimics axis {mimic.axis} of '{mimic.joint}', which has "
            f"{others[mimic.joint]}",
            source=joint.source,
        )


def add_closure(
    spec: mujoco.MjSpec, closure: Closure, bodies: list[TreeLink], time_step: float
) -> None:
    """Close a loop, or couple two joints through a gearbox.

    Raises:
        EngineError: The joint is none that MuJoCo knows, or a screw has no thread.
    """
    _warn_of_loss(closure)
    _CLOSERS.get(closure.joint.type, _through_a_link)(spec, closure, bodies, time_step)


def _warn_of_loss(closure: Closure) -> None:
    """Warn of features of a joint that are lost because it closes a loop."""
    joint = closure.joint
    if joint.type == "universal":
        lost = "it is held as a ball joint"
    elif terms := lost_in_loop(joint) if joint.type in _LOSING else ():
        lost = f"without effect there: {', '.join(terms)}"
    else:
        return
    text = f"joint '{closure.name}' closes a loop; {lost}"
    warnings.warn(EngineWarning(located(text, joint.source)), stacklevel=2)


def _weld(spec: mujoco.MjSpec, closure: Closure, _: list[TreeLink], time_step: float) -> None:
    equality = _between(spec, mujoco.mjtEq.mjEQ_WELD, closure, time_step)
    equality.name = closure.name


def _ball(spec: mujoco.MjSpec, closure: Closure, _: list[TreeLink], time_step: float) -> None:
    equality = _between(spec, mujoco.mjtEq.mjEQ_CONNECT, closure, time_step)
    equality.name = closure.name
    equality.data[:3] = closure.pose.position


def _hinge(spec: mujoco.MjSpec, closure: Closure, bodies: list[TreeLink], time_step: float) -> None:
    """Close a loop by a hinge: two points on the axis are held together."""
    _ball(spec, closure, bodies, time_step)
    axis = closure.joint.axes[0].xyz if closure.joint.axes else (0.0, 0.0, 1.0)
    far = closure.pose.apply(tuple(_ARM * a for a in axis))
    equality = _between(spec, mujoco.mjtEq.mjEQ_CONNECT, closure, time_step)
    equality.name = f"{closure.name}#1"
    equality.data[:3] = far


def _through_a_link(
    spec: mujoco.MjSpec, closure: Closure, bodies: list[TreeLink], time_step: float
) -> None:
    """Close a loop by a link of the parent, which moves as the joint says.

    The child is welded to it.

    MuJoCo has no constraint for two bodies that slide along an axis. The link is where the child
    is and like it, but lighter; it weighs nothing, and the child is held nearly rigidly.
    """
    joint = closure.joint
    if joint.type == "floating":
        return  # it holds nothing
    by_name = {body.name: body for body in bodies}
    child = by_name[joint.child]
    place, above = at_rest(child, by_name), spec.worldbody
    if joint.parent != "world":
        above = spec.body(joint.parent)
        place = at_rest(by_name[joint.parent], by_name).inverse() * place
    x, y, z, w = place.quaternion
    name = f"{closure.name}#link"
    handle = above.add_body(name=name, pos=list(place.position), quat=[w, x, y, z])
    add_joint(handle, closure.name, joint, time_step)
    if joint.type == "screw":
        _tie_screw(spec, closure.name, joint, time_step).solimp = _RIGID
    inertial = child.link.inertial or Inertial()
    moments, quaternion = inertia_of(child)
    handle.explicitinertial, handle.gravcomp = True, 1.0
    handle.mass, handle.ipos = _LIGHTER * inertial.mass, list(inertial.pose.position)
    handle.inertia = (_LIGHTER * possible(moments)).tolist()
    handle.iquat = quaternion.tolist()
    equality = spec.add_equality(type=mujoco.mjtEq.mjEQ_WELD, name1=joint.child, name2=name)
    equality.objtype, equality.name = mujoco.mjtObj.mjOBJ_BODY, closure.name
    equality.solref = [_STEPS * time_step, _DAMPING_RATIO]
    equality.solimp = _RIGID


def at_rest(body: TreeLink, by_name: Mapping[str, TreeLink]) -> Pose:
    """Return the pose of a body in the world with all joints at zero."""
    pose = body.pose
    while body.parent is not None:
        body = by_name[body.parent]
        pose = body.pose * pose
    return pose


def _gearbox(
    spec: mujoco.MjSpec, closure: Closure, bodies: list[TreeLink], time_step: float
) -> None:
    """Add a gearbox: the child turns -ratio times as far as the parent.

    Both are relative to the reference body.
    """
    joint = closure.joint
    driving = _turning(closure, joint.parent, bodies, 0)
    driven = _turning(closure, joint.child, bodies, 1)
    if driving is None or driven is None:
        link = joint.parent if driving is None else joint.child
        text = (
            f"gearbox '{closure.name}' needs a revolute joint that turns '{link}', and was left out"
        )
        warnings.warn(EngineWarning(located(text, joint.source)), stacklevel=3)
        return
    ratio = -joint.gearbox_ratio * driving[1] * driven[1]
    _tie(spec, driven[0], driving[0], (0.0, ratio), time_step)


def _turning(
    closure: Closure, link: str, bodies: list[TreeLink], axis: int
) -> tuple[str, float] | None:
    """Return the hinge of a link, and whether it turns with or against the gear's axis."""
    joint = closure.joint
    for body in bodies:
        if body.name == link and body.joint is not None and body.joint.axes:
            own = body.joint.pose.rotate(body.joint.axes[0].xyz)
            gear = joint.axes[min(axis, len(joint.axes) - 1)].xyz if joint.axes else own
            return body.joint_name, 1.0 if float(np.dot(own, gear)) >= 0.0 else -1.0
    return None


_CLOSERS: dict[str, Callable[[mujoco.MjSpec, Closure, list[TreeLink], float], None]] = {
    "ball": _ball,
    "continuous": _hinge,
    "fixed": _weld,
    "gearbox": _gearbox,
    "revolute": _hinge,
    "universal": _ball,
}


_LOSING = _CLOSERS.keys() - {"gearbox"}
"""Types that lose what is more than their kind of motion."""


def _tie(
    spec: mujoco.MjSpec,
    follower: str,
    leader: str,
    line: tuple[float, float],
    time_step: float,
) -> Any:
    """Add the constraint follower = line[0] + line[1] * leader."""
    equality = spec.add_equality(type=mujoco.mjtEq.mjEQ_JOINT, name1=follower, name2=leader)
    equality.objtype = mujoco.mjtObj.mjOBJ_JOINT
    equality.data[:5] = [line[0], line[1], 0.0, 0.0, 0.0]
    equality.solref = [_STEPS * time_step, _DAMPING_RATIO]
    return equality


def _between(spec: mujoco.MjSpec, kind: Any, closure: Closure, time_step: float) -> Any:
    joint: Joint = closure.joint
    equality = spec.add_equality(type=kind, name1=joint.child, name2=joint.parent)
    equality.objtype = mujoco.mjtObj.mjOBJ_BODY
    equality.solref = [_STEPS * time_step, _DAMPING_RATIO]
    return equality


def _coordinate(joint: str, axis: int) -> str:
    return joint if axis == 0 else f"{joint}#{axis}"
