"""Four steered and driven wheels in physics: the circle is the one that the angles make."""

from __future__ import annotations

import math

import pytest

import gazelle
from gazelle import builders, formats
from gazelle.control.values import BaseTwist, FourWheelCommand

LENGTH, TRACK, RADIUS = 1.0, 0.8, 0.15
SIDES = [("front_left", 0.5, 0.4), ("front_right", 0.5, -0.4)]
SIDES += [("rear_left", -0.5, 0.4), ("rear_right", -0.5, -0.4)]
INERTIAL = """<inertial><mass value="{0}"/><inertia ixx="{1}" iyy="{1}" izz="{1}" ixy="0" ixz="0"
 iyz="0"/></inertial>"""
AT_WHEEL = 'xyz="0 0 0" rpy="1.5707963267948966 0 0"'
VARIANCE = [0.001] * 6


def base_text():
    """Return a box on four wheels, each on a steering link of its own."""
    box = '<collision><geometry><box size="0.9 0.5 0.2"/></geometry></collision>'
    text = f'<link name="base_link">{INERTIAL.format(20, 1.5)}{box}</link>'
    for name, x, y in SIDES:
        text += f"""<link name="{name}_fork">{INERTIAL.format(0.5, 0.01)}</link>
<joint name="{name}_steer" type="revolute"><parent link="base_link"/><child link="{name}_fork"/>
<origin xyz="{x} {y} -0.15"/><axis xyz="0 0 1"/>
<limit lower="-1.6" upper="1.6" effort="200" velocity="10"/></joint>
<link name="{name}_wheel">{INERTIAL.format(1, 0.01)}<collision><origin {AT_WHEEL}/>
<geometry><cylinder radius="{RADIUS}" length="0.05"/></geometry></collision></link>
<joint name="{name}" type="continuous"><parent link="{name}_fork"/><child link="{name}_wheel"/>
<axis xyz="0 1 0"/><limit effort="50" velocity="50"/></joint>"""
    plugin = '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
    text = f'<robot name="rover">{text}{plugin}</robot>'
    for name, *_ in SIDES:
        kind = "hardware_interface/{}JointInterface".format
        text = builders.add_transmission(text, name, interface=kind("Velocity"))
        text = builders.add_transmission(text, f"{name}_steer", interface=kind("Position"))
    return text


@pytest.fixture(scope="module")
def rover():
    """Return a simulation of it, its controller running."""
    sim = gazelle.Simulation("empty")
    robot = sim.spawn(formats.load_model_string(base_text()), pose=gazelle.Pose(z=0.31))
    gains = {"p": 400.0, "i": 0.0, "d": 8.0}
    robot.settings["pid_gains"].send({f"{name}_steer": gains for name, *_ in SIDES})
    robot.controllers.load(
        "drive",
        {
            "type": "four_wheel_steering_controller/FourWheelSteeringController",
            "front_wheel": ["front_left", "front_right"],
            "rear_wheel": ["rear_left", "rear_right"],
            "front_steering": ["front_left_steer", "front_right_steer"],
            "rear_steering": ["rear_left_steer", "rear_right_steer"],
            "pose_covariance_diagonal": VARIANCE,
            "twist_covariance_diagonal": VARIANCE,
            "cmd_vel_timeout": 100.0,
        },
    )
    robot.controllers.start("drive")
    return sim, robot


def circle(sim, robot, seconds):
    """Return radius [m] and turning rate [rad/s] of the drive: by chord and angle of the path."""
    sim.run(0.8)
    x, y, heading = sim.engine.models[robot.name].planar_pose()[0]
    turned, before = 0.0, heading
    for _ in range(round(seconds / 0.1)):
        sim.run(0.1)
        now = sim.engine.models[robot.name].planar_pose()[0]
        turned, before = turned + math.remainder(now[2] - before, math.tau), now[2]
    chord = math.hypot(now[0] - x, now[1] - y)
    return chord / (2.0 * abs(math.sin(0.5 * turned))), turned / seconds


SLOW = pytest.mark.slow
ANGLES = [(0.3, -0.3, 0.5), (-0.35, 0.0, 0.5), (0.4, 0.2, 0.4), (0.3, -0.3, -0.4)]
TWISTS = [(0.4, -0.5), (0.5, 0.3), (-0.4, 0.3)]


def first_quick(cases):
    """Mark all cases but the first as slow."""
    return [cases[0], *(pytest.param(*case, marks=SLOW) for case in cases[1:])]


@pytest.mark.parametrize(("front", "rear", "speed"), first_quick(ANGLES))
def test_angles_in_front_and_behind_make_their_circle(rover, front, rear, speed):
    """The middle turns about the point where the normals of both axles meet."""
    sim, robot = rover
    sim.reset()
    port = robot.controllers["drive"].inputs["cmd_four_wheel_steering"]
    port.send(FourWheelCommand(front, rear, speed))
    radius, rate = circle(sim, robot, 2.0)
    slopes = math.tan(front), math.tan(rear)
    wanted = speed * (slopes[0] - slopes[1]) / LENGTH
    across = 0.5 * speed * (slopes[0] + slopes[1])
    assert rate == pytest.approx(wanted, rel=0.03)
    assert radius == pytest.approx(math.hypot(speed, across) / abs(wanted), rel=0.03)


@pytest.mark.parametrize(("forward", "turning"), first_quick(TWISTS))
def test_a_velocity_makes_its_circle_and_odometry_knows(rover, forward, turning):
    sim, robot = rover
    sim.reset()
    drive = robot.controllers["drive"]
    drive.inputs["cmd_vel"].send(BaseTwist((forward, 0.0, 0.0), (0.0, 0.0, turning)))
    radius, rate = circle(sim, robot, 2.0)
    assert rate == pytest.approx(turning, rel=0.03)
    assert radius == pytest.approx(abs(forward / turning), rel=0.03)
    assert drive.odometry.twist[0, 2] == pytest.approx(turning, rel=0.03)
    assert drive.odometry.twist[0, 0] == pytest.approx(forward, rel=0.03)
