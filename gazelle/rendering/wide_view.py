"""Pictures through lenses that bend lines: mixed from six flat ones around the camera.

N. Greene, "Environment mapping and other applications of world projections", 1986; Gazebo's way.
"""

from __future__ import annotations

import math

import numpy as np

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Bytes, Floats, Worlds
from gazelle.errors import EngineError
from gazelle.rendering.bilinear import PixelMeans
from gazelle.rendering.lens import PinholeLens
from gazelle.rendering.live_scene import LiveScene
from gazelle.rendering.wide_lens import WideLens
from gazelle.rotations import multiply, rotate

_HALF = math.sqrt(0.5)
_TURNS = np.array(  # of each face: x, y, z, w
    [
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 0.0],
        [0.0, 0.0, _HALF, _HALF],
        [0.0, 0.0, -_HALF, _HALF],
        [0.0, -_HALF, 0.0, _HALF],
        [0.0, _HALF, 0.0, _HALF],
    ]
)
# Forward, left and up of each face in the camera's frame, shape (6, 3, 3).
_FACES = np.rint(rotate(_TURNS[:, None], np.eye(3)))
_BORDER = 1  # pixels around a face that its neighbours show too, so that there are no seams
_DARK = 0.2  # of the light beyond the cutoff, as in Gazebo's shader


@checked(EngineError)
class WideView:
    """Draws what cameras with one wide lens see.

    Args:
        lens: Of all of them.
    """

    def __init__(self, lens: WideLens) -> None:
        directions, beyond = lens.rays()
        seen: Bools = np.asarray(np.isfinite(directions).all(axis=-1), np.bool_)
        along = np.where(seen[..., None], directions, _FACES[0, 0])
        face = np.argmax(along @ _FACES[:, 0].T, axis=-1)
        used, number = np.unique(face, return_inverse=True)
        axes = _FACES[face]
        depth = np.einsum("ijk,ijk->ij", along, axes[..., 0, :])
        across = np.einsum("ijk,ijnk->ijn", along, axes[..., 1:, :])
        side = lens.face + 2 * _BORDER
        places = 0.5 * lens.face * (1.0 - across / depth[..., None]) - 0.5 + _BORDER
        first = number.reshape(face.shape) * side * side
        self._means = PixelMeans.about(places, seen, (side, side), first)
        self._turns = _TURNS[used]
        fov = 2.0 * math.atan(side / lens.face)
        self._face = PinholeLens(side, side, fov, lens.near, lens.far)
        self._light = np.where(beyond, _DARK, 1.0)[..., None]

    def color(
        self, scene: LiveScene, positions: Floats, quaternions: Floats, worlds: Worlds
    ) -> Bytes:
        """Render one camera in each of some worlds, shape (n, height, width, 3).

        Args:
            scene: Draws.
            positions: Of the cameras [m], shape (n, 3).
            quaternions: x, y, z, w, shape (n, 4).
            worlds: Their worlds, shape (n,).
        """
        count, faces = len(positions), len(self._turns)
        at = np.repeat(positions, faces, axis=0)
        turned = multiply(np.repeat(quaternions, faces, axis=0), np.tile(self._turns, (count, 1)))
        flat = scene.render(self._face, at, turned, np.repeat(worlds, faces), want=("color",)).color
        mixed = self._means.of(flat.reshape(count, -1, 3))
        return np.asarray(np.rint(mixed * self._light), np.uint8)
