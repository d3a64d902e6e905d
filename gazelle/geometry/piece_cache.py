"""Convex pieces on disk, in the user's cache folder, found by the mesh's content."""

from __future__ import annotations

import os
import tempfile
from contextlib import suppress
from pathlib import Path

import numpy as np

from gazelle.geometry.hull import Solid

Stored = tuple[list[Solid], bool, float, bool]
"""Pieces, whether the one is the whole mesh, how far they are off it [m], whether it is closed."""

VERSION = 11
"""Of the rules that cut meshes up: files of another are not used."""


def folder() -> Path:
    """Return ``$XDG_CACHE_HOME/gazelle/convex``, else below ``~/.cache``."""
    base = os.environ.get("XDG_CACHE_HOME", "")
    root = Path(base) if Path(base).is_absolute() else Path("~/.cache").expanduser()
    return root / "gazelle" / "convex"


def _file(digest: str) -> Path:
    return folder() / f"{digest}-{VERSION}.npz"


def load(digest: str) -> Stored | None:
    """Load the pieces of a mesh; None if they are missing, or the file is damaged."""
    try:
        with np.load(_file(digest), allow_pickle=False) as data:
            vertices = np.asarray(data["vertices"], np.float64).reshape(-1, 3)
            faces = np.asarray(data["faces"], np.int32).reshape(-1, 3)
            ends = np.asarray(data["ends"], np.int64).reshape(-1, 2)
            whole, gap, closed = bool(data["whole"]), float(data["gap"]), bool(data["closed"])
    except Exception:  # noqa: BLE001  # a damaged file may raise anything; it is made again
        return None
    solids = _split(vertices, faces, ends)
    return None if solids is None else (solids, whole, gap, closed)


def _split(
    vertices: np.ndarray[tuple[int, int], np.dtype[np.float64]],
    faces: np.ndarray[tuple[int, int], np.dtype[np.int32]],
    ends: np.ndarray[tuple[int, int], np.dtype[np.int64]],
) -> list[Solid] | None:
    solids: list[Solid] = []
    before = np.zeros(2, np.int64)
    for after in ends:
        points, triangles = vertices[before[0] : after[0]], faces[before[1] : after[1]]
        if not len(triangles) or triangles.min() < 0 or triangles.max() >= len(points):
            return None
        solids.append((points, triangles))
        before = after
    return solids if np.isfinite(vertices).all() else None


def store(digest: str, pieces: Stored) -> None:
    """Store the pieces of a mesh, if the folder is writable."""
    solids, whole, gap, closed = pieces
    if not solids:
        return
    counts = [(len(points), len(triangles)) for points, triangles in solids]
    with suppress(OSError):
        folder().mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=folder(), suffix=".tmp")
        try:
            with os.fdopen(handle, "wb") as file:
                np.savez(
                    file,
                    vertices=np.concatenate([points for points, _ in solids]),
                    faces=np.concatenate([triangles for _, triangles in solids]),
                    ends=np.cumsum(counts, axis=0),
                    whole=whole,
                    gap=gap,
                    closed=closed,
                )
            Path(name).replace(_file(digest))
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
