"""Tools for a model on the page: select, follow, drag, push, delete."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.simulation.lights import delete_light
from gazelle.viewer.page.context import ROOT, PageContext, ScenePart
from gazelle.viewer.page.landing import on_level
from gazelle.viewer.page.shapes import Instance

NONE = "none"
_PUSH = 0.2  # how long a push lasts [s]
_LIFT = 0.5  # [m]


class ModelTools:
    """Works on one model.

    Args:
        context: Of the page.
    """

    def __init__(self, context: PageContext) -> None:
        self._context = context
        self._held = False  # it is dragged
        gui = context.gui
        with gui.add_folder("Model"):
            self._name: Any = gui.add_dropdown("Selected", (NONE,))
            self._follow = gui.add_checkbox("Follow", initial_value=False)
        self._gizmo_on: Any = None
        self._gizmo: Any = None
        if not context.read_only:
            self._offer()
        context.on_user_change(self._name, self._choose)
        context.listeners.append(self._selected)
        self.renew()

    def _offer(self) -> None:
        """Add the controls that change the simulation."""
        context = self._context
        gui, guarded = context.gui, context.guarded
        with gui.add_folder("Change"):
            self._gizmo_on = gui.add_checkbox("Gizmo", initial_value=True)
            self._force = gui.add_vector3("Force [N]", (1.0, 0.0, 0.0), step=0.1)
            self._work = gui.add_button_group("Do", ("push", "lift", "delete"))
            gui.add_markdown("Click selects; drag with Shift moves, with Ctrl pulls by a spring.")
        self._gizmo = context.scene.add_transform_controls(
            f"{ROOT}/gizmo", scale=0.5, depth_test=False, visible=False
        )
        self._gizmo.on_update(self._moved)
        self._work.on_click(lambda event: guarded(lambda: self.do(event.target.value)))

    def read(self) -> tuple[Floats, Floats] | None:
        """Return the selected model's position (3,) and quaternion (4,)."""
        model = self._context.selected
        if model not in self._context.simulation.robots:
            if model:
                self._context.select("")
            return None
        place = self._context.simulation.engine.models[model].placement(self._context.chosen)
        return place.position[0], place.quaternion[0]

    def show(self, state: tuple[Floats, Floats] | None) -> None:
        """Show the gizmo at the model's pose, and follow it."""
        context = self._context
        followed = np.zeros(3)
        if state is not None:
            spot = context.spot
            if self._follow.value:
                followed = state[0] + spot
            if self._gizmo is not None and not self._held and self._gizmo_on.value:
                self._gizmo.position, self._gizmo.wxyz = state[0] + spot, state[1][[3, 0, 1, 2]]
        if self._gizmo is not None:
            self._gizmo.visible = state is not None and self._gizmo_on.value
        context.heading = followed

    def renew(self) -> None:
        """List the models again."""
        self._name.options = (NONE, *self._context.simulation.robots)
        self._selected()

    def watch(self, handle: Any, met: Callable[[int], Instance]) -> None:
        """Make the shapes of a batch clickable and draggable."""
        context = self._context

        def click(event: Any) -> None:
            if time.monotonic() < context.placing_until:
                return
            found = met(event.instance_index or 0)
            model = found.link.split("::")[0]
            again = (model, found.world) == (context.selected, context.world)
            part = ScenePart("link", found.link) if again else None
            context.guarded(lambda: context.select(model, found.world, part))

        handle.on_click(click)
        if context.read_only:
            return
        handle.on_drag("left", modifier="shift")(_Drag(context, met).moved)
        handle.on_drag("left", modifier="cmd/ctrl")(_Drag(context, met, pull=True).moved)

    def _selected(self) -> None:
        selected = self._context.selected or NONE
        if selected in self._name.options:
            self._name.value = selected

    def _choose(self) -> None:
        name = self._name.value
        self._context.select("" if name == NONE else name, self._context.world)

    async def _moved(self, event: Any) -> None:
        """Handle an event of the gizmo."""
        self._held = event.phase != "end"
        if event.phase != "update":
            return
        context, model = self._context, self._context.selected
        at = np.asarray(self._gizmo.position) - context.spot
        turned = np.asarray(self._gizmo.wxyz)[[1, 2, 3, 0]]
        chosen = context.chosen
        _place(context, model, at, turned, chosen)

    def do(self, work: str) -> None:
        """Apply ``push``, ``lift`` or ``delete`` to the selected model."""
        context = self._context
        if work == "delete" and context.part.kind == "light":
            delete_light(context.simulation, context.part.name)
            context.select("")
            return
        if not context.selected:
            context.notify("No model is selected", "Click one, or choose it by name.")
            return
        robot = context.simulation.robots[context.selected]
        if work == "delete":
            context.simulation.delete(context.selected)
        elif work == "lift":
            pose = robot.placement(context.chosen)
            up = np.array([0.0, 0.0, _LIFT])
            robot.set_pose(pose.position + up, pose.quaternion, worlds=context.chosen)
        else:
            link = next(iter(robot.links.values()))
            link.apply_wrench(self._force.value, duration=_PUSH, worlds=context.chosen)


class _Drag:
    """A model in the hand of the mouse: moved along the ground, or pulled by a spring.

    Args:
        context: Of the page.
        met: The part of an instance.
        pull: Whether it is pulled instead of moved.
    """

    def __init__(
        self, context: PageContext, met: Callable[[int], Instance], *, pull: bool = False
    ) -> None:
        self._context, self._met, self._pull = context, met, pull
        self._begin = np.zeros(3)
        self._grabbed = np.zeros(3)
        self._turned = np.array([0.0, 0.0, 0.0, 1.0])

    async def moved(self, event: Any) -> None:
        """Handle a mouse event of a drag; in order, as viser promises for coroutines."""
        context = self._context
        found = self._met(event.instance_index or 0)
        model = found.link.split("::")[0]
        if event.phase == "start":
            context.select(model, found.world)
        world = context.worlds[found.world : found.world + 1]
        if self._pull:
            if event.phase != "end":
                force = np.subtract(event.end_position, event.start_position)
                _pull(context, model, found.link, force, world)
            return
        if event.phase == "start":
            self._grabbed = np.asarray(event.start_position, np.float64)
            context.simulation.lock.post(lambda: self._remember(model, world))
        if event.phase == "update":
            eye = np.asarray(event.client.camera.position, np.float64)
            step = on_level(eye, np.asarray(event.end_position), self._grabbed[2]) - self._grabbed
            if np.isfinite(step).all():
                _place(context, model, lambda: self._begin + step, lambda: self._turned, world)

    def _remember(self, model: str, world: Any) -> None:
        place = self._context.simulation.robots[model].placement(world)
        self._begin, self._turned = place.position[0], place.quaternion[0]


def _place(context: PageContext, model: str, at: Any, turned: Any, world: Any) -> None:
    """Set the pose of a model between two steps, without waiting for it."""

    def put() -> None:
        if model in context.simulation.robots:
            robot = context.simulation.robots[model]
            place = at() if callable(at) else at
            rotation = turned() if callable(turned) else turned
            context.guarded(lambda: robot.set_pose(place, rotation, worlds=world))

    context.simulation.lock.post(put)


def _pull(context: PageContext, model: str, link: str, offset: Floats, world: Any) -> None:
    """Pull a link towards the mouse, harder the heavier its model and the farther the mouse is."""

    def pull() -> None:
        if model in context.simulation.robots:
            robot = context.simulation.robots[model]
            bodies = (each.description.inertial for each in robot.links.values())
            mass = sum(body.mass for body in bodies if body is not None)
            handle = robot.links[link.removeprefix(f"{model}::")]
            force = 10.0 * mass * offset
            context.guarded(lambda: handle.apply_wrench(force, duration=0.1, worlds=world))

    context.simulation.lock.post(pull)
