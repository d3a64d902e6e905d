"""Gazebo's plugin libraries, one module each; ``table`` lists them by file name."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])
