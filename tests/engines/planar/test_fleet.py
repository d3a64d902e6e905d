"""Motion of bodies, which never overlap."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, PlanarPart, RangeNoise, Scanner
from gazelle.engines.planar.roaming import Roaming, RoamingSettings
from gazelle.errors import EngineError

shapely = pytest.importorskip("shapely")

SPEEDS = st.floats(-1.5, 1.5)


def one(drive, pose=(0.0, 0.0, 0.0), **options):
    return Fleet([Body((PlanarPart.box(0.3, 0.2),), pose, drive=drive)], **options)


@given(v=SPEEDS, w=SPEEDS, yaw=st.floats(-3.0, 3.0), dt=st.sampled_from([0.01, 0.1, 1.0]))
@settings(max_examples=50, deadline=None)
def test_an_arc_is_exact(v, w, yaw, dt):
    fleet = one(Drive(), (1.0, -2.0, yaw), time_step=dt)
    fleet.command[:] = v, 0.7, w
    fleet.step(20)
    x, y, heading = fleet.pose[0, 0]
    t = 20 * dt
    if abs(w) < 1e-9:
        expected = 1.0 + v * t * math.cos(yaw), -2.0 + v * t * math.sin(yaw)
    else:
        r = v / w
        expected = (
            1.0 + r * (math.sin(yaw + w * t) - math.sin(yaw)),
            -2.0 - r * (math.cos(yaw + w * t) - math.cos(yaw)),
        )
    assert (x, y) == pytest.approx(expected, abs=1e-9 * max(1.0, abs(v / w) if w else 1.0))
    assert math.remainder(heading - yaw - w * t, 2 * math.pi) == pytest.approx(
        0.0, abs=1e-12 * t + 1e-12
    )


@pytest.mark.parametrize("nworld", [1, 3])
def test_a_fleet_of_nothing_steps(nworld):
    fleet = Fleet([], nworld=nworld)
    fleet.step(5)
    assert fleet.pose.shape == (nworld, 0, 3)


@pytest.mark.parametrize("kinds", ["one", "many"])
def test_each_body_goes_by_its_own_drive_in_every_world(kinds):
    """Bodies share a drive or have each their own; rows of worlds may be divided anywhere."""
    drives = [Drive(), Drive("omni"), None, Drive()] if kinds == "many" else [Drive("omni")] * 4
    part = (PlanarPart.box(0.3, 0.2),)
    bodies = [Body(part, (3.0 * i, 0.0, 0.0), drive=drive) for i, drive in enumerate(drives)]
    fleet = Fleet(bodies, nworld=3)
    fleet.command[:, :, 1] = [[0.1], [0.2], [0.3]]
    fleet.step(10)
    sideways = [0.0, 1.0, 0.0, 0.0] if kinds == "many" else [1.0] * 4
    expected = np.outer([0.1, 0.2, 0.3], sideways)
    assert fleet.pose[:, :, 1] == pytest.approx(expected)


def test_stages_way_goes_straight_and_then_turns():
    fleet = one(Drive(), euler=True)
    fleet.command[:] = 1.0, 0.0, 1.0
    fleet.step(2)
    expected = 0.1 + 0.1 * math.cos(0.1), 0.1 * math.sin(0.1), 0.2
    assert fleet.pose[0, 0] == pytest.approx(expected)


def test_only_an_omnidirectional_drive_goes_sideways():
    moved = []
    for kind in ("diff", "omni"):
        fleet = one(Drive(kind))
        fleet.command[:] = 0.0, 1.0, 0.0
        fleet.step(10)
        moved.append(fleet.pose[0, 0, 1])
    assert moved == pytest.approx([0.0, 1.0])


def test_a_car_goes_around_its_circle():
    fleet = one(Drive("car", wheelbase=0.5), time_step=0.01)
    steer = 0.4
    fleet.command[:] = 1.0, 0.0, steer
    radius = 0.5 / math.tan(steer)
    around = 2 * math.pi * radius / math.cos(steer)
    fleet.step(round(around / 2 / 0.01))
    assert fleet.pose[0, 0, :2] == pytest.approx([0.0, 2 * radius], abs=0.01)


def test_bounds_hold():
    drive = Drive(fastest=(0.5, 0.0, 0.3), push=(1.0, 1.0, 0.5), brake=(-2.0, -1.0, -0.5))
    fleet = one(drive)
    fleet.command[:] = 9.0, 0.0, 9.0
    fleet.step()
    assert fleet.velocity[0, 0] == pytest.approx([0.1, 0.0, 0.05])
    fleet.step(20)
    assert fleet.velocity[0, 0] == pytest.approx([0.5, 0.0, 0.3])
    fleet.command[:] = 0.0
    fleet.step()
    assert fleet.velocity[0, 0] == pytest.approx([0.3, 0.0, 0.25])


def test_bounds_of_a_car_hold_for_its_body_not_its_steering():
    fleet = one(Drive("car", fastest=(1.0, 0.0, 0.5), wheelbase=0.3), euler=True)
    fleet.command[:] = 0.9, 0.0, 1.2
    fleet.step()
    step = fleet.time_step
    assert fleet.pose[0, 0] == pytest.approx([0.9 * math.cos(1.2) * step, 0.0, 0.5 * step])


def test_a_move_into_a_wall_is_not_made_at_all():
    wall = PlanarPart.box(0.1, 4.0, x=1.0)
    fleet = Fleet([Body((PlanarPart.box(0.3, 0.2),), drive=Drive())], [wall])
    fleet.command[:] = 0.4, 0.0, 0.1
    fleet.step(100)
    before = fleet.pose.copy()
    assert fleet.stalled[0, 0]
    assert 0.7 < before[0, 0, 0] < 0.8
    fleet.step()
    assert (fleet.pose == before).all()
    fleet.command[:] = -0.4, 0.0, 0.0
    fleet.step()
    assert not fleet.stalled[0, 0]


def test_a_robot_may_be_inside_an_outline():
    room = PlanarPart.box(3.0, 3.0)
    fleet = Fleet([Body((PlanarPart.box(0.3, 0.2),), drive=Drive())], [room])
    fleet.command[:] = 0.4, 0.0, 0.0
    fleet.step(20)
    assert fleet.pose[0, 0, 0] == pytest.approx(0.8)


def test_bodies_at_other_heights_pass():
    low = PlanarPart(PlanarPart.box(0.3, 0.2).points, low=0.0, high=0.2)
    fleet = Fleet(
        [Body((low,), drive=Drive()), Body((low,), (1.0, 0.0, 0.0), z=0.2)],
        [PlanarPart(PlanarPart.box(0.3, 0.3, x=2.0).points, low=0.2, high=1.0)],
    )
    fleet.command[0, 0] = 0.5, 0.0, 0.0
    fleet.step(100)
    assert fleet.pose[0, 0, 0] == pytest.approx(5.0)


def outline(part, x, y, yaw):
    """Return a part in shapely; circles are a little too small."""
    c, s = math.cos(yaw), math.sin(yaw)
    points = [(x + c * px - s * py, y + s * px + c * py) for px, py in part.points]
    if part.radius > 0.0:
        return shapely.Point(points[0]).buffer(part.radius, quad_segs=32)
    return shapely.Polygon(points)


SHAPES = [
    (PlanarPart.box(0.5, 0.3),),
    (PlanarPart.circle(0.1, 0.0, 0.2),),
    (PlanarPart(((-0.2, -0.2), (0.3, 0.0), (-0.2, 0.2))), PlanarPart.circle(0.0, 0.3, 0.1)),
    (PlanarPart(((-0.3, -0.3), (0.3, -0.3), (0.3, 0.3), (0.1, 0.3), (0.1, -0.1), (-0.3, -0.1))),),
]


@pytest.mark.long
@given(seed=st.integers(0, 2**32 - 1), count=st.integers(2, 70), dt=st.sampled_from([0.05, 0.3]))
@settings(max_examples=25, deadline=None)
def test_robots_never_overlap_after_a_step(seed, count, dt):
    rng = np.random.default_rng(seed)
    side = math.ceil(math.sqrt(count))
    bodies = []
    for i in range(count):
        pose = (1.0 * (i % side), 1.0 * (i // side), rng.uniform(-3.0, 3.0))
        kind = ("diff", "omni")[int(rng.integers(2))]
        bodies.append(Body(SHAPES[int(rng.integers(4))], pose, drive=Drive(kind)))
    walls = [PlanarPart.box(side + 0.2, side + 0.2, x=(side - 1) / 2, y=(side - 1) / 2)]
    walls += [PlanarPart.circle(x + 0.5, y + 0.5, 0.08) for x in range(2) for y in range(2)]
    fleet = Fleet(bodies, walls, time_step=dt, threads=1)
    stalls = 0
    for _ in range(12):
        fleet.command[:] = rng.uniform(-2.0, 2.0, fleet.command.shape)
        fleet.step()
        stalls += int(fleet.stalled.sum())
        check(fleet, bodies, walls)
    if count > 40 and dt > 0.1:
        assert stalls > 0


def check(fleet, bodies, walls):
    solids = [
        shapely.union_all([outline(part, *pose) for part in body.parts])
        for body, pose in zip(bodies, fleet.pose[0], strict=True)
    ]
    tree = shapely.STRtree(solids)
    first, second = tree.query(solids)
    for a, b in zip(first, second, strict=True):
        if a < b:
            assert solids[a].intersection(solids[b]).area < 1e-6
    for wall in walls:
        ring = outline(wall, 0.0, 0.0, 0.0).exterior
        for i in tree.query(ring):
            assert ring.intersection(solids[i]).length < 1e-3


def roam(threads, nworld=1, count=300):
    rng = np.random.default_rng(3)
    side = math.ceil(math.sqrt(count))
    shape = (PlanarPart.box(0.25, 0.25),)
    bodies = [
        Body(shape, (0.8 * (i % side), 0.8 * (i // side), rng.uniform(-3, 3)), drive=Drive())
        for i in range(count)
    ]
    room = PlanarPart.box(
        0.8 * side + 0.4, 0.8 * side + 0.4, x=0.4 * side - 0.4, y=0.4 * side - 0.4
    )
    fleet = Fleet(bodies, [room], nworld=nworld, threads=threads, euler=True)
    mounts = [Mount(i) for i in range(count)]
    scanner = Scanner(
        fleet, Fan.spread(math.pi, 60, 4.0), mounts, noise=RangeNoise(0.01), seed=5, named=True
    )
    Roaming(fleet, scanner, RoamingSettings(avoid_distance=0.05), seed=4).run(40)
    return fleet, scanner


@pytest.mark.long
def test_any_number_of_threads_gives_the_same_bits():
    one, two = roam(1), roam(2)
    assert 0.0 < one[0].stalled.mean() < 0.9
    for fleet, scanner in (two, roam(3)):
        assert (fleet.pose == one[0].pose).all()
        assert (fleet.stalled == one[0].stalled).all()
        assert (scanner.ranges == one[1].ranges).all()
        assert (scanner.names == one[1].names).all()


def test_worlds_of_a_batch_are_as_they_are_alone():
    def drive(nworld):
        bodies = [
            Body((PlanarPart.box(0.3, 0.2),), (0.5 * i, 0.0, i), drive=Drive()) for i in range(5)
        ]
        fleet = Fleet(bodies, [PlanarPart.box(4.0, 3.0, x=1.0)], nworld=nworld, threads=2)
        fleet.command[:] = np.linspace(-0.5, 0.5, 15).reshape(5, 3)
        fleet.step(30)
        return fleet.pose

    batch = drive(200)
    assert (batch == drive(1)).all()


def test_a_reset_world_starts_again():
    fleet = one(Drive(), (0.3, 0.0, 0.0), nworld=3)
    fleet.command[:] = 0.5, 0.0, 0.2
    fleet.step(5)
    fleet.reset(np.array([1]))
    assert fleet.pose[1, 0] == pytest.approx([0.3, 0.0, 0.0])
    assert (fleet.command[1] == 0.0).all()
    assert fleet.pose[0, 0, 0] > 0.5


def test_what_cannot_be_is_refused():
    with pytest.raises(EngineError, match="physics step"):
        one(Drive(), time_step=0.0)
    with pytest.raises(EngineError, match="drive must be one of"):
        one(Drive("hover"))
    with pytest.raises(EngineError, match="at least 3"):
        Fleet([Body((PlanarPart(((0.0, 0.0), (1.0, 0.0))),))])
    with pytest.raises(EngineError, match="nworld"):
        Fleet([], nworld=0)
    with pytest.raises(EngineError, match="threads"):
        Fleet([], threads=0)


def test_memory_and_loading_stay_small():
    shape = (PlanarPart.box(0.25, 0.25),)
    drive = Drive()
    bodies = [
        Body(shape, (1.0 * (i % 100), 1.0 * (i // 100), 0.0), drive=drive) for i in range(5000)
    ]
    fleet = Fleet(bodies, threads=1)
    arrays = [v for v in vars(fleet).values() if isinstance(v, np.ndarray)]
    arrays += [fleet.scene.grid, fleet.scene.start, fleet.scene.items, fleet.scene.table.rows]
    assert sum(array.nbytes for array in arrays) / 5000 < 1000


@pytest.mark.parametrize(
    "change",
    [
        lambda fleet: fleet.place(2, (0.0, 0.0, 0.0)),
        lambda fleet: fleet.place(-1, (0.0, 0.0, 0.0)),
        lambda fleet: fleet.place(0, (0.0, 0.0, 0.0), np.array([2])),
        lambda fleet: fleet.put(np.zeros((1, 3)), [0.0], np.array([4])),
        lambda fleet: fleet.put(np.zeros((1, 3)), [0.0], np.array([-1])),
        lambda fleet: fleet.reset(np.array([-1])),
        lambda fleet: fleet.reset(np.array([2**62])),
        lambda fleet: fleet.reset(np.array([0.0])),
    ],
)
def test_bodies_and_worlds_that_are_not_there_are_refused(change):
    fleet = Fleet([Body((PlanarPart.box(0.3, 0.2),))] * 2, nworld=2, threads=1)
    fleet.place(1, (1.0, 0.0, 0.0))
    before = fleet.rows.copy()
    with pytest.raises(EngineError, match=r"0 to|ints"):
        change(fleet)
    assert (fleet.rows == before).all()


def test_poses_for_other_worlds_are_refused():
    fleet = one(Drive("omni"), nworld=3)
    with pytest.raises(EngineError, match="are not for 3 worlds"):
        fleet.place(0, np.zeros((2, 3)))
    fleet.place(0, [(1.0, 2.0, 0.5)], np.array([2, 0]))
    assert fleet.pose[:, 0, 0].tolist() == [1.0, 0.0, 1.0]


def test_numbers_that_are_none_do_no_harm():
    fleet = one(Drive("omni"), nworld=2)
    for bad in (math.nan, math.inf):
        fleet.command[0] = bad, bad, bad
        fleet.command[1] = 0.5, 0.0, 0.0
        fleet.step()
        assert fleet.stalled[:, 0].tolist() == [True, False]
        assert np.isfinite(fleet.pose).all()
        with pytest.raises(EngineError, match="finite"):
            fleet.place(0, (bad, 0.0, 0.0))
    fleet.command[:] = 0.5, 0.0, 0.0
    fleet.step()
    assert not fleet.stalled.any()


@pytest.mark.parametrize("noise", [None, RangeNoise(0.01)])
def test_roaming_alone_and_in_a_crew_is_the_same(noise):
    poses = []
    for threads in (1, 2):
        bodies = [
            Body((PlanarPart.box(0.3, 0.2),), (0.6 * (i % 13), 0.6 * (i // 13), i), drive=Drive())
            for i in range(150)
        ]
        fleet = Fleet(bodies, [PlanarPart.box(9.0, 9.0, x=3.6, y=3.6)], threads=threads)
        mounts = [Mount(i) for i in range(150)]
        scanner = Scanner(fleet, Fan.spread(3.0, 40, 3.0), mounts, noise=noise)
        Roaming(fleet, scanner).run(25)
        poses.append(fleet.pose.copy())
    assert (poses[0] == poses[1]).all()
