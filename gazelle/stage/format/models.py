"""Models of any type: what all have in common, and the tree of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace

from gazelle.errors import did_you_mean
from gazelle.stage.description.devices import StageGripper
from gazelle.stage.description.models import (
    StageColor,
    StageController,
    StageGui,
    StageModel,
    StagePose,
    StagePower,
    StageReturns,
    StageSize,
)
from gazelle.stage.format.body import gripper_body, is_block, read_body
from gazelle.stage.format.devices import KINDS
from gazelle.stage.format.entity import Entity, Property
from gazelle.stage.format.properties import Properties
from gazelle.stage.format.reader import Context

known_controllers = {"lasernoise", "rounds", "wander"}
"""Those that are started here; others may join (``stage.register_controller``)."""
"""Controllers that come with Gazelle."""

_GONE = {
    "charger": "Stage 4 has no chargers; a model with give_watts may stand in",
    "map": "write a model with a bitmap",
    "puck": "write a model",
    "simulation": "that is of Player's files",
    "wifi": "Stage 4.3 has no wifi models",
}
_LIGHT = {"color", "name", "pose"}
"""Properties that an instance can change without the rest being read again."""
_MAX_INTERVAL = 3600.0


def read_models(
    entities: Iterable[Entity], context: Context, *, on_ground: bool = False
) -> tuple[StageModel, ...]:
    """Read models that stand beside each other, numbered by their types.

    Args:
        entities: Entities of the file.
        context: Of the file.
        on_ground: Whether they stand on the ground, which is a ``model`` to Stage, and its first.

    Raises:
        FormatError: One has a type that is not known, or says something that is impossible.
    """
    counts = {"model": 1} if on_ground else {}
    found = []
    for entity in entities:
        kind = "ranger" if entity.type == "laser" else entity.type
        index = counts.get(kind, 0)
        counts[kind] = index + 1
        found.append(read_model(entity, f"{kind}:{index}", context))
    return tuple(found)


def read_model(entity: Entity, default_name: str, context: Context) -> StageModel:
    """Read one model; ``default_name`` is for one without a name of its own.

    A model that only gives a macro another pose or name shares all else with it.

    Raises:
        FormatError: Its type is not known, or it says something that is impossible.
    """
    macro = entity.macro
    if macro is None or entity.children or not entity.own.keys() <= _LIGHT:
        return _read_whole(entity, default_name, context)
    prototype = context.prototypes.get(macro)
    if prototype is None:
        prototype = context.prototypes[macro] = _read_whole(macro, "", context)
    properties = Properties(entity, context.reading, context.units, own=True)
    return replace(
        prototype,
        name=_name(properties, prototype.name or default_name),
        pose=properties.pose("pose", prototype.pose),
        color=_color(properties, prototype.color),
        source=entity.source,
    )


def _read_whole(entity: Entity, default_name: str, context: Context) -> StageModel:
    kind = KINDS.get(entity.type)
    if kind is None:
        raise _unknown(entity)
    properties = Properties(entity, context.reading, context.units)
    size, origin = _extent(properties, kind.size)
    body = read_body(properties, size, context, solid=kind.solid)
    device = None if kind.read is None else kind.read(properties)
    if isinstance(device, StageGripper) and body.is_plain:
        body = gripper_body(device, size)
    parts = [part for part in entity.parts if not is_block(part) and part.type != "sensor"]
    if entity.type != "ranger":
        _refuse_sensors(entity)
    model = StageModel(
        type="ranger" if entity.type == "laser" else entity.type,
        name=_name(properties, default_name),
        pose=properties.pose("pose"),
        size=size,
        origin=origin,
        blocks=body.blocks,
        bitmap=body.bitmap,
        boundary=properties.flag("boundary", default=False),
        color=_color(properties, kind.color),
        returns=_returns(properties),
        device=device,
        controllers=_controllers(properties),
        children=read_models(parts, context),
        update_interval=_interval(properties),
        always_on=properties.flag("alwayson", default=False),
        stack_children=properties.flag("stack_children", default=True),
        mass=properties.number("mass", 0.0),
        friction=properties.number("friction", 0.0),
        map_resolution=properties.length("map_resolution", 0.1),
        gui=_gui(properties),
        power=_power(properties),
        source=entity.source,
    )
    _old_words(properties)
    properties.report_unknown()
    return model


def _unknown(entity: Entity) -> Exception:
    if entity.type in {"sensor", "block", "window"}:
        return entity.fail(f"'{entity.type}' is not allowed here: it is not a model")
    hint = _GONE.get(entity.type) or did_you_mean(entity.type, [*KINDS, *entity.macros])
    return entity.fail(f"'{entity.type}' is not a type of model and no macro defined above", hint)


def _refuse_sensors(entity: Entity) -> None:
    for part in entity.parts:
        if part.type == "sensor":
            raise part.fail(f"a sensor must stand in a ranger, not in a {entity.type}")


def _name(properties: Properties, default: str) -> str:
    written = properties.get("name")
    name = properties.text("name", default)
    if written is not None and (not name.strip("/ ") or "::" in name):
        raise written.fail(f"'{name}' is not a name for a model")
    return name


def _extent(properties: Properties, size: StageSize) -> tuple[StageSize, StagePose]:
    """Return ``size`` and ``origin``, or what Stage 2 called them."""
    old_size, old_origin = properties.get("size3"), properties.get("origin3")
    for name, new in (("size3", "size"), ("origin3", "origin")):
        properties.note(name, f"'{name}' is of Stage 2; it is read as '{new}'", f"write {new}")
    origin = StagePose()
    if old_size is not None:
        size = properties.size("size3", size)
    if old_origin is not None:
        x, y, yaw = properties.numbers("origin3", "lla", (0.0, 0.0, 0.0))
        origin = StagePose(x, y, 0.0, yaw)
    return properties.size("size", size), properties.pose("origin", origin)


def _color(properties: Properties, default: StageColor) -> StageColor:
    color = properties.color()
    return default if color is None else color


def _returns(properties: Properties) -> StageReturns:
    default = StageReturns()
    return StageReturns(
        obstacle=properties.flag("obstacle_return", default=default.obstacle),
        ranger=properties.number("ranger_return", default.ranger),
        fiducial=properties.whole("fiducial_return", default.fiducial),
        fiducial_key=properties.whole("fiducial_key", default.fiducial_key),
        blob=properties.flag("blob_return", default=default.blob),
        gripper=properties.flag("gripper_return", default=default.gripper),
    )


def _controllers(properties: Properties) -> tuple[StageController, ...]:
    """Return ``ctrl "NAME ARGUMENTS"``, or a tuple of such strings."""
    written = properties.get("ctrl")
    if written is None:
        return ()
    value = written.value
    texts = value if isinstance(value, tuple) else (value,)
    found = []
    for text in texts:
        words = text.split(maxsplit=1) if isinstance(text, str) else []
        if not words:
            raise written.fail(f"'ctrl' must name a controller, found {written.token.text}")
        found.append(StageController(words[0], words[1] if len(words) > 1 else ""))
        _note_foreign(words[0], written, properties)
    return tuple(found)


def _note_foreign(name: str, written: Property, properties: Properties) -> None:
    if name not in known_controllers:
        properties.reading.remark(
            f"the controller '{name}' is a program for Stage itself, and not started",
            written.source,
            f"there are: {', '.join(sorted(known_controllers))}; others drive it from Python or ROS",
        )


def _interval(properties: Properties) -> float:
    milliseconds = properties.number("update_interval", 100.0)
    written = properties.get("update_interval")
    if written is not None and not 0.0 <= milliseconds <= 1000.0 * _MAX_INTERVAL:
        raise written.fail(f"'update_interval' is out of range: {milliseconds:g} ms")
    return milliseconds / 1000.0


def _gui(properties: Properties) -> StageGui:
    default = StageGui()
    return StageGui(
        nose=properties.flag("gui_nose", default=default.nose),
        grid=properties.flag("gui_grid", default=default.grid),
        outline=properties.flag("gui_outline", default=default.outline),
        move=properties.flag("gui_move", default=default.move),
        trail_length=properties.whole("trail_length", default.trail_length),
        trail_interval=properties.whole("trail_interval", default.trail_interval),
        say=properties.text("say", default.say),
    )


def _power(properties: Properties) -> StagePower:
    def joules(name: str) -> float | None:
        if properties.has(f"k{name}"):
            return 1000.0 * properties.number(f"k{name}", 0.0)
        return properties.number(name, 0.0) if properties.has(name) else None

    stored, capacity = joules("joules"), joules("joules_capacity")
    return StagePower(
        watts=properties.number("watts", 0.0),
        give_watts=properties.number("give_watts", 0.0),
        take_watts=properties.number("take_watts", 0.0),
        joules=stored,
        capacity=capacity,
    )


def _old_words(properties: Properties) -> None:
    """Warn of words that Stage 4 ignores, or that only matter inside of Stage."""
    for name in ("debug", "event_queue"):
        properties.get(name)
    properties.note(
        "laser_return", "'laser_return' is of Stage 3, and ignored", "say 'ranger_return'"
    )
