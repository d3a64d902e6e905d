"""The bundled Fetch has the figures of the published one, and moves and grips as it does."""

from __future__ import annotations

import os
import warnings
from pathlib import Path

import numpy as np
import pytest
import yaml

import gazelle
from gazelle import assets, formats
from gazelle.control import GoalState
from gazelle.control.values import GripperGoal, JointTrajectory, TrajectoryGoal, TrajectoryPoint
from gazelle.errors import FormatWarning
from gazelle.kinematics import RobotModel

URDF = assets.root() / "fetch_description" / "robots" / "fetch.urdf"
CONTROLLERS = assets.root() / "fetch_gazebo" / "config" / "default_controllers.yaml"
ARM = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "upperarm_roll_joint",
    "elbow_flex_joint",
    "forearm_roll_joint",
    "wrist_flex_joint",
    "wrist_roll_joint",
)
# Type, parent, origin, axis, limits, speed, effort, damping: docs.fetchrobotics.com.
JOINTS = {
    "r_wheel_joint": ("continuous", "base_link", (0.0012914, -0.18738, 0.055325), (0, 1, 0), None, 17.4, 8.85, 0),
    "l_wheel_joint": ("continuous", "base_link", (0.0012914, 0.18738, 0.055325), (0, 1, 0), None, 17.4, 8.85, 0),
    "torso_lift_joint": ("prismatic", "base_link", (-0.086875, 0, 0.37743), (0, 0, 1), (0, 0.38615), 0.1, 450, 100),
    "head_pan_joint": ("revolute", "torso_lift_link", (0.053125, 0, 0.603001417713939), (0, 0, 1), (-1.57, 1.57), 1.57, 0.32, 0),
    "head_tilt_joint": ("revolute", "head_pan_link", (0.14253, 0, 0.057999), (0, 1, 0), (-0.76, 1.45), 1.57, 0.68, 0),
    "shoulder_pan_joint": ("revolute", "torso_lift_link", (0.119525, 0, 0.34858), (0, 0, 1), (-1.6056, 1.6056), 1.256, 33.82, 1),
    "shoulder_lift_joint": ("revolute", "shoulder_pan_link", (0.117, 0, 0.06), (0, 1, 0), (-1.221, 1.518), 1.454, 131.76, 1),
    "upperarm_roll_joint": ("continuous", "shoulder_lift_link", (0.219, 0, 0), (1, 0, 0), None, 1.571, 76.94, 5),
    "elbow_flex_joint": ("revolute", "upperarm_roll_link", (0.133, 0, 0), (0, 1, 0), (-2.251, 2.251), 1.521, 66.18, 1),
    "forearm_roll_joint": ("continuous", "elbow_flex_link", (0.197, 0, 0), (1, 0, 0), None, 1.571, 29.35, 5),
    "wrist_flex_joint": ("revolute", "forearm_roll_link", (0.1245, 0, 0), (0, 1, 0), (-2.16, 2.16), 2.268, 25.7, 1),
    "wrist_roll_joint": ("continuous", "wrist_flex_link", (0.1385, 0, 0), (1, 0, 0), None, 2.268, 7.36, 5),
    "r_gripper_finger_joint": ("prismatic", "gripper_link", (0, 0.015425, 0), (0, 1, 0), (0, 0.05), 0.05, 60, 100),
    "l_gripper_finger_joint": ("prismatic", "gripper_link", (0, -0.015425, 0), (0, -1, 0), (0, 0.05), 0.05, 60, 100),
    "bellows_joint": ("prismatic", "torso_lift_link", (0, 0, 0), (0, 0, -1), (0, 0.4), 0.1, 5, 0),
}  # fmt: skip
MASSES = {
    "base_link": 70.1294, "r_wheel_link": 4.3542, "l_wheel_link": 4.3542, "torso_lift_link": 10.7796,
    "head_pan_link": 2.2556, "head_tilt_link": 0.9087, "shoulder_pan_link": 2.5587,
    "shoulder_lift_link": 2.6615, "upperarm_roll_link": 2.3311, "elbow_flex_link": 2.1299,
    "forearm_roll_link": 1.6563, "wrist_flex_link": 1.725, "wrist_roll_link": 0.1354,
    "gripper_link": 1.5175, "r_gripper_finger_link": 0.0798, "l_gripper_finger_link": 0.0798,
    "torso_fixed_link": 13.2775,
}  # fmt: skip


@pytest.fixture(scope="module")
def tree():
    from lxml import etree

    return etree.parse(str(URDF)).getroot()


def joints_of(tree):
    """Return the figures of the joints, in the form of ``JOINTS``."""

    def triple(element, key="xyz"):
        text = "0 0 0" if element is None else element.get(key, "0 0 0")
        return tuple(float(word) for word in text.split())

    found = {}
    for joint in tree.findall("joint"):
        limit, damping = joint.find("limit"), joint.find("dynamics")
        if limit is None:
            continue
        between = None
        if "upper" in limit.attrib:
            between = (float(limit.get("lower", "0")), float(limit.get("upper")))
        found[joint.get("name")] = (
            joint.get("type"),
            joint.find("parent").get("link"),
            triple(joint.find("origin")),
            triple(joint.find("axis")),
            between,
            float(limit.get("velocity")),
            float(limit.get("effort")),
            float(damping.get("damping")) if damping is not None else 0.0,
        )
    return found


def same(one, other):
    for mine, theirs in zip(one, other, strict=True):
        assert mine == (theirs if isinstance(theirs, str) else pytest.approx(theirs, abs=1e-9))


def masses_of(tree):
    return {
        link.get("name"): float(link.find("inertial/mass").get("value"))
        for link in tree.findall("link")
        if link.find("inertial") is not None
    }


def test_joints_have_the_published_figures(tree):
    found = joints_of(tree)
    assert found.keys() == JOINTS.keys()
    for name, figures in JOINTS.items():
        same(found[name], figures)


def test_links_have_the_published_masses(tree):
    found = masses_of(tree)
    for link, mass in MASSES.items():
        assert found[link] == pytest.approx(mass, abs=1e-9), link
    assert sum(found.values()) == pytest.approx(121.28, abs=0.05)


def test_shapes_are_primitive_and_links_are_there_for_frames(tree):
    assert {shape.tag for shape in tree.iterfind(".//geometry/*")} <= {"box", "cylinder", "sphere"}
    links = {link.get("name") for link in tree.findall("link")}
    assert {"head_camera_rgb_optical_frame", "laser_link", "estop_link", "bellows_link2"} <= links


@pytest.fixture(scope="module")
def published():
    """Return the original's ``fetch.urdf``, of a checkout of fetch_ros in ``GAZELLE_ROBOTS``."""
    file = (
        Path(os.environ.get("GAZELLE_ROBOTS", "")) / "fetch_ros/fetch_description/robots/fetch.urdf"
    )
    if not file.is_file():
        pytest.skip("no checkout of fetch_ros is at hand (set GAZELLE_ROBOTS)")
    return file


def test_figures_are_the_originals(tree, published):
    from lxml import etree

    original = etree.parse(str(published)).getroot()
    wanted = joints_of(original)
    for name, figures in joints_of(tree).items():
        same(figures, wanted[name])
    assert masses_of(tree) == pytest.approx(masses_of(original))
    for link in original.findall("link"):
        moments = link.find("inertial/inertia")
        if moments is None or "finger" in link.get("name"):
            continue
        (own,) = tree.xpath(f"link[@name='{link.get('name')}']/inertial")
        for key, value in moments.attrib.items():
            assert float(own.find("inertia").get(key)) == pytest.approx(float(value), abs=1e-12)
        there = link.find("inertial/origin").get("xyz")
        here = own.find("origin").get("xyz", "0 0 0")
        assert [float(word) for word in here.split()] == pytest.approx(
            [float(word) for word in there.split()], abs=1e-12
        )


def test_links_are_where_the_originals_are(published):
    ours = RobotModel(formats.load_model(URDF))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FormatWarning)  # moments of its fingers are of no body
        theirs = RobotModel(formats.load_model(published))
    random = np.random.default_rng(1)
    low, high = theirs.limits()
    states = random.uniform(np.maximum(low, -3.0), np.minimum(high, 3.0), (200, len(low)))
    torso, bellows = (theirs.column(f"{name}_joint") for name in ("torso_lift", "bellows"))
    states[:, bellows] = 0.5 * states[:, torso]  # as the original's controller has it
    own = np.zeros((200, len(ours.variables)))
    for name in theirs.names:
        own[:, ours.column(name)] = states[:, theirs.column(name)]
    assert {*theirs.links} == {*ours.links}
    links = [*theirs.links]
    np.testing.assert_allclose(
        ours.forward(own, links), theirs.forward(states, links), rtol=0.0, atol=1e-6
    )


# -- in simulation ---------------------------------------------------------------------------


@pytest.fixture
def fetch():
    """Yield the robot in an empty world, with its controllers running."""
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn("fetch")
        for name, parameters in yaml.safe_load(CONTROLLERS.read_text(encoding="utf-8")).items():
            robot.controllers.load(name, parameters)
            if name != "arm_with_torso_controller":
                robot.controllers.start(name)
        yield robot


def done(goal, sim, seconds=10.0):
    """Step until a goal ends."""
    until = sim.time + seconds
    while not goal.done and sim.time < until:
        sim.run(0.02)
    return goal


def grip(robot, position, effort=0.0):
    action = robot.controllers["gripper_controller"].actions["gripper_action"]
    return done(action.send(GripperGoal(position, effort)), robot.simulation)


@pytest.mark.long
def test_it_stands_and_holds_its_arm(fetch):
    sim = fetch.simulation
    sim.run(1.0)
    before = [fetch.joints[name].position for name in ARM]
    sim.run(2.0)
    assert [fetch.joints[name].position for name in ARM] == pytest.approx(before, abs=1e-4)
    assert fetch.pose.position == pytest.approx((0.0, 0.0, 0.005), abs=2e-3)
    assert abs(fetch.pose.pitch) < 5e-3


@pytest.mark.long
def test_it_tucks_its_arm_as_the_published_script_does(fetch):
    still = (0.0,) * 7
    way = [
        (3.0, (1.32, 0.0, -1.4, 1.72, 0.0, 1.66, 0.0)),
        (6.5, (1.32, 1.4, -0.2, 1.72, 0.0, 1.66, 0.0)),
    ]
    points = tuple(TrajectoryPoint(time, there, still, still) for time, there in way)
    action = fetch.controllers["arm_controller"].actions["follow_joint_trajectory"]
    goal = done(action.send(TrajectoryGoal(JointTrajectory(ARM, points))), fetch.simulation)
    assert goal.state == GoalState.SUCCEEDED, goal.text
    assert [fetch.joints[name].position for name in ARM] == pytest.approx(way[-1][1], abs=0.01)


@pytest.mark.long
def test_fingers_go_to_an_opening_alike(fetch):
    for opening in (0.1, 0.02, 0.06):
        goal = grip(fetch, opening)
        assert goal.state == GoalState.SUCCEEDED
        assert goal.result.reached_goal
        assert goal.result.position == pytest.approx(opening, abs=0.0021)
        left, right = (fetch.joints[f"{side}_gripper_finger_joint"].position for side in "lr")
        assert left == pytest.approx(right, abs=1e-4)


def test_its_topics_have_the_robots_names(fetch):
    topics = {port.topic for port in fetch.outputs.values()}
    assert {"/odom", "/tf", "/base_scan"} <= topics
    assert {"/head_camera/rgb/image_raw", "/head_camera/depth_registered/points"} <= topics
    assert fetch.inputs["cmd_vel"].topic == "/cmd_vel"


@pytest.mark.long
def test_it_drives_and_knows_how_far(fetch):
    fetch.inputs["cmd_vel"].send(0.5, 0.0)
    fetch.simulation.run(3.0)
    assert fetch.twist.linear[0] == pytest.approx(0.5, abs=0.02)
    away = fetch.outputs["odom"].last.position[0, 0]
    assert away == pytest.approx(fetch.pose.x, rel=0.02)


def test_its_laser_and_camera_see_nothing_of_itself(fetch):
    fetch.simulation.run(0.1)
    scan = fetch.sensors["base_laser"].read()
    assert scan.ranges.shape[-1] == 662
    assert np.isinf(scan.ranges).all()
