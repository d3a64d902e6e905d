"""Local planners drive to goals around what stands there, and hit nothing."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.description import Pose
from gazelle.description.occupancy import OccupancyMap
from gazelle.navigation.costmap import Costmap, InflationLayer, StaticLayer, footprint_of
from gazelle.navigation.costmap.footprint import placed
from gazelle.navigation.planners import DwaPlanner, NavfnPlanner
from gazelle.navigation.planners.dwa import spread
from gazelle.navigation.planners.oscillation import OscillationGuard
from gazelle.navigation.planners.planar import between, composed, inverse, moved
from gazelle.navigation.planners.rollout import TrajectoryRollout, steps_of
from gazelle.navigation.planners.trajectory_planner import TrajectoryPlanner
from gazelle.navigation.planners.wavefront import grid_distances

BURGER = footprint_of([[-0.105, -0.105], [-0.105, 0.105], [0.041, 0.105], [0.041, -0.105]])
DWA = {
    "max_vel_x": 0.22, "min_vel_x": -0.22, "max_vel_y": 0.0, "min_vel_y": 0.0, "max_vel_trans": 0.22,
    "min_vel_trans": 0.11, "max_vel_theta": 2.75, "min_vel_theta": 1.37, "acc_lim_x": 2.5,
    "acc_lim_y": 0.0, "acc_lim_theta": 3.2, "xy_goal_tolerance": 0.05, "yaw_goal_tolerance": 0.17,
    "sim_time": 1.5, "vx_samples": 20, "vy_samples": 0, "vth_samples": 40,
    "path_distance_bias": 32.0, "goal_distance_bias": 20.0, "occdist_scale": 0.02,
}  # fmt: skip
OLD = {
    "max_vel_x": 0.22,
    "min_vel_x": 0.05,
    "max_vel_theta": 2.0,
    "min_vel_theta": -2.0,
    "sim_time": 1.5,
}


def world(walls=()):
    """Return a global and a local costmap of a room of 6 m by 6 m with walls (x0, y0, x1, y1)."""
    grid = np.zeros((120, 120), np.int8)
    grid[[0, -1]] = grid[:, [0, -1]] = 100
    for x0, y0, x1, y1 in walls:
        grid[round(y0 * 20) : round(y1 * 20), round(x0 * 20) : round(x1 * 20)] = 100
    found = []
    for rolling in (False, True):
        static = StaticLayer()
        costmap = Costmap(
            [static, InflationLayer(radius=1.0, scaling=3.0)],
            BURGER,
            width=3,
            height=3,
            rolling=rolling,
        )
        static.set_map(OccupancyMap(grid, 0.05, Pose()), costmap)
        costmap.update((1.0, 1.0, 0.0))
        found.append(costmap)
    return grid, *found


def drive(planner, grid, plan, local, pose, seconds=60.0):
    """Follow a plan with a base that has no inertia; returns the poses."""
    planner.set_plan(plan)
    velocity, poses = (0.0, 0.0, 0.0), [pose]
    for _ in range(round(seconds / 0.1)):
        local.update(pose)
        if planner.goal_reached(pose, velocity, (0.0, 0.0, 0.0)):
            return poses
        velocity = planner.command(pose, velocity, (0.0, 0.0, 0.0))
        assert velocity is not None, f"stuck at {pose}"
        for _ in range(10):
            x, y, heading = pose
            pose = (
                x + 0.01 * velocity[0] * math.cos(heading),
                y + 0.01 * velocity[0] * math.sin(heading),
                heading + 0.01 * velocity[2],
            )
        for corner in placed(BURGER / 1.1, *pose):
            assert grid[int(corner[1] / 0.05), int(corner[0] / 0.05)] == 0, f"hit at {pose}"
        poses.append(pose)
    raise AssertionError(f"not there after {seconds} s but at {pose}")


ROOMS = [
    ((), (1.0, 1.0, 0.0), (4.5, 4.0, 1.0)),
    ((), (1.0, 1.0, 3.0), (4.5, 1.2, -2.0)),
    (((2.5, 0.0, 2.7, 4.5),), (1.0, 1.0, 0.0), (4.5, 1.0, 0.0)),
    (((2.0, 1.0, 2.3, 5.0), (3.5, 2.0, 3.8, 6.0)), (1.0, 3.0, 1.5), (5.0, 3.0, 3.1)),
]


@pytest.mark.long
@pytest.mark.parametrize(("walls", "start", "goal"), ROOMS)
@pytest.mark.parametrize(("kind", "values"), [(DwaPlanner, DWA), (TrajectoryPlanner, OLD)])
def test_a_robot_gets_there_and_hits_nothing(kind, values, walls, start, goal):
    grid, whole, local = world(walls)
    plan = NavfnPlanner("n", whole, {}).make_plan(start, goal)
    planner = kind("d", local, values, 0.1)
    poses = drive(planner, grid, plan, local, start, 90.0)
    assert math.hypot(poses[-1][0] - goal[0], poses[-1][1] - goal[1]) < 0.11
    assert abs(math.remainder(poses[-1][2] - goal[2], 2 * math.pi)) < 0.2


def test_there_is_no_command_when_it_is_walled_in():
    _, _, local = world(
        [
            (0.85, 0.85, 1.2, 0.9),
            (0.85, 1.1, 1.2, 1.15),
            (1.1, 0.85, 1.15, 1.15),
            (0.8, 0.8, 0.85, 1.2),
        ]
    )
    planner = DwaPlanner("d", local, DWA, 0.1)
    planner.set_plan(np.array([[1.0, 1.0, 0.0], [3.0, 1.0, 0.0]]))
    local.update((1.0, 1.0, 0.0))
    assert planner.command((1.0, 1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)) is None


@pytest.mark.parametrize(
    "limits",
    [
        {},
        {"min_vel_trans": 0.2, "sim_time": 1.5},
        {"min_vel_theta": 0.9, "max_vel_theta": 1.82},
        {"acc_lim_theta": 0.1, "min_vel_theta": 0.2},
    ],
)
def test_one_that_stands_between_two_walls_turns(limits):
    """It cannot reach its least turning rate within a cycle, and may drive neither way."""
    _, _, local = world([(0.7, 0.6, 0.75, 1.4), (1.2, 0.6, 1.25, 1.4)])
    start = (1.0, 1.0, 0.0)
    values = {**DWA, "min_vel_trans": 0.15, "sim_time": 2.0, **limits}
    local.update(start)
    planner = DwaPlanner("d", local, values, 0.1)
    planner.set_plan(np.array([start, (1.0, 1.2, 1.57), (1.0, 3.0, 1.57)]))
    first = planner.command(start, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert first is not None
    assert first[:2] == (0.0, 0.0)
    assert abs(first[2]) == pytest.approx(values["min_vel_theta"])
    assert planner.command(start, first, (0.0, 0.0, 0.0)) is not None


@pytest.mark.parametrize(("blocked", "way"), [(None, 1), (math.pi / 2, -1), (-math.pi / 2, 1)])
def test_at_a_goal_it_turns_the_way_that_is_free(blocked, way):
    grid, _, local = world()
    pose = (3.0, 3.0, 0.0)
    goal = (3.0, 3.0, 3.0)
    rear = footprint_of([[-0.4, -0.05], [-0.4, 0.05], [0.05, 0.05], [0.05, -0.05]])
    local.set_footprint(rear)
    if blocked is not None:
        # Where its rear passes when it looks there.
        x, y = 3.0 - 0.35 * math.cos(blocked), 3.0 - 0.35 * math.sin(blocked)
        grid[
            round(y / 0.05) - 1 : round(y / 0.05) + 1, round(x / 0.05) - 1 : round(x / 0.05) + 1
        ] = 100
        local.layers[0].set_map(OccupancyMap(grid, 0.05, Pose()), local)
    planner = DwaPlanner("d", local, DWA, 0.1)
    planner.set_plan(np.array([pose, goal]))
    velocity, turned = (0.0, 0.0, 0.0), 0.0
    for _ in range(100):
        local.update(pose)
        if planner.goal_reached(pose, velocity, (0.0, 0.0, 0.0)):
            break
        velocity = planner.command(pose, velocity, (0.0, 0.0, 0.0))
        assert velocity is not None
        turned += 0.1 * velocity[2]
        pose = (3.0, 3.0, pose[2] + 0.1 * velocity[2])
    assert turned == pytest.approx(3.0 if way > 0 else 3.0 - 2.0 * math.pi, abs=0.2)


def test_velocities_keep_to_the_dynamic_window():
    _, _, local = world()
    local.update((3.0, 3.0, 0.0))
    planner = DwaPlanner("d", local, {**DWA, "acc_lim_x": 0.5, "acc_lim_theta": 1.0}, 0.1)
    planner.set_plan(np.array([[3.0, 3.0, 0.0], [3.6, 3.6, 0.0]]))
    found = planner.command((3.0, 3.0, 0.0), (0.1, 0.0, 0.3), (0.0, 0.0, 0.0))
    assert 0.05 - 1e-9 <= found[0] <= 0.15 + 1e-9
    assert 0.2 - 1e-9 <= found[2] <= 0.4 + 1e-9


def test_a_command_on_the_way_is_judged_by_its_whole_outline():
    costs = np.zeros((60, 60), np.uint8)
    costs[30, 40] = 254
    grids = np.zeros((4, 60, 60), np.int32)
    rollout = TrajectoryRollout(costs, (0.0, 0.0), 0.05, BURGER, grids, np.zeros(6), 0.0)
    commands = np.array([[0.5, 0.0, 0.0], [0.2, 0.0, 0.0], [0.5, 0.0, 1.5]])
    steps = steps_of(commands, 1.0, 0.025, 0.1)
    found = rollout.judge(np.array([1.6, 1.6, 0.0]), np.zeros(3), commands, steps, 1.0)
    assert (found < 0).tolist() == [True, False, False]
    assert rollout.footprint_cost(1.98, 1.6, 0.0) < 0
    assert rollout.footprint_cost(2.5, 1.6, 0.0) == 0
    assert rollout.footprint_cost(0.05, 1.6, 0.0) < 0


def test_steps_over_a_grid_go_around_walls():
    costs = np.zeros((5, 5), np.uint8)
    costs[0:4, 2] = 254
    found = grid_distances(costs, np.array([[0, 0]]))
    assert found[0].tolist() == [0, 1, 25, 11, 12]
    assert found[4].tolist() == [4, 5, 6, 7, 8]


@given(st.floats(-3, 3), st.floats(-3, 3), st.integers(1, 30))
def test_samples_hold_both_ends_and_zero(low, width, count):
    high = low + abs(width)
    values = spread(low, high, count)
    assert values[0] == pytest.approx(low)
    assert values[-1] == pytest.approx(high)
    if low < 0 < high:
        assert (values == 0).any()


def test_going_to_and_fro_is_forbidden_until_it_has_moved_on():
    guard = OscillationGuard(0.05, 0.2)
    here = (0.0, 0.0, 0.0)
    turns = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.1, 0.0, 0.0]])
    guard.update(here, turns[0], 0.1)
    assert not guard.forbidden(turns).any()
    guard.update(here, turns[1], 0.1)
    assert guard.forbidden(turns).tolist() == [True, False, False]
    guard.update((0.0, 0.0, -0.3), turns[1], 0.1)
    assert not guard.forbidden(turns).any()


poses = st.tuples(st.floats(-5, 5), st.floats(-5, 5), st.floats(-3, 3))


@given(poses, poses)
def test_poses_go_from_frame_to_frame_and_back(first, second):
    assert between(first, composed(first, second)) == pytest.approx(second, abs=1e-9)
    assert composed(first, inverse(first)) == pytest.approx((0, 0, 0), abs=1e-9)
    assert moved(np.array([second]), first)[0, :2] == pytest.approx(composed(first, second)[:2])
