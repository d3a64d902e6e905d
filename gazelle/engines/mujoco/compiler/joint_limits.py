"""Soft stops of joints: limits that give way as a spring and damper.

SDF's ``<stiffness>`` and ``<dissipation>`` of a limit are of the stop's spring. Its default of
1e8 stands for a stop that does not give; so is every stop with a spring too stiff for
the physics step to follow.
"""

from __future__ import annotations

import math
from collections.abc import Iterable

import mujoco

from gazelle.description import JointAxis, JointPhysics
from gazelle.kinematics.tree import TreeLink

# A spring is followed when its period with what it moves takes at least this number of steps.
_FEWEST_STEPS_A_PERIOD = 10.0

# SDF's default, which no file means as a spring.
_RIGID = 1e8

# MuJoCo's bounds of an impedance.
_LEAST, _MOST = 1e-4, 0.9999


def tune_stops(model: mujoco.MjModel, bodies: Iterable[TreeLink]) -> None:
    """Set limits with a spring to the terms of ODE's implicit spring and damper.

    They are those of a springy contact (see ``contact_pairs.tune_springs``): erp = h k / (h k + c)
    and cfm = 1 / (h k + c) become a reference acceleration of -v / h - erp / h² * overshoot and
    a regularisation R = cfm / h, which is the impedance d by R = (1 - d) / d times the inverse
    inertia at the joint. That of the initial pose is taken; at rest the deflection is torque /
    stiffness in every pose, since R is a constant of the model.
    """
    for body in bodies:
        if body.joint is None:
            continue
        for index, axis in enumerate(body.joint.axes):
            name = body.joint_name if index == 0 else f"{body.joint_name}#{index}"
            joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
            if joint >= 0 and model.jnt_limited[joint]:
                _tune(model, joint, *_spring_of(axis, body.joint.physics, model.opt.timestep))


def _spring_of(axis: JointAxis, physics: JointPhysics, h: float) -> tuple[float, float]:
    """Return stiffness and damping of a stop, from its ERP and CFM if only those are given.

    With erp = h k / (h k + c) and cfm = 1 / (h k + c), ODE's manual, k is erp / (h cfm) and c
    is (1 - erp) / cfm.
    """
    erp, cfm = physics.stop_erp, physics.stop_cfm
    if axis.stiffness >= _RIGID and cfm > 0.0:
        return erp / (h * cfm), max(0.0, 1.0 - erp) / cfm
    return axis.stiffness, max(axis.dissipation, 0.0)


def _tune(model: mujoco.MjModel, joint: int, stiffness: float, damping: float) -> None:
    if stiffness >= _RIGID:
        return
    h = float(model.opt.timestep)
    mobility = float(model.dof_invweight0[model.jnt_dofadr[joint]])
    stiffest = (2.0 * math.pi / (_FEWEST_STEPS_A_PERIOD * h)) ** 2
    if not 0.0 < stiffness * mobility <= stiffest:
        return
    give = 1.0 / (h * stiffness + damping)
    erp = h * stiffness * give
    d = min(max(1.0 / (1.0 + give / h / mobility), _LEAST), _MOST)
    model.jnt_solimp[joint] = (d, d, 0.001, 0.5, 2.0)
    model.jnt_solref[joint] = (-d * erp / h**2, -d / h)
