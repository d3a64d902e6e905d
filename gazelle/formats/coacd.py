"""Closed meshes cut into nearly convex solids by the package ``coacd``, where it is installed."""

from __future__ import annotations

import importlib
from functools import cache
from importlib.metadata import version
from typing import Any

import numpy as np

from gazelle.formats.patches import MAX_PATCHES, Solid
from gazelle.formats.surface import Surface

_CONCAVITY = 0.02
"""Deviation from convex that is allowed, as a share of the mesh's size."""


@cache
def _package() -> Any | None:
    try:
        package = importlib.import_module("coacd")
    except ImportError:
        return None
    package.set_log_level("error")
    return package


def method() -> str:
    """What cuts closed meshes here, for the cache: the pieces of two methods differ."""
    package = _package()
    return "patches" if package is None else f"coacd {version('coacd')}"


def decompose(surface: Surface) -> list[Solid] | None:
    """The solids of a closed surface; None without the package, or if it fails."""
    package = _package()
    if package is None:
        return None
    try:
        parts = package.run_coacd(
            package.Mesh(surface.vertices, surface.faces.astype(np.int32)),
            threshold=_CONCAVITY,
            max_convex_hull=MAX_PATCHES,
            preprocess_mode="off",
            seed=0,
        )
    except Exception:  # noqa: BLE001  # it raises anything; the surface is cut instead
        return None
    solids = [(np.asarray(v, np.float64), np.asarray(f, np.int32)) for v, f in parts]
    return [solid for solid in solids if len(solid[1]) >= 4] or None
