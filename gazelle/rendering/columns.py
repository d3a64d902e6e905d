"""Columns of the tables that pictures are drawn from."""

from __future__ import annotations

from typing import Final

# Kinds of lamps.
DIRECTIONAL: Final = 0
POINT: Final = 1
SPOT: Final = 2

# Lamps: kind; place [m]; direction of the light, of unit length; red, green and blue; how far it
# reaches [m]; the three factors of its fading; cosines of half of a spot's inner and outer cones.
KIND: Final = 0
ALONG: Final = 4
COLOR: Final = 7
REACH: Final = 10
CONSTANT: Final = 11
LINEAR: Final = 12
QUADRATIC: Final = 13
INNER: Final = 14
OUTER: Final = 15
LAMP: Final = 16

# Cameras: number of the world; place [m]; the directions of right, down and forward in the world;
# number of the link that the camera does not see, or -1.
UNSEEN: Final = 13
CAMERA: Final = 14

# Meshes: their first vertex and the one after the last, the same of faces, whether both sides show.
FIRST_VERTEX: Final = 0
LAST_VERTEX: Final = 1
FIRST_FACE: Final = 2
LAST_FACE: Final = 3
TWO_SIDED: Final = 4
MESH: Final = 5

# Parts: what shape, on which link, what number it has in pictures of labels, and the number of the
# texture on it, or -1.
MESH_OF_PART: Final = 0
LINK_OF_PART: Final = 1
LABEL_OF_PART: Final = 2
TEXTURE_OF_PART: Final = 3
PART: Final = 4

# Textures: where their first pixel is among all, columns and rows.
FIRST_TEXEL: Final = 0
TEXTURE_WIDTH: Final = 1
TEXTURE_HEIGHT: Final = 2
TEXTURE: Final = 3
