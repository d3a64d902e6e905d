"""Planned motions of arms, as ghosts of the robots."""

from __future__ import annotations

import threading
from dataclasses import dataclass

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Model
from gazelle.errors import Error
from gazelle.simulation.joint_motion import JointMotion
from gazelle.simulation.robot import Robot
from gazelle.viewer.page.context import ROOT, PageContext
from gazelle.viewer.page.motion_ghost import MotionGhost

_Placed = tuple[Floats, Floats]


@dataclass(frozen=True, slots=True)
class _Seen:
    """A motion, and where its robot is: positions and quaternions of its base and its links."""

    motion: JointMotion
    model: Model
    base: _Placed
    links: _Placed | None
    spot: Floats


class MotionLayer:
    """Ghosts of robots whose motions were reported by ``simulation.events.planned``.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context, self.shown = context, True
        self._lock = threading.Lock()
        self._motions: dict[tuple[str, int], JointMotion] = {}
        self._ghosts: dict[tuple[str, int], MotionGhost] = {}
        self._count = 0
        self.forget = context.simulation.events.planned.subscribe(self._take)

    def read(self) -> dict[tuple[str, int], _Seen]:
        """Return the poses of the robots with motions, of those that still exist."""
        simulation = self._context.simulation
        spots = dict(zip(self._context.worlds.tolist(), self._context.spots, strict=True))
        with self._lock:
            for key in [key for key in self._motions if key[0] not in simulation.robots]:
                del self._motions[key]
            motions = dict(self._motions) if self.shown else {}
        return {
            key: self._show_motion(simulation.robots[key[0]], motion, key, spots[key[1]])
            for key, motion in motions.items()
            if key[1] in spots
        }

    def show(self, state: dict[tuple[str, int], _Seen]) -> None:
        """Move the ghosts."""
        for key in [key for key in self._ghosts if key not in state]:
            self._ghosts.pop(key).remove()
        for key, seen in state.items():
            ghost = self._ghosts.get(key)
            if ghost is None or ghost.motion is not seen.motion:
                ghost = self._made(key, seen)
            if ghost is not None:
                if seen.links is not None:
                    ghost.compare(seen.base, seen.links)
                ghost.show(seen.base[0] + seen.spot, seen.base[1])

    def renew(self) -> None:
        """Do nothing: robots are looked up with every picture."""

    def _take(self, robot: Robot, world: int, motion: JointMotion) -> None:
        with self._lock:
            self._motions[robot.name, world] = motion

    def _show_motion(
        self, robot: Robot, motion: JointMotion, key: tuple[str, int], spot: Floats
    ) -> _Seen:
        ghost, rows = self._ghosts.get(key), np.array([key[1]])
        if ghost is not None and ghost.base in robot.links:
            placed = robot.links[ghost.base].placement(rows)
        else:
            placed = robot.placement(rows)
        base = placed.position[0], placed.quaternion[0]
        links = None
        if ghost is not None and all(link in robot.links for link in ghost.links):
            each = [robot.links[link].placement(rows) for link in ghost.links]
            links = (
                np.array([place.position[0] for place in each]),
                np.array([place.quaternion[0] for place in each]),
            )
        return _Seen(motion, robot.description, base, links, spot)

    def _made(self, key: tuple[str, int], seen: _Seen) -> MotionGhost | None:
        """Return a ghost in place of the robot's last one.

        None, with a notice, if it is impossible.
        """
        if key in self._ghosts:
            self._ghosts.pop(key).remove()
        self._count += 1
        try:
            ghost = MotionGhost(
                self._context.scene, f"{ROOT}/motions/{self._count}", seen.model, seen.motion
            )
        except Error as error:
            with self._lock:
                if self._motions.get(key) is seen.motion:
                    del self._motions[key]
            self._context.notify("A motion cannot be shown", str(error))
            return None
        self._ghosts[key] = ghost
        return ghost
