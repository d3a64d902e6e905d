"""What the columns of the tables mean that pictures are drawn from."""

from __future__ import annotations

from typing import Final

# Faces: four corners x, y, z [m] around a convex polygon, counter-clockwise seen from its front,
# the first of a triangle twice; red, green and blue from 0 to 255; and a number of the thing
# that it is a face of. From behind, where it is solid, nothing is seen.
RED: Final = 12
OWNER: Final = 15
FACE: Final = 16

# Cameras: place [m]; the directions of right, down and forward in the world; index of the body
# that carries it, counted through all worlds; the owner of faces on it that are not drawn.
RIGHT: Final = 3
DOWN: Final = 6
AHEAD: Final = 9
CARRIER: Final = 12
UNSEEN: Final = 13
CAMERA: Final = 14

# Lenses: pixels a unit of slope along rows and columns, nearest and farthest depth [m].
FX: Final = 0
FY: Final = 1
NEAREST: Final = 2
FARTHEST: Final = 3
LENS: Final = 4
