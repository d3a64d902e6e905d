"""Files that a command left: each is whole."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path


def _npz(file: Path) -> None:
    import numpy as np

    with np.load(file, allow_pickle=False) as arrays:
        for name in arrays.files:
            arrays[name]


def _bag(file: Path) -> None:
    from gazelle_ros.bags import Bag

    with Bag(str(file)) as bag:
        bag.get_message_count()


def _picture(file: Path) -> None:
    from PIL import Image

    with Image.open(file) as picture:
        picture.load()


def _film(file: Path) -> None:
    data = file.read_bytes()
    if b"moov" not in data:
        raise ValueError("a film without an index")


def _table(file: Path) -> None:
    lines = file.read_text().splitlines(keepends=True)
    widths = {line.count(",") for line in lines}
    if len(widths) > 1 or not all(line.endswith("\n") for line in lines):
        raise ValueError("a row is cut off")


_READERS: dict[str, Callable[[Path], object]] = {
    ".npz": _npz,
    ".bag": _bag,
    ".png": _picture,
    ".gif": _picture,
    ".mp4": _film,
    ".csv": _table,
    ".json": lambda file: json.loads(file.read_text()),
}


def broken_files(folder: Path) -> list[str]:
    """Return a line for each file that is half-written, a draft, or cannot be read."""
    found = []
    for file in sorted(each for each in folder.rglob("*") if each.is_file()):
        name = file.relative_to(folder)
        if ".part" in str(name) or file.suffix == ".active":
            found.append(f"{name} is a draft")
            continue
        try:
            _READERS.get(file.suffix, bool)(file)
        except Exception as error:  # noqa: BLE001  # whatever a reader says of a broken file
            found.append(f"{name}: {type(error).__name__}: {error}")
    return found
