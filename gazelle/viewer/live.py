"""A running simulation, live in a browser on this machine."""

from __future__ import annotations

import threading
import time
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from gazelle.argument_checks import checked
from gazelle.errors import Error, SimulationError, SimulationWarning
from gazelle.simulation import Replay, Robot, Simulation
from gazelle.simulation.inputs import one_world
from gazelle.viewer.page.camera_insets import CameraInsets
from gazelle.viewer.page.context import ROOT, OptionalLayer, PageContext, PageLayer, spots_of
from gazelle.viewer.page.driving import DriveControls
from gazelle.viewer.page.entity_tree import EntityTree
from gazelle.viewer.page.frustum_layer import FrustumLayer
from gazelle.viewer.page.goal_layer import GoalLayer, GoalPlaces
from gazelle.viewer.page.grid_layer import GridLayer
from gazelle.viewer.page.insertion import InsertTools
from gazelle.viewer.page.joint_axis_layer import JointAxisLayer
from gazelle.viewer.page.joint_sliders import JointSliders
from gazelle.viewer.page.light_layer import LightLayer
from gazelle.viewer.page.mass_layers import MassLayer
from gazelle.viewer.page.model_tools import ModelTools
from gazelle.viewer.page.motion_layer import MotionLayer
from gazelle.viewer.page.overlays import ContactLayer, FrameLayer, NameLayer, RayLayer
from gazelle.viewer.page.plan_layer import PlanLayer
from gazelle.viewer.page.plots import PlotLayer
from gazelle.viewer.page.property_panel import PropertyPanel
from gazelle.viewer.page.run_controls import RunControls
from gazelle.viewer.page.selection_box import SelectionBox
from gazelle.viewer.page.server import PageServer
from gazelle.viewer.page.speed_plots import SpeedPlots
from gazelle.viewer.page.theme import ThemeSwitch
from gazelle.viewer.page.time_log import TimeLog
from gazelle.viewer.page.viewpoints import AROUND, Viewpoints, overview
from gazelle.viewer.page.world_layer import LOOKS, ShapeLayer
from gazelle_ros.base.closing import Closeable

_BESIDE = 4  # worlds of a batch that are shown by default
_LEFT = 300  # width of the left panel [pixel]
_SHARE = 0.25  # of a core that pictures take at most: dearer ones come less often


@checked(Error)
class LiveView(Closeable):
    """Shows a simulation in a browser while it runs, with controls; a context manager.

    The page is served on this machine's loopback address, and only to those who know the secret
    in its address. While no page is open it costs nothing. What goes wrong on it stops nothing.

    Args:
        simulation: With any engine.
        world: The first world of a batch that is shown.
        worlds: Number of worlds shown beside each other; a few if None.
        port: Of the server; any free one if 0.
        rate: Pictures per second at most.
        read_only: Whether nothing can be changed on the page.
        goals: Function that returns the goals of a task that runs in these worlds [m], shape
            (worlds * n, 2 or 3), world by world, or None; called between two steps.
        panels: Makers of further parts of the page.

    Attributes:
        url: Address of the page.

    Raises:
        MissingExtraError: viser is not installed.
        Error: There is no such world, the rate is not above zero, or the port is taken.
    """

    def __init__(
        self,
        simulation: Simulation,
        *,
        world: int = 0,
        worlds: int | None = None,
        port: int = 0,
        rate: float = 20.0,
        read_only: bool = False,
        goals: GoalPlaces | None = None,
        panels: Sequence[Callable[[PageContext], PageLayer]] = (),
    ) -> None:
        left = simulation.nworld - one_world(world, simulation.nworld)
        count = min(_BESIDE, left) if worlds is None else worlds
        if not 0 < count <= left:
            raise Error(f"a view cannot show {count} worlds from {world} on: there are {left}")
        if not rate > 0.0:
            raise Error(f"a view needs a rate above zero, not {rate:g}")
        self._simulation, self._period = simulation, 1.0 / rate
        self._goals, self._panels, self._stop = goals, panels, threading.Event()
        self._server = PageServer(simulation.world.name or "Gazelle", port)
        self.url = self._server.url
        try:
            self._begin(np.arange(world, world + count), read_only=read_only)
        except BaseException:
            self._server.close()
            raise
        self._thread = threading.Thread(target=self._follow, name="live-view", daemon=True)
        self._thread.start()

    @property
    def watched(self) -> bool:
        """True while the page is open somewhere."""
        return self._server.watched

    def show_world(self, world: int) -> None:
        """Show another world of the batch in the place of the first that is shown.

        Raises:
            Error: There is no such world.
        """
        which = one_world(world, self._simulation.nworld)
        with self._simulation.lock:
            self._context.worlds[0] = which

    def show_recording(self, replay: Replay) -> None:
        """Run a recording to its end, for the slider of the log to go through.

        Args:
            replay: Of the simulation that is shown, with nothing done yet.

        Raises:
            SimulationError: The recording is damaged, or the run does not do the same again.
            Error: The page is only to look at.
        """
        if self._log is None:
            raise Error("a read-only page has no log")
        self._log.fill(replay)

    def close(self) -> None:
        """Stop showing it, and give the port back; a second call does nothing."""
        if self._stop.is_set():
            return
        self._stop.set()
        self._server.wake()
        if threading.current_thread() is not self._thread:
            self._thread.join()
        self._server.close()
        for end in self._ends:
            end()

    def _begin(self, worlds: Any, *, read_only: bool) -> None:
        """Create everything on the page."""
        simulation, page = self._simulation, self._server.viser
        spots = spots_of(simulation, len(worlds))
        self._context = context = PageContext(simulation, page, worlds, spots, read_only=read_only)
        self._root = page.scene.add_frame(ROOT, show_axes=False)
        page.gui.main_panel.dock_right()
        self._server.light_up()
        self._look_around()
        with simulation.lock:
            controls, views = RunControls(context), Viewpoints(context)
            panels = [make(context) for make in self._panels]
            tools = ModelTools(context)
            shapes = ShapeLayer(context, "shapes", on_batch=tools.watch)
            steering: list[PageLayer] = []
            if not read_only:
                steering = [
                    DriveControls(context, self._server),
                    JointSliders(context),
                    InsertTools(context, self._server),
                ]
            left = page.gui.add_panel()
            with left.add_tab("World"):
                tree, properties = EntityTree(context, self._server), PropertyPanel(context)
            with left.add_tab("Speed"):
                speed = SpeedPlots(context)
            self._log: TimeLog | None = None
            if not read_only:
                with left.add_tab("Log"):
                    self._log = TimeLog(context)
                steering.append(self._log)
            left.dock_left()
            left.set_width(_LEFT)
            motions = MotionLayer(context)
            frames, axes = FrameLayer(context), JointAxisLayer(context)
            masses, inertias = MassLayer(context), MassLayer(context, boxes=True)
            shapes.veils = (frames, axes, masses, inertias)
            self._optional: dict[str, OptionalLayer] = {
                "Grid": GridLayer(context),
                "Names": NameLayer(context),
                "Collisions": ShapeLayer(context, "solid", collisions=True, shown=False),
                "Frames": frames,
                "Joint axes": axes,
                "Masses": masses,
                "Inertias": inertias,
                "Contacts": ContactLayer(context),
                "Forces": ContactLayer(context, forces=True),
                "Lights": LightLayer(context),
                "Lidar rays": RayLayer(context),
                "Frusta": FrustumLayer(context),
                "Cameras": CameraInsets(context),
                "Plans": PlanLayer(context),
                "Motions": motions,
            }
            if self._goals is not None:
                self._optional["Task goals"] = GoalLayer(context, self._goals)
            self._shapes = shapes
            self._plots = PlotLayer(context)
            self._offer()
            self._layers: tuple[PageLayer, ...] = (
                controls, *panels, shapes, tools, *steering, *self._optional.values(), self._plots,
                tree, properties, SelectionBox(context), views, speed,
            )  # fmt: skip
            self._changed = False
            events = simulation.events
            self._ends = (
                events.spawned.subscribe(self._note),
                events.deleted.subscribe(self._note),
                self._plots.forget,
                motions.forget,
            )

    def _offer(self) -> None:
        """Add a checkbox for each optional layer."""
        gui, scene = self._context.gui, self._context.scene
        with gui.add_folder("Show"):
            surfaces: Any = gui.add_dropdown("Surfaces", LOOKS)
            for label, layer in self._optional.items():
                box = gui.add_checkbox(label, initial_value=layer.shown)
                box.on_update(_switch(layer))
            shadows = gui.add_checkbox("Shadows", initial_value=True)
            ThemeSwitch(self._server)

        def dress() -> None:
            self._shapes.look = surfaces.value

        def shade(event: Any) -> None:
            scene.configure_default_lights(cast_shadow=event.target.value)

        self._context.on_user_change(surfaces, dress)
        shadows.on_update(shade)

    def _look_around(self) -> None:
        """Set the initial view: all of it, from above and aside."""
        middle, eye = overview(self._context, AROUND)
        camera = self._server.viser.initial_camera
        camera.look_at, camera.position = tuple(middle.tolist()), tuple(eye.tolist())

    def _note(self, _robot: Robot) -> None:
        """Record a change of models; between two steps."""
        self._changed = True

    def _follow(self) -> None:
        """Show picture after picture while the page is open."""
        try:
            while not self._stop.is_set():
                if not self._server.watched:
                    self._server.wait()
                    continue
                spent = time.thread_time()
                self._picture()
                spent = time.thread_time() - spent
                self._stop.wait(max(self._period, spent / _SHARE))
        except SimulationError:
            if not self._simulation.lock.closed:
                raise
        except Exception as error:  # noqa: BLE001  a view never ends what it shows
            if not self._stop.is_set():
                text = f"the live view ended: {type(error).__name__}: {error}"
                warnings.warn(SimulationWarning(text), stacklevel=1)

    def _picture(self) -> None:
        """Read everything at one moment, then show it on the page."""
        with self._simulation.lock:
            states = self._look()
        with self._server.viser.atomic():
            for layer, state in zip(self._layers, states, strict=True):
                layer.show(state)
            self._root.position = -self._context.heading * [1.0, 1.0, 0.0]

    def _look(self) -> list[Any]:
        if self._changed:
            self._changed = False
            for layer in self._layers:
                layer.renew()
        self._context.announce_selection()
        return [layer.read() for layer in self._layers]


def _switch(layer: OptionalLayer) -> Callable[[Any], None]:
    """Return a callback that shows or hides a layer when a box is ticked."""

    def turn(event: Any) -> None:
        layer.shown = event.target.value

    return turn
