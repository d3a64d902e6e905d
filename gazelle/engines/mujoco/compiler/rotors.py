"""Contacts of bodies that only turn about an axis through their centre of mass.

MuJoCo scales the softness of a contact by how easily the centres of mass of its bodies move. That
of a balanced gear or roller on an axle does not move at all, so its contacts had no softness: a
contact across the axle, which nothing gives way to, took 1e14 N, and its friction held the gear.
"""

from __future__ import annotations

import mujoco
import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats

_LEAST = 1e-5
"""Share of the mobility at the rim up to which that of the centre counts as none."""


def soften_rotors(model: mujoco.MjModel) -> None:
    """Set balanced rotors of a compiled model to the mobility of their rim."""
    model.body_invweight0[:] = _mobility(model, model.body_invweight0)


def soften_rotors_of_worlds(batch: Batch) -> None:
    """Set balanced rotors of worlds with their own inertias likewise, after ``set_const``."""
    own = batch.expanded("body_invweight0")
    if own is not None:
        batch.expand("body_invweight0")[:] = _mobility(batch.model, own)


def _mobility(model: mujoco.MjModel, mobility: Floats) -> Floats:
    """Return inverse masses and inertias of bodies, shape (..., nbody, 2)."""
    shift = model.geom_pos - model.body_ipos[model.geom_bodyid]
    reach = np.zeros(model.nbody)
    np.maximum.at(reach, model.geom_bodyid, np.linalg.norm(shift, axis=1) + model.geom_rbound)
    rim = mobility[..., 1] * reach**2
    found = np.array(mobility)
    found[..., 0] = np.where(mobility[..., 0] < _LEAST * rim, rim, mobility[..., 0])
    return found
