"""State of one load of a Stage file."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

from gazelle.formats.reading import Reading
from gazelle.stage.description.models import StageModel
from gazelle.stage.format.bitmaps import BitmapCells
from gazelle.stage.format.entity import Entity
from gazelle.stage.format.properties import Units


@dataclass(slots=True)
class Context:
    """The state of one load.

    Attributes:
        reading: Finds files, takes remarks.
        units: Of the file.
        folder: Of the top-level file; None for text.
        pictures: Bitmaps already read.
        prototypes: Models already made of macros.
    """

    reading: Reading
    units: Units
    folder: Path | None
    pictures: BitmapCells
    prototypes: dict[Entity, StageModel] = field(default_factory=dict)
