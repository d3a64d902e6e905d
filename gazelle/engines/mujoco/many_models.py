"""Many models at once: where their frames are, and how they are made to move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from gazelle.array_types import Floats, Indices
from gazelle.engines.motion import Placement
from gazelle.engines.mujoco.layout import MujocoLayout
from gazelle.engines.mujoco.many_joints import Lookups
from gazelle.engines.mujoco.many_links import ManyLinks
from gazelle.engines.mujoco.running import RunningWorlds
from gazelle.rotations import conjugate, cross, from_yaw, multiply, rotate, yaw_of


@dataclass(frozen=True, slots=True)
class FramePlaces:
    """Frames of some models, looked up once.

    Attributes:
        links: Scoped names of those that carry the frames.
        moved: Which models' frames are not their links', shape (k,).
        at: Where those are in their links' frames [m], shape (k, 3).
        turned: Quaternions (x, y, z, w), shape (k, 4).
    """

    links: tuple[str, ...]
    moved: Indices
    at: Floats
    turned: Floats

    @classmethod
    def find(cls, layout: MujocoLayout, models: Sequence[str]) -> FramePlaces:
        """Look models up.

        Raises:
            EngineError: There is no such model.
        """
        slots = [layout.model(name) for name in models]
        moved = [i for i, slot in enumerate(slots) if slot.back is not None]
        at = [slots[i].offset.position for i in moved]
        turned = [slots[i].offset.quaternion for i in moved]
        return cls(
            tuple(slot.canonical for slot in slots),
            np.array(moved, np.intp),
            np.array(at).reshape(-1, 3),
            np.array(turned).reshape(-1, 4),
        )


@dataclass(frozen=True, slots=True)
class ModelRoots:
    """Links that carry some models and move freely, looked up once.

    Attributes:
        links: Their scoped names.
        owners: Of each the place of its model, shape (k,).
        rates: Columns of their velocities, shape (k, 6).
        dofs: Columns of the velocities of all joints of the models, shape (joints,).
    """

    links: tuple[str, ...]
    owners: Indices
    rates: Indices
    dofs: Indices

    @classmethod
    def find(cls, layout: MujocoLayout, models: Sequence[str]) -> ModelRoots:
        """Look models up.

        Raises:
            EngineError: There is no such model.
        """
        slots = [layout.model(name) for name in models]
        found = [
            (root, owner, free.velocity)
            for owner, slot in enumerate(slots)
            for root in slot.roots
            if (free := layout.link(root).free) is not None
        ]
        joints = [each.velocity for s in slots for name in s.joints for each in layout.joint(name)]
        return cls(
            tuple(root for root, _, _ in found),
            np.array([owner for _, owner, _ in found], np.intp),
            np.array([range(at.start, at.stop) for _, _, at in found], np.intp).reshape(-1, 6),
            np.array([column for at in joints for column in range(at.start, at.stop)], np.intp),
        )


class ManyModels:
    """The part of ``gazelle.engines.table_engine.TableEngine`` for models.

    Args:
        run: What runs.
        links: Where links are.
    """

    def __init__(self, run: RunningWorlds, links: ManyLinks) -> None:
        self._run, self._links, self._found = run, links, Lookups()

    def model_placements(self, models: Sequence[str]) -> Placement:
        """Where models' frames are: shapes (nworld, models, 3) and (nworld, models, 4)."""
        frames = self._found.find(self._run.known(), models, FramePlaces.find)
        place = self._links.link_placements(frames.links)
        if len(frames.moved):
            quaternion = place.quaternion[:, frames.moved]
            place.position[:, frames.moved] += rotate(quaternion, frames.at[None])
            place.quaternion[:, frames.moved] = multiply(quaternion, frames.turned[None])
        return place

    def set_ground_motions(self, models: Sequence[str], twist: ArrayLike) -> None:
        """Give many models level velocities along and across their headings; see the protocol."""
        roots = self._found.find(self._run.now(), models, ModelRoots.find)
        origin = self.model_placements(models)
        wanted = np.broadcast_to(np.asarray(twist, np.float64), origin.position.shape)
        heading = from_yaw(yaw_of(origin.quaternion))
        v = rotate(heading, wanted * (1.0, 1.0, 0.0))[:, roots.owners]
        w = (wanted * (0.0, 0.0, 1.0))[:, roots.owners]
        link = self._links.link_placements(roots.links)
        at_link = v + cross(w, link.position - origin.position[:, roots.owners])
        local = rotate(conjugate(link.quaternion), w)
        self._run.state.qvel[:, roots.rates] = np.concatenate((at_link, local), axis=-1)
        self._run.state.qvel[:, roots.dofs] = 0.0
        self._run.stale = True
