"""Contacts that single precision can solve.

MuJoCo solves a step by factorising M + J' D J. With D a hundred million times M, as contacts are on the
processor (``surfaces``), rounding in single precision is larger than M, and the factor of what rolls or
tips is that of no matrix: the world breaks down. Here friction is less stiff, so that D is a hundred
thousand times M; what is held creeps by micrometres a second for that, where it creeps by nanometres on the
processor. A pyramid's edges are stiffer the less friction there is, at any ratio: boxes fall through the
ground. So friction is a cone always.
"""

from __future__ import annotations

import mujoco

# How many times stiffer friction is than the normal direction; as of what rolls on the processor.
_RATIO = 10.0


def soften(model: mujoco.MjModel) -> None:
    """Set the friction of a compiled model as stiff as single precision bears."""
    model.opt.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    model.opt.impratio = min(float(model.opt.impratio), _RATIO)
