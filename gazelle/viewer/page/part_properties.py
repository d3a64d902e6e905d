"""Properties of models, links, collisions, joints, sensors and lights, as the page shows them."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields
from functools import partial
from typing import Any

from gazelle.array_types import Floats
from gazelle.description import Geometry, Joint, Light, Link, Model, Pose, Sensor
from gazelle.errors import Error, SimulationError, did_you_mean
from gazelle.sensors import LidarModel
from gazelle.simulation import Robot
from gazelle.viewer.page.context import PageContext, ScenePart

Value = str | bool | float


@dataclass(frozen=True, slots=True)
class PartProperty:
    """A property of a part.

    Attributes:
        label: With its unit.
        read: Returns the present value; called between two steps.
        write: Sets it; None if it cannot be changed.
        step: Of a number, one click.
        decimals: Of a number, at most.
    """

    label: str
    read: Callable[[], Value]
    write: Callable[[Any], None] | None = None
    step: float = 0.01
    decimals: int = 12


def properties_of(context: PageContext, part: ScenePart) -> Iterator[PartProperty]:
    """Yield the properties of a part; none if it is gone."""
    if part.kind == "world":
        yield from _of_world(context)
    elif part.kind == "light":
        yield from _of_light(context, part.name)
    elif (robot := context.simulation.robots.get(part.name.split("::")[0])) is not None:
        within = part.name.removeprefix(f"{robot.name}::")
        readers = {
            "model": _of_model,
            "link": _of_link,
            "collision": _of_collision,
            "joint": _of_joint,
            "sensor": _of_sensor,
        }
        yield from readers[part.kind](context, robot, within)


def _constant(label: str, value: str) -> PartProperty:
    return PartProperty(label, lambda: value)


def _vector(
    labels: str,
    read: Callable[[], Sequence[float]],
    write: Callable[[Any], None],
    step: float = 0.1,
    decimals: int = 4,
) -> Iterator[PartProperty]:
    """Yield the components of a vector; a change of one sets them all."""

    def component(number: int) -> Callable[[], float]:
        return lambda: float(read()[number])

    def setter(number: int) -> Callable[[Any], None]:
        def put(value: float) -> None:
            values = [float(each) for each in read()]
            values[number] = value
            write(tuple(values))

        return put

    for number, label in enumerate(labels.split(", ")):
        yield PartProperty(label, component(number), setter(number), step, decimals)


def _of_world(context: PageContext) -> Iterator[PartProperty]:
    simulation = context.simulation
    yield _constant("Engine", simulation.engine_name)
    yield _constant("Models", str(len(simulation.robots)))

    def set_time_step(value: float) -> None:
        simulation.physics.time_step = value

    yield PartProperty("Step [s]", lambda: simulation.physics.time_step, set_time_step, step=1e-4)
    yield from _parameter(
        context, "Gravity x [m/s²], Gravity y, Gravity z", "gravity", "", step=0.1
    )


def _of_model(context: PageContext, robot: Robot, _name: str) -> Iterator[PartProperty]:
    chosen = context.chosen

    def pose() -> Pose:
        return robot.placement(chosen).first()

    def put(position: Any, rpy: Any) -> None:
        there = Pose(*position, *rpy)
        robot.set_pose(there.position, there.quaternion, worlds=chosen)

    yield _constant("Kind", "static" if robot.description.static else "dynamic")
    yield from _vector(
        "x [m], y [m], z [m]", lambda: pose().position, lambda at: put(at, pose().rpy)
    )
    yield from _vector(
        "Roll [rad], Pitch [rad], Yaw [rad]",
        lambda: pose().rpy,
        lambda at: put(pose().position, at),
    )


def _of_link(context: PageContext, robot: Robot, name: str) -> Iterator[PartProperty]:
    link = robot.links.get(name)
    if link is None:
        return
    chosen = context.chosen
    yield PartProperty("Position [m]", lambda: _text(link.placement(chosen).position[0]))
    yield PartProperty("Velocity [m/s]", lambda: _text(link.motion(chosen).linear[0]))
    yield PartProperty("Turning [rad/s]", lambda: _text(link.motion(chosen).angular[0]))
    yield from _parameter(context, "Mass [kg]", "link_mass", link.name)
    yield from _parameter(
        context, "Centre x [m], Centre y [m], Centre z [m]", "link_centre", link.name
    )
    yield from _parameter(
        context, "Ixx [kg m²], Iyy [kg m²], Izz [kg m²]", "link_inertia", link.name
    )
    yield from _parameter(context, "Gravity", "link_gravity", link.name, flag=True)


def _of_collision(context: PageContext, robot: Robot, name: str) -> Iterator[PartProperty]:
    link_name, _, own = name.rpartition("::")
    link = robot.links.get(link_name)
    found = link.description.collisions if link is not None else ()
    for collision in found:
        if collision.name == own:
            yield _constant("Shape", shape_text(collision.geometry))
            yield from _parameter(
                context, "Friction", "collision_friction", f"{robot.name}::{name}"
            )


def _of_joint(context: PageContext, robot: Robot, name: str) -> Iterator[PartProperty]:
    try:
        joint = robot.joint_description(name)
    except Error:  # deleted
        return
    yield _constant("Type", joint.type)
    yield _constant("Parent", joint.parent)
    yield _constant("Child", joint.child)
    handle = robot.joints.get(name)
    if handle is None or handle.axes != 1:
        return
    scoped, chosen = handle.name, context.chosen
    unit = "m" if joint.type == "prismatic" else "rad"
    yield PartProperty(f"Position [{unit}]", lambda: _text(handle.positions(chosen)[0]))
    yield PartProperty(f"Velocity [{unit}/s]", lambda: _text(handle.velocities(chosen)[0]))
    yield from _parameter(context, "Damping", "joint_damping", scoped)
    yield from _parameter(context, "Friction", "joint_friction", scoped)
    yield from _parameter(context, "Lower limit", "joint_lower", scoped)
    yield from _parameter(context, "Upper limit", "joint_upper", scoped)
    if handle.has_motor:
        yield from _parameter(context, "Motor, largest", "motor_effort", scoped)


def _of_sensor(context: PageContext, robot: Robot, name: str) -> Iterator[PartProperty]:
    scoped = f"{robot.name}::{name}"
    sensor = _sensors(robot.description).get(scoped)
    if sensor is None:
        return
    yield _constant("Type", sensor.type)
    rate = f"{sensor.update_rate:g} Hz" if sensor.update_rate else "every step"
    yield _constant("Rate", rate)
    if sensor.topic:
        yield _constant("Topic", sensor.topic)
    if sensor.lidar is not None:
        lidar = sensor.lidar
        yield _constant("Rays", str(lidar.horizontal.samples * lidar.vertical.samples))
        yield _constant("Range", f"{lidar.range_min:g} to {lidar.range_max:g} m")
    for camera in sensor.cameras:
        yield _constant("Image", f"{camera.width} x {camera.height}")
        yield _constant("View", f"{camera.horizontal_fov:.3g} rad")
    unit = next((each for each in robot.sensors.values() if each.name == scoped), None)
    if unit is not None and isinstance(unit.model, LidarModel):
        noise = context.simulation.parameters.lidar_noise
        row = int(context.chosen[0])

        def set_noise(value: float) -> None:
            values = noise[scoped].copy()
            values[row] = value
            noise[scoped] = values

        yield PartProperty("Noise [m]", lambda: float(noise[scoped][row]), set_noise)


def _sensors(model: Model) -> dict[str, Sensor]:
    """Return the sensors of links and joints by scoped name."""
    found: dict[str, Sensor] = {}
    for placed in model.walk():
        parts: tuple[Link | Joint, ...] = (*placed.model.links, *placed.model.joints)
        for part in parts:
            for sensor in part.sensors:
                found[f"{placed.scope}::{part.name}::{sensor.name}"] = sensor
    return found


def _of_light(context: PageContext, name: str) -> Iterator[PartProperty]:
    simulation = context.simulation

    def now() -> Light:
        lights = {each.name: each for each in simulation.world.lights}
        if name not in lights:
            raise SimulationError(f"there is no light '{name}'", hint=did_you_mean(name, lights))
        return lights[name]

    def put(field: str, value: Any) -> None:
        simulation.set_light(name, **{field: value})

    if name not in {each.name for each in simulation.world.lights}:
        return
    yield _constant("Type", now().type)

    def move(value: Any) -> None:
        put("pose", Pose.from_quaternion(value, now().pose.quaternion))

    def color(value: Any) -> None:
        put("diffuse", (*value, now().diffuse[3]))

    if now().type != "directional":
        yield from _vector("x [m], y [m], z [m]", lambda: now().pose.position, move)
    if now().type != "point":
        aim = partial(put, "direction")
        yield from _vector("Direction x, Direction y, Direction z", lambda: now().direction, aim)
    yield from _vector("Red, Green, Blue", lambda: now().diffuse[:3], color)
    yield PartProperty("Intensity", lambda: now().intensity, partial(put, "intensity"), step=0.1)
    yield PartProperty("Shadows", lambda: now().cast_shadows, partial(put, "cast_shadows"))


def _parameter(
    context: PageContext,
    labels: str,
    kind: str,
    name: str,
    *,
    flag: bool = False,
    step: float = 0.01,
) -> Iterator[PartProperty]:
    """Yield a parameter of the engine, if it has one of this kind for the part.

    Of an inertia the three moments are shown, and the products stay.
    """
    engine, chosen = context.simulation.engine, context.chosen
    count = len(labels.split(", "))

    def row() -> list[float]:
        values: list[float] = engine.parameter(kind, name, chosen)[0, :count].tolist()
        return values

    def write(value: Any) -> None:
        with context.simulation.lock:
            rows = engine.parameter(kind, name, chosen).copy()
            rows[:, :count] = value
            engine.set_parameter(kind, name, rows, chosen)

    try:
        first = row()
    except Error:  # static, or of an engine without it
        return
    if flag:
        yield PartProperty(labels, lambda: row()[0] > 0.5, write)
    elif count > 1:
        yield from _vector(labels, row, write, step, decimals=12)
    elif math.isfinite(first[0]):
        yield PartProperty(labels, lambda: row()[0], write, step)
    else:
        yield _constant(labels, "none")


def shape_text(geometry: Geometry) -> str:
    """Return the kind of a shape and its lengths.

    >>> from gazelle.description import Box
    >>> shape_text(Box((1.0, 2.0, 0.5)))
    'box, size 1 2 0.5'
    """
    parts = [type(geometry).__name__.lower()]
    for field in fields(geometry):
        value = getattr(geometry, field.name)
        if not field.repr or field.name in ("path", "extras", "source"):
            continue
        if isinstance(value, tuple) and all(isinstance(each, float) for each in value):
            parts.append(f"{field.name} {' '.join(f'{each:g}' for each in value)}")
        elif isinstance(value, float | str):
            parts.append(f"{field.name} {value:g}" if isinstance(value, float) else str(value))
    return ", ".join(parts)


def _text(values: Floats) -> str:
    """Return numbers with three decimals."""
    return ", ".join(f"{each:.3f}" for each in values.tolist())
