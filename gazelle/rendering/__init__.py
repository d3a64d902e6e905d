"""Rendering of worlds: colour, depth and labels for many cameras at once on the CPU."""

from __future__ import annotations

from pathlib import Path

from gazelle.native import search_path

__path__ = search_path([str(Path(__file__).parent)])

from gazelle.rendering.bilinear import PixelMeans
from gazelle.rendering.lens import PinholeLens
from gazelle.rendering.live_scene import LiveScene
from gazelle.rendering.painted import PaintedPart, painted_world, plain_surroundings
from gazelle.rendering.renderer import Frames, Renderer
from gazelle.rendering.visible import VisiblePart
from gazelle.rendering.wide_lens import LensMapping, WideLens
from gazelle.rendering.wide_view import WideView

__all__ = [
    "Frames",
    "LensMapping",
    "LiveScene",
    "PaintedPart",
    "PinholeLens",
    "PixelMeans",
    "Renderer",
    "VisiblePart",
    "WideLens",
    "WideView",
    "painted_world",
    "plain_surroundings",
]
