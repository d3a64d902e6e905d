"""Timed elastic bands: derivatives, limits, and drives of a car through narrow passages and into gaps.

Table of docs/reference/navigation.md: ``pytest -m long -s tests/navigation/planners/test_teb.py``.
"""

import math
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from navigation.planners.car_drives import CAR, ROOMS, costmaps, drive

from gazelle.errors import Error
from gazelle.navigation.planners.plugins import STOP, local_planner
from gazelle.navigation.planners.teb import TebPlanner
from gazelle.navigation.planners.teb_band import _derivatives, first_band, maneuvers, resized
from gazelle.navigation.planners.teb_cost import Band, BandCost
from gazelle.navigation.planners.teb_equations import BandEquations
from gazelle.navigation.planners.teb_obstacles import BandObstacle, ObstacleDistances
from gazelle.navigation.planners.teb_settings import UNUSED, TebFootprint, TebSettings

NOWHERE = (0.0, 0.0, 0.0)
OPEN = ROOMS[0]


def planner(values=None, room=OPEN):
    _, _, local = costmaps(room)
    return TebPlanner("teb", local, {**CAR, **(values or {})}, 0.2)


@pytest.mark.long
@pytest.mark.parametrize("room", ROOMS, ids=lambda each: each.name)
def test_a_car_gets_there_and_hits_nothing(room):
    found = drive(room)
    print(
        f"\n| {room.name} | {found.seconds:.1f} s | {found.clearance:.2f} m | {found.turns} "
        f"| {1e3 * found.cycle:.0f} ms |"
    )
    assert found.reached
    assert found.clearance > 0.02
    assert found.failures == 0 or "corridor" in room.name


@settings(max_examples=20)
@given(st.integers(0, 1000), st.sampled_from([0.0, 0.5]), st.sampled_from([0.0, 0.3]))
def test_derivatives_by_color_are_those_of_one_variable_at_a_time(seed, radius, aside):
    rng = np.random.default_rng(seed)
    poses = np.cumsum(rng.normal((0.1, 0.0, 0.0), 0.05, (7, 3)), axis=0)
    band = Band(poses, rng.uniform(0.1, 0.5, 6))
    away = np.hypot(*(np.indices((30, 30)) - 12.0)) * 0.1
    teb = TebSettings(
        min_turning_radius=radius,
        weight_shortest_path=1.0,
        obstacle_cost_exponent=4.0,
        max_vel_y=aside,
    )
    cost = BandCost(
        teb,
        TebFootprint(np.array([[0.0, 0.0], [0.2, 0.0]]), np.array([0.1, 0.05])),
        ObstacleDistances(away, (-1.0, -1.0), 0.1),
        (0.1, 0.05, 0.2),
        stops=True,
        vias=rng.uniform(0.0, 0.5, (2, 2)),
        obstacle_weight=50.0,
        moving=[BandObstacle(np.array([[0.4, 0.2]]), 0.1, np.array([-0.2, 0.0]))],
        arrivals=band.arrivals(),
    )
    residuals, first = cost.residuals(band), cost.first_poses(len(band.times))
    found = _derivatives(band, cost, residuals, first)
    dense = np.zeros((len(residuals), len(poses), 4))
    for place in range(3):
        inside = first + place < len(poses)
        dense[inside, first[inside] + place] = found[inside, place]
    step = 1e-6
    for pose, variable in np.ndindex(len(poses), 4):
        moved = Band(band.poses.copy(), band.times.copy())
        if variable == 3 and pose < len(band.times):
            moved.times[pose] += step
        elif variable < 3 and 0 < pose < len(poses) - 1:
            moved.poses[pose, variable] += step
        exact = (cost.residuals(moved) - residuals) / step
        assert np.allclose(dense[:, pose, variable], exact, rtol=1e-3, atol=1e-3)
    equations = BandEquations(found, first, residuals, len(poses))
    jacobian = dense.reshape(len(residuals), -1)
    damped = jacobian.T @ jacobian + 0.1 * np.eye(jacobian.shape[1])
    solution = np.linalg.solve(damped, -jacobian.T @ residuals)
    assert np.allclose(equations.step(0.1).ravel(), solution, rtol=1e-6, atol=1e-9)


def test_a_straight_drive_costs_its_time_alone():
    teb = TebSettings(max_vel_x=1.0, penalty_epsilon=0.0, acc_lim_x=10.0, weight_inflation=0.0)
    cost = BandCost(
        teb,
        TebFootprint(np.zeros((1, 2)), np.zeros(1)),
        ObstacleDistances(None, (0.0, 0.0), 0.05),
        (0.5, 0.0, 0.0),
        stops=False,
        vias=np.zeros((0, 2)),
        obstacle_weight=50.0,
    )
    poses = np.zeros((6, 3))
    poses[:, 0] = 0.1 * np.arange(6)
    assert cost.of(Band(poses, np.full(5, 0.2))) == pytest.approx(5 * 0.2**2)
    # 0.2 m/s too fast, twice the weight of time squared
    fast = cost.of(Band(poses, np.full(5, 0.1 / 1.2)))
    assert fast == pytest.approx(5 * (0.1 / 1.2) ** 2 + 5 * 2.0 * 0.2**2)


@given(st.lists(st.floats(0.02, 2.0), min_size=4, max_size=12))
def test_resizing_keeps_the_ends_and_the_duration(times):
    poses = np.zeros((len(times) + 1, 3))
    poses[:, 0] = np.arange(len(poses))
    band = resized(Band(poses, np.array(times)), TebSettings())
    assert band.poses[[0, -1], 0].tolist() == [0.0, len(times)]
    assert band.times.sum() == pytest.approx(sum(times))
    assert len(band.times) == len(band.poses) - 1
    assert band.times.max() <= 0.4 or len(band.times) > 50


def test_a_command_keeps_to_the_turning_radius():
    teb = planner()
    teb.set_plan(np.array([OPEN.start, (1.0, 2.5, 3.0)]))
    velocity = teb.command(OPEN.start, STOP, NOWHERE)
    assert abs(velocity[2]) <= abs(velocity[0]) / 0.5 + 1e-9
    angled = planner({"cmd_angle_instead_rotvel": True})
    angled.set_plan(np.array([OPEN.start, (1.0, 2.5, 3.0)]))
    steering = angled.command(OPEN.start, STOP, NOWHERE)
    assert steering[0] == pytest.approx(velocity[0])
    assert steering[2] == pytest.approx(math.atan(0.4 * velocity[2] / velocity[0]))


def test_there_is_no_command_inside_of_a_wall_and_none_without_a_plan():
    _, _, local = costmaps(OPEN)
    local.cells[:] = 254
    teb = TebPlanner("teb", local, CAR, 0.2)
    assert teb.command(OPEN.start, STOP, NOWHERE) is None
    teb.set_plan(np.array([OPEN.start, (3.0, 1.0, 0.0)]))
    assert teb.command(OPEN.start, STOP, NOWHERE) is None
    assert not teb.goal_reached(OPEN.start, STOP, NOWHERE)


def test_a_goal_is_reached_within_the_tolerances_and_at_rest():
    teb = planner()
    teb.set_plan(np.array([OPEN.start, OPEN.goal]))
    x, y, yaw = OPEN.goal
    assert teb.goal_reached((x + 0.09, y, yaw - 0.09), STOP, NOWHERE)
    assert not teb.goal_reached((x + 0.11, y, yaw), STOP, NOWHERE)
    assert not teb.goal_reached((x, y, yaw + 0.11), STOP, NOWHERE)
    assert not teb.goal_reached(OPEN.goal, (0.2, 0.0, 0.0), NOWHERE)
    assert teb.command(OPEN.goal, (0.2, 0.0, 0.0), NOWHERE) == STOP
    free = planner({"free_goal_vel": True})
    free.set_plan(np.array([OPEN.start, OPEN.goal]))
    assert free.goal_reached(OPEN.goal, (0.2, 0.0, 0.0), NOWHERE)


def test_a_first_band_goes_along_the_plan_at_the_greatest_speed():
    plan = np.array([(x, 0.0, 0.0) for x in np.linspace(0.1, 2.0, 20)])
    band = first_band(plan, NOWHERE, TebSettings())
    assert band.times.sum() == pytest.approx(2.0 / 0.4)
    assert np.allclose(band.velocities()[0], 0.4)
    behind = first_band(
        -plan, NOWHERE, TebSettings(allow_init_with_backwards_motion=True, max_vel_x_backwards=0.4)
    )
    assert np.allclose(behind.velocities()[0][1:-1], -0.4)


def test_maneuvers_begin_and_end_at_the_poses_given():
    for band in maneuvers((0.0, 0.0, 0.3), (1.0, 1.0, 2.0), TebSettings(min_turning_radius=0.5)):
        assert band.poses[0].tolist() == [0.0, 0.0, 0.3]
        assert band.poses[-1].tolist() == [1.0, 1.0, 2.0]


@pytest.mark.parametrize(
    ("model", "count", "reach"),
    [
        ({}, 1, 0.0),
        ({"type": "circular", "radius": 0.3}, 1, 0.3),
        ({"type": "two_circles", "front_offset": 0.2, "rear_offset": 0.1, "front_radius": 0.1,
          "rear_radius": 0.2}, 2, 0.3),
        ({"type": "line", "line_start": [0.0, 0.0], "line_end": [0.4, 0.0]}, 9, 0.4),
        ({"type": "polygon", "vertices": [[0.1, 0.1], [-0.1, 0.1], [-0.1, -0.1], [0.1, -0.1]]}, 17,
         math.hypot(0.1, 0.1)),
    ],
)  # fmt: skip
def test_the_shape_of_the_robot(model, count, reach):
    found = TebFootprint.read({"footprint_model": model})
    assert len(found.centers) == count
    assert (np.hypot(*found.centers.T) + found.radii).max() == pytest.approx(reach)


@pytest.mark.parametrize(
    ("values", "text"),
    [
        ({"dt_ref": 0.0}, "'dt_ref' must be above 0, not 0.0"),
        ({"weight_obstacle": -1.0}, "'weight_obstacle' must be 0 or more, not -1.0"),
        ({"min_samples": 2}, "'min_samples' must be 3 to 'max_samples', not 2"),
        ({"footprint_model": {"type": "lime"}}, "'footprint_model/type' is no 'lime'"),
        ({"footprint_model": {"type": "circular"}}, "'footprint_model/radius' is missing"),
        ({"footprint_model": {"type": "line", "line_start": [0, 0]}}, "must be points [x, y]"),
        ({"footprint_model": 3}, "'footprint_model' must be a namespace, not 3"),
    ],
)
def test_wrong_parameters_are_refused(values, text):
    with pytest.raises(Error, match=re.escape(text)):
        planner(values)


def test_unknown_parameters_are_warned_of_and_unused_ones_are_not(caplog):
    planner({"min_turning_radios": 1.0, **dict.fromkeys(UNUSED - {"footprint_model"}, 1.0)})
    assert [record.message for record in caplog.records] == [
        "teb/min_turning_radios is an unknown parameter; did you mean 'min_turning_radius'?"
    ]
    assert local_planner("teb_local_planner/TebLocalPlannerROS") is TebPlanner
