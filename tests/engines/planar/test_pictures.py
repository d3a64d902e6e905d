"""Pictures in the plane, against rays through the middles of pixels, and in every build."""

import hashlib
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from gazelle import EngineError, native
from gazelle.engines.planar import Body, Fleet, PlanarPart
from gazelle.engines.planar.pictures import CameraMount, Lens, Painter, Scenery, prism

LENS = Lens(48, 36, (1.3, 1.0), 0.3, 30.0)
WORLDS = np.arange(2, dtype=np.intp)


def outline(random, away):
    """A star about a point that is far from the cameras' worlds' middle, or not."""
    angles = np.sort(random.uniform(0.0, 2.0 * math.pi, 7))
    sizes = random.uniform(0.2, 1.2, 7)
    middle = away * np.array((math.cos(angles[0]), math.sin(angles[0])))
    return middle + sizes[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)


def painted(seed, threads=1):
    """A painter of two worlds with three bodies, its views, and its scenery."""
    random = np.random.default_rng(seed)
    fleet = Fleet([Body((PlanarPart.circle(0.0, 0.0, 0.1),))] * 3, nworld=2, threads=threads)
    for body in range(3):
        fleet.place(body, random.normal(0.0, 2.0, (2, 3)))

    def thing(owner, away):
        low, color = random.uniform(-0.2, 1.0), tuple(random.integers(0, 255, 3))
        return prism(outline(random, away), low, low + random.uniform(0.1, 1.5), color, owner)

    still = np.vstack([thing(-1, 4.0) for _ in range(6)])
    looks = [np.vstack((thing(0, 0.0), thing(1, 1.0))) for _ in range(2)]
    scenery = Scenery(still, [looks[0], looks[1], looks[0]])
    views = [
        CameraMount(body, *random.normal(0.0, 0.2, 2), random.uniform(0.2, 2.0), yaw, pitch, unseen)
        for body, yaw, pitch, unseen in ((0, 0.5, 0.0, 0), (2, -2.0, 0.4, -1), (1, 3.0, -0.2, 1))
    ]
    return Painter(fleet, scenery), views, scenery


def in_world(faces, pose):
    """Corners of faces of a body, shape (n, 4, 3)."""
    corners = faces[:, :12].reshape(-1, 4, 3)
    cos, sin = math.cos(pose[2]), math.sin(pose[2])
    turn = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return corners @ turn.T + (pose[0], pose[1], 0.0)


def rays(fleet, scenery, view, world):
    """What rays meet: colours, depths, and how far from any edge of a face they pass."""
    poses = [fleet.rows[world * 3 + body, :3] for body in range(3)]
    corners, colors = [scenery.still[:, :12].reshape(-1, 4, 3)], [scenery.still[:, 12:15]]
    for body, faces in enumerate(scenery.bodies):
        shown = faces[(faces[:, 15] != view.unseen) | (body != view.body)]
        corners.append(in_world(shown, poses[body]))
        colors.append(shown[:, 12:15])
    x, y, heading = poses[view.body]
    cos, sin = math.cos(heading), math.sin(heading)
    eye = np.array((x + cos * view.x - sin * view.y, y + sin * view.x + cos * view.y, view.z))
    yaw, low, level = heading + view.yaw, math.sin(view.pitch), math.cos(view.pitch)
    cos, sin = math.cos(yaw), math.sin(yaw)
    axes = np.array(
        [[sin, -cos, 0.0], [-cos * low, -sin * low, -level], [cos * level, sin * level, -low]]
    )
    floor = 100.0 * np.array([[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0]])
    quads = (np.vstack((*corners, floor[None])) - eye) @ axes.T
    shades = np.vstack((*colors, [scenery.floor]))
    u = (np.arange(LENS.width) + 0.5 - LENS.width / 2) / LENS.focal[0]
    v = (np.arange(LENS.height) + 0.5 - LENS.height / 2) / LENS.focal[1]
    ways = np.stack([*np.meshgrid(u, v), np.ones((LENS.height, LENS.width))], axis=-1)
    depth = np.full(ways.shape[:2], np.inf)
    color = np.tile(np.array(scenery.sky), (*ways.shape[:2], 1))
    margin = np.full(ways.shape[:2], np.inf)
    for quad, shade in zip(quads, shades, strict=True):
        normal = np.cross(quad[2] - quad[0], quad[3] - quad[1])
        if normal @ normal < 1e-18:
            continue  # without area
        with np.errstate(divide="ignore", invalid="ignore"):
            far = (normal @ quad[0]) / (ways @ normal)
        edges = [np.cross(quad[k], quad[(k + 1) % 4]) for k in range(4)]
        sides = np.stack([-(ways @ e) / np.linalg.norm(e) for e in edges if e @ e > 1e-18])
        inside = sides.min(axis=0)
        margin = np.minimum(margin, np.abs(sides).min(axis=0))
        margin = np.minimum(margin, np.abs(far - LENS.near))
        met = (inside > 0) & (normal @ quad[0] < 0) & (far >= LENS.near) & (far < LENS.far)
        met &= far < depth
        depth[met], color[met] = far[met], shade
    return color, depth, margin


@pytest.mark.parametrize("seed", range(8))
def test_pixels_are_what_rays_through_their_middles_meet(seed):
    painter, views, scenery = painted(seed)
    found = painter.draw(LENS, views, WORLDS)
    compared = 0
    for world in WORLDS:
        for k, view in enumerate(views):
            color, depth, margin = rays(painter.fleet, scenery, view, world)
            sure = margin > 1e-9
            compared += sure.sum()
            np.testing.assert_allclose(found.depth[world, k][sure], depth[sure], rtol=1e-6)
            np.testing.assert_array_equal(found.color[world, k, ..., :3][sure], color[sure])
    assert compared > 0.99 * found.depth.size
    assert (found.color[..., 3] == 255).all()


def digest(threads=1):
    hashed = hashlib.sha256()
    for seed in range(3):
        painter, views, _ = painted(seed, threads)
        found = painter.draw(LENS, views, WORLDS)
        hashed.update(found.color.tobytes() + found.depth.tobytes())
        painter.fleet.close()
    return hashed.hexdigest()


def test_pictures_do_not_depend_on_threads():
    assert digest(1) == digest(3)


@pytest.mark.long
@pytest.mark.parametrize("build", ["baseline", "avx2", "python"])
def test_pictures_do_not_depend_on_the_build(build):
    if build == "avx2" and native.BUILD != "avx2":
        pytest.skip("this processor has no AVX2")
    done = subprocess.run(
        [sys.executable, __file__],
        env=os.environ | {"GAZELLE_NATIVE": build},
        check=True,
        capture_output=True,
        text=True,
    )
    assert done.stdout.strip() == digest()


def test_a_scenery_is_of_the_bodies_that_there_are():
    painter, _, scenery = painted(0)
    with pytest.raises(EngineError, match="2 looks for 3 bodies"):
        Painter(painter.fleet, Scenery(scenery.still, scenery.bodies[:2]))


if __name__ == "__main__":
    print(digest())
