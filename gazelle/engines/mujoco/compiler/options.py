"""The laws of a world as MuJoCo's options.

What of SDF's solver terms has a counterpart is written down in ``docs/explanation/physics.md``.
"""

from __future__ import annotations

from collections.abc import Collection

import mujoco
import numpy as np

from gazelle.description import World
from gazelle.engines.limits import MAX_ITERATIONS
from gazelle.engines.mujoco.compiler.free_bodies import (
    SLEEP_SPEED,
    allows_sleep,
    has_free_bodies,
    uses_speculative_contacts,
)
from gazelle.errors import EngineError, did_you_mean

# So often MuJoCo's line search may halve its interval: motors and dry friction are stiff.
_LINE_SEARCH_ITERATIONS = 100

# Names of how contacts are solved.
CONTACTS = ("exact", "fast")

_INTEGRATORS = {
    # Semi-implicit Euler as ODE integrates; joint damping is implicit (eulerdamp).
    "euler": mujoco.mjtIntegrator.mjINT_EULER,
    "rk4": mujoco.mjtIntegrator.mjINT_RK4,
}


# Name of the sensor of the least distance of any contact [m], and how it reduces many to one.
DEEPEST = "deepest"
_LEAST = 1

SENSORS_OFF = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)

# MuJoCo knows no forces of springs, dampers, fluids and against gravity when both are off.
PASSIVE_OFF = int(mujoco.mjtDisableBit.mjDSBL_SPRING) | int(mujoco.mjtDisableBit.mjDSBL_DAMPER)


def set_options(
    spec: mujoco.MjSpec, world: World, time_step: float, kinematic: Collection[str]
) -> None:
    """Set what holds for the whole world.

    Args:
        spec: Specification for MuJoCo's compiler.
        world: The description.
        time_step: Physics step [s].
        kinematic: Names of kinematic models.
    """
    option = spec.option
    option.timestep = time_step
    option.integrator = _integrator(world.profile.integrator)
    option.cone = _cone(world, kinematic)
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    # Newton's method is done after a few; the file's number is where it gives up.
    option.iterations = min(max(1, world.profile.ode.iters), MAX_ITERATIONS)
    option.ls_iterations = _LINE_SEARCH_ITERATIONS
    option.gravity = list(world.gravity)
    option.magnetic = list(world.magnetic_field)
    option.sleep_tolerance = SLEEP_SPEED
    if allows_sleep(world, kinematic):
        option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SLEEP)
    if uses_speculative_contacts(world, time_step, kinematic):
        option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE)
    spec.compiler.autolimits = True
    spec.compiler.degree = False
    spec.compiler.discardvisual = False
    spec.compiler.fusestatic = False


def _cone(world: World, kinematic: Collection[str]) -> mujoco.mjtCone:
    """Return MuJoCo's friction cone: by name, by SDF's friction model, or by the world.

    In a cone what is held does not creep. A pyramid is faster for robots that drive.

    Raises:
        EngineError: There are no such contacts.
    """
    kind, friction_model = world.profile.contacts, world.profile.ode.friction_model
    if kind is not None and kind not in CONTACTS:
        raise EngineError(f"there are no contacts '{kind}'", hint=did_you_mean(kind, CONTACTS))
    if kind is not None:
        cone = kind == "exact"
    elif friction_model is not None:
        cone = friction_model == "cone_model"
    else:
        cone = has_free_bodies(world, kinematic)
    return mujoco.mjtCone.mjCONE_ELLIPTIC if cone else mujoco.mjtCone.mjCONE_PYRAMIDAL


def damp_implicitly(spec: mujoco.MjSpec) -> None:
    """Set Euler's method to damp joints implicitly, constraints included.

    With the damping D and the step h, implicit Euler is (M + h D) a = f - D v. MuJoCo's own way
    (``eulerdamp``) solves constraints with M, and finds the acceleration again with M + h D from their
    forces: the force that a motor and a stiff contact command is not the resulting one, and a robot that grips
    or leans on something shakes until it flies apart. Here h D is part of the joints' inertia (as an
    armature), so that both are found together; motion without constraints is the same.
    """
    if spec.option.integrator != mujoco.mjtIntegrator.mjINT_EULER:
        return
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_EULERDAMP)
    for joint in spec.joints:
        joint.armature += spec.option.timestep * float(np.ravel(joint.damping)[0])


def skip_idle_forces(model: mujoco.MjModel) -> None:
    """Disable springs, dampers and gravity compensation where nothing has any: 2 % faster."""
    if not (model.jnt_stiffness.any() or model.dof_damping.any() or model.body_gravcomp.any()):
        model.opt.disableflags |= PASSIVE_OFF


def _integrator(name: str | None) -> mujoco.mjtIntegrator:
    """Return MuJoCo's integrator of a name.

    Raises:
        EngineError: There is none.
    """
    known = name or "euler"
    if known not in _INTEGRATORS:
        raise EngineError(
            f"there is no integrator '{name}'", hint=did_you_mean(known, _INTEGRATORS)
        )
    return _INTEGRATORS[known]


def add_probes(spec: mujoco.MjSpec) -> None:
    """Add sensors for the depth of the deepest contact and the forces between bodies.

    MuJoCo computes forces between bodies only for sensors that need them; one stands for all.
    Sensors are switched off in every step.
    """
    spec.add_sensor(
        name=DEEPEST,
        type=mujoco.mjtSensor.mjSENS_CONTACT,
        intprm=[1 << int(mujoco.mjtConDataField.mjCONDATA_DIST), _LEAST, 1],
    )
    spec.add_sensor(
        type=mujoco.mjtSensor.mjSENS_FRAMELINACC,
        objtype=mujoco.mjtObj.mjOBJ_BODY,
        objname="world",
    )
    spec.option.disableflags |= SENSORS_OFF
