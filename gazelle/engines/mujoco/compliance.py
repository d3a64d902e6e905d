"""Springs of stops and contacts in worlds that have masses of their own.

MuJoCo's terms of a spring hold for the inertia that they were tuned to (see
``contact_pairs.tune_springs`` and ``joint_limits.tune_stops``): its compliance is a regularisation R that
is given as an impedance d by R = (1 - d) / d times the inverse inertia. Where a world has
another inertia, another impedance gives the same compliance.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from gazelle.array_types import Floats

# MuJoCo's bounds of an impedance.
_LEAST, _MOST = 1e-4, 0.9999


def retune(batch: Batch, springs: Sequence[int]) -> None:
    """Set the springs of every world to the described stiffness.

    Args:
        batch: Worlds with changed inertias, after ``set_const``.
        springs: Indices of MuJoCo's contact pairs that are springs.
    """
    model = batch.model
    of_dofs, of_bodies = batch.expanded("dof_invweight0"), batch.expanded("body_invweight0")
    soft = model.jnt_solimp[:, 0] < _MOST
    stops = np.flatnonzero((model.jnt_limited != 0) & (model.jnt_solref[:, 1] < 0.0) & soft)
    if stops.size and of_dofs is not None:
        dofs = model.jnt_dofadr[stops]
        _keep(batch, "jnt", stops, model.dof_invweight0[dofs], of_dofs[:, dofs])
    if springs and of_bodies is not None:
        pairs = np.asarray(springs, np.intp)
        ends = [model.geom_bodyid[geoms[pairs]] for geoms in (model.pair_geom1, model.pair_geom2)]
        compiled = sum(model.body_invweight0[end, 0] for end in ends)
        _keep(batch, "pair", pairs, compiled, sum(of_bodies[:, end, 0] for end in ends))


def _keep(
    batch: Batch, kind: str, rows: NDArray[np.intp], compiled: Floats, mobility: Floats
) -> None:
    """Preserve the compliance of constraints.

    Args:
        batch: Of them.
        kind: Prefix of their fields in MuJoCo.
        rows: Rows, shape (k,).
        compiled: Inverse inertias that they are tuned to, shape (k,).
        mobility: Those of every world, shape (nworld, k).
    """
    terms, impedance = f"{kind}_solref", f"{kind}_solimp"
    old = getattr(batch.model, impedance)[rows, 0]
    compliance = (1.0 - old) / old * compiled
    new = np.clip(1.0 / (1.0 + compliance / np.maximum(mobility, 1e-12)), _LEAST, _MOST)
    batch.expand(impedance)[:, rows, :2] = new[..., None]
    batch.expand(terms)[:, rows] = getattr(batch.model, terms)[rows] * (new / old)[..., None]
