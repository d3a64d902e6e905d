# cython: infer_types=True, annotation_typing=False
"""Depth buffer: the triangle that each pixel of a picture shows, and its depth.

The inverse of the depth along the optical axis is linear in a picture, as on any graphics card. It
is taken from the plane of a triangle, so that a flat shape has exact depths all over. A pixel shows
what its middle sees; triangles that share an edge compute it from the same ends in the same order,
so that between them no pixel is left out and none is drawn twice.
"""

from __future__ import annotations

import cython
import numpy as np
from cython.cimports.gazelle.native.memory import integers, singles
from cython.cimports.gazelle.rendering.columns import (
    FIRST_FACE,
    FIRST_VERTEX,
    LAST_FACE,
    LAST_VERTEX,
    LINK_OF_PART,
    MESH_OF_PART,
    TWO_SIDED,
    UNSEEN,
)  # fmt: skip
from cython.cimports.libc.math import ceil, sqrt

from gazelle.array_types import Bytes, Floats, Floats32, Ints32, Ints64


class DrawnShapes:
    """Shapes that cameras may see in any world, and the parts of links that have them.

    Args:
        vertices: Of all meshes [m], shape (n, 3).
        normals: At the vertices, of unit length, shape (n, 3).
        faces: Corners of triangles, counted in their mesh, counter-clockwise from outside,
            shape (m, 3).
        meshes: As ``columns.FIRST_VERTEX`` and what follows say, shape (k, MESH).
        spheres: Middle and radius of a ball around each mesh [m], shape (k, 4).
        parts: As ``columns.MESH_OF_PART`` and what follows say, shape (p, PART).
        local: Of each part in its link, rotation by rows and place [m], shape (p, 12).
        color: Red, green and blue of each part, 0 to 1, shape (p, 3).
        glow: Emitted light, likewise.
        alpha: Of each part, 1 for what hides all behind it, shape (p,).
        uv: Of the vertices, to the right and up in a picture, shape (n, 2).
        textures: As ``columns.FIRST_TEXEL`` and what follows say, shape (t, TEXTURE).
        texels: Red, green and blue of the pixels of all textures, bottom row first, shape (x, 3).
    """

    def __init__(
        self,
        vertices: Floats,
        normals: Floats,
        faces: Ints32,
        meshes: Ints64,
        spheres: Floats,
        parts: Ints64,
        local: Floats,
        color: Floats32,
        glow: Floats32,
        alpha: Floats32,
        uv: Floats,
        textures: Ints64,
        texels: Bytes,
    ) -> None:
        self.vertices, self.normals, self.faces = vertices, normals, faces
        self.meshes, self.spheres = meshes, spheres
        self.parts, self.local, self.color, self.glow = parts, local, color, glow
        self.alpha, self.clear = alpha, bool((alpha < 1.0).any())
        self.uv, self.textures, self.texels = uv, textures, texels


class Rasterizer:
    """Draws one picture after another; what one thread needs for it.

    Args:
        shapes: Shapes to draw.
        links: Rotation by rows and place [m] of all links, shape (nworld, nlink, 12).
        cameras: As ``columns.CAMERA`` says, shape (n, CAMERA).
        lens: Focal lengths along rows and columns, column and row of the axis [pixel], nearest
            and farthest depth [m].
        size: Columns and rows of pixels.

    Attributes:
        inverse: One over the depth [1/m], shape (height, width).
        owner: Number of the triangle that is seen, of those drawn; -1 for none.
        part_of: The part that has a triangle; shape (triangles,).
        face_of: Its number among all faces.
        slot_of: -1; free for who looks at the picture.
        placed: Of each part in the camera's frame, rotation by rows and place [m].
    """

    def __init__(
        self,
        shapes: DrawnShapes,
        links: Floats,
        cameras: Floats,
        lens: tuple[float, float, float, float, float, float],
        size: tuple[int, int],
    ) -> None:
        self.shapes, self.links, self.cameras = shapes, links, cameras
        self.width, self.height = size
        self.fx, self.fy, self.cx, self.cy, self.near, self.far = lens
        self.inverse = np.empty((self.height, self.width), np.float32)
        self.owner = np.empty((self.height, self.width), np.int32)
        self.inverse_at = np.asarray(self.inverse).ctypes.data
        self.owner_at = np.asarray(self.owner).ctypes.data
        meshes, parts = np.asarray(shapes.meshes), np.asarray(shapes.parts)[:, MESH_OF_PART]
        most = int((meshes[parts, LAST_FACE] - meshes[parts, FIRST_FACE]).sum())
        self.part_of, self.face_of = np.empty(most, np.int32), np.empty(most, np.int32)
        self.slot_of = np.empty(most, np.int32)
        self.placed = np.empty((len(parts), 12))
        widest = int((meshes[:, LAST_VERTEX] - meshes[:, FIRST_VERTEX]).max(initial=1))
        self.seen, self.spots = np.empty((widest, 3)), np.empty((widest, 2))
        self.cut = np.empty((4, 2))  # what is left of a triangle before the camera [pixel]
        right, below = self.width - self.cx, self.height - self.cy
        fx, fy, cx, cy = self.fx, self.fy, self.cx, self.cy
        self.sides = np.array(
            [sqrt(f * f + c * c) for f, c in ((fx, cx), (fx, right), (fy, cy), (fy, below))]
        )

    def draw(self, n: int) -> None:
        """Draw everything opaque that camera n sees."""
        self.clear()
        self.draw_parts(n, False)

    def draw_clear(self, n: int) -> None:
        """Draw the nearest transparent surfaces in front of all others, after ``draw``."""
        self.count = 0
        for r in range(self.height):
            for c in range(self.width):
                self.owner[r, c] = -1
        self.draw_parts(n, True)

    def draw_parts(self, n: int, clear: bool) -> None:  # noqa: FBT001
        """Draw the transparent parts, or the opaque ones."""
        unseen = cython.cast(cython.Py_ssize_t, self.cameras[n, UNSEEN])
        for p in range(self.shapes.parts.shape[0]):
            if (self.shapes.alpha[p] < 1.0) != clear:
                continue
            if self.shapes.parts[p, LINK_OF_PART] == unseen:
                continue
            self.place(n, p)
            if self.is_in_view(p):
                self.project(p)
                self.draw_part(p)

    def clear(self) -> None:
        """Start a picture; its depth is the lens's far plane."""
        self.count = 0
        inverse, owner = singles(self.inverse_at), integers(self.owner_at)
        least = 1.0 / self.far
        for k in range(self.width * self.height):
            inverse[k] = least
            owner[k] = -1

    def place(self, n: int, p: int) -> None:
        """Find where a part is in the frame of camera n: x right, y down, z forward."""
        world = cython.cast(cython.Py_ssize_t, self.cameras[n, 0])
        link = self.shapes.parts[p, LINK_OF_PART]
        for k in range(3):
            right = 4 + 3 * k
            dx, dy, dz = (
                self.cameras[n, right],
                self.cameras[n, right + 1],
                self.cameras[n, right + 2],
            )
            a = (
                dx * self.links[world, link, 0]
                + dy * self.links[world, link, 3]
                + dz * self.links[world, link, 6]
            )
            b = (
                dx * self.links[world, link, 1]
                + dy * self.links[world, link, 4]
                + dz * self.links[world, link, 7]
            )
            c = (
                dx * self.links[world, link, 2]
                + dy * self.links[world, link, 5]
                + dz * self.links[world, link, 8]
            )
            x = (
                dx * (self.links[world, link, 9] - self.cameras[n, 1])
                + dy * (self.links[world, link, 10] - self.cameras[n, 2])
                + dz * (self.links[world, link, 11] - self.cameras[n, 3])
            )
            for j in range(3):
                self.placed[p, 3 * k + j] = (
                    a * self.shapes.local[p, j]
                    + b * self.shapes.local[p, 3 + j]
                    + c * self.shapes.local[p, 6 + j]
                )
            self.placed[p, 9 + k] = (
                a * self.shapes.local[p, 9]
                + b * self.shapes.local[p, 10]
                + c * self.shapes.local[p, 11]
                + x
            )

    def is_in_view(self, p: int) -> bool:
        """Return whether the bounding sphere of a part is in the view pyramid."""
        mesh = self.shapes.parts[p, MESH_OF_PART]
        a, b, c = (
            self.shapes.spheres[mesh, 0],
            self.shapes.spheres[mesh, 1],
            self.shapes.spheres[mesh, 2],
        )
        reach = self.shapes.spheres[mesh, 3]
        x = (
            self.placed[p, 9]
            + self.placed[p, 0] * a
            + self.placed[p, 1] * b
            + self.placed[p, 2] * c
        )
        y = (
            self.placed[p, 10]
            + self.placed[p, 3] * a
            + self.placed[p, 4] * b
            + self.placed[p, 5] * c
        )
        z = (
            self.placed[p, 11]
            + self.placed[p, 6] * a
            + self.placed[p, 7] * b
            + self.placed[p, 8] * c
        )
        if z + reach < self.near or z - reach > self.far:
            return False
        if self.fx * x + self.cx * z < -reach * self.sides[0]:
            return False
        if (self.width - self.cx) * z - self.fx * x < -reach * self.sides[1]:
            return False
        if self.fy * y + self.cy * z < -reach * self.sides[2]:
            return False
        return not (self.height - self.cy) * z - self.fy * y < -reach * self.sides[3]

    def project(self, p: int) -> None:
        """Find vertices of a part in the camera's frame, and in the picture if they are before it."""
        mesh = self.shapes.parts[p, MESH_OF_PART]
        first = self.shapes.meshes[mesh, FIRST_VERTEX]
        for v in range(self.shapes.meshes[mesh, LAST_VERTEX] - first):
            a, b, c = (
                self.shapes.vertices[first + v, 0],
                self.shapes.vertices[first + v, 1],
                self.shapes.vertices[first + v, 2],
            )
            x = (
                self.placed[p, 0] * a
                + self.placed[p, 1] * b
                + self.placed[p, 2] * c
                + self.placed[p, 9]
            )
            y = (
                self.placed[p, 3] * a
                + self.placed[p, 4] * b
                + self.placed[p, 5] * c
                + self.placed[p, 10]
            )
            z = (
                self.placed[p, 6] * a
                + self.placed[p, 7] * b
                + self.placed[p, 8] * c
                + self.placed[p, 11]
            )
            self.seen[v, 0], self.seen[v, 1], self.seen[v, 2] = x, y, z
            if z >= self.near:
                over = 1.0 / z
                self.spots[v, 0] = self.cx + self.fx * x * over
                self.spots[v, 1] = self.cy + self.fy * y * over

    def draw_part(self, p: int) -> None:
        """Draw the triangles of a part whose vertices are projected."""
        mesh = self.shapes.parts[p, MESH_OF_PART]
        two_sided = self.shapes.meshes[mesh, TWO_SIDED] != 0
        for f in range(self.shapes.meshes[mesh, FIRST_FACE], self.shapes.meshes[mesh, LAST_FACE]):
            i, j, k = self.shapes.faces[f, 0], self.shapes.faces[f, 1], self.shapes.faces[f, 2]
            behind = 0
            behind += self.seen[i, 2] < self.near
            behind += self.seen[j, 2] < self.near
            behind += self.seen[k, 2] < self.near
            if behind == 0:
                self.draw_face(p, f, i, j, k, two_sided)
            elif behind < 3:
                self.draw_cut_face(p, f, i, j, k, two_sided)

    def draw_face(self, p: int, f: int, i: int, j: int, k: int, two_sided: bool) -> None:  # noqa: FBT001
        """Draw a triangle that is all before the camera."""
        ax, ay = self.spots[i, 0], self.spots[i, 1]
        bx, by = self.spots[j, 0], self.spots[j, 1]
        cx, cy = self.spots[k, 0], self.spots[k, 1]
        twice = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
        if twice >= 0.0 and not two_sided:
            return  # seen from behind
        left, right = min(ax, bx, cx), max(ax, bx, cx)
        top, bottom = min(ay, by, cy), max(ay, by, cy)
        if first_middle(left, self.width) >= first_middle(right, self.width):
            return  # no middle of a pixel is in it
        if first_middle(top, self.height) >= first_middle(bottom, self.height):
            return
        if self.find_plane(i, j, k, two_sided):
            self.record(p, f)
            self.fill(ax, ay, bx, by, cx, cy)

    def draw_cut_face(self, p: int, f: int, i: int, j: int, k: int, two_sided: bool) -> None:  # noqa: FBT001
        """Draw the part before the camera of a triangle that is partly behind it."""
        if not self.find_plane(i, j, k, two_sided):
            return
        m = 0
        for side in range(3):
            a = i if side == 0 else (j if side == 1 else k)
            b = j if side == 0 else (k if side == 1 else i)
            here, there = self.seen[a, 2], self.seen[b, 2]
            before, after = here >= self.near, there >= self.near
            if before:
                self.put_cut(m, self.seen[a, 0], self.seen[a, 1], here)
                m += 1
            if before != after:
                t = (self.near - here) / (there - here)
                x = self.seen[a, 0] + t * (self.seen[b, 0] - self.seen[a, 0])
                y = self.seen[a, 1] + t * (self.seen[b, 1] - self.seen[a, 1])
                self.put_cut(m, x, y, self.near)
                m += 1
        if m < 3:
            return
        self.record(p, f)
        for side in range(2, m):
            self.fill(
                self.cut[0, 0],
                self.cut[0, 1],
                self.cut[side - 1, 0],
                self.cut[side - 1, 1],
                self.cut[side, 0],
                self.cut[side, 1],
            )

    def put_cut(self, m: int, x: float, y: float, z: float) -> None:
        """Write down where in the picture a corner of a cut triangle is."""
        self.cut[m, 0] = self.cx + self.fx * x / z
        self.cut[m, 1] = self.cy + self.fy * y / z

    def find_plane(self, i: int, j: int, k: int, two_sided: bool) -> bool:  # noqa: FBT001
        """Find the inverse depth of a triangle's plane in the picture; whether it is seen at all."""
        x0, y0, z0 = self.seen[i, 0], self.seen[i, 1], self.seen[i, 2]
        ax, ay, az = self.seen[j, 0] - x0, self.seen[j, 1] - y0, self.seen[j, 2] - z0
        bx, by, bz = self.seen[k, 0] - x0, self.seen[k, 1] - y0, self.seen[k, 2] - z0
        nx, ny, nz = ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx
        off = nx * x0 + ny * y0 + nz * z0
        if off == 0.0 or (off > 0.0 and not two_sided):
            return False
        self.plane_x, self.plane_y = nx / (off * self.fx), ny / (off * self.fy)
        self.plane_0 = nz / off - self.plane_x * self.cx - self.plane_y * self.cy
        return True

    def record(self, p: int, f: int) -> None:
        """Assign a number to a triangle that is drawn."""
        self.part_of[self.count], self.face_of[self.count] = p, f
        self.slot_of[self.count] = -1
        self.count += 1

    def fill(self, x0: float, y0: float, x1: float, y1: float, x2: float, y2: float) -> None:
        """Draw the last recorded triangle, or a part of it with these corners [pixel]."""
        if y0 > y1 or (y0 == y1 and x0 > x1):
            x0, y0, x1, y1 = x1, y1, x0, y0
        if y1 > y2 or (y1 == y2 and x1 > x2):
            x1, y1, x2, y2 = x2, y2, x1, y1
        if y0 > y1 or (y0 == y1 and x0 > x1):
            x0, y0, x1, y1 = x1, y1, x0, y0
        long = (x2 - x0) / (y2 - y0) if y2 > y0 else 0.0
        upper = (x1 - x0) / (y1 - y0) if y1 > y0 else 0.0
        lower = (x2 - x1) / (y2 - y1) if y2 > y1 else 0.0
        for r in range(first_middle(y0, self.height), first_middle(y2, self.height)):
            middle = r + 0.5
            a = x0 + (middle - y0) * long
            b = x0 + (middle - y0) * upper if middle < y1 else x1 + (middle - y1) * lower
            if a < b:
                self.fill_row(r, a, b)
            else:
                self.fill_row(r, b, a)

    def fill_row(self, r: int, low: float, high: float) -> None:
        """Draw the last triangle in a row of pixels, between two places, where it is nearest."""
        first = first_middle(low, self.width)
        count, mine = first_middle(high, self.width) - first, self.count - 1
        start = 4 * (r * self.width + first)  # bytes: local memory views would count references
        inverse, owner = singles(self.inverse_at + start), integers(self.owner_at + start)
        slope = self.plane_x
        at = self.plane_x * (first + 0.5) + self.plane_y * (r + 0.5) + self.plane_0
        for c in range(count):
            near = at + c * slope
            closer = near > inverse[c]
            inverse[c] = near if closer else inverse[c]
            owner[c] = mine if closer else owner[c]


def first_middle(edge: float, most: int) -> int:
    """Return the first of a given number of pixels whose middle is not before an edge."""
    inside = min(max(edge - 0.5, 0.0), 1.0 * most)
    return cython.cast(cython.int, ceil(inside))  # type: ignore[no-any-return]
