"""Where many links are at once, from the arrays of the batch."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from mujoco.batch import Batch

from gazelle.array_types import Floats, Worlds
from gazelle.engines.motion import Placement
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.order import xyzw_from_wxyz


class MujocoLinkTable:
    """Some links of a layout, looked up once.

    Args:
        layout: Of what runs.
        links: Their scoped names.

    Attributes:
        layout: As given; another one has other links.
        moving: Whether any of them can move.

    Raises:
        EngineError: There is no such link.
    """

    def __init__(self, layout: MujocoLayout, links: Sequence[str]) -> None:
        self.layout = layout
        slots = [layout.link(link) for link in links]
        self._at = np.array([slot.pose.position for slot in slots]).reshape(-1, 3)
        self._turned = np.array([slot.pose.quaternion for slot in slots]).reshape(-1, 4)
        still = np.array([slot.root == "static" for slot in slots], np.bool_)
        self._which = np.flatnonzero(~still)
        self._bodies = np.array([slot.body for slot in slots], np.intp)[self._which]
        self.moving = bool(len(self._which))

    def placement(self, batch: Batch, worlds: Worlds | None) -> Placement:
        """Positions [m], shape (n, links, 3), and quaternions (x, y, z, w), shape (n, links, 4).

        Args:
            batch: In which bodies have been placed.
            worlds: Which worlds; all if None.
        """
        rows = slice(None) if worlds is None else worlds
        places: Floats = batch.xpos[rows]
        at = np.repeat(self._at[None], len(places), axis=0)
        turned = np.repeat(self._turned[None], len(places), axis=0)
        at[:, self._which] = places[:, self._bodies]
        turned[:, self._which] = xyzw_from_wxyz(batch.xquat[rows][:, self._bodies])
        return Placement(at, turned)
