"""The laws of a world as MuJoCo's options.

What of SDF's solver terms has a counterpart is written down in ``docs/physics.md``.
"""

from __future__ import annotations

import mujoco

from gazelle.description import World

_LINE_SEARCH_ITERATIONS = 20


def set_options(spec: mujoco.MjSpec, world: World, time_step: float) -> None:
    """Set what holds for the whole world."""
    option = spec.option
    option.timestep = time_step
    # Semi-implicit Euler as ODE integrates; joint damping stays implicit (eulerdamp).
    option.integrator = mujoco.mjtIntegrator.mjINT_EULER
    option.cone = mujoco.mjtCone.mjCONE_PYRAMIDAL
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    option.iterations = 20
    option.ls_iterations = _LINE_SEARCH_ITERATIONS
    spec.compiler.autolimits = True
    spec.compiler.degree = False
    spec.compiler.discardvisual = False
    spec.compiler.fusestatic = False
    option.gravity = list(world.gravity)
    option.magnetic = list(world.magnetic_field)
