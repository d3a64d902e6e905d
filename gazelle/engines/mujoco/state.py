"""State arrays of a batch, as live views, and rows of worlds in them."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds


@dataclass(frozen=True, slots=True)
class StateViews:
    """Live views, all with a leading axis over worlds.

    Attributes:
        faults: Counts of bad positions, velocities, accelerations and commands, shape
            (nworld, 4).
        overflows: Counts of steps in which contacts, and rows of constraints, did not fit into
            memory, shape (nworld, 2).

    The others are the fields of ``mjData`` of their names.
    """

    qpos: Floats
    qvel: Floats
    userdata: Floats
    mocap_pos: Floats
    mocap_quat: Floats
    qfrc_applied: Floats
    xfrc_applied: Floats
    faults: NDArray[np.int32]
    overflows: NDArray[np.int32]

    @classmethod
    def of(cls, batch: Batch) -> StateViews:
        """Return the views of a batch."""
        first, last = mujoco.mjtWarning.mjWARN_BADQPOS, mujoco.mjtWarning.mjWARN_BADCTRL
        contacts, rows = mujoco.mjtWarning.mjWARN_CONTACTFULL, mujoco.mjtWarning.mjWARN_CNSTRFULL
        return cls(
            qpos=batch.bind("qpos"),
            qvel=batch.bind("qvel"),
            userdata=batch.bind("userdata"),
            mocap_pos=batch.bind("mocap_pos"),
            mocap_quat=batch.bind("mocap_quat"),
            qfrc_applied=batch.bind("qfrc_applied"),
            xfrc_applied=batch.bind("xfrc_applied"),
            faults=batch.warning[:, int(first) : int(last) + 1, 1],
            overflows=batch.warning[:, int(contacts) : int(rows) + 1, 1],
        )


def rows_of(worlds: Worlds | None) -> slice | Worlds:
    """Return an index for these worlds, all if None."""
    return slice(None) if worlds is None else worlds
