"""Actors that find their way: what ``libActorPlugin.so`` does."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
from numpy.typing import NDArray

from gazelle.array_types import Floats, Worlds
from gazelle.description import Parameters
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import SimulationError
from gazelle.rotations import from_yaw, multiply
from gazelle.simulation import ModelPlugin, Robot
from gazelle.streams import Stream

# Gazebo's plugin: speed [m/s], when a target is reached, how far it stays away from models,
# how near they push it [m], from which angle on it turns in place [rad], and how fast it does
# at Gazebo's usual step: by a thousandth of the angle in a thousandth of a second.
_SPEED, _REACHED, _AWAY, _NEAR = 0.8, 0.3, 2.0, 4.0
_TURNS_FROM, _TURNING_RATE = math.radians(10.0), 1.0
# A place that is far enough from all models is sought so often; Gazebo seeks for ever.
_TRIES = 100
# The frame that moves is the hip, whose y points up.
_ROLLED = np.array([math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)])


class ActorWalk(ModelPlugin):
    """An actor drawn to random targets and pushed away by other models.

    It goes through what does not push it away enough, as in Gazebo. Every world has targets
    of its own.
    """

    update_rate = 100.0

    def load(self, robot: Robot, parameters: Parameters) -> None:
        """Read the tags, take hold of the model."""
        self._robot, self._simulation = robot, robot.simulation
        self._first = np.asarray(parameters.numbers("target", (0.0, -5.0, 1.2138)))
        self._attraction = parameters.get("target_weight", 1.15)
        self._repulsion = parameters.get("obstacle_weight", 1.5)
        self._area = np.asarray(parameters.numbers("area", (-3.0, 3.5, -10.0, 2.0))).reshape(2, 2)
        if (self._area[:, 0] >= self._area[:, 1]).any():
            raise SimulationError("an <area> ends where it begins", source=parameters.source)
        ignored = parameters.find("ignore_obstacles")
        tags = () if ignored is None else ignored.find_all("model")
        self._ignored = {robot.name, *(tag.text for tag in tags)}
        nworld = robot.simulation.nworld
        self._position, self._target = np.zeros((2, nworld, 3))
        self._yaw, self._last_ns = np.zeros(nworld), np.zeros(nworld, np.int64)
        self._stream = Stream(robot.simulation.seed, f"{robot.name}::walk", nworld)
        robot.simulation.engine.make_kinematic(robot.name)
        self._begin(None)

    def _begin(self, worlds: Worlds | None) -> None:
        rows = slice(None) if worlds is None else worlds
        start = self._robot.description.pose
        self._position[rows], self._yaw[rows] = start.position, start.rpy[2]
        self._target[rows], self._last_ns[rows] = self._first, self._simulation.clock.now_ns
        self._place()

    def on_update(self, time: float) -> None:  # noqa: ARG002  the clock of the simulation counts
        """Turn and move the actor."""
        now_ns = self._simulation.clock.now_ns
        interval = (now_ns - self._last_ns) / NANOSECONDS
        self._last_ns[:] = now_ns
        way = self._target - self._position
        there = np.flatnonzero(np.linalg.norm(way, axis=1) < _REACHED)
        if there.size:
            self._choose(there)
            way = self._target - self._position
        way = _directions(way) * self._attraction
        for place in self._obstacles(self._ignored):
            apart = place - self._position
            distance = np.linalg.norm(apart, axis=1, keepdims=True)
            push = self._repulsion / np.maximum(distance, 1e-9)
            way -= np.where(distance < _NEAR, _directions(apart) * push, 0.0)
        self._advance(way, interval)

    def _advance(self, way: Floats, interval: Floats) -> None:
        """Turn towards a direction, and move along it once it is ahead."""
        angle = np.arctan2(way[:, 1], way[:, 0]) + math.pi / 2.0 - self._yaw
        angle = (angle + math.pi) % (2.0 * math.pi) - math.pi
        turning = np.abs(angle) > _TURNS_FROM
        share = np.where(turning, np.minimum(_TURNING_RATE * interval, 1.0), 1.0)
        self._yaw += share * angle
        gone = np.where(turning, 0.0, _SPEED * interval)
        self._position += way * gone[:, None]
        self._position[:, :2] = np.clip(self._position[:, :2], *self._area.T)
        self._position[:, 2] = self._first[2]
        self._place()

    def _choose(self, worlds: Worlds) -> None:
        """Sample targets that are far from the last one and from all models."""
        models = [place[worlds] for place in self._obstacles({self._robot.name})]
        last = self._target[worlds]
        pending = np.arange(len(worlds))
        for _ in range(_TRIES):
            drawn = self._stream.uniform(2, worlds[pending])
            place = last[pending].copy()
            place[:, :2] = self._area[:, 0] + drawn * (self._area[:, 1] - self._area[:, 0])
            self._target[worlds[pending]] = place
            others = [last[pending], *(model[pending] for model in models)]
            near = [np.linalg.norm(other - place, axis=1) < _AWAY for other in others]
            pending = pending[np.any(near, axis=0)]
            if not pending.size:
                return

    def _obstacles(self, ignored: set[str]) -> Iterator[Floats]:
        """Yield the positions of other models, shape (nworld, 3) each."""
        for name, robot in self._simulation.robots.items():
            if name not in ignored and robot.links:
                yield robot.placement().position

    def _place(self) -> None:
        quaternion = multiply(from_yaw(self._yaw), _ROLLED[None])
        engine = self._simulation.engine
        engine.models[self._robot.name].set_placement(self._position, quaternion)

    def reseed(self, seed: int, worlds: Worlds | None) -> None:
        """Set the seed of the targets."""
        self._stream.reseed(seed, worlds)

    def reset(self, worlds: Worlds | None) -> None:
        """Start where the file says."""
        if worlds is None:
            self._stream.rewind()
        self._begin(worlds)

    def state(self) -> Mapping[str, NDArray[np.generic]]:
        """Return its position and target, and the random numbers."""
        return {
            "position": self._position.copy(),
            "yaw": self._yaw.copy(),
            "target": self._target.copy(),
            "time": self._last_ns.copy(),
            "keys": self._stream.keys.copy(),
            "counters": self._stream.counters.copy(),
        }

    def restore(self, state: Mapping[str, NDArray[np.generic]]) -> None:
        """Restore what ``state`` returned."""
        self._position[:], self._yaw[:] = state["position"], state["yaw"]
        self._target[:], self._last_ns[:] = state["target"], state["time"]
        self._stream.keys[:], self._stream.counters[:] = state["keys"], state["counters"]


def _directions(vectors: Floats) -> Floats:
    """Return vectors of length one; zero stays zero."""
    size = np.linalg.norm(vectors, axis=1, keepdims=True)
    one: Floats = vectors / np.where(size > 0.0, size, 1.0)
    return one
