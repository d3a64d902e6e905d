"""Objects held between fingers: what ``libgazebo_grasp_fix.so`` does."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.description import Parameters
from gazelle.engines import Contacts
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.simulation import LinkHandle, ModelPlugin, Robot

Floats = NDArray[np.float64]
Worlds = NDArray[np.intp]

# Forces weaker than this squeeze nothing [N].
_LEAST_FORCE = 1e-6


@dataclass(slots=True)
class _Arm:
    """A palm, its fingers, and what they hold.

    Attributes:
        palm: Link that objects are held to.
        fingers: Links that squeeze.
        collisions: Scoped names of the collisions of palm and fingers.
        counts: How often an object, by link, was seen squeezed in a world; goes down when not.
        held: What is held in a world, and how far the fingers were from it.
    """

    palm: LinkHandle
    fingers: list[LinkHandle]
    collisions: list[str]
    counts: dict[tuple[int, str], int] = field(default_factory=dict)
    held: dict[int, tuple[str, Floats]] = field(default_factory=dict)


class GraspFix(ModelPlugin):
    """Holds an object to the palm when forces from opposite sides last; lets go when fingers open.

    It looks at ``update_rate`` of simulated time, where the original does of wall time. The
    contacts of a held object stay on.
    """

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, find palms and fingers."""
        self._robot, self._simulation = robot, robot.simulation
        self._arms = [
            _arm(robot, tags) for tags in (list(parameters.find_all("arm")) or [parameters])
        ]
        self.update_rate = parameters.get("update_rate", 5.0)
        angle = parameters.get("forces_angle_tolerance", 120.0)
        self._most_cosine = math.cos(math.radians(angle))
        self._most_count = parameters.get("max_grip_count", 10)
        self._threshold = parameters.get("grip_count_threshold", self._most_count // 2)
        self._release = parameters.get("release_tolerance", 0.005)
        if parameters.get("disable_collisions_on_attach", False):
            warnings.warn(
                SimulationWarning(
                    f"'{robot.name}': held objects go on touching; disable_collisions_on_attach "
                    "of grasp_fix has no effect"
                ),
                stacklevel=2,
            )

    def on_update(self, time: float) -> None:  # noqa: ARG002  it counts its updates
        """Look at what the fingers touch; hold or let go."""
        # The engine lists contacts of one world at a time.
        for world in range(self._simulation.nworld):
            for arm in self._arms:
                if world in arm.held:
                    self._let_go_if_open(arm, world)
                else:
                    self._count(arm, world)

    def _count(self, arm: _Arm, world: int) -> None:
        squeezed = self._squeezed(self._simulation.engine.contacts(arm.collisions, world))
        for key in [key for key in arm.counts if key[0] == world and key[1] not in squeezed]:
            arm.counts[key] -= 1
            if arm.counts[key] <= 0:
                del arm.counts[key]
        for link in sorted(squeezed):
            count = min(arm.counts.get((world, link), 0) + 1, self._most_count)
            arm.counts[world, link] = count
            if count > self._threshold and world not in arm.held:
                self._simulation.engine.attach(arm.palm.name, link, np.array([world]))
                arm.held[world] = (link, self._gaps(arm, link, world))

    def _squeezed(self, contacts: Contacts) -> set[str]:
        """Links of other, movable models that are pushed from opposite sides."""
        pushes: dict[str, list[Floats]] = {}
        for name, force in zip(contacts.others, -contacts.force, strict=True):
            size = float(np.linalg.norm(force))
            if size > _LEAST_FORCE and self._can_be_held(name.partition("::")[0]):
                pushes.setdefault(name.rpartition("::")[0], []).append(force / size)
        return {
            link
            for link, directions in pushes.items()
            if (np.array(directions) @ np.array(directions).T).min() < self._most_cosine
        }

    def _can_be_held(self, model: str) -> bool:
        robot = self._simulation.robots.get(model)
        return robot is not None and robot is not self._robot and not robot.description.static

    def _gaps(self, arm: _Arm, link: str, world: int) -> Floats:
        """How far each finger is from an object [m], shape (fingers,)."""
        worlds = np.array([world])
        place = self._simulation.engine.link_placement(link, worlds).position
        away = [finger.placement(worlds).position - place for finger in arm.fingers]
        return np.asarray(np.linalg.norm(np.concatenate(away), axis=1), np.float64)

    def _let_go_if_open(self, arm: _Arm, world: int) -> None:
        link, gaps = arm.held[world]
        if link not in self._simulation.engine.link_names:
            del arm.held[world]
        elif (self._gaps(arm, link, world) > gaps + self._release).any():
            self._simulation.engine.detach(arm.palm.name, link, np.array([world]))
            del arm.held[world]
            arm.counts.pop((world, link), None)

    def reset(self, worlds: Worlds | None) -> None:
        """Hold nothing; the engine's reset let go."""
        chosen = range(self._simulation.nworld) if worlds is None else worlds.tolist()
        for arm in self._arms:
            arm.held = {world: held for world, held in arm.held.items() if world not in chosen}
            arm.counts = {key: n for key, n in arm.counts.items() if key[0] not in chosen}

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """What is held, and what was counted."""
        state: dict[str, NDArray[np.generic]] = {}
        for i, arm in enumerate(self._arms):
            links = [link for _, link in arm.counts]
            state[f"{i} counted"] = np.asarray(links, np.str_)
            numbers = [(world, count) for (world, _), count in arm.counts.items()]
            state[f"{i} counts"] = np.asarray(numbers, np.int64).reshape(-1, 2)
            state[f"{i} held"] = np.asarray([link for link, _ in arm.held.values()], np.str_)
            state[f"{i} worlds"] = np.asarray(list(arm.held), np.int64)
            gaps = [gaps for _, gaps in arm.held.values()]
            state[f"{i} gaps"] = np.asarray(gaps, np.float64).reshape(-1, len(arm.fingers))
        return state

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Put back what ``state`` gave; that it is held is in the engine's state."""
        for i, arm in enumerate(self._arms):
            pairs = zip(state[f"{i} counted"], state[f"{i} counts"], strict=True)
            arm.counts = {(int(n[0]), str(link)): int(n[1]) for link, n in pairs}
            held = zip(state[f"{i} worlds"], state[f"{i} held"], state[f"{i} gaps"], strict=True)
            arm.held = {
                int(world): (str(link), np.asarray(gaps, np.float64)) for world, link, gaps in held
            }


def _arm(robot: Robot, tags: Parameters) -> _Arm:
    palm = robot.frame(_own(tags.require("palm_link", str)))[0]
    names = [_own(tag.text) for tag in tags.find_all("gripper_link")]
    if not names:
        raise SimulationError("a <gripper_link> is required here", source=tags.source)
    fingers = [robot.frame(name)[0] for name in names]
    links = {link.name: link for link in (palm, *fingers)}.values()
    collisions = [f"{link.name}::{c.name}" for link in links for c in link.description.collisions]
    return _Arm(palm, fingers, collisions)


def _own(name: str) -> str:
    """A link's name without its model's."""
    return name.rpartition("::")[2]
