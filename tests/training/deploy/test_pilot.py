"""The pilot, without ROS: limits, time-outs, obstacles, goals."""

from __future__ import annotations

import dataclasses
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from gazelle.errors import FormatError, TaskError
from gazelle.training.deploy import (
    GoalPlace,
    OdometryReading,
    Pilot,
    SafetyLimits,
    ScanReading,
    open_policy,
    read_goals,
)
from gazelle.training.deploy.goals import parse_goal
from gazelle.training.deploy.policies import command_of
from gazelle.training.deploy.safety import VelocityCommand

FREE = np.full(360, np.inf)
AT = OdometryReading(0.0, 0.0, 0.0)


def scan(ranges=FREE):
    return ScanReading(np.asarray(ranges, float), 0.0, 2 * math.pi / len(ranges), 0.12, 3.5)


@pytest.fixture
def pilot(straight_on):
    """Return an armed pilot, on its way to a goal far ahead."""
    made = Pilot(open_policy(straight_on), SafetyLimits(stop_distance=0.2))
    made.set_scan(scan(), 10.0)
    made.set_odometry(AT, 10.0)
    made.go_to([GoalPlace(3.0, 0.0)], 10.0)
    assert made.arm(10.0) is None
    return made


def test_it_drives_when_it_is_armed_and_has_a_goal(straight_on):
    pilot = Pilot(open_policy(straight_on), SafetyLimits())
    assert pilot.arm(0.0) == "no scan yet"
    pilot.set_scan(scan(), 0.0)
    assert pilot.arm(0.0) == "no odometry yet"
    pilot.set_odometry(AT, 0.0)
    assert pilot.arm(0.0) is None
    assert not pilot.tick(0.0, None).active
    pilot.go_to([GoalPlace(3.0, 0.0)], 0.0)
    tick = pilot.tick(0.0, (3.0, 0.0))
    assert tick.active
    assert tick.command == VelocityCommand(0.15, 0.0)
    assert tick.acted.decision.action == (2.0,)
    pilot.disarm()
    assert not pilot.tick(0.0, (3.0, 0.0)).active


@pytest.mark.parametrize(("deaf", "reason"), [("scan", "scan lost"), ("odometry", "odometry lost")])
def test_without_news_it_stands(pilot, deaf, reason):
    now = 10.0
    while now < 12.0:
        now += 0.05
        if deaf != "scan":
            pilot.set_scan(scan(), now)
        if deaf != "odometry":
            pilot.set_odometry(AT, now)
        tick = pilot.tick(now, (3.0, 0.0))
        assert tick.command.moves == (now - 10.0 <= 0.4)
        assert tick.reason == (None if tick.command.moves else reason)
    pilot.set_scan(scan(), now)
    pilot.set_odometry(AT, now)
    assert pilot.tick(now, (3.0, 0.0)).command.moves


def test_it_acts_once_a_period_and_on_new_scans_only(pilot):
    acts, now = [], 10.0
    for number in range(100):
        now = 10.0 + 0.02 * number
        if number % 2 == 0:
            pilot.set_scan(scan(), now)
        pilot.set_odometry(AT, now)
        if pilot.tick(now, (3.0, 0.0)).acted:
            acts.append(now)
    assert min(np.diff(acts)) >= 0.15 - 1e-9
    assert max(np.diff(acts)) <= 0.2 + 1e-9
    pilot.set_scan(scan(), now + 0.2)
    assert pilot.tick(now + 0.2, (3.0, 0.0)).acted
    assert pilot.tick(now + 0.39, (3.0, 0.0)).acted is None


@pytest.mark.parametrize("angle", [0, 30, -50])
def test_an_obstacle_ahead_stops_it_whatever_the_policy_wants(pilot, angle):
    ranges = FREE.copy()
    ranges[angle] = 0.19
    pilot.set_scan(scan(ranges), 10.1)
    tick = pilot.tick(10.1, (3.0, 0.0))
    assert tick.command == VelocityCommand(0.0, 0.0)
    assert tick.policy_command == VelocityCommand(0.15, 0.0)
    assert tick.reason == "obstacle at 0.19 m"


@pytest.mark.parametrize("angle", [90, 180, -70])
def test_an_obstacle_beside_or_behind_it_does_not(pilot, angle):
    ranges = FREE.copy()
    ranges[angle] = 0.19
    pilot.set_scan(scan(ranges), 10.1)
    assert pilot.tick(10.1, (3.0, 0.0)).command == VelocityCommand(0.15, 0.0)


def test_what_is_too_near_to_measure_is_an_obstacle(pilot):
    ranges = FREE.copy()
    ranges[5] = -np.inf
    pilot.set_scan(scan(ranges), 10.1)
    assert pilot.tick(10.1, (3.0, 0.0)).command == VelocityCommand(0.0, 0.0)


def test_the_stop_sees_rays_that_the_policy_does_not(pilot):
    """Between two of the policy's 24 rays there is a pole of one ray's width."""
    ranges = FREE.copy()
    ranges[7] = 0.15
    pilot.set_scan(scan(ranges), 10.1)
    assert pilot.tick(10.1, (3.0, 0.0)).command == VelocityCommand(0.0, 0.0)


def test_a_scan_of_failed_rays_is_no_scan(pilot):
    pilot.set_scan(scan(np.where(np.arange(360) % 3, np.nan, 1.0)), 10.1)
    tick = pilot.tick(10.1, (3.0, 0.0))
    assert not tick.command.moves
    assert tick.reason == "scan unusable: most rays failed"


def test_speeds_are_limited(straight_on):
    pilot = Pilot(open_policy(straight_on), SafetyLimits(max_linear=0.1))
    pilot.set_scan(scan(), 0.0)
    pilot.set_odometry(AT, 0.0)
    pilot.go_to([GoalPlace(3.0, 0.0)], 0.0)
    pilot.arm(0.0)
    tick = pilot.tick(0.0, (3.0, 0.0))
    assert (tick.command, tick.reason) == (VelocityCommand(0.1, 0.0), "limit")


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_a_mad_command_is_none(value):
    limits = SafetyLimits(max_linear=0.2, max_angular=1.0)
    assert limits.limited(VelocityCommand(value, value)) == VelocityCommand(0.0, 0.0)
    assert limits.limited(VelocityCommand(-9.0, 9.0)) == VelocityCommand(-0.2, 1.0)


def test_backwards_it_looks_behind(pilot):
    ranges = FREE.copy()
    ranges[180] = 0.15
    assert pilot.limits.blocked(VelocityCommand(-0.1, 0.0), scan(ranges)) == pytest.approx(0.15)
    assert pilot.limits.blocked(VelocityCommand(0.1, 0.0), scan(ranges)) is None
    assert pilot.limits.blocked(VelocityCommand(0.0, 1.0), scan(np.full(360, 0.15))) is None


@pytest.mark.parametrize(
    ("place", "ranges", "after", "outcome"),
    [
        (OdometryReading(2.9, 0.0, 0.0), FREE, 0.3, "reached"),
        (AT, np.full(360, 0.125), 0.3, "collision"),
        (AT, FREE, 100.5, "time-out"),
    ],
)
def test_goals_come_to_an_end(pilot, place, ranges, after, outcome):
    pilot.waiting.append(GoalPlace(1.0, 1.0))
    pilot.tick(10.0, (3.0, 0.0))
    now = 10.0 + after
    pilot.set_scan(scan(ranges), now)
    pilot.set_odometry(place, now)
    tick = pilot.tick(now, (3.0, 0.0))
    assert tick.ended.outcome == outcome
    assert tick.ended.seconds == pytest.approx(after)
    assert pilot.goal == GoalPlace(1.0, 1.0)
    assert not tick.command.moves
    assert pilot.tick(now, (1.0, 1.0)).active


def test_after_the_last_goal_others_may_drive(pilot):
    pilot.set_odometry(OdometryReading(3.0, 0.0, 0.0), 10.1)
    assert pilot.tick(10.1, (3.0, 0.0)).ended.outcome == "reached"
    assert not pilot.tick(10.2, None).active


def test_a_goal_that_nobody_can_place_stops_it(pilot):
    pilot.go_to([GoalPlace(1.0, 0.0, "map")], 10.0)
    tick = pilot.tick(10.0, None)
    assert not tick.command.moves
    assert tick.reason == "no transform from the goal's frame 'map'"


def test_when_time_jumps_back_old_readings_are_forgotten(pilot):
    assert pilot.tick(10.1, (3.0, 0.0)).command.moves
    tick = pilot.tick(0.0, (3.0, 0.0))
    assert not tick.command.moves
    assert tick.reason == "no scan yet"
    pilot.set_scan(scan(), 0.1)
    pilot.set_odometry(AT, 0.1)
    assert pilot.tick(0.1, (3.0, 0.0)).command.moves


def test_the_score_is_what_it_came_nearer(pilot):
    pilot.tick(10.0, (3.0, 0.0))
    for number in range(1, 4):
        now = 10.0 + 0.2 * number
        pilot.set_scan(scan(), now)
        pilot.set_odometry(OdometryReading(0.03 * number, 0.0, 0.0), now)
        acted = pilot.tick(now, (3.0, 0.0)).acted
        assert acted.gain == pytest.approx(0.03)
        assert acted.score == pytest.approx(0.03 * number)


def test_continuous_actions_are_spread_over_their_velocities(straight_on):
    import gymnasium as gym

    env = gym.make("gazelle/TurtleBot3Stage1Continuous-v0", engine="planar")
    rule = env.unwrapped.contract.action
    env.close()
    assert command_of((-1.0, 1.0), rule) == VelocityCommand(0.0, 1.5)
    assert command_of((1.0, -9.0), rule) == VelocityCommand(0.22, -1.5)
    assert command_of((0.0, 0.0), rule) == VelocityCommand(pytest.approx(0.11), 0.0)
    with pytest.raises(TaskError, match="does not define action 7"):
        command_of((7.0,), open_policy(straight_on).contract.action)


@pytest.mark.parametrize(
    "limits",
    [{"max_linear": 0.0}, {"scan_timeout": -1.0}, {"stop_distance": -0.1}, {"stop_angle": 4.0}],
)
def test_impossible_limits_are_refused(limits):
    with pytest.raises(TaskError):
        SafetyLimits(**limits)


def test_stop_distance_suits_the_policy(straight_on):
    contract = open_policy(straight_on).contract
    assert SafetyLimits.default_stop_distance(contract) == pytest.approx(0.16)
    other = dataclasses.replace(contract, collision_range=None)
    assert SafetyLimits.default_stop_distance(other) == 0.3


@pytest.mark.parametrize("turned", [math.nan, math.inf, -math.inf])
def test_a_lidar_that_is_turned_by_no_angle_is_refused(straight_on, turned):
    with pytest.raises(TaskError, match="'turned' must be a finite number"):
        Pilot(open_policy(straight_on), SafetyLimits(), turned=turned)


@pytest.mark.parametrize(
    "call",
    [
        lambda pilot, now: pilot.go_to([GoalPlace(1.0, 0.0)], now),
        lambda pilot, now: pilot.set_scan(scan(), now),
        lambda pilot, now: pilot.set_odometry(AT, now),
        lambda pilot, now: pilot.tick(now, (3.0, 0.0)),
        lambda pilot, now: pilot.arm(now),
    ],
)
def test_a_time_of_nan_is_refused_and_readings_grow_old_all_the_same(pilot, call):
    for now in (math.nan, math.inf, -math.inf):
        with pytest.raises(TaskError, match="must be a finite number"):
            call(pilot, now)
    assert not pilot.outcomes
    assert pilot.tick(10.0, (3.0, 0.0)).command.moves
    assert pilot.tick(99.0, (3.0, 0.0)).reason == "scan lost"


@pytest.mark.parametrize("name", ["x", "y", "yaw", "forward", "turning"])
def test_odometry_with_nan_stops_it(pilot, name):
    pilot.set_odometry(dataclasses.replace(AT, **{name: math.nan}), 10.0)
    tick = pilot.tick(10.0, (3.0, 0.0))
    assert (tick.command.moves, tick.acted) == (False, None)
    assert tick.reason == "odometry unusable: not finite numbers"


@pytest.mark.parametrize("name", ["angle_min", "angle_increment", "range_min", "range_max"])
def test_a_scan_that_says_nowhere_stops_it(pilot, name):
    pilot.set_scan(dataclasses.replace(scan(), **{name: math.nan}), 10.0)
    tick = pilot.tick(10.0, (3.0, 0.0))
    assert not tick.command.moves
    assert tick.reason.startswith("scan unusable")


def test_a_goal_that_is_nowhere_stops_it(pilot):
    assert not pilot.tick(10.0, (math.nan, 0.0)).command.moves


def test_obstacles_are_looked_for_in_a_direction():
    with pytest.raises(TaskError, match="yaw of a lidar"):
        SafetyLimits().blocked(VelocityCommand(), scan(), turned=math.nan)


@pytest.mark.parametrize("text", ["1,2\n3,4", "", '"', "1", "nan,1", "1e400,1"])
def test_a_text_that_is_no_goal(text):
    with pytest.raises(ValueError, match="is not a goal"):
        parse_goal(text)


def test_goals_are_read_from_a_file(tmp_path):
    file = tmp_path / "goals.txt"
    file.write_text("# x, y\n1, 2.5\n\n-3,0 # back\n0.5, 0.5, map\n")
    assert read_goals(file) == [
        GoalPlace(1.0, 2.5),
        GoalPlace(-3.0, 0.0),
        GoalPlace(0.5, 0.5, "map"),
    ]
    for line in ("1", "a, b", "1, nan", "1, 2, map, 4", f"1, {'9' * 200_000}"):
        file.write_text(f"1, 2\n{line}\n")
        with pytest.raises(FormatError, match=r"goals\.txt:2: .*is not a goal"):
            read_goals(file)
    with pytest.raises(FormatError, match="cannot read"):
        read_goals(tmp_path / "none.txt")


def test_an_onnx_file_drives_too(tmp_path, straight_on):
    pytest.importorskip("onnxruntime")
    from gazelle.training import load_actor
    from gazelle.training.onnx_graph import onnx_model

    file = tmp_path / "robot.onnx"
    file.write_bytes(onnx_model(load_actor(straight_on)).SerializeToString())
    file.with_suffix(".json").write_text(straight_on.with_suffix(".json").read_text())
    obs = np.random.default_rng(0).uniform(0, 3, (1, 26)).astype(np.float32)
    assert open_policy(file).decide(obs).command == VelocityCommand(0.15, 0.0)
    file.write_bytes(b"nonsense")
    with pytest.raises(FormatError, match="not a policy"):
        open_policy(file)


@pytest.mark.long
def test_onnx_runtime_leaves_nothing_and_reports_nothing(tmp_path, straight_on):
    from gazelle.training import load_actor
    from gazelle.training.onnx_graph import onnx_model

    file = tmp_path / "robot.onnx"
    file.write_bytes(onnx_model(load_actor(straight_on)).SerializeToString())
    file.with_suffix(".json").write_text(straight_on.with_suffix(".json").read_text())
    home = tmp_path / "home"
    home.mkdir()
    hidden = {"ORT_DISABLE_TELEMETRY", "XDG_CACHE_HOME"}
    env = {name: value for name, value in os.environ.items() if name not in hidden}
    script = "from gazelle.training.deploy import open_policy; import sys; open_policy(sys.argv[1])"
    subprocess.run(
        [sys.executable, "-c", script, str(file)],
        env=env | {"HOME": str(home), "TMPDIR": str(home)},
        check=True,
    )
    assert list(home.rglob("*")) == []


def test_a_policy_without_velocities_is_refused(tmp_path, straight_on):
    import json

    told = json.loads(straight_on.with_suffix(".json").read_text())
    told["action"] = {"kind": "other", "type": "discrete"}
    (tmp_path / "a.json").write_text(json.dumps(told))
    (tmp_path / "a.npz").write_bytes(straight_on.read_bytes())
    with pytest.raises(TaskError, match="not velocities"):
        open_policy(tmp_path / "a.npz")
