"""Rays that frames carry, against quaternions in NumPy."""

import numpy as np
import pytest

from gazelle.native.ray_frames import FrameRays
from gazelle.rotations import rotate


@pytest.mark.parametrize(("nworld", "frames", "rays"), [(1, 1, 1), (1, 3, 5), (4, 2, 7)])
def test_rays_go_with_their_frames(nworld, frames, rays):
    rng = np.random.default_rng(rays)
    quaternion = rng.normal(size=(nworld, frames, 4))
    quaternion /= np.linalg.norm(quaternion, axis=-1, keepdims=True)
    position, beside = rng.normal(size=(nworld, frames, 3)), rng.normal(size=3)
    origins, directions = rng.normal(size=(2, frames, rays, 3))
    for each in (position, quaternion, origins, directions):
        each.flags.writeable = False
    carried = FrameRays(origins, directions, nworld)
    carried.aim(position, quaternion, beside)
    turned = quaternion[:, :, None]
    wanted = position[:, :, None] + beside + rotate(turned, origins[None])
    np.testing.assert_allclose(carried.start, wanted.reshape(nworld, -1, 3), atol=1e-14)
    wanted = rotate(turned, directions[None])
    np.testing.assert_allclose(carried.along, wanted.reshape(nworld, -1, 3), atol=1e-14)


@pytest.mark.parametrize("signed", [False, True])
def test_what_is_met_from_inside_faces_away_and_has_an_inside(signed):
    along = np.tile([1.0, 0.0, 0.0], (1, 4, 1))
    rays = FrameRays(np.zeros((1, 4, 3)), along, 1)
    rays.aim(np.zeros((1, 1, 3)), np.array([[[0.0, 0.0, 0.0, 1.0]]]), np.zeros(3))
    rays.normal[:] = [[-1.0, 0, 0], [0.5, 0.5, 0], [1.0, 0, 0], [0.0, 0, 0]]
    rays.distance[:] = [2.0, 3.0, 4.0, -1.0]
    rays.geom[:] = [0, 0, 1, -1]
    rays.settle(np.array([False, True]), signed=signed)
    assert rays.inside.tolist() == [[False, True, False, False]]
    assert rays.distance.tolist() == [[2.0, -np.inf if signed else 3.0, 4.0, np.inf]]
