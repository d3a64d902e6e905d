"""Content of a Stage world file, in Stage's vocabulary but SI units and radians.

Names and defaults are those of Stage 4.3 (player-stage-manual.readthedocs.io). A model's
frame is that of its ``pose``; its body stands in the frame of ``origin`` in that, centred in
x and y, its bottom at z = 0.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar, Literal, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.description.material import Color
from gazelle.description.pose import Pose
from gazelle.description.source import Source
from gazelle.errors import FormatError
from gazelle.stage.description.devices import (
    StageActuator,
    StageDevice,
    StagePosition,
    StageRanger,
)

D = TypeVar("D")
Kind = type[D]
StageColor = Color | Literal["random"]


class StagePose(NamedTuple):
    """A pose with four degrees of freedom: position [m] and heading [rad]."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    yaw: float = 0.0

    def then(self, child: StagePose) -> StagePose:
        """Return a pose given in this one's frame, in the frame that this one is given in."""
        cos, sin = math.cos(self.yaw), math.sin(self.yaw)
        return StagePose(
            self.x + cos * child.x - sin * child.y,
            self.y + sin * child.x + cos * child.y,
            self.z + child.z,
            self.yaw + child.yaw,
        )

    @property
    def pose(self) -> Pose:
        """The same as a pose of six degrees of freedom."""
        return Pose(self.x, self.y, self.z, yaw=self.yaw)


class StageSize(NamedTuple):
    """Full lengths along x, y, z [m]."""

    x: float = 0.4
    y: float = 0.4
    z: float = 1.0


_ORIGIN = StagePose()
_SIZE = StageSize()


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageBlock:
    """A prism of a model's body, scaled to the model's size.

    Attributes:
        points: Outline in the body frame [m]; closed from the last point to the first.
        z: Bottom and top [m].
        color: None for that of the model.
    """

    points: tuple[tuple[float, float], ...]
    z: tuple[float, float]
    color: Color | None = None


@checked(FormatError)
@dataclass(frozen=True, slots=True, eq=False)
class StageBitmap:
    """Prisms from the dark pixels of a picture.

    Attributes:
        uri: Text of the file.
        path: The picture.
        cells: True where a wall is, shape (rows, columns), the row of least y first; cut to
            the rectangle that holds all walls. Each cell is a square of pixels' edges.
        low: x, y of the rectangle's lower left corner in the body frame [m].
        high: x, y of its upper right corner [m].
        z: Bottom and top of the walls [m].
    """

    uri: str
    path: Path
    cells: NDArray[np.bool_] = field(repr=False)
    low: tuple[float, float]
    high: tuple[float, float]
    z: tuple[float, float]

    @property
    def cell_size(self) -> tuple[float, float]:
        """Length of a cell along x and y [m]."""
        rows, columns = self.cells.shape
        return (self.high[0] - self.low[0]) / columns, (self.high[1] - self.low[1]) / rows

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, type(self)):
            return NotImplemented
        return self._key() == other._key() and np.array_equal(self.cells, other.cells)

    def __hash__(self) -> int:
        return hash((self._key(), self.cells.shape, self.cells.tobytes()))

    def _key(self) -> tuple[object, ...]:
        return self.uri, self.low, self.high, self.z


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageReturns:
    """Properties of a model as other models and sensors perceive it.

    Attributes:
        obstacle: Whether other models collide with it.
        ranger: Intensity that rangers report; negative: they do not see it.
        fiducial: Number that fiducial finders read; 0: they do not see it.
        fiducial_key: Key of the fiducial finders that see it.
        blob: Whether blob finders see it.
        gripper: Whether grippers can take it.
    """

    obstacle: bool = True
    ranger: float = 1.0
    fiducial: int = 0
    fiducial_key: int = 0
    blob: bool = True
    gripper: bool = False


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageGui:
    """Display of a model in a window: nose, grid, outline, and whether a mouse moves it."""

    nose: bool = False
    grid: bool = False
    outline: bool = True
    move: bool = True
    trail_length: int = 20
    trail_interval: int = 10
    say: str = ""


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StagePower:
    """Energy of a model.

    Attributes:
        watts: Consumed while it is on [W].
        give_watts: Given at most to a model that takes [W].
        take_watts: Taken at most [W].
        joules: Stored at the start [J]; None without a battery.
        capacity: Stored at most [J]; None without a limit.
    """

    watts: float = 0.0
    give_watts: float = 0.0
    take_watts: float = 0.0
    joules: float | None = None
    capacity: float | None = None


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageController:
    """``ctrl``: a controller by the name of its library, and its arguments."""

    name: str
    arguments: str = ""


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageModel:
    """A model.

    Attributes:
        type: ``model``, ``position``, ``ranger``, ...
        name: Its own name, without its parent's; ``type:number`` where the file gives none.
            A leading ``/`` makes it a name that the parent's is not put before.
        pose: In the parent's frame, or the world.
        size: Of its body.
        origin: Of its body, in its own frame.
        blocks: Its body; empty without one.
        bitmap: More of its body, from a picture.
        boundary: Whether walls 1 cm thick stand around the body (they are in ``blocks``).
        color: ``random`` for one of no matter.
        returns: Returns for other models' sensors.
        device: Device of its type; None for a plain ``model``.
        controllers: Programs that the file starts on it.
        children: Models mounted on it.
        update_interval: Between two updates [s].
        always_on: Whether it works without subscribers.
        stack_children: Whether z of the children's poses starts at the top of the body.
        mass: [kg]; 0 where the file says none.
        friction: Of a model that was pushed.
        map_resolution: Of maps made of it [m].
        gui: Look.
        power: Energy.
    """

    kind: ClassVar[str] = "stage"

    type: str
    name: str
    pose: StagePose = _ORIGIN
    size: StageSize = _SIZE
    origin: StagePose = _ORIGIN
    blocks: tuple[StageBlock, ...] = ()
    bitmap: StageBitmap | None = None
    boundary: bool = False
    color: StageColor = (1.0, 0.0, 0.0, 1.0)
    returns: StageReturns = field(default_factory=StageReturns)
    device: StageDevice | None = None
    controllers: tuple[StageController, ...] = ()
    children: tuple[StageModel, ...] = ()
    update_interval: float = 0.1
    always_on: bool = False
    stack_children: bool = True
    mass: float = 0.0
    friction: float = 0.0
    map_resolution: float = 0.1
    gui: StageGui = field(default_factory=StageGui)
    power: StagePower = field(default_factory=StagePower)
    source: Source | None = field(default=None, compare=False, repr=False)

    @property
    def position(self) -> StagePosition | None:
        """Position device that makes it a robot; None if it is none."""
        return self.device_of(StagePosition)

    def device_of(self, kind: Kind[D]) -> D | None:
        """Return its device, if it is of a kind; else None."""
        return self.device if isinstance(self.device, kind) else None

    @property
    def _begin(self) -> StagePose:
        """Pose of the model; of an actuator that of its start."""
        device = self.device_of(StageActuator)
        return self.pose if device is None else self.pose.then(StagePose(*device.offset))

    @property
    def rangers(self) -> tuple[StageModel, ...]:
        """The rangers mounted directly on it, in file order."""
        return tuple(child for child in self.children if child.device_of(StageRanger))

    def walk(self, parent: PlacedStageModel | None = None) -> Iterator[PlacedStageModel]:
        """Yield this model and all below it, depth first, with names and poses in the world.

        Args:
            parent: The model that this one is mounted on, already placed.
        """
        placed = PlacedStageModel(self, self.name.removeprefix("/"), self._begin, parent)
        if parent is not None:
            lift = parent.model.size.z if parent.model.stack_children else 0.0
            pose = parent.pose.then(self._begin)
            name = placed.name if self.name.startswith("/") else f"{parent.name}.{self.name}"
            placed = PlacedStageModel(self, name, pose._replace(z=pose.z + lift), parent)
        yield placed
        for child in self.children:
            yield from child.walk(placed)


@dataclass(frozen=True, slots=True)
class PlacedStageModel:
    """A model found by ``walk``.

    Attributes:
        model: The model.
        name: Its whole name, such as ``robot.ranger:0``.
        pose: In the world.
        parent: The model it is mounted on.
    """

    model: StageModel
    name: str
    pose: StagePose
    parent: PlacedStageModel | None = None

    @property
    def body_pose(self) -> StagePose:
        """Pose of the body, in the world."""
        return self.pose.then(self.model.origin)


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageWindow:
    """Stage's window; kept for viewers.

    Attributes:
        size: [pixel].
        center: Point of the world in the middle [m].
        rotate: Tilt and turn of the camera, as written.
        scale: [pixel/m]; 0 where the file says none.
        settings: All other properties as written, such as ``("show_data", 1.0)``.
    """

    size: tuple[float, float] = (400.0, 300.0)
    center: tuple[float, float] = (0.0, 0.0)
    rotate: tuple[float, float] = (0.0, 0.0)
    scale: float = 0.0
    settings: tuple[tuple[str, float | str | tuple[float | str, ...]], ...] = ()


@checked(FormatError)
@dataclass(frozen=True, slots=True)
class StageWorld:
    """A world.

    Attributes:
        name: Its name; that of the file where it gives none.
        models: Top-level models in file order.
        interval_sim: Simulated time of a step [s].
        resolution: Side of a cell of Stage's ray-tracing grid [m].
        quit_time: Simulated time at which to end [s]; 0: never.
        speedup: Simulated seconds a wall second to keep to; 0 or less: as fast as possible.
        paused: Whether it starts paused.
        threads: Threads that Stage would use.
        show_clock: Whether the time is printed.
        show_clock_interval: Steps between two prints.
        confirm_on_quit: Whether the window prompts before it closes.
        window: The window; None without one.
    """

    kind: ClassVar[str] = "stage"

    name: str = "default"
    models: tuple[StageModel, ...] = ()
    interval_sim: float = 0.1
    resolution: float = 0.02
    quit_time: float = 0.0
    speedup: float = 1.0
    paused: bool = False
    threads: int = 1
    show_clock: bool = False
    show_clock_interval: int = 100
    confirm_on_quit: bool = True
    window: StageWindow | None = None
    source: Source | None = field(default=None, compare=False, repr=False)

    def walk(self) -> Iterator[PlacedStageModel]:
        """Yield all models, depth first, with their names and poses in the world."""
        for model in self.models:
            yield from model.walk()

    @property
    def robots(self) -> tuple[StageModel, ...]:
        """Top-level position models in file order."""
        return tuple(model for model in self.models if model.position is not None)
