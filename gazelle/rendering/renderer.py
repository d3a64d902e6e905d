"""Pictures of many cameras in many worlds at once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bytes, Floats, Floats32, Ints32, Ints64, Worlds
from gazelle.description import World
from gazelle.engines.limits import MAX_WORLDS, integer
from gazelle.errors import EngineError, did_you_mean
from gazelle.native.worker_pool import WorkerPool
from gazelle.rendering import columns as c
from gazelle.rendering.lamps import SUN, lighting_of, table_of
from gazelle.rendering.lens import PinholeLens
from gazelle.rendering.rasterizer import Rasterizer
from gazelle.rendering.shading import Shader
from gazelle.rendering.shadow_maps import (
    ShadowMaps,
    casting_lamp,
    extent_of_shapes,
    shadow_maps,
    side_of,
)
from gazelle.rendering.visible import VisiblePart, VisibleWorld, rows_of, visible_world


@dataclass(frozen=True, slots=True)
class Frames:
    """Images of some cameras; those not requested have shape (0, height, width, ...).

    Attributes:
        color: Red, green, blue, shape (n, height, width, channels), top row first.
        depth: Along the optical axis [m], infinite where nothing is, shape (n, height, width).
        labels: Index into ``Renderer.parts``, -1 for none, likewise.
    """

    color: Bytes
    depth: Floats32
    labels: Ints32


@checked(EngineError)
class Renderer:
    """Draws the visuals of a world's copies, with links anywhere.

    A picture is the same, bit for bit, at any number of threads, worlds and other cameras.

    Args:
        world: World to draw.
        nworld: Number of copies.
        threads: Number of threads; all processors if None.
        gamma: Brightness b becomes b to the power 1 / gamma.
        shadows: Whether things throw shadows in the first directional light that has them.
        seen: Visuals in place of the world's; its lamps and sky stay.

    Attributes:
        shadows: Likewise; it can be set.
        links: Scoped names of the links that have visuals.
        parts: Parts by which labels count.

    Raises:
        FormatError: A mesh or a terrain cannot be read.
    """

    def __init__(
        self,
        world: World,
        *,
        nworld: int = 1,
        threads: int | None = None,
        gamma: float = 1.0,
        shadows: bool = False,
        seen: VisibleWorld | None = None,
    ) -> None:
        integer("nworld", nworld, most=MAX_WORLDS)
        self.shadows = shadows
        seen = visible_world(world) if seen is None else seen
        self.links: tuple[str, ...] = seen.links
        self.parts: tuple[VisiblePart, ...] = seen.parts
        self._numbers = {link: number for number, link in enumerate(seen.links)}
        self._world, self._gamma = world, gamma
        self._shapes = seen.shapes
        self._placed = np.repeat(seen.rest[None], nworld, axis=0)
        self._lights = world.lights or (SUN,)
        self._extent = extent_of_shapes(seen.shapes, seen.rest)
        self._pool = WorkerPool(threads)

    def place(
        self, link: str, positions: Floats, quaternions: Floats, worlds: Worlds | None = None
    ) -> None:
        """Set the pose of a link.

        Args:
            link: Scoped name; a link without visuals is left alone.
            positions: [m] in the world, shape (nworlds, 3).
            quaternions: x, y, z, w, shape (nworlds, 4).
            worlds: Worlds; all if None.
        """
        number = self._numbers.get(link)
        if number is not None:
            chosen = slice(None) if worlds is None else worlds
            self._placed[chosen, number] = rows_of(positions, quaternions)

    def place_all(
        self,
        links: tuple[str, ...],
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None = None,
    ) -> None:
        """Set the poses of many links at once.

        Args:
            links: Scoped names of links with visuals.
            positions: [m] in the world, shape (nworlds, links, 3).
            quaternions: x, y, z, w, shape (nworlds, links, 4).
            worlds: Worlds; all if None.
        """
        unknown = next((link for link in links if link not in self._numbers), None)
        if unknown is not None:
            hint = did_you_mean(unknown, self._numbers)
            raise EngineError(f"no link '{unknown}' has a visual", hint=hint)
        numbers = [self._numbers[link] for link in links]
        rows = rows_of(positions, quaternions)
        if worlds is None:
            self._placed[:, numbers] = rows
        else:
            self._placed[np.asarray(worlds)[:, None], numbers] = rows

    def render(
        self,
        lens: PinholeLens,
        positions: Floats,
        quaternions: Floats,
        worlds: Worlds | None = None,
        *,
        want: tuple[str, ...] = ("color", "depth", "labels"),
        unseen: Ints64 | None = None,
        channels: int = 3,
    ) -> Frames:
        """Render what cameras see.

        Args:
            lens: Of all of them.
            positions: Of the cameras in their worlds [m], shape (n, 3).
            quaternions: x, y, z, w; a camera looks along its x axis, z is up, shape (n, 4).
            worlds: Worlds of the cameras, shape (n,); the first n if None.
            want: Images: color, depth and labels.
            unseen: Of each camera the link that it does not see, such as its own casing, counted as
                in ``links``, or -1, shape (n,); none if None. Shadows of it stay.
            channels: Bytes a pixel of colours, 4 with 255 after red, green and blue.

        Raises:
            EngineError: Something else is wanted, or there is no such world.
        """
        unknown = set(want) - {"color", "depth", "labels"}
        if unknown:
            raise EngineError(f"pictures have color, depth and labels, not {min(unknown)!r}")
        cameras = self._cameras(positions, quaternions, worlds)
        cameras[:, c.UNSEEN] = -1 if unseen is None else unseen
        shape = (lens.height, lens.width)
        frames = Frames(
            np.empty((len(cameras) if "color" in want else 0, *shape, channels), np.uint8),
            np.empty((len(cameras) if "depth" in want else 0, *shape), np.float32),
            np.empty((len(cameras) if "labels" in want else 0, *shape), np.int32),
        )

        maps = self._maps(cameras, lens) if "color" in want else None

        def work(first: int, last: int, _part: int) -> None:
            size = (lens.width, lens.height)
            rasterizer = Rasterizer(self._shapes, self._placed, cameras, lens.row, size)
            lighting = lighting_of(self._world, gamma=self._gamma)
            pictures = frames.color, frames.depth, frames.labels
            shader = Shader(rasterizer, lighting, *pictures, maps)
            shader.draw(first, last)

        self._pool.share(work, len(cameras), 1)
        return frames

    def _maps(self, cameras: Floats, lens: PinholeLens) -> ShadowMaps | None:
        """Return the pictures that shadows are looked up in, if there are any."""
        lamp = casting_lamp(self._lights) if self.shadows else None
        if lamp is None:
            return None
        along = table_of(self._lights)[lamp, c.ALONG : c.ALONG + 3]
        return shadow_maps(cameras, lamp, along, self._extent, side_of(lens))

    def _cameras(self, positions: Floats, quaternions: Floats, worlds: Worlds | None) -> Floats:
        count = len(positions)
        chosen = np.arange(count) if worlds is None else np.asarray(worlds)
        if count and not (chosen.min() >= 0 and chosen.max() < len(self._placed)):
            raise EngineError(f"there are worlds 0 to {len(self._placed) - 1}")
        turned = rows_of(positions, quaternions)
        made = np.empty((count, c.CAMERA))
        made[:, 0], made[:, 1:4] = chosen, positions
        forward, left, up = turned[:, 0:9:3], turned[:, 1:9:3], turned[:, 2:9:3]
        made[:, 4:7], made[:, 7:10], made[:, 10:13] = -left, -up, forward
        return made
