"""The Stage world in whatever a user names: a file, a world, or that itself."""

from __future__ import annotations

from pathlib import Path

from gazelle import formats
from gazelle.description import StageWorld, World
from gazelle.errors import SimulationError
from gazelle.formats.loader import path_text
from gazelle.formats.stage import is_stage, load_stage
from gazelle.formats.xml import read_bytes


def stage_of(world: StageWorld | World | str | Path) -> StageWorld:
    """What a Stage file says.

    Raises:
        FormatError: The file cannot be read.
        SimulationError: It is not Stage's.
    """
    if isinstance(world, StageWorld):
        return world
    file = None if isinstance(world, World) else Path(path_text(world))
    if file is not None and file.is_file() and is_stage(read_bytes(file), file.suffix):
        return load_stage(file)
    loaded = world if isinstance(world, World) else formats.load(world)
    if loaded.stage is None:
        place = loaded.source.file if loaded.source is not None else None
        raise SimulationError("this is no world of Stage", file=place, hint="use Simulation")
    return loaded.stage
