"""Many joints at once: where they are in MuJoCo's arrays, and between which limits."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Bools, Floats, Indices
from gazelle.engines.mujoco.layout import MujocoLayout


@dataclass(frozen=True, slots=True)
class JointCells:
    """Joints with one axis each.

    Attributes:
        places: Among positions, shape (joints,).
        dofs: Among velocities and efforts, likewise.
        lower: Least positions in each world [m or rad], shape (nworld, joints).
        upper: Greatest, never less than ``lower``, likewise.
    """

    places: Indices
    dofs: Indices
    lower: Floats
    upper: Floats

    @classmethod
    def find(
        cls, layout: MujocoLayout, joints: Sequence[str], limit: Callable[[str, str], Floats]
    ) -> JointCells:
        """Look joints up.

        Args:
            layout: Of the model.
            joints: Scoped names.
            limit: Gives ``joint_lower`` or ``joint_upper`` of a joint, shape (nworld, 1).
        """
        slots = [layout.joint(name)[0] for name in joints]
        lower, upper = (
            np.concatenate([limit(side, name) for name in joints], axis=1)
            for side in ("joint_lower", "joint_upper")
        )
        places = np.array([slot.position.start for slot in slots], np.intp)
        dofs = np.array([slot.velocity.start for slot in slots], np.intp)
        return cls(places, dofs, lower, np.maximum(lower, upper))

    def put(
        self, qpos: Floats, qvel: Floats, position: Floats, velocity: Floats, chosen: Bools
    ) -> None:
        """Put joints somewhere, to their limits at most, and give them velocities.

        Args:
            qpos: Positions of all worlds.
            qvel: Velocities of all worlds.
            position: Of the joints [m or rad], shape (nworld, joints).
            velocity: [m/s or rad/s], likewise.
            chosen: Which are put, likewise.
        """
        within = np.clip(position, self.lower, self.upper)
        if chosen.all():
            qpos[:, self.places], qvel[:, self.dofs] = within, velocity
            return
        worlds, joints = np.nonzero(chosen)
        qpos[worlds, self.places[joints]] = within[chosen]
        qvel[worlds, self.dofs[joints]] = velocity[chosen]
