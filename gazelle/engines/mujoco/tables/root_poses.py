"""Put the root of a tree of links somewhere in MuJoCo's state."""

from __future__ import annotations

import numpy as np

from gazelle.array_types import Floats, Worlds
from gazelle.engines.mujoco.layout import LinkSlot
from gazelle.engines.mujoco.quaternions import wxyz_from_xyzw
from gazelle.engines.mujoco.state import rows_of
from gazelle.engines.mujoco.worlds import RunningWorlds
from gazelle.rotations import unit


def put_root(
    run: RunningWorlds,
    slot: LinkSlot,
    position: Floats,
    quaternion: Floats,
    worlds: Worlds | None,
) -> None:
    """Set the pose of a root; a static one keeps its pose.

    Args:
        run: Worlds that run.
        slot: The root.
        position: [m], shape (3,) or (n, 3).
        quaternion: (x, y, z, w), shape (4,) or (n, 4).
        worlds: Worlds.
    """
    rows = rows_of(worlds)
    run.placed = True
    # Normalised, or rounding errors would grow with every relative move.
    wxyz = wxyz_from_xyzw(unit(quaternion))
    if slot.mocap is not None:
        run.state.mocap_pos[rows, slot.mocap] = position
        run.state.mocap_quat[rows, slot.mocap] = wxyz
    elif slot.free is not None:
        run.dropped.setdefault(slot.body, np.zeros(run.nworld, np.bool_))[rows] = True
        start = slot.free.position.start
        run.state.qpos[rows, start : start + 3] = position
        run.state.qpos[rows, start + 3 : start + 7] = wxyz


def note_moves(run: RunningWorlds, before: Floats) -> None:
    """Record which bodies were placed, by positions before and now.

    Args:
        run: Worlds that run.
        before: Positions of all joints before, shape (nworld, positions).
    """
    moved = run.state.qpos != before
    run.placed = True
    for slot in run.layout.links.values():
        if slot.free is not None:
            worlds = moved[:, slot.free.position].any(axis=1)
            if worlds.any():
                run.dropped.setdefault(slot.body, np.zeros(run.nworld, np.bool_))[worlds] = True
