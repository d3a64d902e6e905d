"""A seeker alone, on ground made of discs and walls: plain numbers, no simulation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.errors import SimulationError
from gazelle.navigation import BaseLimits, GoalSeeker
from gazelle.navigation.avoidance import safe_velocity
from gazelle.navigation.following import following_velocity
from gazelle.sensors import LaserScan

ANGLES = np.linspace(-0.75 * math.pi, 0.75 * math.pi, 181)
STEP = 0.1


class Ground:
    """Discs (x, y, radius) on a plane, and a point-mass base that obeys at once."""

    def __init__(self, *discs):
        self.discs = np.array(discs, np.float64).reshape(-1, 3)
        self.pose, self.time = (0.0, 0.0, 0.0), 0.0
        self.nearest = math.inf

    def scan(self):
        x, y, yaw = self.pose
        along = np.stack((np.cos(ANGLES + yaw), np.sin(ANGLES + yaw)), axis=1)
        ranges = np.full(len(ANGLES), np.inf)
        for cx, cy, radius in self.discs:
            to = np.array((cx - x, cy - y))
            ahead = along @ to
            aside = to @ to - ahead**2
            hit = (ahead > 0.0) & (aside < radius**2)
            distance = ahead - np.sqrt(np.maximum(radius**2 - aside, 0.0))
            ranges = np.where(hit, np.minimum(ranges, distance), ranges)
        ranges[ranges > 8.0] = np.inf
        first, increment = ANGLES[0], ANGLES[1] - ANGLES[0]
        stamp = round(self.time * 1e9)
        return LaserScan(stamp, ranges, first, ANGLES[-1], increment, 0.05, 8.0)

    def run(self, seeker, seconds):
        end = self.time + seconds
        while self.time < end and not seeker.arrived:
            forward, turning = seeker.update(self.pose, self.scan(), self.time)
            x, y, yaw = self.pose
            middle = yaw + turning * STEP / 2.0
            x, y = x + forward * math.cos(middle) * STEP, y + forward * math.sin(middle) * STEP
            self.pose, self.time = (x, y, yaw + turning * STEP), self.time + STEP
            if len(self.discs):
                away = np.hypot(*(self.discs[:, :2] - (x, y)).T) - self.discs[:, 2]
                self.nearest = min(self.nearest, float(away.min()))


def test_open_ground_is_crossed_straight_and_fast():
    ground, seeker = Ground(), GoalSeeker()
    seeker.set_goal((3.0, 0.0))
    ground.run(seeker, 10.0)
    assert seeker.arrived
    assert seeker.goal is None
    assert math.dist(ground.pose[:2], (3.0, 0.0)) <= 0.1
    assert ground.time < 8.0


def test_the_heading_of_a_goal_is_taken():
    ground, seeker = Ground(), GoalSeeker()
    seeker.set_goal((-1.0, 1.0, math.pi / 2.0))
    ground.run(seeker, 20.0)
    assert seeker.arrived
    assert ground.pose[2] == pytest.approx(math.pi / 2.0, abs=0.1)


@pytest.mark.long
@settings(max_examples=5, deadline=None)
@given(st.integers(0, 10_000))
def test_obstacles_are_driven_around(seed):
    stream = np.random.default_rng(seed)
    places = stream.uniform((1.0, -1.5), (4.0, 1.5), (4, 2))
    radii = stream.uniform(0.05, 0.35, 4)
    ground, seeker = Ground(*np.column_stack((places, radii))), GoalSeeker()
    seeker.set_goal((5.2, 0.0))
    ground.run(seeker, 60.0)
    assert seeker.arrived
    assert ground.nearest > 0.2


def test_a_dead_end_is_left():
    pocket = [(2.0, y / 10.0, 0.1) for y in range(-10, 11, 2)]
    pocket += [(x / 10.0, side, 0.1) for x in range(8, 21, 2) for side in (-1.0, 1.0)]
    ground, seeker = Ground(*pocket), GoalSeeker()
    seeker.set_goal((3.5, 0.0))
    ground.run(seeker, 60.0)
    assert seeker.arrived
    assert ground.nearest > 0.2


@pytest.mark.long
def test_where_there_is_no_way_it_waits_for_one():
    ring = [(2.0 * math.cos(a), 2.0 * math.sin(a), 0.2) for a in np.linspace(-3.1, 3.1, 40)]
    ground, seeker = Ground(*ring), GoalSeeker()
    seeker.set_goal((4.0, 0.0))
    ground.run(seeker, 20.0)
    assert not seeker.arrived
    assert not len(seeker.path)
    assert ground.nearest > 0.2
    ground.discs = ground.discs[np.abs(ground.discs[:, 1]) > 1.0]
    ground.run(seeker, 40.0)
    assert seeker.arrived


def test_of_a_goal_in_an_obstacle_the_nearest_free_place_is_taken():
    ground, seeker = Ground((3.0, 0.0, 0.2)), GoalSeeker()
    seeker.set_goal((3.0, 0.0))
    ground.run(seeker, 20.0)
    assert seeker.arrived
    assert 0.4 < math.dist(ground.pose[:2], (3.0, 0.0)) < 0.8


def test_what_is_put_back_goes_on_the_same():
    first, second = GoalSeeker(), GoalSeeker()
    ground = Ground((1.5, 0.1, 0.3), (2.5, -0.6, 0.2))
    first.set_goal((4.0, 0.0, 1.0))
    ground.run(first, 3.0)
    second.restore(first.state())
    scan = ground.scan()
    assert second.update(ground.pose, scan, ground.time) == first.update(
        ground.pose, scan, ground.time
    )
    np.testing.assert_array_equal(second.path, first.path)
    assert second.goal == first.goal == (4.0, 0.0, 1.0)


@given(
    st.tuples(st.floats(0.0, 0.6), st.floats(-1.5, 1.5)),
    st.lists(st.tuples(st.floats(-1.5, 1.5), st.floats(-1.5, 1.5)), max_size=8),
)
def test_commands_stay_within_the_limits(now, points):
    limits = BaseLimits()
    seen = np.array(points, np.float64).reshape(-1, 2)
    forward, turning = safe_velocity((5.0, 9.0), now, seen, 0.1, limits)
    assert 0.0 <= forward <= limits.linear + 1e-9
    assert abs(turning) <= limits.angular + 1e-9
    assert abs(forward - now[0]) <= limits.linear_acceleration * 0.1 + 1e-9
    assert abs(turning - now[1]) <= limits.angular_acceleration * 0.1 + 1e-9


def test_it_brakes_before_a_wall():
    limits, velocity, x = BaseLimits(), (0.6, 0.0), 0.0
    wall = np.array([(2.0, y / 20.0) for y in range(-40, 41)])
    for _ in range(100):
        velocity = safe_velocity((0.6, 0.0), velocity, wall - (x, 0.0), 0.1, limits)
        velocity = (velocity[0], 0.0)
        x += velocity[0] * 0.1
    assert x < 2.0 - limits.radius
    assert velocity[0] == pytest.approx(0.0, abs=0.02)


def test_a_path_behind_is_turned_to_first():
    path = np.array([(0.0, 0.0), (-1.0, 0.1)])
    forward, turning = following_velocity(path, (0.0, 0.0, 0.0), BaseLimits())
    assert forward == 0.0
    assert turning > 1.0


def test_limits_are_positive():
    with pytest.raises(SimulationError, match="'linear' must be positive"):
        BaseLimits(linear=0.0)
