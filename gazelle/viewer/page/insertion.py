"""Insert models, shapes and lights at a place, and save the world."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

from gazelle import assets, builders, formats
from gazelle.description import Light, Model, Pose
from gazelle.simulation.free_place import spawn_where_free
from gazelle.simulation.lights import add_light
from gazelle.simulation.present_world import present_world
from gazelle.viewer.page.context import PageContext, ScenePart
from gazelle.viewer.page.ghost_placing import GhostPlacing
from gazelle.viewer.page.server import PageServer

_OWN = "file ..."
_MASS = 1.0  # of a shape [kg]
SHAPES: dict[str, Callable[[], Model]] = {
    "box": lambda: builders.box(mass=_MASS),
    "sphere": lambda: builders.sphere(mass=_MASS),
    "cylinder": lambda: builders.cylinder(mass=_MASS),
}
LIGHTS: dict[str, Callable[[], Light]] = {
    "point light": builders.lamp,
    "directional light": builders.sun,
}


class InsertTools:
    """Inserts things: at coordinates, or under the cursor of a page.

    Args:
        context: Of the page.
        server: Gets the cursor.
    """

    def __init__(self, context: PageContext, server: PageServer) -> None:
        self._context = context
        self._ghost = GhostPlacing(context, server)
        gui, guarded = context.gui, context.guarded
        bundled = (*sorted(assets.robots()), *sorted(assets.models()))
        with gui.add_folder("Spawn", expand_by_default=False):
            self._what = gui.add_dropdown("What", (*bundled, *SHAPES, *LIGHTS, _OWN))
            self._file = gui.add_text("File", "", hint="a file or folder of this machine")
            self._where = gui.add_vector3("x, y, yaw", (0.0, 0.0, 0.0), step=0.1)
            spawn = gui.add_button("Spawn")
            place = gui.add_button("Place by mouse", hint="a click in the scene puts it there")
            self._path = gui.add_text("World file", _default_path(context))
            save = gui.add_button("Save world")
        spawn.on_click(lambda _event: guarded(self.spawn))
        place.on_click(lambda event: guarded(lambda: self._begin(event.client)))
        save.on_click(lambda _event: guarded(self.save))

    def read(self) -> None:
        """Do nothing: there is nothing to follow."""

    def show(self, _state: None) -> None:
        """Do nothing: there is nothing to show."""

    def renew(self) -> None:
        """Do nothing; the insertable models do not change."""

    def spawn(self) -> None:
        """Insert the chosen model at the requested place, or at the nearest free one."""
        x, y, yaw = self._where.value
        self._insert(self._chosen(), Pose(x, y, yaw=yaw))

    def save(self) -> None:
        """Write the world as it is now."""
        path = Path(self._path.value.strip())
        context = self._context
        formats.save(present_world(context.simulation, int(context.chosen[0])), path)
        context.notify("The world is saved", str(path.absolute()))

    def _begin(self, client: Any) -> None:
        """Show a ghost under the cursor of a page until a click or Escape."""
        thing = self._chosen()
        self._ghost.begin(
            client, thing, float(self._where.value[2]), lambda pose: self._insert(thing, pose)
        )

    def _chosen(self) -> Model | Light:
        what = self._what.value
        maker = SHAPES.get(what) or LIGHTS.get(what)
        if maker is not None:
            return maker()
        return formats.load_model(self._file.value.strip() if what == _OWN else what)

    def _insert(self, thing: Model | Light, pose: Pose) -> None:
        context, simulation = self._context, self._context.simulation
        if isinstance(thing, Light):
            light = add_light(simulation, replace(thing, pose=pose * thing.pose))
            context.select("", context.world, ScenePart("light", light.name))
            return
        put = spawn_where_free(simulation, thing, pose)
        name = put.robot.name
        if put.stuck:
            context.notify("There is no free place", f"{name} is stuck in something.")
        elif put.moved_to is not None:
            there = "{:g}, {:g}".format(*put.moved_to)
            context.notify("Something stands there", f"{name} was put at {there}.")
        context.select(name, context.world)


def _default_path(context: PageContext) -> str:
    name = context.simulation.world.name or "world"
    return f"{name}-{time.strftime('%Y%m%d-%H%M')}.world"
