"""Computational geometry: polygons, hulls, surfaces, and meshes as convex pieces."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])
