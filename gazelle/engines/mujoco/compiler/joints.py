"""SDF joints as MuJoCo joints: one small function a type, in a table.

The second and third axis of a joint are MuJoCo joints of their own, named ``joint#1`` and
``joint#2``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np

from gazelle.description import Joint, JointAxis
from gazelle.engines.hanging_links import across
from gazelle.errors import EngineError

_HINGE = mujoco.mjtJoint.mjJNT_HINGE
_SLIDE = mujoco.mjtJoint.mjJNT_SLIDE
_BALL = mujoco.mjtJoint.mjJNT_BALL

# Share of the overshoot of a stop that goes in a step. What comes back is as fast, and so bounces
# with this coefficient at most; with ODE's 0.2 by up to four times as much.
_STOP_ERP = 0.05

_PLAY = 1e-6  # [m or rad]

# MuJoCo's largest impedance.
_HOLDING = 0.9999


def add_joint(body: Any, name: str, joint: Joint, time_step: float) -> None:
    """Add the joint of a MuJoCo body in its parent.

    Raises:
        EngineError: The joint's type is not simulated.
    """
    if joint.type not in _ADDERS:
        known = ", ".join(sorted(_ADDERS))
        raise EngineError(
            f"joint '{name}': there is no joint type '{joint.type}'",
            source=joint.source,
            hint=f"there are: {known}",
        )
    _ADDERS[joint.type](body, name, joint, time_step)


def _fixed(_: Any, __: str, ___: Joint, ____: float) -> None:
    """Add nothing: a body without a joint is welded to its parent."""


def _hinge(body: Any, name: str, joint: Joint, time_step: float) -> None:
    body.add_joint(name=name, type=_HINGE, **_axis_options(joint, _axis(joint, 0), time_step))


def _slide(body: Any, name: str, joint: Joint, time_step: float) -> None:
    body.add_joint(name=name, type=_SLIDE, **_axis_options(joint, _axis(joint, 0), time_step))


def _ball(body: Any, name: str, joint: Joint, _: float) -> None:
    options: dict[str, Any] = {}
    if joint.axes:
        options["damping"] = [joint.axes[0].damping, 0.0, 0.0]
    body.add_joint(name=name, type=_BALL, pos=list(joint.pose.position), **options)


def _two_hinges(body: Any, name: str, joint: Joint, time_step: float) -> None:
    first, second = _axis(joint, 0), _axis(joint, 1)
    body.add_joint(name=name, type=_HINGE, **_axis_options(joint, first, time_step))
    body.add_joint(name=f"{name}#1", type=_HINGE, **_axis_options(joint, second, time_step))


def _screw(body: Any, name: str, joint: Joint, time_step: float) -> None:
    axis = _axis(joint, 0)
    along = list(joint.pose.rotate(axis.xyz))
    body.add_joint(name=name, type=_HINGE, **_axis_options(joint, axis, time_step))
    body.add_joint(name=f"{name}#1", type=_SLIDE, axis=along)


def _planar(body: Any, name: str, joint: Joint, time_step: float) -> None:
    """Add two slides in the plane across the axis, then a hinge about it."""
    axis = _axis(joint, 0)
    first, second = across(np.asarray(axis.xyz))
    damping = [axis.damping, 0.0, 0.0]
    for suffix, direction in (("", first), ("#1", second)):
        along = list(joint.pose.rotate(tuple(direction.tolist())))
        body.add_joint(name=f"{name}{suffix}", type=_SLIDE, axis=along, damping=damping)
    turn = replace(joint, type="continuous")
    body.add_joint(name=f"{name}#2", type=_HINGE, **_axis_options(turn, axis, time_step))


def _floating(body: Any, name: str, joint: Joint, _: float) -> None:
    if joint.parent != "world":
        raise EngineError(
            f"joint '{name}': a floating joint needs the world as parent", source=joint.source
        )
    body.add_freejoint(name=name, align=mujoco.mjtAlignFree.mjALIGNFREE_FALSE)


def dry_friction(time_step: float) -> tuple[list[float], list[float]]:
    """Return MuJoCo's reference and impedance of a friction that stops within a step and holds.

    What it holds creeps by 1e-4 of the acceleration that it holds back, times the step.
    """
    return [0.0, -_HOLDING / time_step], [_HOLDING, _HOLDING, 0.001, 0.5, 2.0]


def rigid_stop(time_step: float) -> tuple[list[float], list[float]]:
    """Return MuJoCo's reference and impedance of a limit that stops a joint within a step.

    As ODE's: a joint that is found beyond its limit is to have the velocity -erp / h * overshoot at
    the end of the step, so that it passes the limit by v h at most.
    """
    reference = [-_HOLDING * _STOP_ERP / time_step**2, -_HOLDING / time_step]
    return reference, [_HOLDING, _HOLDING, 0.001, 0.5, 2.0]


def _axis(joint: Joint, index: int) -> JointAxis:
    if index >= len(joint.axes):
        raise EngineError(
            f"joint '{joint.name}' of type '{joint.type}' needs {index + 1} axes, "
            f"it has {len(joint.axes)}",
            source=joint.source,
        )
    return joint.axes[index]


def _axis_options(joint: Joint, axis: JointAxis, time_step: float) -> dict[str, Any]:
    hold, stiff = dry_friction(time_step)
    options: dict[str, Any] = {
        "pos": list(joint.pose.position),
        "axis": list(joint.pose.rotate(axis.xyz)),
        "damping": [axis.damping, 0.0, 0.0],
        "frictionloss": axis.friction,
        "solref_friction": hold,
        "solimp_friction": stiff,
        "stiffness": [axis.spring_stiffness, 0.0, 0.0],
        "armature": axis.armature,
        "springref": axis.spring_reference,
    }
    if joint.type != "continuous" and (math.isfinite(axis.lower) or math.isfinite(axis.upper)):
        options["limited"] = mujoco.mjtLimited.mjLIMITED_TRUE
        # A joint that is locked by equal limits keeps a play that MuJoCo requires.
        play = _PLAY if axis.upper - axis.lower < _PLAY else 0.0
        options["range"] = [max(axis.lower, -1e10) - play, min(axis.upper, 1e10) + play]
        options["solref_limit"], options["solimp_limit"] = rigid_stop(time_step)
    return options


_ADDERS: dict[str, Callable[[Any, str, Joint, float], None]] = {
    "ball": _ball,
    "continuous": _hinge,
    "fixed": _fixed,
    "floating": _floating,
    "planar": _planar,
    "prismatic": _slide,
    "revolute": _hinge,
    "revolute2": _two_hinges,
    "screw": _screw,
    "universal": _two_hinges,
}
