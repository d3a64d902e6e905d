"""Models that fall out of the world."""

from __future__ import annotations

import math
import warnings

import numpy as np

from gazelle.array_types import Floats
from gazelle.description import Model, World
from gazelle.engines import Engine, RangeRays
from gazelle.engines.state import LinkRows
from gazelle.engines.world_rays import cast_in_world
from gazelle.errors import SimulationWarning, describe

_PERIOD_NS = 1_000_000_000
"""Simulated time between two looks; falling by `_DEPTH` takes longer [ns]."""

_DEPTH = 10.0
"""Least distance below its start of a model that may have fallen out of the world [m]."""

_RINGS = (2.0, 5.0)
"""Radii around the model at which ground below it counts [m]; the model itself is narrower."""
_TURNS = np.arange(8) * math.pi / 4.0
_DOWN = np.array([0.0, 0.0, -1.0])


class FallWatch:
    """Warns once of each model that has nothing below it and is far below its start.

    Args:
        engine: Knows where models are, and what is below them.
    """

    def __init__(self, engine: Engine) -> None:
        self._engine = engine
        self._period = 0
        self._warned: set[str] = set()
        self._seen: tuple[World, int] | None = None
        self._watched: list[Model] = []
        self._links: LinkRows | None = None
        self._lowest: Floats = np.zeros(0)

    def check(self, now_ns: int) -> None:
        """Check for falling models, once in a simulated second."""
        period = now_ns // _PERIOD_NS
        if period == self._period:
            return
        self._period = period
        seen = self._engine.world, self._engine.revision
        if self._seen is None or seen[1] != self._seen[1] or seen[0] is not self._seen[0]:
            self._seen = seen
            self._watch(seen[0])
        if self._links is None:
            return
        heights = self._links.placement().position[:, :, 2]
        if not (heights < self._lowest).any():
            return
        worlds = heights.argmin(axis=0)
        for column in np.flatnonzero(heights.min(axis=0) < self._lowest).tolist():
            world, model = int(worlds[column]), self._watched[column]
            if model.name not in self._warned:
                self._judge(model, world, float(heights[world, column]), now_ns / 1e9)

    def _watch(self, world: World) -> None:
        """Start watching the models of a world that can fall."""
        calls = self._engine.history()
        held = {call.arguments[0] for call in calls if call.method == "make_kinematic"}
        self._watched = [
            model
            for model in world.models
            if not model.static and model.links and model.name not in self._warned | held
        ]
        if self._watched:
            down = RangeRays(_first_link(self._watched[0]), np.zeros((1, 3)), _DOWN[None])
            if self._engine.range_kind(down) is None:  # nothing falls in the plane
                self._watched = []
        links = tuple(_first_link(model) for model in self._watched)
        self._links = self._engine.links[links] if links else None
        starts = [(model.pose * model.links[0].pose).z for model in self._watched]
        self._lowest = np.array(starts) - _DEPTH

    def _judge(self, model: Model, world: int, height: float, seconds: float) -> None:
        if self._has_ground(model, world):
            return
        self._warned.add(model.name)
        where = f" of world {world}" if self._engine.nworld > 1 else ""
        text = describe(
            f"'{model.name}'{where} has fallen out of the world: at {seconds:g} s it is at "
            f"z = {height:.1f} m, and there is nothing below it",
            hint=self._cause(model),
        )
        warnings.warn(SimulationWarning(text), stacklevel=6)

    def _has_ground(self, model: Model, world: int) -> bool:
        """Return whether there is something below a model or beside that."""
        name, worlds = _first_link(model), np.array([world])
        place = self._engine.links[name].placement(worlds).position[0]
        ring = np.stack([np.cos(_TURNS), np.sin(_TURNS), np.zeros(len(_TURNS))], axis=1)
        origins = place + np.vstack([radius * ring for radius in _RINGS])
        down = np.broadcast_to(_DOWN, origins.shape)
        hits = cast_in_world(self._engine, name, origins, down, worlds)
        return bool(np.isfinite(hits.distance).any())

    def _cause(self, model: Model) -> str:
        if not model.has_collisions:
            return "no link of it has a <collision>, so nothing can hold it"
        others = [each for each in self._engine.world.models if each.name != model.name]
        if any(each.static and each.has_collisions for each in others):
            return "it started beside the ground or in it, or was pushed through it"
        return "this world has no ground: add model://ground_plane, or leave out --no-ground"


def _first_link(model: Model) -> str:
    return f"{model.name}::{model.links[0].name}"
