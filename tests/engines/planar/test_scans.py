"""Ranges of beams against exact geometry."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.engines.planar import Body, Fan, Fleet, Mount, PlanarPart, RangeNoise, Scanner
from gazelle.errors import EngineError

shapely = pytest.importorskip("shapely")

SEEDS = st.integers(0, 2**32 - 1)
FANS = [
    Fan(-math.pi, 2 * math.pi / 24, 24, 6.0),
    Fan(0.0, 2 * math.pi / 359, 360, 6.0),
    Fan.spread(math.radians(58.0), 640, 6.5),
    Fan.spread(math.pi, 180, 8.0),
    Fan(2.0, 0.03, 77, 5.0),
    Fan(0.0, 1.0, 1, 9.0),
]


def polygon(rng, size=1.0):
    """Return a convex polygon about the origin."""
    angles = np.sort(rng.uniform(0.0, 2 * math.pi, rng.integers(3, 8)))
    radius = size * rng.uniform(0.3, 1.0)
    return tuple((radius * math.cos(a), radius * math.sin(a)) for a in angles)


def moved(points, x, y, yaw):
    c, s = math.cos(yaw), math.sin(yaw)
    return [(x + c * px - s * py, y + s * px + c * py) for px, py in points]


def nearest(lines, circles, x, y, angle, reach, begin=0.0):
    """Return distance along a ray to the nearest line or circle, by shapely and in closed form."""
    dx, dy = math.cos(angle), math.sin(angle)
    far = (x + dx * (reach + 1.0), y + dy * (reach + 1.0))
    met = shapely.LineString([(x + begin * dx, y + begin * dy), far]).intersection(lines)
    best = reach
    if not met.is_empty:
        best = min(best, shapely.Point(x, y).distance(met))
    for cx, cy, radius in circles:
        along, aside = dx * (cx - x) + dy * (cy - y), dx * (cy - y) - dy * (cx - x)
        rest = radius**2 - aside**2
        for t in (along - math.sqrt(max(rest, 0.0)), along + math.sqrt(max(rest, 0.0))):
            if rest >= 0.0 and begin <= t < best:
                best = t
    return best


@given(seed=SEEDS, fan=st.sampled_from(FANS), many=st.booleans(), begin=st.sampled_from([0.0, 0.4]))
@settings(max_examples=30, deadline=None)
def test_ranges_are_exact_to_a_nanometre(seed, fan, many, begin):
    rng = np.random.default_rng(seed)
    fan = Fan(fan.start, fan.step, fan.count, fan.reach, begin)
    statics, rings, circles = [], [], []
    for _ in range(60 if many else 6):
        points = moved(polygon(rng), *rng.uniform(-9.0, 9.0, 2), 0.0)
        rings.append(shapely.LinearRing(points))
        statics.append(PlanarPart(tuple(points)))
    for _ in range(20 if many else 3):
        x, y = rng.uniform(-9.0, 9.0, 2)
        circles.append((x, y, rng.uniform(0.05, 0.5)))
        statics.append(PlanarPart.circle(*circles[-1]))
    ends = rng.uniform(-9.0, 9.0, (2, 2))
    rings.append(shapely.LineString(ends))
    statics.append(PlanarPart(tuple(map(tuple, ends)), closed=False))
    bodies = [Body((PlanarPart.box(0.1, 0.1),), tuple(rng.uniform(-4.0, 4.0, 3)))]
    for _ in range(8):
        pose = rng.uniform(-5.0, 5.0, 3)
        shape = polygon(rng, 0.4)
        rings.append(shapely.LinearRing(moved(shape, *pose)))
        bodies.append(Body((PlanarPart(shape),), tuple(pose)))
    fleet = Fleet(bodies, statics)
    mount = Mount(0, 0.05, -0.02, 0.3)
    ranges = Scanner(fleet, fan, [mount]).scan()[0, 0]
    x, y, yaw = bodies[0].pose
    ((sx, sy),) = moved([(mount.x, mount.y)], x, y, yaw)
    lines = shapely.union_all(rings)
    chosen = rng.choice(fan.count, min(fan.count, 40), replace=False)
    for k in chosen:
        true = nearest(lines, circles, sx, sy, yaw + mount.yaw + fan.angles[k], fan.reach, begin)
        assert ranges[k] == pytest.approx(true, abs=1e-9)


@pytest.mark.parametrize("resolution", [0.02, 0.05, 0.1])
def test_a_box_of_ten_metres_is_no_worse_than_stages(resolution):
    """Stage 4.3 is 4.0 mm off on average at 0.02 m; here resolution does not matter."""
    rng = np.random.default_rng(7)
    poses = np.hstack((rng.uniform(-4.5, 4.5, (20, 2)), rng.uniform(-3.0, 3.0, (20, 1))))
    wall = PlanarPart(((-5.0, -5.0), (5.0, -5.0), (5.0, 5.0), (-5.0, 5.0)))
    fleet = Fleet([Body((), tuple(pose), family=1) for pose in poses], [wall], cell=resolution * 20)
    fan = Fan.spread(2 * math.pi, 361, 30.0)
    ranges = Scanner(fleet, fan, [Mount(i) for i in range(20)]).scan()[0]
    angles = poses[:, 2:] + fan.angles
    dx, dy = np.cos(angles), np.sin(angles)
    tx = (np.sign(dx) * 5.0 - poses[:, 0:1]) / dx
    ty = (np.sign(dy) * 5.0 - poses[:, 1:2]) / dy
    assert np.abs(ranges - np.minimum(tx, ty)).max() < 1e-9


def test_a_body_sees_no_one_of_its_family_and_all_others():
    ring = PlanarPart.box(1.0, 1.0)
    bodies = [
        Body((ring,), (0.0, 0.0, 0.0), family=3),
        Body((ring,), (2.0, 0.0, 0.0), family=3),
        Body((ring,), (4.0, 0.0, 0.0)),
    ]
    scanner = Scanner(Fleet(bodies), Fan(0.0, 1.0, 1, 9.0), [Mount(0)], named=True)
    assert scanner.scan()[0, 0, 0] == pytest.approx(3.5)


def test_rays_pass_over_what_is_low_and_what_is_invisible():
    low = PlanarPart.box(1.0, 1.0, x=2.0)
    parts = [
        PlanarPart(low.points, low=0.0, high=0.3),
        PlanarPart(PlanarPart.box(1.0, 1.0, x=4.0).points, glow=-1.0),
        PlanarPart(PlanarPart.box(1.0, 1.0, x=6.0).points, low=0.0, high=1.0, glow=7.0, tag=42),
    ]
    fleet = Fleet([Body((), z=0.1)], parts)
    fan = Fan(0.0, 1.0, 1, 9.0)
    assert Scanner(fleet, fan, [Mount(0, z=0.1)]).scan()[0, 0, 0] == pytest.approx(1.5)
    over = Scanner(fleet, fan, [Mount(0, z=0.4)], named=True)
    assert over.scan()[0, 0, 0] == pytest.approx(5.5)
    assert over.glows()[0, 0, 0] == 7.0
    assert over.tags()[0, 0, 0] == 42
    assert over.bodies()[0, 0, 0] == -1


def test_what_is_met_is_told():
    bodies = [Body(()), Body((PlanarPart(((0.0, 0.0),), 0.5, glow=3.0, tag=9),), (2.0, 0.0, 0.0))]
    scanner = Scanner(Fleet(bodies, nworld=2), Fan.spread(6.0, 25, 9.0), [Mount(0)], named=True)
    scanner.scan()
    assert scanner.bodies()[1, 0, 12] == 1
    assert scanner.glows()[1, 0, 12] == 3.0
    assert scanner.tags()[1, 0, 12] == 9
    assert scanner.bodies()[1, 0, 0] == -1
    assert scanner.glows()[1, 0, 0] == 0.0


def test_some_worlds_are_scanned_alone():
    fleet = Fleet([Body((), (0.0, 0.0, 0.0))], [PlanarPart.circle(3.0, 0.0, 1.0)], nworld=4)
    fleet.place(0, [[0.5 * w, 0.0, 0.0] for w in range(4)])
    scanner = Scanner(fleet, Fan(0.0, 1.0, 1, 9.0), [Mount(0)])
    assert scanner.scan()[:, 0, 0] == pytest.approx([2.0, 1.5, 1.0, 0.5])
    assert scanner.scan(np.array([1, 3]))[:, 0, 0] == pytest.approx([1.5, 0.5])


def test_a_scan_from_inside_meets_the_far_side_from_inside():
    fleet = Fleet([Body(())], [PlanarPart.circle(0.2, 0.0, 1.0)])
    scanner = Scanner(fleet, Fan.spread(6.0, 99, 9.0), [Mount(0)], named=True)
    assert scanner.scan()[0, 0, 49] == pytest.approx(1.2)
    assert (scanner.names < 0.0).all()


def test_noise_has_its_deviation_and_is_the_same_again():
    wall = PlanarPart(((4.0, -50.0), (4.0, 50.0)), closed=False)

    def measure(seed):
        fleet = Fleet([Body(())], [wall])
        noise = RangeNoise(0.02, 0.01)
        scanner = Scanner(fleet, Fan.spread(1e-3, 2000, 9.0), [Mount(0)], noise=noise, seed=seed)
        return np.array([scanner.scan()[0, 0].copy() for _ in range(5)])

    first = measure(1)
    assert (first == measure(1)).all()
    assert (first != measure(2)).any()
    assert (first[0] != first[1]).any()
    assert first.mean() == pytest.approx(4.0, abs=0.003)
    assert first.std() == pytest.approx(0.06, rel=0.05)


def test_a_fan_that_cannot_be_is_refused():
    fleet = Fleet([Body(())])
    with pytest.raises(EngineError, match="must be a finite number"):
        Fan(0.0, 1.0, 1, math.inf)
    with pytest.raises(EngineError, match="finite reach"):
        Scanner(fleet, Fan(0.0, 1.0, 1, 0.0), [Mount(0)])
    with pytest.raises(EngineError, match="once around"):
        Scanner(fleet, Fan(0.0, 0.1, 100, 3.0), [Mount(0)])
    with pytest.raises(EngineError, match=r"bodies must be from 0 to 0, not \[3\]"):
        Scanner(fleet, FANS[0], [Mount(3)])
    with pytest.raises(EngineError, match="too many"):
        Scanner(fleet, Fan(0.0, 1e-9, 2**30, 3.0), [Mount(0)])
    with pytest.raises(EngineError, match="in 1 worlds, not in 9"):
        Scanner(fleet, FANS[0], [Mount(0)]).scan(np.zeros(9, np.intp))


def test_a_crowd_of_statics_hides_none_that_can_be_seen():
    rng = np.random.default_rng(5)
    lines = rng.uniform(-12.0, 12.0, (700, 2))
    ends = lines + rng.uniform(-0.8, 0.8, lines.shape)
    statics = [
        PlanarPart((tuple(a), tuple(b)), closed=False) for a, b in zip(lines, ends, strict=True)
    ]
    poses = [(0.0, 0.0, 0.3), (-11.9, 3.0, 0.0), (14.0, -2.0, 3.0), (5.0, 13.5, -1.6)]
    fleet = Fleet([Body((), pose) for pose in poses], statics)
    mounts = [Mount(i) for i in range(len(poses))]
    whole = Scanner(fleet, Fan(-math.pi, 2 * math.pi / 500, 500, 30.0), mounts).scan()[0].copy()
    reach = np.stack((lines, ends), axis=1)
    union = shapely.union_all([shapely.LineString(each) for each in reach])
    for (x, y, yaw), ranges in zip(poses, whole, strict=True):
        for k in range(0, 500, 9):
            true = nearest(union, [], x, y, yaw - math.pi + 2 * math.pi / 500 * k, 30.0)
            assert ranges[k] == pytest.approx(true, abs=1e-9)


def test_single_beams_measure_what_fans_do():
    rng = np.random.default_rng(6)
    statics = [
        PlanarPart.box(*rng.uniform(0.1, 0.6, 2), *rng.uniform(-9.0, 9.0, 2)) for _ in range(80)
    ]
    bodies = [
        Body((PlanarPart.circle(0.1, 0.0, 0.3),), tuple(rng.uniform(-9.0, 9.0, 3)))
        for _ in range(60)
    ]
    fleet = Fleet(bodies, statics)
    mounts = [Mount(i, yaw=yaw) for i in range(60) for yaw in (0.0, 0.25 * math.pi, 2.0)]
    many = Scanner(fleet, Fan(0.0, 0.01, 60, 7.0), mounts, named=True)
    few = Scanner(fleet, Fan(0.0, 0.01, 5, 7.0), mounts, named=True)
    assert few.scan()[0] == pytest.approx(many.scan()[0, :, :5], abs=1e-9)
    assert (few.bodies() == many.bodies()[..., :5]).all()
