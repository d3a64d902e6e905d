# cython: infer_types=True, annotation_typing=False
"""Colours, depths and labels of pictures whose nearest triangles are known."""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.rendering.columns import (
    FIRST_TEXEL,
    FIRST_VERTEX,
    LABEL_OF_PART,
    MESH_OF_PART,
    TEXTURE_HEIGHT,
    TEXTURE_OF_PART,
    TEXTURE_WIDTH,
)  # fmt: skip
from cython.cimports.libc.math import floor, sqrt

from gazelle.array_types import Bytes, Floats32, Ints32
from gazelle.rendering.lighting import Lighting
from gazelle.rendering.rasterizer import Rasterizer
from gazelle.rendering.shadow_maps import ShadowMaps
from gazelle.rendering.sunlight import Sunlight

NOTHING = cython.declare(cython.float, float("inf"))
# How a triangle looks: different everywhere, alike all over, or alike but for shadows.
VARIED = cython.declare(cython.uchar, 0)
ALIKE = cython.declare(cython.uchar, 1)
EVEN = cython.declare(cython.uchar, 2)


class Shader:
    """Draws pictures, and fills in what is asked for.

    Lamps that are far away light corners of triangles, and what is between them is interpolated;
    as soon as a lamp has a place, every pixel is lit by itself, and so it is where there are shadows
    on what is not flat and of one colour.

    Args:
        seen: Rasteriser that finds the triangles.
        lighting: Lights of the scene.
        color: Red, green and blue come out, and 255 if there is a fourth, shape (n, height, width,
            3 or 4); with n = 0 none.
        depth: Along the optical axis [m], infinite where nothing is, shape (n, height, width);
            with n = 0 none.
        labels: Numbers of what is seen, -1 where nothing is, likewise.
        maps: Shadow maps of a lamp; None for no shadows.
    """

    def __init__(
        self,
        seen: Rasterizer,
        lighting: Lighting,
        color: Bytes,
        depth: Floats32,
        labels: Ints32,
        maps: ShadowMaps | None = None,
    ) -> None:
        self.seen, self.lighting = seen, lighting
        self.color, self.depth, self.labels = color, depth, labels
        self.colored, self.measured, self.labelled = (
            len(color) > 0,
            len(depth) > 0,
            len(labels) > 0,
        )
        size = seen.width * seen.height if self.colored else 0
        # Of each triangle that a pixel shows: what is interpolated, divided by the depth, as
        # factors of column and row, and a constant; or its one colour.
        self.planes = np.empty((size + 1, 15), np.float32)
        self.flat = np.empty((size + 1, 4), np.uint8)
        # Corners for the camera; normals at them, or how they look, and their places in a picture.
        self.corners, self.bends = np.empty((3, 3)), np.zeros((3, 5))
        self.shares = np.empty((3, 3))
        self.light, self.normal, self.base = np.empty(3), np.empty(3), np.empty(3)
        self.behind = np.empty(3)
        self.sun = Sunlight(seen, maps)
        self.shadowed = self.sun.there and self.colored
        # Of a triangle that looks the same all over but for shadows: how it looks in shadow, what
        # the lamp adds, and its normal.
        self.even = np.empty((size + 1 if self.shadowed else 0, 9))
        self.distant = not lighting.local
        if maps is not None:
            self.lighting.caster, self.lighting.local = maps.lamp, True

    def draw(self, first: int, last: int) -> None:
        """Draw the pictures of cameras first to last, without the interpreter's lock."""
        begin, end = (
            cython.declare(cython.Py_ssize_t, first),
            cython.declare(cython.Py_ssize_t, last),
        )
        with cython.nogil:
            for n in range(begin, end):
                self.draw_one(n)

    def draw_one(self, n: int) -> None:
        """Draw the picture of camera n."""
        self.seen.draw(n)
        if self.shadowed:
            self.sun.draw(n)
        if self.colored:
            self.lighting.look(self.seen.cameras, n)
            self.put_color(n)
        if self.measured:
            self.put_depth(n, False)
        if self.labelled:
            self.put_labels(n, False)
        if self.seen.shapes.clear:
            self.seen.draw_clear(n)
            if self.colored:
                self.put_clear(n)
            if self.measured:
                self.put_depth(n, True)
            if self.labelled:
                self.put_labels(n, True)

    def put_color(self, n: int) -> None:
        """Set the colours of all pixels."""
        color, owner, last = self.color, self.seen.owner, -2
        self.slots = 1
        self.flat[0, 3] = 1
        for k in range(3):
            self.flat[0, k] = self.lighting.tone(self.lighting.horizon[k])
        s, constant, red, green, blue = 0, False, 0, 0, 0
        fourth = color.shape[3] > 3
        for r in range(self.seen.height):
            for c in range(self.seen.width):
                t = owner[r, c]
                if fourth:
                    color[n, r, c, 3] = 255
                if t < 0 and self.lighting.sky:
                    self.put_backdrop(n, r, c)
                    continue
                if t != last:
                    s, last = self.prepare(t), t
                    constant = self.flat[s, 3] == ALIKE
                    red, green, blue = self.flat[s, 0], self.flat[s, 1], self.flat[s, 2]
                if constant:
                    color[n, r, c, 0], color[n, r, c, 1], color[n, r, c, 2] = red, green, blue
                else:
                    self.shade(n, r, c, s, t)

    def put_clear(self, n: int) -> None:
        """Blend transparent surfaces with what is behind them."""
        self.slots = 1
        for r in range(self.seen.height):
            for c in range(self.seen.width):
                t = self.seen.owner[r, c]
                if t < 0:
                    continue
                s, p = self.prepare(t), self.seen.part_of[t]
                for k in range(3):
                    self.behind[k] = self.color[n, r, c, k]
                    self.color[n, r, c, k] = self.flat[s, k]
                if self.flat[s, 3] != ALIKE:
                    self.shade(n, r, c, s, t)
                alpha = self.seen.shapes.alpha[p]
                for k in range(3):
                    mixed = alpha * self.color[n, r, c, k] + (1.0 - alpha) * self.behind[k]
                    self.color[n, r, c, k] = cython.cast(cython.uchar, mixed + 0.5)

    def shade(self, n: int, r: int, c: int, s: int, t: int) -> None:
        """Compute the colour of a pixel of a triangle without a uniform look."""
        if self.flat[s, 3] == EVEN:
            self.shade_evenly(n, r, c, s)
        elif self.lighting.local:
            self.shade_exactly(n, r, c, s, t)
        elif self.seen.shapes.parts[self.seen.part_of[t], TEXTURE_OF_PART] >= 0:
            self.shade_picture(n, r, c, s, self.seen.part_of[t])
        else:
            self.shade_smoothly(n, r, c, s)

    def shade_evenly(self, n: int, r: int, c: int, s: int) -> None:
        """Compute the colour of a pixel of a triangle with a uniform look except shadows."""
        z = 1.0 / self.seen.inverse[r, c]
        x = (c + 0.5 - self.seen.cx) / self.seen.fx * z
        y = (r + 0.5 - self.seen.cy) / self.seen.fy * z
        share = self.sun.share(n, x, y, z, self.even[s, 6], self.even[s, 7], self.even[s, 8])
        for k in range(3):
            self.color[n, r, c, k] = self.lighting.tone(
                self.even[s, k] + share * self.even[s, 3 + k]
            )

    def shade_smoothly(self, n: int, r: int, c: int, s: int) -> None:
        """Compute the colour of a pixel by interpolation between the corners of its triangle."""
        z = 1.0 / self.seen.inverse[r, c]
        for k in range(3):
            value = z * (
                self.planes[s, 3 * k] * c
                + self.planes[s, 3 * k + 1] * r
                + self.planes[s, 3 * k + 2]
            )
            self.color[n, r, c, k] = self.lighting.tone(value)

    def shade_picture(self, n: int, r: int, c: int, s: int, p: int) -> None:
        """Compute the colour of a pixel by interpolation between corners, and a texture."""
        z = 1.0 / self.seen.inverse[r, c]
        self.find_base(s, p, r, c, z)
        for k in range(3):
            value = z * (
                self.planes[s, 3 * k] * c
                + self.planes[s, 3 * k + 1] * r
                + self.planes[s, 3 * k + 2]
            )
            value = self.base[k] * value + self.seen.shapes.glow[p, k]
            self.color[n, r, c, k] = self.lighting.tone(value)

    def find_base(self, s: int, p: int, r: int, c: int, z: float) -> None:
        """Find the colour of a surface in white light: its own, or of the four nearest texels."""
        t = self.seen.shapes.parts[p, TEXTURE_OF_PART]
        if t < 0:
            for k in range(3):
                self.base[k] = self.seen.shapes.color[p, k]
            return
        first = self.seen.shapes.textures[t, FIRST_TEXEL]
        wide = self.seen.shapes.textures[t, TEXTURE_WIDTH]
        high = self.seen.shapes.textures[t, TEXTURE_HEIGHT]
        u = z * (self.planes[s, 9] * c + self.planes[s, 10] * r + self.planes[s, 11])
        v = z * (self.planes[s, 12] * c + self.planes[s, 13] * r + self.planes[s, 14])
        u, v = u - floor(u), v - floor(v)
        u = u if 0.0 <= u <= 1.0 else 0.0  # what is not a number would be no place in the picture
        v = v if 0.0 <= v <= 1.0 else 0.0
        x, y = u * wide - 0.5, v * high - 0.5
        a = cython.cast(cython.Py_ssize_t, floor(x))
        b = cython.cast(cython.Py_ssize_t, floor(y))
        x, y = x - a, y - b
        for k in range(3):
            self.base[k] = 0.0
        for j in range(4):
            d, e = a + (j & 1), b + (j >> 1)
            d = d + wide if d < 0 else (d - wide if d >= wide else d)  # pictures repeat
            e = e + high if e < 0 else (e - high if e >= high else e)
            at = first + e * wide + d
            u = (x if j & 1 else 1.0 - x) * (y if j >> 1 else 1.0 - y) / 255.0
            for k in range(3):
                self.base[k] += u * self.seen.shapes.texels[at, k]

    def shade_exactly(self, n: int, r: int, c: int, s: int, t: int) -> None:
        """Compute the colour of a pixel by the light that falls on it."""
        z = 1.0 / self.seen.inverse[r, c]
        for k in range(3):
            self.normal[k] = z * (
                self.planes[s, 3 * k] * c
                + self.planes[s, 3 * k + 1] * r
                + self.planes[s, 3 * k + 2]
            )
        size = sqrt(
            self.normal[0] * self.normal[0]
            + self.normal[1] * self.normal[1]
            + self.normal[2] * self.normal[2]
        )
        for k in range(3):
            self.normal[k] /= max(size, 1e-12)
        x = (c + 0.5 - self.seen.cx) / self.seen.fx * z
        y = (r + 0.5 - self.seen.cy) / self.seen.fy * z
        if self.shadowed:
            self.lighting.share = self.sun.share(
                n, x, y, z, self.normal[0], self.normal[1], self.normal[2]
            )
        self.lighting.light_up(x, y, z, self.normal, self.light)
        p = self.seen.part_of[t]
        self.find_base(s, p, r, c, z)
        for k in range(3):
            b = self.seen.shapes.glow[p, k]
            self.color[n, r, c, k] = self.lighting.tone(self.base[k] * self.light[k] + b)

    def put_backdrop(self, n: int, r: int, c: int) -> None:
        """Compute the colour of a pixel without a surface."""
        x = (c + 0.5 - self.seen.cx) / self.seen.fx
        y = (r + 0.5 - self.seen.cy) / self.seen.fy
        up = x * self.lighting.up[0] + y * self.lighting.up[1] + self.lighting.up[2]
        self.lighting.backdrop(up / sqrt(1.0 + x * x + y * y), self.light)
        for k in range(3):
            self.color[n, r, c, k] = self.lighting.tone(self.light[k])

    def prepare(self, t: int) -> int:
        """Compute the light of a triangle when its first pixel is coloured.

        Returns:
            Where it is in ``planes`` and ``flat``: at 0 is what is behind all.
        """
        if t < 0:
            return 0
        if self.seen.slot_of[t] >= 0:
            return self.seen.slot_of[t]  # type: ignore[no-any-return]
        s, self.slots = self.slots, self.slots + 1
        self.seen.slot_of[t] = s
        self.find_corners(t)
        self.find_shares()
        self.flat[s, 3] = VARIED
        if not self.lighting.local:
            if self.light_corners(self.seen.part_of[t]):
                self.flat[s, 3] = ALIKE
        elif self.shadowed and self.distant:
            self.light_evenly(s, self.seen.part_of[t])
        for k in range(3):
            self.flat[s, k] = self.lighting.tone(self.bends[0, k])
        for k in range(5):
            for j in range(3):
                self.planes[s, 3 * k + j] = (
                    self.shares[0, j] * self.bends[0, k]
                    + self.shares[1, j] * self.bends[1, k]
                    + self.shares[2, j] * self.bends[2, k]
                )
        return s

    def light_corners(self, p: int) -> bool:
        """Replace normals by the looks of a triangle's corners; returns whether all are alike.

        Those of a surface with a texture are as if it were white.
        """
        worn = self.seen.shapes.parts[p, TEXTURE_OF_PART] >= 0
        flat = not worn
        for i in range(3):
            for k in range(3):
                self.normal[k] = self.bends[i, k]
            self.lighting.light_up(0.0, 0.0, 0.0, self.normal, self.light)
            for k in range(3):
                if not worn:
                    self.light[k] *= self.seen.shapes.color[p, k]
                    self.light[k] += self.seen.shapes.glow[p, k]
                self.bends[i, k] = self.light[k]
                flat = flat and self.bends[i, k] == self.bends[0, k]
        return flat

    def light_evenly(self, s: int, p: int) -> None:
        """Find how a flat triangle of one colour looks in shadow, and what the lamp adds."""
        if self.seen.shapes.parts[p, TEXTURE_OF_PART] >= 0:
            return
        for i in range(1, 3):
            for k in range(3):
                if self.bends[i, k] != self.bends[0, k]:
                    return
        for k in range(3):
            self.normal[k] = self.bends[0, k]
            self.even[s, 6 + k] = self.normal[k]
        self.flat[s, 3] = ALIKE
        for j in range(2):
            self.lighting.share = j
            self.lighting.light_up(0.0, 0.0, 0.0, self.normal, self.light)
            for k in range(3):
                value = self.light[k] * self.seen.shapes.color[p, k]
                if j == 0:
                    self.even[s, k] = value + self.seen.shapes.glow[p, k]
                    self.bends[0, k] = self.even[s, k]
                else:
                    self.even[s, 3 + k] = value + self.seen.shapes.glow[p, k] - self.even[s, k]
                    if self.even[s, 3 + k] != 0.0:
                        self.flat[s, 3] = EVEN

    def find_corners(self, t: int) -> None:
        """Find corners of a triangle in the camera's frame, with normals and places in a picture."""
        p, f = self.seen.part_of[t], self.seen.face_of[t]
        first = self.seen.shapes.meshes[self.seen.shapes.parts[p, MESH_OF_PART], FIRST_VERTEX]
        for i in range(3):
            v = first + self.seen.shapes.faces[f, i]
            self.bends[i, 3] = self.seen.shapes.uv[v, 0]
            self.bends[i, 4] = self.seen.shapes.uv[v, 1]
            x, y, z = (
                self.seen.shapes.vertices[v, 0],
                self.seen.shapes.vertices[v, 1],
                self.seen.shapes.vertices[v, 2],
            )
            for k in range(3):
                self.corners[i, k] = (
                    self.seen.placed[p, 3 * k] * x
                    + self.seen.placed[p, 3 * k + 1] * y
                    + self.seen.placed[p, 3 * k + 2] * z
                    + self.seen.placed[p, 9 + k]
                )
            x, y, z = (
                self.seen.shapes.normals[v, 0],
                self.seen.shapes.normals[v, 1],
                self.seen.shapes.normals[v, 2],
            )
            for k in range(3):
                self.bends[i, k] = (
                    self.seen.placed[p, 3 * k] * x
                    + self.seen.placed[p, 3 * k + 1] * y
                    + self.seen.placed[p, 3 * k + 2] * z
                )

    def find_shares(self) -> None:
        """Find the share of each corner in a pixel, divided by its depth (Olano and Greer, 1997)."""
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            self.shares[i, 0] = (
                self.corners[j, 1] * self.corners[k, 2] - self.corners[j, 2] * self.corners[k, 1]
            )
            self.shares[i, 1] = (
                self.corners[j, 2] * self.corners[k, 0] - self.corners[j, 0] * self.corners[k, 2]
            )
            self.shares[i, 2] = (
                self.corners[j, 0] * self.corners[k, 1] - self.corners[j, 1] * self.corners[k, 0]
            )
        off = (
            self.corners[0, 0] * self.shares[0, 0]
            + self.corners[0, 1] * self.shares[0, 1]
            + self.corners[0, 2] * self.shares[0, 2]
        )
        if off > 0.0:  # seen from behind, where it looks as from its front
            for i in range(3):
                for k in range(3):
                    self.bends[i, k] = -self.bends[i, k]
        for i in range(3):
            x = self.shares[i, 0] / (off * self.seen.fx)
            y = self.shares[i, 1] / (off * self.seen.fy)
            z = self.shares[i, 2] / off
            self.shares[i, 0], self.shares[i, 1] = x, y
            self.shares[i, 2] = z + x * (0.5 - self.seen.cx) + y * (0.5 - self.seen.cy)

    def put_depth(self, n: int, over: bool) -> None:  # noqa: FBT001
        """Convert inverse depths to depths; ``over`` skips pixels without a surface."""
        depth, inverse, owner = self.depth, self.seen.inverse, self.seen.owner
        for r in range(self.seen.height):
            for c in range(self.seen.width):
                if owner[r, c] >= 0:
                    depth[n, r, c] = 1.0 / inverse[r, c]
                elif not over:
                    depth[n, r, c] = NOTHING

    def put_labels(self, n: int, over: bool) -> None:  # noqa: FBT001
        """Set the visible labels; ``over`` skips pixels without a surface."""
        for r in range(self.seen.height):
            for c in range(self.seen.width):
                t = self.seen.owner[r, c]
                if t >= 0:
                    self.labels[n, r, c] = self.seen.shapes.parts[
                        self.seen.part_of[t], LABEL_OF_PART
                    ]
                elif not over:
                    self.labels[n, r, c] = -1
