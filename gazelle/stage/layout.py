"""Models of Stage files as bodies, walls and scanners of the planar engine."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass, field, replace

from gazelle.description import Model
from gazelle.engines.planar import Body, Drive, Fan, KindLayout, Mount, PlanarEngine
from gazelle.geometry.planar_part import PlanarPart
from gazelle.stage.description import (
    PlacedStageModel,
    StageActuator,
    StageGripper,
    StageModel,
    StagePose,
    StagePosition,
    StageRanger,
    StageSensor,
    stage_model,
)
from gazelle.stage.robots import MountedActuator, Ranger, StageRobot, without_actuators
from gazelle.stage.shapes import parts_of
from gazelle.stage.walls import table_of

_FINEST = 1e-6
"""Least field of view [rad] and reach [m] of a fan."""

Key = tuple[int, int, int]


@dataclass(slots=True)
class StageLayout(KindLayout):
    """Models of Stage files in a fleet.

    Bodies are robots, then objects, then kinematic models; there is an extra body for each actuator.

    Attributes:
        robots: In file order.
        things: Models that grippers can take, if there are grippers.
        placed: Kinematic models.
        still: Models that never move.
        fans: Of each scanner.
        mounts: Of each scanner, one a sensor.
        noises: Of each scanner: of each sensor the standard deviation [m], the largest share
            of the distance, and the standard deviation of angles [rad].
    """

    robots: list[StageRobot] = field(default_factory=list)
    things: list[StageModel] = field(default_factory=list)
    placed: list[StageModel] = field(default_factory=list)
    still: list[StageModel] = field(default_factory=list)
    fans: list[Fan] = field(default_factory=list)
    mounts: list[list[Mount]] = field(default_factory=list)
    noises: list[list[tuple[float, float, float]]] = field(default_factory=list)


def layout_of(
    models: Sequence[Model], *, kinematic: Collection[str] = (), others: int = 0
) -> StageLayout:
    """Return a Stage world's layout: position models are robots, others static or movable.

    Args:
        models: Those of Stage files.
        kinematic: Names of kinematic models.
        others: Bodies that come between ``bodies`` and ``extra_bodies``.
    """
    own = [(model.name, stage) for model in models if (stage := _now(model)) is not None]
    robots = [(name, model) for name, model in own if model.position is not None]
    rest = [(name, model) for name, model in own if model.position is None]
    grips = any(_grips(model) for _, model in robots)
    things = [each for each in rest if grips and each[1].returns.gripper]
    taken = {name for name, _ in things}
    placed = [each for each in rest if each[0] in kinematic and each[0] not in taken]
    taken |= {name for name, _ in placed}
    maker = _Maker(len(robots) + len(things) + len(placed) + others)
    layout = maker.layout
    for name, model in robots:
        maker.robot(name, model, driven=name not in kinematic)
    layout.passive = [name for name, _ in (*things, *placed)]
    layout.names = [*(name for name, _ in robots), *layout.passive]
    layout.things, layout.placed = [m for _, m in things], [m for _, m in placed]
    layout.still = [model for name, model in rest if name not in taken]
    layout.bodies += map(_thing, (*layout.things, *layout.placed))
    layout.statics = table_of(each for model in layout.still for each in model.walk())
    layout.heights = _heights_of(layout)
    return layout


def stage_layout(engine: PlanarEngine) -> StageLayout:
    """Return the models of Stage files among those of an engine; an empty layout without any."""
    of_kind = engine.layout.of_kind
    return of_kind if isinstance(of_kind, StageLayout) else StageLayout()


def _heights_of(layout: StageLayout) -> frozenset[float]:
    """Return the heights of the rangers on robots [m]."""
    heights = [body.z for body in layout.bodies]
    return frozenset(
        round(heights[mount.body] + mount.z, 4)
        for mounts in layout.mounts
        for mount in mounts
        if mount.body < len(heights)
    )


def _now(model: Model) -> StageModel | None:
    """Return a model's Stage description, with the name and the pose that it has now."""
    stage = stage_model(model)
    if stage is None:
        return None
    if stage.name.removeprefix("/") != model.name:
        stage = replace(stage, name=model.name)
    if stage.pose.pose != model.pose:
        x, y, z = model.pose.position
        stage = replace(stage, pose=StagePose(x, y, z, model.pose.yaw))
    return stage


def _grips(model: StageModel) -> bool:
    return model.device_of(StageGripper) is not None or any(
        _grips(child) for child in model.children
    )


def _actuators(
    placed: PlacedStageModel,
) -> Iterator[tuple[PlacedStageModel, StageActuator, StagePose]]:
    """Yield the actuators on a model, except nested ones, and their poses at position zero."""
    model = placed.model
    for child in model.children:
        lift = model.size.z if model.stack_children else 0.0
        still = replace(child, pose=child.pose._replace(z=child.pose.z + lift))
        device = child.device_of(StageActuator)
        if device is not None:
            yield next(still.walk(placed)), device, placed.pose.then(still.pose)
        else:
            yield from _actuators(next(child.walk(placed)))


def _thing(model: StageModel) -> Body:
    parts = tuple(_all_parts(list(replace(model, pose=StagePose()).walk())))
    return Body(parts, (model.pose.x, model.pose.y, model.pose.yaw), model.pose.z)


@dataclass(frozen=True, slots=True)
class _View:
    """A sensor of robots of one macro: its scanner, and x, y, heading and height on the robot."""

    scanner: int
    place: tuple[float, float, float, float]
    noise: tuple[float, float, float]


@dataclass(slots=True)
class _Shape:
    """Common parts of robots of one macro."""

    parts: tuple[PlanarPart, ...]
    drive: Drive
    rangers: list[tuple[PlacedStageModel, tuple[StageSensor, ...], list[_View]]]
    moved: bool = False


@dataclass(slots=True)
class _Maker:
    first_actuator: int = 0
    layout: StageLayout = field(default_factory=StageLayout)
    shapes: dict[Key, _Shape] = field(default_factory=dict)
    fans: dict[Fan, int] = field(default_factory=dict)

    def robot(self, name: str, model: StageModel, *, driven: bool) -> None:
        """Add a robot with its rangers."""
        index = len(self.layout.robots)
        key = (id(model.blocks), id(model.children), id(model.device))
        shape = self.shapes.get(key)
        if shape is None:
            shape = self.shapes[key] = self.shape(model)
        pose = model.pose
        self.layout.bodies.append(
            Body(shape.parts, (pose.x, pose.y, pose.yaw), pose.z, shape.drive if driven else None)
        )
        rangers = [
            self.ranger(index, name, placed, sensors, views)
            for placed, sensors, views in shape.rangers
        ]
        mounted_actuators = []
        if shape.moved:
            for placed, device, base in _actuators(next(replace(model, pose=StagePose()).walk())):
                actuator, more = self.actuator(index, name, placed, device, base)
                mounted_actuators.append(actuator)
                rangers += more
        robot = StageRobot(index, name, model, tuple(rangers), tuple(mounted_actuators))
        self.layout.robots.append(robot)

    def actuator(
        self,
        robot: int,
        name: str,
        placed: PlacedStageModel,
        device: StageActuator,
        base: StagePose,
    ) -> tuple[MountedActuator, list[Ranger]]:
        """Add what an actuator of a robot moves, a body of the robot's family."""
        whole = f"{name}.{placed.name.partition('.')[2]}"
        model = replace(
            placed.model, name=f"/{whole}", pose=StagePose(), device=replace(device, start=0.0)
        )
        body = self.first_actuator + len(self.layout.extra_bodies)
        shape = self.shape(model)
        at = self.layout.bodies[robot]
        own = StagePose(at.pose[0], at.pose[1], at.z, at.pose[2])
        x, y, z, yaw = own.then(base).then(StagePose(*device.offset))
        self.layout.extra_bodies.append(Body(shape.parts, (x, y, yaw), z, family=-1 - robot))
        rangers = [
            self.ranger(body, whole, there, sensors, views)
            for there, sensors, views in shape.rangers
        ]
        return MountedActuator(body, model, device, base), rangers

    def ranger(
        self,
        robot: int,
        name: str,
        placed: PlacedStageModel,
        sensors: tuple[StageSensor, ...],
        views: list[_View],
    ) -> Ranger:
        """Add the sensors of a ranger to the scanners with their fans."""
        places = []
        for view in views:
            mounts = self.layout.mounts[view.scanner]
            places.append((view.scanner, len(mounts)))
            mounts.append(Mount(robot, *view.place))
            self.layout.noises[view.scanner].append(view.noise)
        _, _, own = placed.name.partition(".")
        whole = f"{name}.{own}" if own else placed.name
        direct = placed.parent is not None and placed.parent.parent is None
        return Ranger(whole, placed.model, sensors, tuple(places), placed.pose, direct)

    def shape(self, model: StageModel) -> _Shape:
        """Return the shape of a robot, in its frame."""
        own = list(replace(without_actuators(model), pose=StagePose()).walk())
        rangers = []
        for placed in own:
            device = placed.model.device_of(StageRanger)
            if device is not None:
                views = [self.view(placed, sensor) for sensor in device.sensors]
                rangers.append((placed, device.sensors, views))
        parts = tuple(_all_parts(own))
        moved = sum(1 for _ in model.walk()) > len(own)
        return _Shape(parts, _drive_of(model.position or StagePosition()), rangers, moved)

    def view(self, placed: PlacedStageModel, sensor: StageSensor) -> _View:
        """Return the pose of a sensor, and the scanner with its beams."""
        fan = _fan_of(sensor)
        which = self.fans.setdefault(fan, len(self.fans))
        if which == len(self.layout.fans):
            self.layout.fans.append(fan)
            self.layout.mounts.append([])
            self.layout.noises.append([])
        at = placed.pose.then(StagePose(*sensor.pose))
        place = (at.x, at.y, at.yaw, at.z + sensor.size[2] / 2.0)
        variance, share, angle = sensor.noise
        return _View(which, place, (math.sqrt(variance), share, angle))


def _all_parts(own: list[PlacedStageModel]) -> Iterator[PlanarPart]:
    for placed in own:
        yield from parts_of(placed)


def _drive_of(position: StagePosition) -> Drive:
    """Return the drive of a position model, with its velocity bounds."""
    (x0, x1), (y0, y1), _, (a0, a1) = position.velocity_bounds
    return Drive(
        position.drive,
        slowest=(x0, y0, a0),
        fastest=(x1, y1, a1),
        wheelbase=position.wheelbase,
    )


def _fan_of(sensor: StageSensor) -> Fan:
    """Return beams from edge to edge, counter-clockwise; the sign of the angle does not matter."""
    fov = min(max(abs(sensor.fov), _FINEST), 2.0 * math.pi)
    return Fan.spread(fov, sensor.samples, max(sensor.range[1], _FINEST))
