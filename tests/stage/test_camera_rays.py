"""Images of Stage's cameras against exact rays through the centres of pixels."""

import math
from dataclasses import replace

import numpy as np
import pytest
from stage_samples import write

from gazelle.engines.planar import columns as c
from gazelle.stage import StageSimulation, cameras_of
from gazelle.stage.description import StagePose
from gazelle.stage.faces import in_tiles
from gazelle.stage.shapes import blocks_of
from gazelle.stage.stage_devices import models_of

ROWS, COLUMNS = 36, 48
SKY = (179, 179, 204)
FAR = 100.0


def outline(random):
    """Return a star about its middle, as a block."""
    angles, sizes = np.sort(random.uniform(0.0, 2.0 * math.pi, 7)), random.uniform(0.2, 1.2, 7)
    points = sizes[:, None] * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    corners = " ".join(f"point[{k}] [{x:.4f} {y:.4f}]" for k, (x, y) in enumerate(points))
    return f"block ( points {len(points)} {corners} z [0 1] )"


def thing(random, place, more=""):
    """Return a model with such an outline and a colour of its own."""
    x, y = place
    size = " ".join(f"{length:.3f}" for length in random.uniform(0.2, 1.5, 3))
    color = " ".join(f"{part / 255.0:.9f}" for part in random.integers(0, 255, 3))
    z, heading = random.uniform(-0.2, 0.6), random.uniform(-180.0, 180.0)
    return (
        f"( size [{size}] pose [{x:.3f} {y:.3f} {z:.3f} {heading:.2f}] color_rgba [{color} 1] "
        f"{outline(random)} {more} )\n"
    )


def world(seed):
    """Return robots with cameras, and the things around them."""
    random = np.random.default_rng(seed)
    text = ""
    for number in range(3):
        pan, tilt, high = random.uniform(-180, 180), random.uniform(-20, 40), random.uniform(0, 1)
        camera = (
            f"camera ( resolution [{COLUMNS} {ROWS}] fov [75 57] range [0.3 30] "
            f"size [.3 .2 .2] pose [{0.2 * number:.2f} -.1 {high:.3f} 20] "
            f"pantilt [{pan:.2f} {tilt:.2f}] )"
        )
        place = random.normal(0.0, 2.0, 2)
        text += "position " + thing(random, place, f'name "r{number}" {camera}')
    for _ in range(6):
        angle = random.uniform(0.0, 2.0 * math.pi)
        away = random.uniform(3.0, 6.0)
        text += "model " + thing(random, (away * math.cos(angle), away * math.sin(angle)))
    return text


def prisms(model, pose, hidden=-1):
    """Yield outline (n, 2), heights and bytes of a model and all on it.

    Args:
        model: At the origin, or where it stands if it never moves.
        pose: x, y, heading, z of its frame.
        hidden: Which of the models on it is left out.
    """
    x, y, heading, z = pose
    turn = np.array(
        [[math.cos(heading), math.sin(heading)], [-math.sin(heading), math.cos(heading)]]
    )
    for owner, placed in enumerate(model.walk()):
        if owner != hidden:
            color = [round(255.0 * part) for part in placed.model.color[:3]]
            for part in blocks_of(placed):
                ring = np.array(part.points) @ turn + (x, y)
                ends = np.roll(ring, -1, axis=0)
                area = (ring[:, 0] * ends[:, 1] - ring[:, 1] * ends[:, 0]).sum()
                yield (ring if area > 0 else ring[::-1]), part.low + z, part.high + z, color


def inside(points, ring):
    """Return whether points are in an outline, and how far from its edges."""
    odd, margin = np.zeros(len(points), bool), np.full(len(points), np.inf)
    for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
        crossing = (a[1] > points[:, 1]) != (b[1] > points[:, 1])
        with np.errstate(divide="ignore", invalid="ignore"):
            at = a[0] + (points[:, 1] - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
        odd ^= crossing & (points[:, 0] < at)
        along = np.clip(((points - a) @ (b - a)) / ((b - a) @ (b - a)), 0.0, 1.0)
        margin = np.minimum(margin, np.linalg.norm(points - a - along[:, None] * (b - a), axis=1))
    return odd, margin


class Rays:
    """What rays through the middles of pixels meet.

    ``margin`` is how near the ray passes to an edge of anything at that depth [m].
    """

    def __init__(self, eye, heading, tilt, device):
        cos, sin, level, low = np.cos(heading), np.sin(heading), np.cos(tilt), np.sin(tilt)
        axes = np.array(
            [[sin, -cos, 0.0], [-cos * low, -sin * low, -level], [cos * level, sin * level, -low]]
        )
        across, up = (math.tan(angle / 2.0) for angle in device.fov)
        u = ((np.arange(COLUMNS) + 0.5) / COLUMNS * 2.0 - 1.0) * across
        v = ((np.arange(ROWS) + 0.5) / ROWS * 2.0 - 1.0) * up
        grid = np.stack([*np.meshgrid(u, v), np.ones((ROWS, COLUMNS))], axis=-1).reshape(-1, 3)
        self.eye, self.ways = eye, grid @ axes
        self.near, self.far = device.range
        self.depth = np.full(len(grid), np.inf)
        self.color = np.tile(np.array(SKY), (len(grid), 1))
        self.margin = np.full(len(grid), np.inf)

    def meet(self, normal, offset, color, covers):
        """Add a plane that is seen from its front, with its covered part."""
        facing = self.ways @ normal
        with np.errstate(divide="ignore", invalid="ignore"):
            depth = (offset - self.eye @ normal) / facing
        ahead = (facing < 0) & (depth > 0) & np.isfinite(depth)
        places = self.eye + np.where(ahead, depth, 0.0)[:, None] * self.ways
        there, margin = covers(places)
        margin = np.minimum(margin, np.abs(depth - self.near))
        self.margin = np.where(ahead, np.minimum(self.margin, margin), self.margin)
        met = ahead & there & (depth >= self.near) & (depth < min(self.far, FAR))
        met &= depth < self.depth
        self.depth[met], self.color[met] = depth[met], color

    def meet_prism(self, ring, low, high, color):
        """Add all sides of a prism on an outline."""
        for a, b in zip(ring, np.roll(ring, -1, axis=0), strict=True):
            length = np.linalg.norm(b - a)
            along = (b - a) / length
            normal = np.array([along[1], -along[0], 0.0])

            def covers(places, a=a, along=along, length=length):
                share, z = (places[:, :2] - a) @ along, places[:, 2]
                sides = np.stack((share, length - share, z - low, high - z))
                return (sides > 0).all(axis=0), np.abs(sides).min(axis=0)

            self.meet(normal, normal[:2] @ a, color, covers)
        for height, up in ((high, 1.0), (low, -1.0)):
            level = np.array([0.0, 0.0, up])
            self.meet(level, up * height, color, lambda places: inside(places[:, :2], ring))

    def meet_ground(self):
        """Add the infinite ground."""
        endless = np.full(len(self.ways), np.inf)
        up = np.array([0.0, 0.0, 1.0])
        self.meet(up, 0.0, (255, 255, 255), lambda _: (np.isinf(endless), endless))


def seen_by_rays(sim, robot, number):
    """Return the rays of a robot's camera in a world."""
    (camera,) = cameras_of(robot)
    poses = sim.fleet.rows.reshape(sim.nworld, sim.fleet.nbody, -1)[number][
        :, [c.X, c.Y, c.YAW, c.Z]
    ]
    x, y, heading, z = poses[camera.body]
    cos, sin = math.cos(heading), math.sin(heading)
    at, (pan, tilt) = camera.pose, camera.device.pantilt
    eye = np.array((x + cos * at.x - sin * at.y, y + sin * at.x + cos * at.y, z + at.z))
    rays = Rays(eye, heading + at.yaw - pan, tilt, camera.device)
    rays.meet_ground()
    for model in sim.still:
        for prism in prisms(model, (0.0, 0.0, 0.0, 0.0)):
            rays.meet_prism(*prism)
    for body, model in enumerate(models_of(sim)):
        hidden = camera.owner if body == camera.body else -1
        for prism in prisms(replace(model, pose=StagePose()), poses[body], hidden):
            rays.meet_prism(*prism)
    return rays


@pytest.mark.parametrize("seed", range(8))
def test_pixels_are_what_rays_through_their_middles_meet(start, seed):
    sim = start(world(seed), nworld=2)
    random = np.random.default_rng(seed)
    for robot in sim.robots:
        sim.set_pose(
            robot.name, (*random.normal(0.0, 2.0, 2), random.uniform(-3, 3)), np.array([1])
        )
    found, compared = sim.pictures(), 0
    for number in range(2):
        for k, robot in enumerate(sim.robots):
            rays = seen_by_rays(sim.stage_fleet, robot, number)
            sure = rays.margin > 1e-4
            compared += sure.sum()
            depth = found.depth[number, k].ravel()[sure]
            np.testing.assert_array_equal(np.isinf(depth), np.isinf(rays.depth[sure]))
            there = np.isfinite(depth)
            assert np.abs(depth[there] - rays.depth[sure][there]).max(initial=0.0) < 1e-3
            color = found.color[number, k, ..., :3].reshape(-1, 3)[sure]
            np.testing.assert_array_equal(color, rays.color[sure])
    assert compared > 0.97 * found.depth.size
    assert (found.color[..., 3] == 255).all()


def test_pictures_do_not_depend_on_threads(tmp_path):
    seen = []
    for threads in (1, 3):
        with StageSimulation(write(tmp_path, world(0)), threads=threads, nworld=5) as sim:
            sim.set_pose("r0", (1.0, -1.0, 0.5), np.array([2]))
            seen.append(sim.pictures())
    np.testing.assert_array_equal(seen[0].color, seen[1].color)
    np.testing.assert_array_equal(seen[0].depth, seen[1].depth)


def test_what_is_drawn_together_is_what_is_drawn_alone(start):
    sim = start(world(3), nworld=2)
    wanted = [(f"r{robot}", 0, number) for robot in (2, 0) for number in (1, 0)]
    sim.draw(wanted)
    together = [sim.picture(*key) for key in wanted]
    sim.set_pose("r1", sim.poses[0, 1])  # all is drawn anew, and nothing has moved
    for key, seen in zip(wanted, together, strict=True):
        alone = sim.picture(*key)
        assert alone is not seen
        np.testing.assert_array_equal(alone.color, seen.color)
        np.testing.assert_array_equal(alone.depth, seen.depth)


def test_the_ground_has_no_end(start):
    camera = "camera ( resolution [5 5] fov [60 60] range [1 90000] pantilt [0 0] )"
    sim = start(
        f'position ( name "r" size [.2 .2 2] pose [3e5 -2e5 0 45] {camera} )'.replace("e5", "00000")
    )
    depth = sim.picture("r").depth
    focal = 2.5 / math.tan(math.radians(30))
    assert depth[3] == pytest.approx(2.0 * focal / 1.0, rel=1e-5)
    assert np.isinf(depth[:3]).all()


def test_tiles_hold_all_faces_once():
    random = np.random.default_rng(0)
    faces = random.normal(0.0, 3.0, (301, 4, 3))
    tiles = in_tiles(faces, 16)
    assert max(map(len, tiles)) <= 16
    together = np.vstack(tiles)
    order = np.lexsort(faces.reshape(301, -1).T), np.lexsort(together.reshape(301, -1).T)
    np.testing.assert_array_equal(faces[order[0]], together[order[1]])
