"""A world, put together step by step."""

from __future__ import annotations

import itertools
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, Self

from gazelle.argument_checks import checked
from gazelle.builders import floors
from gazelle.builders.errors import BuildError
from gazelle.builders.land import Terrain
from gazelle.builders.laws import on_planet, physics
from gazelle.builders.obstacles import random_obstacles, random_plants
from gazelle.builders.placing import Zone, along, footprints
from gazelle.builders.plan import plan_places, plan_walls
from gazelle.builders.structures import road
from gazelle.builders.walling import Point, room, walls
from gazelle.description import (
    Light,
    Model,
    Physics,
    Plugin,
    Pose,
    Scene,
    SphericalCoordinates,
    Vector3,
    World,
)
from gazelle.errors import did_you_mean
from gazelle.formats import load_model


@checked(BuildError)
class WorldBuilder:
    """Makes a world by calls that can be chained.

    For example::

        world = (
            WorldBuilder("lab", seed=7)
            .ground().sun()
            .room(8.0, 6.0, openings=[door(0, 2.0)])
            .place(desk, 2.0, 1.0)
            .obstacles(6)
            .build()
        )

    Things get names of their own: a second ``desk`` is called ``desk_1``. Random things
    depend on the seed and on how many random calls went before, keep away from all that
    was added before them and from the zones given to ``keep_clear``.

    Args:
        name: Of the world.
        seed: Of everything random.
    """

    def __init__(self, name: str = "default", *, seed: int = 0) -> None:
        self._world = World(name, scene=Scene(grid=False))
        self._seed = seed
        self._draws = 0
        self._models: dict[str, Model] = {}
        self._lights: dict[str, Light] = {}
        self._taken: list[Zone] = []
        self._level: Callable[[float, float], float] | None = None

    def add(self, *models: Model, solid: bool = True) -> Self:
        """Add models where they stand; a taken name gets a number.

        Args:
            *models: The models.
            solid: Whether random things added later keep away from them.
        """
        for model in models:
            name = _free_name(model.name, self._models)
            self._models[name] = replace(model, name=name)
            if solid:
                self._taken += footprints(model)
        return self

    def place(
        self, make: Callable[..., Model], x: float, y: float, yaw: float = 0.0, **options: Any
    ) -> Self:
        """Place something at (x, y) [m], turned by ``yaw`` [rad], on the ground.

        Args:
            make: A builder such as ``desk`` or ``tree``.
            x: [m].
            y: [m].
            yaw: [rad].
            **options: Passed to ``make``.
        """
        return self.add(make(pose=Pose(x, y, self.level(x, y), yaw=yaw), **options))

    def include(
        self,
        path: str | os.PathLike[str] | Model,
        x: float = 0.0,
        y: float = 0.0,
        yaw: float = 0.0,
        *,
        name: str = "",
    ) -> Self:
        """Add a model of a file, or one that comes with Gazelle, at (x, y) [m] on the ground.

        Its own pose is kept, in the frame put there.

        Raises:
            FormatError: The file cannot be read.
        """
        model = path if isinstance(path, Model) else load_model(path)
        pose = Pose(x, y, self.level(x, y), yaw=yaw) * model.pose
        return self.add(replace(model, name=name or model.name, pose=pose))

    def level(self, x: float, y: float) -> float:
        """Return the height of the ground at a point [m]: that of the terrain, or 0."""
        return 0.0 if self._level is None else max(self._level(x, y), 0.0)

    @property
    def taken(self) -> tuple[Zone, ...]:
        """Zones that random things added now would keep away from."""
        return tuple(self._taken)

    def ground(self, **options: Any) -> Self:
        """Add the ground plane; options are those of ``builders.ground``."""
        return self.add(floors.ground(**options), solid=False)

    def floor(self, **options: Any) -> Self:
        """Add a floor covering; options are those of ``builders.floor``."""
        return self.add(floors.floor(**options), solid=False)

    def terrain(self, terrain: Terrain, **options: Any) -> Self:
        """Add hilly ground; what is placed later stands on it.

        Options are those of its ``model``. Options are those of its ``model``.

        Where it is below 0 the ground plane, if there is one, counts.
        """
        self._level = terrain.height
        return self.add(terrain.model(**options), solid=False)

    def light(self, *lights: Light) -> Self:
        """Add lights; a taken name gets a number."""
        for light in lights:
            name = _free_name(light.name, self._lights)
            self._lights[name] = replace(light, name=name)
        return self

    def sun(self, **options: Any) -> Self:
        """Add a sun; options are those of ``builders.sun``."""
        return self.light(floors.sun(**options))

    def lamp(self, x: float, y: float, **options: Any) -> Self:
        """Add a lamp above (x, y) [m]; options are those of ``builders.lamp``."""
        return self.light(floors.lamp(x=x, y=y, **options))

    def scene(self, **changes: Any) -> Self:
        """Set the look: ``ambient``, ``background``, ``shadows``, ``sky``, ``grid``."""
        return self._set(scene=_changed(self._world.scene, changes))

    def walls(self, points: Sequence[Point], **options: Any) -> Self:
        """Add walls along a line of points; options are those of ``builders.walls``."""
        return self.add(walls(points, **options))

    def room(self, length: float, width: float, **options: Any) -> Self:
        """Add four walls; options are those of ``builders.room``."""
        return self.add(room(length, width, **options))

    def plan(
        self,
        drawing: str,
        legend: Mapping[str, Callable[..., Model]] | None = None,
        *,
        cell: float = 0.5,
        **options: Any,
    ) -> Self:
        """Add walls of a floor plan, and the things at the letters of the legend.

        Args:
            drawing: See ``builders.plan_walls``; its options work here too.
            legend: Function for each letter, such as ``{"d": desk}``.
            cell: Side of a cell [m].
            **options: For the walls.
        """
        self.add(plan_walls(drawing, cell=cell, **options))
        for letter, make in (legend or {}).items():
            for x, y in plan_places(drawing, letter, cell=cell):
                self.place(make, x, y)
        return self

    def road(self, points: Sequence[Point], **options: Any) -> Self:
        """Add a road; options are those of ``builders.road``.

        Random things keep off it. Random things keep off it.
        """
        made = road(points, **options)
        self._taken += along(points, options.get("width", 6.0), made.pose)
        return self.add(made)

    def keep_clear(self, *zones: Zone) -> Self:
        """Add zones that random things added later keep away from."""
        self._taken += zones
        return self

    def obstacles(self, count: int, **options: Any) -> Self:
        """Add random obstacles; options are those of ``builders.random_obstacles``."""
        return self.add(*random_obstacles(count, **self._random(options)))

    def plants(self, count: int, **options: Any) -> Self:
        """Add random trees, bushes and rocks; options are those of ``builders.random_plants``."""
        return self.add(*random_plants(count, **{"ground": self.level, **self._random(options)}))

    def physics(self, preset: str | Physics = "default", **changes: float) -> Self:
        """Set the physics profile, by name of ``builders.PRESETS`` or as it is."""
        chosen = physics(preset, **changes) if isinstance(preset, str) else preset
        return self._set(physics=(chosen,))

    def planet(self, name: str) -> Self:
        """Set gravity, field and air of a place in ``builders.PLANETS``."""
        self._world = on_planet(self._world, name)
        return self

    def earth(self, latitude: float, longitude: float, elevation: float = 0.0) -> Self:
        """Set the position of the origin on Earth [degrees, m], for GPS; x points east."""
        coordinates = SphericalCoordinates(
            latitude=latitude, longitude=longitude, elevation=elevation
        )
        return self._set(spherical_coordinates=coordinates)

    def camera(self, eye: Vector3, target: Vector3) -> Self:
        """Set the viewer's initial position, and the point in the centre of its view [m]."""
        dx, dy, dz = (t - e for e, t in zip(eye, target, strict=True))
        pitch = -math.atan2(dz, math.hypot(dx, dy))
        return self._set(camera=Pose(*eye, pitch=pitch, yaw=math.atan2(dy, dx)))

    def plugin(self, *plugins: Plugin) -> Self:
        """Add plugins of the world."""
        return self._set(plugins=(*self._world.plugins, *plugins))

    def build(self) -> World:
        """Return the world as it is now; the builder can continue."""
        return replace(
            self._world,
            models=tuple(self._models.values()),
            lights=tuple(self._lights.values()),
        )

    def _set(self, **changes: Any) -> Self:
        self._world = replace(self._world, **changes)
        return self

    def _random(self, options: dict[str, Any]) -> dict[str, Any]:
        """Return options of a random call, with its seed and the zones taken so far."""
        self._draws += 1
        zones = (*self._taken, *options.pop("keep_clear", ()))
        seed = options.pop("seed", self._seed * 1_000_003 + self._draws)
        return {**options, "seed": seed, "keep_clear": zones}


def _free_name(name: str, taken: Mapping[str, object]) -> str:
    """Return the name, or the first free one with a number behind."""
    if name not in taken:
        return name
    return next(each for i in itertools.count(1) if (each := f"{name}_{i}") not in taken)


def _changed(scene: Scene, changes: dict[str, Any]) -> Scene:
    known = [each.name for each in fields(scene)]
    for name in changes:
        if name not in known:
            raise BuildError(f"a scene has no '{name}'", hint=did_you_mean(name, known))
    return replace(scene, **changes)
