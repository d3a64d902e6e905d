"""Joints as systems see them that act within MuJoCo's steps (``laws.commands``)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np

from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.native.joint_system import JointSystem

# Integrators that look at forces once in a step.
_ONCE = (
    mujoco.mjtIntegrator.mjINT_EULER,
    mujoco.mjtIntegrator.mjINT_IMPLICIT,
    mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
)


class CarriedSystems:
    """The part of ``gazelle.engines.carrying.CarryingEngine``.

    Args:
        run: What runs.
    """

    def __init__(self, run: RunningWorlds) -> None:
        self._run = run

    @property
    def looks_once(self) -> bool:
        """Whether the integrator looks at forces once in a step."""
        return self._run.batch.model.opt.integrator in _ONCE

    def expect_systems(self) -> None:
        """Be ready to carry systems: what has to be compiled for that is."""
        recipe = self._run.latest
        if not recipe.hooks:
            self._run.change(replace(recipe, hooks=self._run.hooks.address))

    def bind_joints(self, system: JointSystem, joints: Sequence[str]) -> None:
        """Say where joints are, good for one ``revision``."""
        layout = self._run.now()
        slots = [layout.joint(name)[0] for name in joints]
        largest = [layout.limits.effort.get(name, (np.inf,))[0] for name in joints]
        driven = self._run.recipe.motors
        system.bind(
            np.array([slot.position.start for slot in slots], np.intp),
            np.array([slot.velocity.start for slot in slots], np.intp),
            np.array(largest, np.float64),
            np.array(
                [layout.motor(n).targets.start if n in driven else -1 for n in joints], np.intp
            ),
        )

    def read_joints(self, system: JointSystem) -> None:
        """Tell a bound system where its joints are now."""
        system.read(self._run.state.qpos, self._run.state.qvel)

    def push_joints(self, system: JointSystem) -> None:
        """Let act what a bound system says."""
        system.act(self._run.state.qfrc_applied, self._run.state.userdata)
        self._run.stale = True
