"""The world, its window, and what of a file is neither."""

from __future__ import annotations

from pathlib import Path

from gazelle.description.source import Source
from gazelle.errors import FormatError
from gazelle.formats.reading import Reading
from gazelle.stage.description.models import StageWindow, StageWorld
from gazelle.stage.format.bitmaps import BitmapCells
from gazelle.stage.format.devices import KINDS
from gazelle.stage.format.entity import Entity
from gazelle.stage.format.lexer import Script
from gazelle.stage.format.models import read_model, read_models
from gazelle.stage.format.parser import parse
from gazelle.stage.format.properties import ANGLES, LENGTHS, Properties, Units
from gazelle.stage.format.reader import Context

_IGNORED = (
    ("interval_real", "say 'speedup'"),
    ("gui_interval", "say 'interval' in the window"),
    ("threadpool", "say 'threads'"),
    ("ppm", "say 'resolution'"),
)


def read_world(script: Script, reading: Reading, folder: Path | None) -> StageWorld:
    """Read the world of a Stage file.

    Args:
        script: The file.
        reading: Finds what it names, takes remarks.
        folder: Folder of the file; None for text.

    Raises:
        FormatError: It cannot be read, or says something that is impossible.
        ResolveError: A file that it includes or a picture is not there.
    """
    root, macros = parse(script, reading, folder)
    properties = Properties(root, reading, Units())
    properties.units.length = LENGTHS[properties.choice("unit_length", tuple(LENGTHS), "m")]
    properties.units.angle = ANGLES[properties.choice("unit_angle", tuple(ANGLES), "degrees")]
    context = Context(reading, properties.units, folder, BitmapCells())
    windows = [part for part in root.children if part.type == "window"]
    models = [part for part in root.children if part.type != "window"]
    world = StageWorld(
        name=properties.text("name", Path(script.name).stem) or "default",
        models=read_models(models, context, on_ground=True),
        interval_sim=_interval(properties),
        resolution=_resolution(properties),
        quit_time=properties.number("quit_time", 0.0),
        speedup=properties.number("speedup", 1.0),
        paused=properties.flag("paused", default=False),
        threads=properties.whole("threads", 1, least=0),
        show_clock=properties.flag("show_clock", default=False),
        show_clock_interval=properties.whole("show_clock_interval", 100),
        confirm_on_quit=properties.flag("confirm_on_quit", default=True),
        window=read_window(windows[-1], properties) if windows else None,
        source=script.source(0, "world"),
    )
    if not models:
        _try_macros(macros, context)
    properties.get("test")
    for name, hint in _IGNORED:
        properties.note(name, f"'{name}' is not a property in Stage 4 and was ignored", hint)
    properties.report_unknown()
    return world


def _try_macros(macros: dict[str, Entity], context: Context) -> None:
    """Warn of errors in macros of an included file, as they are unused here."""
    for macro in macros.values():
        if macro.type not in KINDS:
            continue
        try:
            read_model(macro, macro.word, context)
        except FormatError as error:
            place = Source(error.file, error.line, error.element)
            context.reading.remark(
                f"cannot create '{macro.word}': {error.message}", place, error.hint
            )


def _interval(properties: Properties) -> float:
    milliseconds = properties.number("interval_sim", 100.0)
    written = properties.get("interval_sim")
    if written is not None and not 1e-3 <= milliseconds <= 1e6:
        raise written.fail(f"'interval_sim' must be a time in ms, found {milliseconds:g}")
    return milliseconds / 1000.0


def _resolution(properties: Properties) -> float:
    value = properties.number("resolution", 0.02)
    written = properties.get("resolution")
    if written is not None and not 1e-4 <= value <= 1e3:
        raise written.fail(f"'resolution' must be a length in m, found {value:g}")
    return value


def read_window(entity: Entity, world: Properties) -> StageWindow:
    """Read ``window``; all of its properties are kept.

    Raises:
        FormatError: One of those with a field is of the wrong type.
    """
    properties = Properties(entity, world.reading, Units())
    default = StageWindow()
    width, height = properties.numbers("size", "ff", default.size)
    x, y = properties.numbers("center", "ff", default.center)
    tilt, turn = properties.numbers("rotate", "ff", default.rotate)
    fields = {"size", "center", "rotate", "scale"}
    return StageWindow(
        size=(width, height),
        center=(x, y),
        rotate=(tilt, turn),
        scale=properties.number("scale", default.scale),
        settings=tuple(
            (name, each.value) for name, each in entity.properties.items() if name not in fields
        ),
    )
