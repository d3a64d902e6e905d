"""A Stage world as models in SDF's vocabulary, so that other engines and formats can use it.

Robots become bodies on a ground plane with lidars; what does not drive stands still. Bitmaps
become boxes.
"""

from __future__ import annotations

import colorsys
import itertools
import math
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from gazelle.description import (
    Box,
    Camera,
    Collision,
    Color,
    Friction,
    Geometry,
    Inertia,
    Inertial,
    Lidar,
    Light,
    Link,
    Material,
    Model,
    Noise,
    Physics,
    Plane,
    Plugin,
    Polyline,
    Pose,
    Scan,
    Sensor,
    Source,
    Surface,
    Visual,
    World,
)
from gazelle.formats.reading import Reading
from gazelle.formats.terrain import rectangles
from gazelle.stage.description import (
    StageBitmap,
    StageBlock,
    StageCamera,
    StageModel,
    StagePose,
    StageRanger,
    StageSensor,
    StageWorld,
)
from gazelle.stage.format.plugins import Names

MAX_BOXES = 5_000
"""Boxes of one bitmap; a finer one is drawn coarser."""
DEFAULT_MASS = 10.0
"""Of a robot without one in its file [kg]; Stage's manual names it as the default."""

_STEP = 0.01
"""Longest step of other engines [s]: robots on wheels that are not simulated need no finer one."""
_SMOOTH = Surface(Friction(mu=0.0, mu2=0.0))
_MANY = 40
"""Runs of pixels a box beyond which rectangles need not be tried."""
_OTHER = "/"
"""Before the number of a sensor of a ranger that has several."""
_FLATTEST = 1e-3
"""Least height of a collision [m]: what has none in Stage would be no body at all."""
_GOLDEN = 0.61803398875


def scene_of(stage: StageWorld, reading: Reading) -> World:
    """Return the world with ``models`` for the content of a Stage file, and itself as ``content``.

    Args:
        stage: Stage world of the file.
        reading: Takes remarks on what is drawn coarser.
    """
    builder = _SceneBuilder(reading, len(stage.robots) > 1, 1.0 / stage.interval_sim)
    models = [builder.model(model) for model in stage.models]
    return World(
        name=stage.name,
        models=(builder.ground(), *models),
        physics=(_physics(stage),),
        lights=(Light("sun", type="directional", pose=Pose(z=10.0), direction=(0.3, 0.2, -1.0)),),
        content=stage,
        source=stage.source,
    )


def _physics(stage: StageWorld) -> Physics:
    """Return physics with steps that bodies can bear, at the file's real-time factor."""
    step = min(stage.interval_sim, _STEP)
    speed = max(stage.speedup, 0.0)
    return Physics(
        max_step_size=step,
        kinematic_step=stage.interval_sim,
        real_time_factor=speed or 1.0,
        real_time_update_rate=speed / step,
    )


Shared = tuple[object, ...]


@dataclass(slots=True)
class _SceneBuilder:
    """Makes models; robots that differ by name and pose only share what is on them.

    Attributes:
        reading: Takes remarks.
        several: Whether there are several robots.
        rate: Steps a second of simulated time.
    """

    reading: Reading
    several: bool
    rate: float
    names: set[str] = field(default_factory=set)
    links: dict[Shared, Link] = field(default_factory=dict)
    colors: itertools.count[int] = field(default_factory=itertools.count)
    robots: itertools.count[int] = field(default_factory=itertools.count)

    def ground(self) -> Model:
        """Return the floor, which Stage has implicitly."""
        plane = Plane()
        look = Visual("visual", Plane(size=(100.0, 100.0)), material=_material((0.9,) * 3 + (1.0,)))
        link = Link("link", collisions=(Collision("collision", plane),), visuals=(look,))
        return Model(self.unique("ground_plane"), static=True, links=(link,))

    def unique(self, name: str) -> str:
        """Return the name, with a number behind it if it is used already."""
        found, numbers = name, itertools.count(1)
        while found in self.names:
            found = f"{name}_{next(numbers)}"
        self.names.add(found)
        return found

    def model(self, model: StageModel) -> Model:
        """Return a top-level model with all that is mounted on it."""
        key = (id(model.blocks), id(model.children), id(model.device), model.color, model.size)
        link = self.links.get(key)
        if link is None or model.color == "random":
            link = self.links[key] = self.link(model)
        plugins: tuple[Plugin, ...] = ()
        if model.position is not None:
            names = Names(f"robot_{next(self.robots)}" if self.several else "")
            plugins = (names.drive(self.rate),)
            link = _published(link, names)
        return Model(
            name=self.unique(model.name.removeprefix("/")),
            pose=model.pose.pose,
            static=model.position is None,
            links=(link,),
            plugins=plugins,
            content=model,
            source=model.source,
        )

    def link(self, model: StageModel) -> Link:
        """Return one body of a model and all below it."""
        collisions: list[Collision] = []
        visuals: list[Visual] = []
        sensors: list[Sensor] = []
        # what drives by its velocity must not be held back by the ground
        surface = Surface() if model.position is None else _SMOOTH
        for placed in replace(model, pose=StagePose()).walk():
            part, name = placed.model, placed.name.partition(".")[2] or "body"
            material = _material(self.color(part))
            for index, (shape, pose) in enumerate(self.shapes(part)):
                where = placed.body_pose.pose * pose
                label = f"{name}_{index}"
                visuals.append(Visual(label, shape, where, material=material))
                if part.returns.obstacle:
                    collisions.append(Collision(label, shape, where, surface, part.returns.ranger))
            sensors += _sensors(part, placed.pose, name)
        sensors = [_past(sensor, collisions) for sensor in sensors]
        return Link(
            "base",
            inertial=_inertial(model),
            collisions=tuple(collisions),
            visuals=tuple(visuals),
            sensors=tuple(sensors),
            source=model.source,
        )

    def color(self, model: StageModel) -> Color:
        """Return its colour; random ones are far apart from each other."""
        if model.color != "random":
            return model.color
        red, green, blue = colorsys.hsv_to_rgb(next(self.colors) * _GOLDEN % 1.0, 0.7, 0.9)
        return (red, green, blue, 1.0)

    def shapes(self, model: StageModel) -> list[tuple[Geometry, Pose]]:
        """Return the prisms and boxes of a body, in the body frame."""
        found = [_prism(block) for block in model.blocks]
        if model.bitmap is not None:
            found += self.boxes(model.bitmap, model.source)
        return found

    def boxes(self, bitmap: StageBitmap, source: Source | None) -> list[tuple[Geometry, Pose]]:
        """Return boxes that cover the walls of a bitmap."""
        cells, step = bitmap.cells, 1
        while _runs(cells) > _MANY * MAX_BOXES:
            cells, step = _coarser(cells), 2 * step
        rows = rectangles(cells)
        while len(rows) > MAX_BOXES:
            cells, step = _coarser(cells), 2 * step
            rows = rectangles(cells)
        if step > 1:
            self.reading.remark(
                f"'{bitmap.uri}' is drawn {step} times coarser for engines in space",
                source,
                "the planar engine uses every pixel",
            )
        width, depth = (length * step for length in bitmap.cell_size)
        left, low, right, high = (
            np.minimum(rows * [width, depth, width, depth], _extent(bitmap)) + [*bitmap.low] * 2
        ).T
        height, middle = bitmap.z[1] - bitmap.z[0], sum(bitmap.z) / 2.0
        return [
            (Box((x1 - x0, y1 - y0, height)), Pose((x0 + x1) / 2.0, (y0 + y1) / 2.0, middle))
            for x0, y0, x1, y1 in zip(
                left.tolist(), low.tolist(), right.tolist(), high.tolist(), strict=True
            )
        ]


def _published(link: Link, names: Names) -> Link:
    """Return the link with topics for stage_ros' lidars: the first of each ranger.

    Those are the rangers on the robot itself: in their names there is no dot.
    """
    first = [
        index
        for index, sensor in enumerate(link.sensors)
        if sensor.lidar is not None
        and "." not in sensor.name
        and (_OTHER not in sensor.name or sensor.name.endswith(f"{_OTHER}0"))
    ]
    if not first:
        return link
    sensors = list(link.sensors)
    for number, index in enumerate(first):
        sensors[index] = names.published(sensors[index], number, len(first))
    return replace(link, sensors=tuple(sensors))


def _runs(cells: NDArray[np.bool_]) -> int:
    """Return the number of walls in the rows, each counted once."""
    return int(np.count_nonzero(cells[:, 1:] & ~cells[:, :-1]) + np.count_nonzero(cells[:, 0]))


def _extent(bitmap: StageBitmap) -> list[float]:
    return [bitmap.high[0] - bitmap.low[0], bitmap.high[1] - bitmap.low[1]] * 2


def _coarser(cells: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return four cells as one, which is a wall if any of them is."""
    rows, columns = cells.shape
    even = np.zeros((rows + rows % 2, columns + columns % 2), np.bool_)
    even[:rows, :columns] = cells
    joined: NDArray[np.bool_] = even[::2, ::2] | even[1::2, ::2]
    joined |= even[::2, 1::2]
    joined |= even[1::2, 1::2]
    return joined


def _prism(block: StageBlock) -> tuple[Geometry, Pose]:
    low, high = block.z
    height = max(high - low, _FLATTEST)
    xs, ys = {x for x, _ in block.points}, {y for _, y in block.points}
    if len(block.points) == 4 and len(xs) == 2 and len(ys) == 2 and len(set(block.points)) == 4:
        size = (max(xs) - min(xs), max(ys) - min(ys), height)
        middle = Pose((max(xs) + min(xs)) / 2.0, (max(ys) + min(ys)) / 2.0, low + height / 2.0)
        return Box(size), middle
    return Polyline((block.points,), height), Pose(z=low)


def _material(color: Color) -> Material:
    return Material(ambient=color, diffuse=color)


def _inertial(model: StageModel) -> Inertial:
    """Return the inertial of a homogeneous box of the model's size."""
    mass = model.mass if model.mass > 0.0 else DEFAULT_MASS
    x, y, z = (max(length, _FLATTEST) for length in model.size)
    return Inertial(
        mass,
        (model.origin.then(StagePose(z=z / 2.0))).pose,
        Inertia(
            mass * (y * y + z * z) / 12.0,
            mass * (x * x + z * z) / 12.0,
            mass * (x * x + y * y) / 12.0,
        ),
    )


def _sensors(model: StageModel, pose: StagePose, name: str) -> list[Sensor]:
    """Return the sensors of SDF that represent a device."""
    device = model.device
    rate = 1.0 / model.update_interval if model.update_interval > 0.0 else 0.0
    if isinstance(device, StageRanger):
        alone = len(device.sensors) == 1
        return [
            _lidar(sensor, pose, name if alone else f"{name}{_OTHER}{index}", rate)
            for index, sensor in enumerate(device.sensors)
        ]
    if isinstance(device, StageCamera):
        return [_camera(device, pose, name, rate)]
    return []


def _lidar(sensor: StageSensor, pose: StagePose, name: str, rate: float) -> Sensor:
    here = pose.then(StagePose(*sensor.pose)).then(StagePose(z=sensor.size[2] / 2.0))
    half = sensor.fov / 2.0
    variance = sensor.noise[0]
    noise = Noise("gaussian", stddev=math.sqrt(variance)) if variance > 0.0 else Noise()
    return Sensor(
        name,
        "ray",
        pose=here.pose,
        update_rate=rate,
        lidar=Lidar(
            horizontal=Scan(sensor.samples, min_angle=-half, max_angle=half),
            range_min=sensor.range[0],
            range_max=sensor.range[1],
            noise=noise,
        ),
    )


def _past(sensor: Sensor, collisions: list[Collision]) -> Sensor:
    """Return a lidar that starts where its own model ends: in Stage it never sees that."""
    lidar = sensor.lidar
    if lidar is None:
        return sensor
    reach = max((_reach(sensor.pose, each) for each in collisions), default=0.0)
    nearest = min(max(lidar.range_min, reach), lidar.range_max)
    return replace(sensor, lidar=replace(lidar, range_min=nearest))


def _reach(pose: Pose, collision: Collision) -> float:
    """Return the reach of a body at a lidar's height from it [m]; 0 for any other."""
    shape, where = collision.geometry, collision.pose
    if isinstance(shape, Box):
        x, y, z = (length / 2.0 for length in shape.size)
        corners = [(-x, -y), (x, -y), (x, y), (-x, y)]
        low, high = where.z - z, where.z + z
    elif isinstance(shape, Polyline):
        corners, low, high = list(shape.outlines[0]), where.z, where.z + shape.height
    else:
        return 0.0
    if not low - _FLATTEST <= pose.z <= high + _FLATTEST:
        return 0.0
    cos, sin = math.cos(where.yaw), math.sin(where.yaw)
    return max(
        math.hypot(where.x + cos * x - sin * y - pose.x, where.y + sin * x + cos * y - pose.y)
        for x, y in corners
    )


def _camera(device: StageCamera, pose: StagePose, name: str, rate: float) -> Sensor:
    pan, tilt = device.pantilt
    where = Pose(pose.x, pose.y, pose.z, pitch=tilt, yaw=pose.yaw - pan)
    camera = Camera(
        horizontal_fov=device.fov[0],
        width=device.resolution[0],
        height=device.resolution[1],
        near=device.range[0],
        far=device.range[1],
    )
    return Sensor(name, "camera", pose=where, update_rate=rate, cameras=(camera,))
