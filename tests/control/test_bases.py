"""Controllers of wheeled bases: what they command, and the odometry of wheels that obey."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gazelle.control import ControllerManager, ControllerParameters
from gazelle.control.base_odometry import BaseOdometry
from gazelle.control.speed_limiter import SpeedLimiter
from gazelle.control.values import BaseTwist, FourWheelCommand
from gazelle.errors import ControlError, ControlWarning
from tests.control.robots import DIFF, ROUND, urdf, wheels
from tests.control.stand_in import Frictionless, spin

COVARIANCE = {
    "pose_covariance_diagonal": [0.001, 0.001, 0.001, 0.001, 0.001, 0.03],
    "twist_covariance_diagonal": [0.002, 0.001, 0.001, 0.001, 0.001, 0.03],
}
DIFF_TYPE = "diff_drive_controller/DiffDriveController"


def base(kind, commands, model, nworld=1, **parameters):
    manager = ControllerManager(Frictionless(commands, nworld), model=model)
    controller = manager.load("c", {"type": kind, **COVARIANCE, **parameters})
    manager.start("c")
    return manager, controller


def diff(model=DIFF, **parameters):
    given = {"left_wheel": "left", "right_wheel": "right", **parameters}
    nworld = given.pop("nworld", 1)
    return base(DIFF_TYPE, {"Velocity": ["left", "right"]}, model, nworld, **given)


def send(controller, forward, turning, sideways=0.0, worlds=None):
    twist = BaseTwist((forward, sideways, 0.0), (0.0, 0.0, turning))
    controller.inputs["cmd_vel"].send(twist, worlds)


def drive(manager, controller, seconds, forward, turning, sideways=0.0):
    """Send the command repeatedly, as a teleoperation does."""
    for _ in range(round(seconds / 0.1)):
        send(controller, forward, turning, sideways)
        spin(manager, 10)


def test_wheels_turn_as_the_urdf_and_the_command_say():
    manager, controller = diff()
    send(controller, 0.22, 1.0)
    spin(manager)
    speeds = manager.hardware.joints.velocity[0]
    assert speeds == pytest.approx([(0.22 - 0.15) / 0.11, (0.22 + 0.15) / 0.11])


@pytest.mark.parametrize(
    ("name", "given", "wanted"),
    [
        ("separation", {"wheel_separation": 0.6}, [(0.22 - 0.3) / 0.11, (0.22 + 0.3) / 0.11]),
        ("radius", {"wheel_radius": 0.22}, [0.07 / 0.22, 0.37 / 0.22]),
        ("wider", {"wheel_separation_multiplier": 2.0}, [-0.08 / 0.11, 0.52 / 0.11]),
        ("both", {"wheel_radius_multiplier": 2.0}, [0.07 / 0.22, 0.37 / 0.22]),
        ("left", {"left_wheel_radius_multiplier": 2.0}, [0.07 / 0.22, 0.37 / 0.11]),
    ],
)
def test_sizes_and_multipliers(name, given, wanted):
    manager, controller = diff(**given)
    send(controller, 0.22, 1.0)
    spin(manager)
    assert manager.hardware.joints.velocity[0] == pytest.approx(wanted), name


@pytest.mark.parametrize(("forward", "turning"), [(0.5, 0.0), (0.0, 1.0), (0.5, 1.0), (-0.3, 0.7)])
def test_odometry_of_a_drive_is_its_arc(forward, turning):
    manager, controller = diff()
    drive(manager, controller, 2.0, forward, turning)
    spin(manager)
    found = controller.outputs["odom"].last
    angle = 2.0 * turning
    x = forward / turning * math.sin(angle) if turning else 2.0 * forward
    y = forward / turning * (1.0 - math.cos(angle)) if turning else 0.0
    assert found.position[0] == pytest.approx([x, y, 0.0], abs=0.01)
    assert found.quaternion[0] == pytest.approx(
        [0, 0, math.sin(angle / 2), math.cos(angle / 2)], abs=0.01
    )
    assert found.linear[0, 0] == pytest.approx(forward)
    assert found.angular[0, 2] == pytest.approx(turning)
    assert (found.frame, found.child_frame) == ("odom", "base_link")
    assert found.pose_variance[5] == 0.03


def test_a_command_is_old_after_its_timeout():
    manager, controller = diff(cmd_vel_timeout=0.2)
    send(controller, 1.0, 0.0)
    spin(manager, 20)
    assert manager.hardware.joints.velocity[0, 0] > 0.0
    spin(manager, 2)
    assert manager.hardware.joints.velocity[0].tolist() == [0.0, 0.0]


def test_commands_that_cannot_be_are_refused():
    manager, controller = diff(allow_multiple_cmd_vel_publishers=False)
    with pytest.warns(ControlWarning, match="not finite"):
        send(controller, math.nan, 0.0)
    send(controller, 1.0, 0.0)
    spin(manager)
    controller.inputs["cmd_vel"].publishers = lambda: 2
    with pytest.raises(ControlError, match="detected 2 publishers on 'c/cmd_vel'"):
        send(controller, 1.0, 0.0)
    manager.stop("c")
    with pytest.raises(ControlError, match="not running"):
        send(controller, 1.0, 0.0)
    assert controller.hardware.interfaces["hardware_interface/VelocityJointInterface"].commands[
        "velocity"
    ].tolist() == [[0.0, 0.0]]


LIMITS = {
    "linear": {"x": {"has_velocity_limits": True, "max_velocity": 1.0, "min_velocity": -0.5}},
    "angular": {"z": {"has_acceleration_limits": True, "max_acceleration": 2.0}},
}


def test_limits_hold_for_what_is_driven():
    manager, controller = diff(publish_cmd=True, **LIMITS)
    got = []
    controller.outputs["cmd_vel_out"].subscribe(got.append)
    drive(manager, controller, 1.0, 5.0, 9.0)
    assert max(each.linear[0, 0] for each in got) == 1.0
    turning = [each.angular[0, 2] for each in got]
    assert np.diff(turning) == pytest.approx([0.02] * (len(got) - 1))
    drive(manager, controller, 1.0, -5.0, 0.0)
    assert min(each.linear[0, 0] for each in got) == -0.5


NUMBER = st.floats(-100.0, 100.0)
BOUND = st.floats(0.01, 10.0)


@given(BOUND, BOUND, BOUND, st.lists(NUMBER, min_size=1, max_size=50), st.floats(0.001, 0.1))
def test_velocity_acceleration_and_jerk_are_never_exceeded(speed, rate, jerk, wanted, dt):
    limiter = SpeedLimiter((-speed, speed), (-rate, rate), (-jerk, jerk))
    only = SpeedLimiter(jerk=(-jerk, jerk))
    v0 = v1 = u0 = u1 = np.zeros(1)
    for each in wanted:
        v = limiter.limit(np.array([each]), v0, v1, dt)
        assert abs(v[0]) <= speed
        assert abs(v - v0)[0] <= rate * dt + 1e-9 or abs(v0[0]) > speed
        u = only.limit(np.array([each]), u0, u1, dt)
        assert abs((u - u0) - (u0 - u1))[0] <= 2.0 * jerk * dt * dt * (1.0 + 1e-6) + 1e-9
        v0, v1, u0, u1 = v, v0, u, u0


def test_limits_need_their_values():
    given_ = {"has_jerk_limits": True}
    with pytest.raises(ControlError, match="'c/linear/x/max_jerk'"):
        SpeedLimiter.read(ControllerParameters(given_, "c/linear/x"))
    wrong = {"has_velocity_limits": True, "max_velocity": 1.0, "min_velocity": 2.0}
    with pytest.raises(ControlError, match="above"):
        SpeedLimiter.read(ControllerParameters(wrong, "c/linear/x"))


@pytest.mark.parametrize(
    ("given_", "said"),
    [
        ({"left_wheel": "lefd"}, "'lefd' couldn't be retrieved"),
        ({"left_wheel": ["left", "left"]}, "#left wheels"),
        ({"left_wheel": []}, "is empty"),
        ({"pose_covariance_diagonal": [0, 0, 0, 0, 0, 0]}, "six floats"),
        ({"pose_covariance_diagonal": None}, "pose_covariance_diagonal"),
        ({"wheel_radius": 0.0}, "must be positive"),
    ],
)
def test_what_cannot_be_is_said_when_it_is_loaded(given_, said):
    with pytest.raises(ControlError, match=said):
        diff(**given_)


def test_wheels_that_are_not_round_need_a_radius():
    box = '<box size="0.1 0.1 0.1"/>'
    square = urdf(
        *((n, "continuous", a, box, "") for n, a in (("left", "0 1 0"), ("right", "0 0 0")))
    )
    with pytest.raises(ControlError, match="it has a box"):
        diff(square)
    diff(square, wheel_radius=0.1)
    with pytest.raises(ControlError, match="description is not known"):
        diff(None)
    diff(None, wheel_radius=0.1, wheel_separation=0.3)


def test_several_wheels_a_side_are_averaged():
    names = ["l0", "l1", "r0", "r1"]
    model = wheels(**dict.fromkeys(names[:2], "0 0.2 0"), **dict.fromkeys(names[2:], "0 -0.2 0"))
    manager, controller = base(
        DIFF_TYPE, {"Velocity": names}, model, left_wheel=names[:2], right_wheel=names[2:]
    )
    drive(manager, controller, 1.0, 0.5, 0.0)
    manager.hardware.joints.position[0, 0] += 0.2  # one slips
    spin(manager)
    assert controller.outputs["odom"].last.position[0, 0] == pytest.approx(
        0.5 + 0.2 * 0.11 / 4, abs=0.01
    )


def test_open_loop_counts_commands_and_nan_wheels_skip():
    manager, controller = diff(open_loop=True)
    manager.hardware.joints.position[:] = math.nan
    drive(manager, controller, 1.0, 0.5, 0.0)
    assert controller.outputs["odom"].last.position[0, 0] == pytest.approx(0.5, abs=0.01)
    manager, controller = diff()
    drive(manager, controller, 1.0, 0.5, 0.0)
    manager.hardware.joints.position[0, 0] = math.nan
    before = controller.outputs["odom"].last.position
    send(controller, 0.0, 0.0)
    spin(manager, 3)
    assert controller.outputs["odom"].last.position.tolist() == before.tolist()
    assert manager.hardware.joints.velocity[0, 1] > 0.0


def test_odometry_and_frames_go_out_at_their_rate():
    manager, controller = diff(publish_rate=20.0)
    odometry, frames = [], []
    controller.outputs["odom"].subscribe(odometry.append)
    controller.outputs["tf"].subscribe(frames.append)
    assert controller.outputs["tf"].topic == "/tf"
    spin(manager, 101)
    assert len(odometry) == len(frames) == 20
    controller.tunings[""].send(publish_rate=10.0, enable_odom_tf=False)
    spin(manager, 101)
    assert (len(odometry), len(frames)) == (30, 20)
    assert controller.tunings[""].send(wheel_separation_multiplier=9.0)[
        "wheel_separation_multiplier"
    ] == pytest.approx(1.5)


def test_worlds_drive_on_their_own_and_reset_alone():
    manager, controller = diff(nworld=3)
    for _ in range(10):
        send(controller, 0.5, 0.0, worlds=np.array([1]))
        spin(manager, 10)
    assert controller.outputs["odom"].last.position[:, 0] == pytest.approx([0, 0.5, 0], abs=0.01)
    state = controller.state()
    controller.reset(np.array([1]))
    assert not controller.outputs["odom"].last.position.any()
    controller.restore(state)
    assert controller.outputs["odom"].last.position[1, 0] == pytest.approx(0.5, abs=0.01)


def test_an_arc_is_exact_however_long_the_step():
    odometry = BaseOdometry(1)
    one = np.ones(1)
    odometry.move(one * math.pi, 0 * one, one * math.pi)
    assert odometry.pose[0] == pytest.approx([0.0, 2.0, math.pi])
    sideways = BaseOdometry(1)
    sideways.move(0 * one, one * math.pi, one * math.pi)
    assert sideways.pose[0] == pytest.approx([-2.0, 0.0, math.pi])


ACKERMANN = urdf(
    ("rear_wheel_joint", "continuous", "0 0 0.1", ROUND, ""),
    (
        "front_steer_joint",
        "revolute",
        "0.5 0 0.1",
        ROUND,
        '<limit lower="-1" upper="1" effort="1" velocity="9"/>',
    ),
)


def test_ackermann_steers_by_the_angle_and_rolls():
    manager, controller = base(
        "ackermann_steering_controller/AckermannSteeringController",
        {"Velocity": ["rear_wheel_joint"], "Position": ["front_steer_joint"]},
        ACKERMANN,
    )
    drive(manager, controller, 2.0, 0.5, 0.3)
    spin(manager)
    joints = manager.hardware.joints
    assert joints.velocity[0, joints.columns(["rear_wheel_joint"])[0]] == pytest.approx(0.5 / 0.11)
    assert joints.position[0, joints.columns(["front_steer_joint"])[0]] == pytest.approx(0.3)
    turning = 0.5 * math.tan(0.3) / 0.5
    found = controller.outputs["odom"].last
    assert found.angular[0, 2] == pytest.approx(turning)
    assert found.position[0, 0] == pytest.approx(0.5 / turning * math.sin(2.0 * turning), abs=0.01)


NAMES = [f"{where}_{side}" for where in ("front", "rear") for side in ("left", "right")]
PLACES = {"front_left": "0.5 0.3 0", "front_right": "0.5 -0.3 0"}
PLACES |= {"rear_left": "-0.5 0.3 0", "rear_right": "-0.5 -0.3 0"}
FOUR = urdf(
    *((f"{name}_wheel", "continuous", at, ROUND, "") for name, at in PLACES.items()),
    *(
        (
            f"{name}_steer",
            "revolute",
            at,
            ROUND,
            '<limit lower="-2" upper="2" effort="1" velocity="9"/>',
        )
        for name, at in PLACES.items()
    ),
)


def four(**changes):
    parameters = {
        "front_wheel": ["front_left_wheel", "front_right_wheel"],
        "rear_wheel": ["rear_left_wheel", "rear_right_wheel"],
        "front_steering": ["front_left_steer", "front_right_steer"],
        "rear_steering": ["rear_left_steer", "rear_right_steer"],
    }
    return base(
        "four_wheel_steering_controller/FourWheelSteeringController",
        {"Velocity": [f"{n}_wheel" for n in NAMES], "Position": [f"{n}_steer" for n in NAMES]},
        FOUR,
        **{**parameters, **changes},
    )


def rolling(manager, forward, sideways, turning):
    """Return each wheel's deviation from rolling along the motion of a rigid body."""
    joints, missed = manager.hardware.joints, []
    for name in NAMES:
        x, y, _ = map(float, PLACES[name].split())
        velocity = np.array([forward - turning * y, sideways + turning * x])
        angle = joints.position[0, joints.columns([f"{name}_steer"])[0]]
        speed = joints.velocity[0, joints.columns([f"{name}_wheel"])[0]] * 0.11
        missed.append(
            np.linalg.norm(velocity - speed * np.array([math.cos(angle), math.sin(angle)]))
        )
    return max(missed)


@pytest.mark.parametrize(("forward", "turning"), [(1.0, 0.0), (1.0, 0.6), (-0.8, 0.5), (0.5, -1.0)])
def test_four_wheels_roll_without_slip_by_twists(forward, turning):
    manager, controller = four()
    drive(manager, controller, 1.0, forward, turning)
    spin(manager)
    assert rolling(manager, forward, 0.0, turning) < 1e-9
    found = controller.outputs["odom"].last
    assert found.linear[0, :2] == pytest.approx([forward, 0.0], abs=1e-3)
    assert found.angular[0, 2] == pytest.approx(turning, abs=1e-3)


@pytest.mark.parametrize(
    ("front", "rear", "speed"),
    [(0.0, 0.0, 1.0), (0.3, -0.3, 1.0), (0.3, 0.3, 1.0), (0.4, 0.0, -0.7), (0.2, -0.1, 0.5)],
)
def test_four_wheels_roll_without_slip_by_angles(front, rear, speed):
    manager, controller = four()
    assert set(controller.inputs) == {"cmd_vel", "cmd_four_wheel_steering"}
    for _ in range(10):
        controller.inputs["cmd_four_wheel_steering"].send(FourWheelCommand(front, rear, speed))
        spin(manager, 10)
    spin(manager)
    turning = speed * (math.tan(front) - math.tan(rear))
    forward, sideways = speed, speed * 0.5 * (math.tan(front) + math.tan(rear))
    if front == rear:  # then the speed is that along the wheels
        forward, sideways = speed * math.cos(front), speed * math.sin(front)
    assert rolling(manager, forward, sideways, turning) < 1e-9
    found = controller.outputs["odom"].last
    assert found.linear[0, :2] == pytest.approx([forward, sideways], abs=1e-3)
    assert found.angular[0, 2] == pytest.approx(turning, abs=1e-3)
    steer = controller.outputs["odom_steer"].last
    assert (steer.front_angle[0], steer.rear_angle[0]) == pytest.approx((front, rear), abs=1e-6)


def test_four_wheels_stand_straight_when_nobody_commands():
    manager, controller = four()
    controller.inputs["cmd_four_wheel_steering"].send(FourWheelCommand(0.3, 0.1, 1.0))
    spin(manager, 60)
    assert not manager.hardware.joints.velocity.any()
    with pytest.warns(ControlWarning, match="not finite"):
        controller.inputs["cmd_four_wheel_steering"].send(FourWheelCommand(math.nan))
    with pytest.raises(ControlError, match="two joints are needed"):
        four(rear_wheel=["rear_left_wheel"])


def mecanum(**parameters):
    corners = {"front_left": "0.3 0.2 0", "back_left": "-0.3 0.2 0"}
    corners |= {"back_right": "-0.3 -0.2 0", "front_right": "0.3 -0.2 0"}
    names = {f"{place}_wheel_joint": place for place in corners}
    of = "mecanum_drive_controller/MecanumDriveController"
    return base(of, {"Velocity": list(corners)}, wheels(**corners), **names, **parameters)


@pytest.mark.long
@given(NUMBER, NUMBER, NUMBER)
def test_mecanum_wheels_roll_along_their_rollers(forward, sideways, turning):
    """At the ground each wheel's centre moves as the rigid body, less what its rollers let go."""
    manager, controller = mecanum()
    send(controller, forward, turning, sideways)
    spin(manager, 11)  # the first one measured wheels that stood
    joints = manager.hardware.joints
    for name, (x, y), slant in (
        ("front_left", (0.3, 0.2), -1.0),
        ("back_left", (-0.3, 0.2), 1.0),
        ("back_right", (-0.3, -0.2), -1.0),
        ("front_right", (0.3, -0.2), 1.0),
    ):
        velocity = np.array([forward - turning * y, sideways + turning * x])
        speed = joints.velocity[0, joints.columns([name])[0]] * 0.11
        slip = velocity - (speed, 0.0)
        along = np.array([1.0, slant])  # the line across a roller's axle is the other diagonal
        assert slip @ along == pytest.approx(0.0, abs=1e-9 * (1 + np.abs(velocity).max()) * 10)
    twist = controller.odometry.twist[0]
    assert twist == pytest.approx([forward, sideways, turning], rel=1e-6, abs=1e-9)


def test_mecanum_sizes_may_be_given():
    manager, controller = mecanum(wheel_separation_x=2.0, wheel_separation_y=1.0, wheel_radius=0.5)
    send(controller, 0.0, 1.0)
    spin(manager)
    assert sorted(manager.hardware.joints.velocity[0]) == pytest.approx([-3.0, -3.0, 3.0, 3.0])
    with pytest.raises(ControlError, match="must be positive"):
        mecanum(wheel_radius=0.0)
