"""Objects held between fingers: what ``libgazebo_grasp_fix.so`` does."""

from __future__ import annotations

import math
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines import Contacts
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.simulation import LinkHandle, ModelPlugin, Robot

# Forces weaker than this squeeze nothing [N].
_LEAST_FORCE = 1e-6


@dataclass(slots=True)
class _Arm:
    """A palm, its fingers, and the held object.

    Attributes:
        palm: Link that objects are held to.
        fingers: Links that squeeze.
        collisions: Scoped names of the collisions of palm and fingers.
        counts: Number of times an object, by link, was squeezed in a world; decreases otherwise.
        held: Object held in a world, and its distance from the fingers.
    """

    palm: LinkHandle
    fingers: list[LinkHandle]
    collisions: list[str]
    counts: dict[tuple[int, str], int] = field(default_factory=dict)
    held: dict[int, tuple[str, Floats]] = field(default_factory=dict)


class GraspFix(ModelPlugin):
    """Holds an object to the palm when forces from opposite sides last; releases it when fingers open.

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
                    f"'{robot.name}': contacts with held objects stay enabled; disable_collisions_on_attach "
                    "of grasp_fix has no effect"
                ),
                stacklevel=2,
            )

    def on_update(self, time: float) -> None:  # noqa: ARG002  it counts its updates
        """Check the contacts of the fingers; attach or detach."""
        for arm in self._arms:
            free = [world for world in range(self._simulation.nworld) if world not in arm.held]
            self._let_go_if_open(arm)
            if free:
                self._count(arm, np.array(free))

    def _count(self, arm: _Arm, worlds: Worlds) -> None:
        found = self._simulation.engine.contacts([arm.collisions], worlds)
        squeezed = self._squeezed(found.worlds, found.named())
        looked_at = set(worlds.tolist())
        for key in [key for key in arm.counts if key[0] in looked_at and key not in squeezed]:
            arm.counts[key] -= 1
            if arm.counts[key] <= 0:
                del arm.counts[key]
        taken: dict[int, str] = {}
        for world, link in sorted(squeezed):
            count = min(arm.counts.get((world, link), 0) + 1, self._most_count)
            arm.counts[world, link] = count
            if count > self._threshold:
                taken.setdefault(world, link)
        for link, rows in _by_link(taken).items():
            self._simulation.engine.attach(arm.palm.name, link, rows)
            gaps = self._gaps(arm, link, rows)
            arm.held |= {world: (link, gap) for world, gap in zip(rows.tolist(), gaps, strict=True)}

    def _squeezed(self, where: Worlds, contacts: Contacts) -> set[tuple[int, str]]:
        """Return worlds, and movable links in them that are pushed from opposite sides."""
        pushes: dict[tuple[int, str], list[Floats]] = {}
        sizes = np.linalg.norm(contacts.force, axis=1)
        directions = -contacts.force / np.maximum(sizes, _LEAST_FORCE)[:, None]
        for index in np.flatnonzero(sizes > _LEAST_FORCE):
            name = contacts.others[index]
            if self._can_be_held(name.partition("::")[0]):
                key = int(where[index]), name.rpartition("::")[0]
                pushes.setdefault(key, []).append(directions[index])
        return {
            key
            for key, pushing in pushes.items()
            if (np.array(pushing) @ np.array(pushing).T).min() < self._most_cosine
        }

    def _can_be_held(self, model: str) -> bool:
        robot = self._simulation.robots.get(model)
        return robot is not None and robot is not self._robot and not robot.description.static

    def _gaps(self, arm: _Arm, link: str, worlds: Worlds) -> Floats:
        """Return the distance of each finger from an object [m], shape (n, fingers)."""
        place = self._simulation.engine.links[link].placement(worlds).position
        away = [finger.placement(worlds).position - place for finger in arm.fingers]
        return np.asarray(np.linalg.norm(np.stack(away, axis=1), axis=2), np.float64)

    def _let_go_if_open(self, arm: _Arm) -> None:
        engine = self._simulation.engine
        for link, rows in _by_link({world: link for world, (link, _) in arm.held.items()}).items():
            if link not in engine.links.names:
                arm.held = {world: each for world, each in arm.held.items() if each[0] != link}
                continue
            before = np.array([arm.held[world][1] for world in rows.tolist()])
            opened = rows[(self._gaps(arm, link, rows) > before + self._release).any(axis=1)]
            if opened.size:
                engine.detach(arm.palm.name, link, opened)
            for world in opened.tolist():
                del arm.held[world]
                arm.counts.pop((world, link), None)

    def reset(self, worlds: Worlds | None) -> None:
        """Discard grasps; the engine's reset detached them."""
        chosen = range(self._simulation.nworld) if worlds is None else worlds.tolist()
        for arm in self._arms:
            arm.held = {world: held for world, held in arm.held.items() if world not in chosen}
            arm.counts = {key: n for key, n in arm.counts.items() if key[0] not in chosen}

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return the held objects and the counts of contacts."""
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
        """Restore what ``state`` returned; that it is held is in the engine's state."""
        for i, arm in enumerate(self._arms):
            pairs = zip(state[f"{i} counted"], state[f"{i} counts"], strict=True)
            arm.counts = {(int(n[0]), str(link)): int(n[1]) for link, n in pairs}
            held = zip(state[f"{i} worlds"], state[f"{i} held"], state[f"{i} gaps"], strict=True)
            arm.held = {
                int(world): (str(link), np.asarray(gaps, np.float64)) for world, link, gaps in held
            }


def _by_link(links: Mapping[int, str]) -> dict[str, Worlds]:
    """Return the worlds of each link, in order."""
    return {
        link: np.array(sorted(world for world, each in links.items() if each == link))
        for link in sorted(set(links.values()))
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
    """Return a link's name without its model's."""
    return name.rpartition("::")[2]
