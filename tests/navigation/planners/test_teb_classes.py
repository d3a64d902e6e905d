"""Timed elastic bands around obstacles: shapes, classes, moving obstacles, and robots that strafe."""

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st
from navigation.planners.car_drives import Room, costmaps

from gazelle.navigation.planners.planar import moved
from gazelle.navigation.planners.plugins import STOP
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_classes import PassedObstacles
from gazelle.navigation.planners.teb_cost import Band
from gazelle.navigation.planners.teb_obstacles import BandObstacle
from gazelle.navigation.planners.teb_search import BandSearch
from gazelle.navigation.planners.teb_settings import TebSettings

NOWHERE = (0.0, 0.0, 0.0)
BLOCK = Room("block", ((2.6, 2.7, 2.8, 3.3),), (1.5, 3.0, 0.0), (3.8, 3.0, 0.0))
OPEN = Room("open", (), (1.0, 3.0, 0.0), (5.0, 3.0, 0.0))
ROUND = {
    "max_global_plan_lookahead_dist": 5.0, "min_obstacle_dist": 0.25, "acc_lim_theta": 1.0,
    "max_vel_theta": 1.0, "footprint_model": {"type": "circular", "radius": 0.1},
}  # fmt: skip
coordinate = st.floats(-2.0, 2.0)


def planner(room, values=None):
    local = costmaps(room)[2]
    local.set_footprint(np.array([[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]]))
    local.update((3.0, 3.0, 0.0))
    found = TebPlanner("teb", local, {**ROUND, **(values or {})}, 0.2)
    plan = np.linspace(room.start, room.goal, 40)
    if room is BLOCK:
        plan[:, 1] += 0.75 * np.exp(-(((plan[:, 0] - 2.7) / 0.5) ** 2))
    found.set_plan(plan)
    return found


def side(band):
    return math.copysign(1.0, band.poses[:, 1].mean() - 3.0)


@settings(max_examples=50)
@given(
    st.sampled_from([1, 2, 3, 6]), st.integers(0, 10_000), st.floats(0.0, 0.5), st.floats(0.0, 3.0)
)
def test_distances_to_shapes_are_those_of_shapely(count, seed, radius, time):
    rng = np.random.default_rng(seed)
    angles = np.sort(rng.uniform(-math.pi, math.pi, count))
    ring = rng.uniform(0.2, 2.0, count)[:, None] * np.stack(
        (np.cos(angles), np.sin(angles)), axis=1
    )
    kind = {1: shapely.Point, 2: shapely.LineString}.get(count, shapely.Polygon)
    shape, points = kind(ring), rng.uniform(-2.0, 2.0, (4, 2))
    velocity = rng.uniform(-1.0, 1.0, 2)
    seen = points + time * velocity
    found = BandObstacle(ring, radius, velocity).distances(seen[:, None], np.full(4, time))[:, 0]
    for point, distance in zip(map(shapely.Point, points), found, strict=True):
        inside = count > 2 and shape.contains(point)
        apart = shape.exterior.distance(point) if count > 2 else shape.distance(point)
        assert distance == pytest.approx((-apart if inside else apart) - radius, abs=1e-9)


@settings(max_examples=40)
@given(st.integers(0, 10_000), st.floats(-3.0, 3.0), coordinate, coordinate)
def test_the_class_of_a_band_is_the_side_of_the_obstacle_in_any_frame(seed, turn, x, y):
    rng = np.random.default_rng(seed)
    along = np.sort(rng.uniform(-1.0, 1.0, 6))
    classes = []
    for side in (1.0, -1.0):
        for _ in range(2):
            poses = np.zeros((8, 3))
            poses[[0, -1], 0] = -1.0, 1.0
            poses[1:-1, 0], poses[1:-1, 1] = along, side * rng.uniform(0.1, 2.0, 6)
            passed = PassedObstacles(moved(np.zeros((1, 2)), (x, y, turn)), np.zeros((0, 2)))
            classes.append(passed.class_of(Band(moved(poses, (x, y, turn)), np.ones(7))))
    left, again, right, once_more = classes
    assert left == again
    assert right == once_more
    assert left[0] - right[0] == -1  # a turn less around it, passing it on the left


def test_bands_on_both_sides_of_an_obstacle_are_kept_and_the_cheaper_one_is_driven():
    teb = planner(BLOCK)
    for _ in range(3):
        assert teb.command(BLOCK.start, STOP, NOWHERE) is not None
    assert {side(each) for each in teb.search.bands} == {1.0, -1.0}
    assert np.array_equal(teb.local_plan, teb.search.bands[0].poses)
    alone = planner(BLOCK, {"enable_homotopy_class_planning": False})
    alone.command(BLOCK.start, STOP, NOWHERE)
    assert len(alone.search.bands) == 1


def test_points_beside_obstacles_lead_around_both_sides_without_chance():
    teb = planner(BLOCK, {"simple_exploration": True})
    teb.command(BLOCK.start, STOP, NOWHERE)
    assert len(teb.search.bands) == 2


def test_a_choice_of_class_has_hysteresis_prefers_the_plan_and_waits_between_switches():
    def chosen(costs, usual, last, search):
        band = Band(np.zeros((2, 3)), np.ones(1))
        return search._ordered({key: (band, cost) for key, cost in costs.items()}, usual, last)[0]

    plain, eager = (1,), (2,)
    search = BandSearch(TebSettings(selection_cost_hysteresis=0.5), 0.2)
    assert chosen({plain: 1.9, eager: 1.0}, (), plain, search) == plain
    assert chosen({plain: 2.1, eager: 1.0}, (), plain, search) == eager
    assert chosen({plain: 1.04, eager: 1.0}, plain, None, search) == plain
    assert chosen({plain: 1.06, eager: 1.0}, plain, None, search) == eager
    blocked = BandSearch(TebSettings(switching_blocking_period=1.0), 0.2)
    assert chosen({plain: 2.0, eager: 1.0}, (), plain, blocked) == eager
    assert chosen({plain: 1.0, eager: 2.0}, (), eager, blocked) == eager


def test_detours_that_take_too_long_are_dropped():
    search = BandSearch(TebSettings(max_ratio_detours_duration_best_duration=3.0), 0.2)
    found = {(key,): (Band(np.zeros((2, 3)), np.full(1, key)), key) for key in (1.0, 2.9, 3.1)}
    assert search._ordered(found, (), None) == [(1.0,), (2.9,)]


@pytest.mark.parametrize("include", [True, False])
def test_a_band_keeps_away_from_where_an_obstacle_will_be(include):
    teb = planner(
        OPEN,
        {
            "include_dynamic_obstacles": include,
            "penalty_epsilon": 0.1,
            "roadmap_graph_area_width": 6.0,
        },
    )
    crossing = BandObstacle(np.array([[3.0, 1.0]]), 0.2, np.array([0.0, 0.4]))
    teb.obstacles = [crossing]
    for _ in range(4):
        teb.command(OPEN.start, STOP, NOWHERE)
    band = teb.search.bands[0]
    clear = crossing.distances(band.poses[:, None, :2], band.arrivals()) - 0.1
    if include:
        assert clear.min() > 0.2
    else:  # it is believed to stand at y = 1
        assert clear.min() < 0.0


def test_a_robot_strafes_to_a_goal_beside_it_within_its_limits():
    values = {
        "max_vel_y": 0.3, "max_vel_trans": 0.4, "weight_kinematics_nh": 1.0, "xy_goal_tolerance": 0.1,
        "global_plan_overwrite_orientation": False,
    }  # fmt: skip
    teb = planner(OPEN, values)
    pose, velocity = (3.0, 2.7, 0.0), STOP
    teb.set_plan(np.linspace(pose, (3.0, 3.3, 0.0), 20))
    for _ in range(60):
        if teb.goal_reached(pose, velocity, NOWHERE):
            break
        velocity = teb.command(pose, velocity, NOWHERE)
        ahead, aside, turning = velocity
        assert abs(aside) <= 0.3 + 1e-9
        assert math.hypot(ahead, aside) <= 0.4 + 1e-9
        x, y, heading = pose
        heading += 0.2 * turning
        pose = (
            x + 0.2 * (ahead * math.cos(heading) - aside * math.sin(heading)),
            y + 0.2 * (ahead * math.sin(heading) + aside * math.cos(heading)),
            heading,
        )
        assert abs(heading) < 0.5
    assert teb.goal_reached(pose, velocity, NOWHERE)


@pytest.mark.parametrize(
    ("proportional", "expected"), [(False, (0.4, 0.2, 0.3)), (True, (0.2, 0.1, 0.3))]
)
def test_velocities_are_limited_one_by_one_or_by_the_same_factor(proportional, expected):
    values = {
        "max_vel_y": 0.3, "max_vel_trans": 0.5, "max_vel_theta": 0.3,
        "use_proportional_saturation": proportional,
    }  # fmt: skip
    assert planner(OPEN, values)._bounded(0.4, 0.2, 0.6) == pytest.approx(expected)
