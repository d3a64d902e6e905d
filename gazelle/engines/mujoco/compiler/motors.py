"""Velocity motors on joints, as ODE has them.

ODE's joint motor (``vel`` and ``fmax``) is a constraint that is solved together with the
contacts: the axle turns at the wanted velocity whatever hangs on it, as long as the effort
suffices. MuJoCo's dry friction is the same constraint with the wanted velocity zero. So a motor
is the friction of a tendon that is nothing but its axis, and a compiled law adds the wanted
velocity in the middle of every step (see ``contact_laws.velocity_motors``). The friction of the joint itself is a
constraint of its own beside it.
"""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping, Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import ArrayLike

from gazelle.engines.mujoco.compiler.joints import dry_friction
from gazelle.errors import EngineError
from gazelle.kinematics.tree import TreeLink

# How many axes of a joint can have a motor. The second of a screw follows from the first.
AXES = {
    "continuous": 1,
    "planar": 3,
    "prismatic": 1,
    "revolute": 1,
    "revolute2": 2,
    "screw": 1,
    "universal": 2,
}

# So much less than the friction of a joint a motor gives way: a wheel of small inertia
# under a heavy robot would else be turned by the robot.
_SHARE = 0.01

# Numbers of a motor in MuJoCo's user data: the commanded velocity, and the part lost to compliance of
# the acceleration in the last step.
NUMBERS = 2


@dataclass(frozen=True, slots=True)
class Motor:
    """A velocity motor on each axis of a joint.

    Attributes:
        joint: Scoped name.
        max_effort: Of each axis [N or N m]; zero disables the motor.
    """

    joint: str
    max_effort: tuple[float, ...]


@dataclass(frozen=True, slots=True)
class MotorSlot:
    """Indices of a joint's motors.

    Attributes:
        targets: Columns of the commanded velocities in ``userdata``, one an axis, and MuJoCo's
            indices of the tendons.
        deflections: Columns of the acceleration lost to compliance in the last step.
    """

    targets: slice
    deflections: slice


def motor_of(
    joint: str,
    max_effort: ArrayLike,
    parts: Mapping[str, Sequence[TreeLink]],
    kinematic: Container[str] = (),
) -> Motor:
    """Return a motor on a joint of a world.

    Args:
        joint: Scoped name.
        max_effort: Of all axes or of each [N or N m], shape () or (axes,).
        parts: Bodies of the models of the world.
        kinematic: Models that move by placing alone, and have no joints then.

    Raises:
        EngineError: The joint cannot have a motor, or an effort is invalid.
    """
    moving = (bodies for model, bodies in parts.items() if model not in kinematic)
    axes = AXES.get(_type_of(joint, moving), 0)
    if not axes:
        raise EngineError(
            f"joint '{joint}' has no axis for a motor",
            hint=f"joints that can have one are {', '.join(sorted(AXES))}",
        )
    try:
        given = np.asarray(max_effort, np.float64)
    except (TypeError, ValueError, OverflowError):
        raise EngineError(
            f"the largest effort of the motor on '{joint}' must be a number, not {max_effort!r}"
        ) from None
    if given.shape not in ((), (1,), (axes,)):
        raise EngineError(f"joint '{joint}' has {axes} axes, not {given.size}")
    efforts = np.broadcast_to(given, (axes,))
    if not (np.isfinite(efforts).all() and (efforts >= 0.0).all()):
        raise EngineError(
            f"the largest effort of the motor on '{joint}' must be finite and not negative, "
            f"not {', '.join(f'{each:g}' for each in efforts)}",
            hint="zero disables the motor",
        )
    return Motor(joint, tuple(efforts.tolist()))


def motor_again(joint: str, max_effort: ArrayLike) -> Motor:
    """Return the motor that another engine of the same world had."""
    return Motor(joint, tuple(np.atleast_1d(np.asarray(max_effort, np.float64)).tolist()))


def refuse_motors(model: str, motors: Iterable[str]) -> None:
    """Raise an error if a kinematic model has motors.

    Args:
        model: Name.
        motors: Scoped names of the joints that have one.

    Raises:
        EngineError: It has.
    """
    if any(joint.startswith(f"{model}::") for joint in motors):
        raise EngineError(
            f"model '{model}' has motors on its joints and cannot be kinematic",
            hint="a kinematic model has no joints; remove the plugin that drives it",
        )


def _type_of(joint: str, parts: Iterable[Sequence[TreeLink]]) -> str:
    for bodies in parts:
        for body in bodies:
            if body.joint is not None and body.joint_name == joint:
                return body.joint.type
    raise EngineError(f"there is no joint '{joint}' to put a motor on")


def add_motors(spec: mujoco.MjSpec, motors: Iterable[Motor], time_step: float) -> None:
    """Add the tendons of motors to a MuJoCo model; nothing else in it has tendons."""
    count = 0
    for motor in motors:
        for axis, effort in enumerate(motor.max_effort):
            name = motor.joint if axis == 0 else f"{motor.joint}#{axis}"
            tendon = spec.add_tendon(name=name)
            tendon.wrap_joint(name, 1.0)
            tendon.frictionloss = effort
            tendon.solref_friction, tendon.solimp_friction = dry_friction(time_step)
            count += 1
    if count:
        spec.nuserdata = NUMBERS * count


def motor_count(motors: Mapping[str, Motor]) -> int:
    """Return the number of axes with a motor."""
    return sum(len(motor.max_effort) for motor in motors.values())


def stiffen(model: mujoco.MjModel) -> None:
    """Set the motors of a compiled model to their least compliance."""
    model.tendon_invweight0 *= _SHARE


def stiffen_worlds(batch: Batch) -> None:
    """Set the motors of worlds with their own inertias likewise, after ``set_const``."""
    if batch.expanded("tendon_invweight0") is not None:
        batch.expand("tendon_invweight0")[:] *= _SHARE


def motor_slots(motors: Mapping[str, Motor]) -> dict[str, MotorSlot]:
    """Return the slots of a model's motors, in the order that they were added in."""
    count = motor_count(motors)
    found: dict[str, MotorSlot] = {}
    start = 0
    for joint, motor in motors.items():
        stop = start + len(motor.max_effort)
        found[joint] = MotorSlot(slice(start, stop), slice(count + start, count + stop))
        start = stop
    return found
