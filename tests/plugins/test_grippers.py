"""Joint paths, the vacuum gripper, and what holds objects between fingers."""

import numpy as np
import pytest
from models import plugin, simulate

from gazelle.errors import PluginWarning
from gazelle.simulation.values import JointPath, PathRequest

ARM = """<model name="arm"><link name="base"><inertial><mass>1</mass></inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<link name="tip"><pose>0.5 0 0 0 0 0</pose><gravity>0</gravity><inertial><mass>2</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
<joint name="elbow" type="revolute"><parent>base</parent><child>tip</child>
<pose>-0.5 0 0 0 0 0</pose><axis><xyz>0 0 1</xyz></axis></joint>{plugin}</model>"""
PATH = JointPath(("elbow",), np.array([0.1, 0.5]), np.array([[0.3], [-0.2]]))
PLAYER = plugin("libgazebo_ros_joint_pose_trajectory.so")


def test_joints_are_at_their_waypoints_at_their_times():
    with simulate(ARM.format(plugin=PLAYER), ground=False, nworld=2) as sim:
        robot = sim.robots["arm"]
        robot.inputs["set_joint_trajectory"].send(PATH, np.array([1]))
        elbow = robot.joints["elbow"]
        for until, there in ((0.05, 0.0), (0.2, 0.3), (0.45, 0.3), (0.6, -0.2)):
            sim.run(seconds=until - sim.time)
            assert elbow.positions()[:, 0] == pytest.approx([0.0, there], abs=1e-6)
        assert robot.inputs["set_joint_trajectory"].topic == "/set_joint_trajectory"


def test_a_joint_path_is_asked_for_by_service_too():
    with simulate(ARM.format(plugin=PLAYER), ground=False) as sim:
        service = sim.robots["arm"].services["set_joint_trajectory"]
        assert service.call(PathRequest(PATH)).success
        sim.run(seconds=0.2)
        assert sim.robots["arm"].joints["elbow"].position == pytest.approx(0.3)
        wrong = JointPath(("knee",), np.zeros(1), np.zeros((1, 1)))
        answer = service.call(PathRequest(wrong))
        assert not answer.success
        assert "knee" in answer.text
        short = JointPath(("elbow",), np.zeros(2), np.zeros((1, 1)))
        assert not service.call(PathRequest(short)).success


def test_a_joint_path_goes_on_after_a_snapshot_and_ends_at_a_reset():
    with simulate(ARM.format(plugin=PLAYER), ground=False) as sim:
        robot = sim.robots["arm"]
        robot.inputs["set_joint_trajectory"].send(PATH)
        sim.run(seconds=0.2)
        state = sim.snapshot()
        sim.reset()
        sim.run(seconds=1.0)
        assert robot.joints["elbow"].position == pytest.approx(0.0)
        sim.restore(state)
        sim.run(seconds=0.4)
        assert robot.joints["elbow"].position == pytest.approx(-0.2)


CUP = f"""<model name="cup"><link name="core"><gravity>0</gravity><inertial><mass>5</mass><inertia>
<ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
{plugin("libgazebo_ros_vacuum_gripper.so", bodyName="core", topicName="grasping")}</model>"""
CRUMB = """<model name="crumb"><pose>0 0 {z} 0 0 0</pose><link name="l"><inertial><mass>0.1</mass>
<inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial></link></model>"""


def test_what_is_near_a_cup_is_drawn_while_it_is_on():
    with simulate(CUP, CRUMB.format(z=-0.03), ground=False, nworld=2) as sim:
        cup, crumb = sim.robots["cup"], sim.robots["crumb"]
        assert cup.outputs["grasping"].topic == "/grasping"
        assert {cup.services["on"].topic, cup.services["off"].topic} == {"/on", "/off"}
        cup.services["on"].call(None, np.array([1]))
        cup.outputs["grasping"].subscribe(lambda _: None)
        sim.run(seconds=0.3)
        assert crumb.position[0, 2] < -0.4
        assert crumb.position[1, 2] == pytest.approx(0.0, abs=0.05)
        assert cup.outputs["grasping"].last.values.tolist() == [False, True]
        cup.services["off"].call(None)
        sim.run(seconds=0.5)
        assert crumb.position[1, 2] < -0.5
        assert not cup.outputs["grasping"].last.values.any()


def test_what_is_held_goes_along_and_what_is_far_does_not():
    with simulate(CUP, CRUMB.format(z=-0.005), ground=False) as sim:
        cup, crumb = sim.robots["cup"], sim.robots["crumb"]
        cup.services["on"].call(None)
        for _ in range(5):
            cup.set_twist((0.2, 0.0, 0.0), (0.0, 0.0, 0.0))
            sim.run(seconds=0.1)
        assert crumb.pose.x == pytest.approx(cup.pose.x, abs=0.01)
    with simulate(CUP, CRUMB.format(z=-0.2), ground=False) as sim:
        sim.robots["cup"].services["on"].call(None)
        sim.run(seconds=0.3)
        assert sim.robots["crumb"].pose.z < -0.5


def test_a_cup_that_is_deleted_draws_no_more():
    light = CRUMB.format(z=-0.03).replace("<inertial>", "<gravity>0</gravity><inertial>", 1)
    with simulate(CUP, light, ground=False) as sim:
        sim.robots["cup"].services["on"].call(None)
        sim.step(2)
        sim.delete("cup")
        before = sim.robots["crumb"].twist.linear[2]
        sim.run(seconds=0.1)
        assert sim.robots["crumb"].twist.linear[2] == pytest.approx(before, abs=1e-6)


HAND = """<model name="hand"><link name="palm"><pose>0 0 1 0 0 0</pose><inertial><mass>1</mass>
</inertial></link><joint name="fix" type="fixed"><parent>world</parent><child>palm</child></joint>
{fingers}{plugin}</model>"""
FINGER = """<link name="f{sign}"><pose>0 {y} 0.9 0 0 0</pose><gravity>0</gravity><inertial>
<mass>0.3</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
<collision name="c"><geometry><box><size>0.04 0.02 0.04</size></box></geometry></collision></link>
<joint name="j{sign}" type="prismatic"><parent>palm</parent><child>f{sign}</child><axis>
<xyz>0 1 0</xyz></axis></joint>"""
CUBE = """<model name="cube"><pose>0 0 0.9 0 0 0</pose><link name="core"><inertial><mass>0.1</mass>
<inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia></inertial><collision name="c">
<geometry><box><size>0.06 0.06 0.06</size></box></geometry></collision></link></model>"""


def hand(**tags):
    links = (
        "<palm_link>palm</palm_link><gripper_link>f0</gripper_link><gripper_link>f1</gripper_link>"
    )
    fix = plugin("libgazebo_grasp_fix.so", update_rate="100", max_grip_count="4", **tags)
    fix = fix.replace("</plugin>", f"<arm><arm_name>a</arm_name>{links}</arm></plugin>")
    fingers = FINGER.format(sign=0, y=0.045) + FINGER.format(sign=1, y=-0.045)
    return HAND.format(fingers=fingers, plugin=fix)


def squeeze(sim, effort):
    joints = sim.robots["hand"].joints
    joints["j0"].effort = -np.asarray(effort)
    joints["j1"].effort = np.asarray(effort)


def test_what_is_squeezed_is_held_until_the_fingers_open():
    with simulate(hand(), CUBE, ground=False) as sim:
        cube = sim.robots["cube"]
        squeeze(sim, 10.0)
        sim.run(seconds=0.3)
        held_at = cube.pose.z
        assert held_at > 0.85
        # Held by the palm now: fingers that press no more do not drop it.
        squeeze(sim, 0.0)
        sim.run(seconds=0.3)
        assert cube.pose.z == pytest.approx(held_at, abs=0.005)
        squeeze(sim, -2.0)
        sim.run(seconds=0.5)
        assert cube.pose.z < held_at - 0.2


def test_what_is_not_squeezed_falls_and_a_reset_forgets():
    with simulate(hand(), CUBE, ground=False, nworld=2) as sim:
        squeeze(sim, [10.0, -1.0])
        sim.run(seconds=0.3)
        height = sim.robots["cube"].position[:, 2]
        assert height[0] > 0.85
        assert height[1] < 0.6
        state = sim.snapshot()
        sim.reset()
        sim.run(seconds=0.3)
        assert (sim.robots["cube"].position[:, 2] < 0.6).all()
        sim.restore(state)
        squeeze(sim, [0.0, 0.0])
        sim.run(seconds=0.2)
        assert sim.robots["cube"].position[0, 2] == pytest.approx(height[0], abs=0.005)


def test_every_world_holds_and_lets_go_by_itself():
    with simulate(hand(), CUBE, ground=False, nworld=3) as sim:
        cube = sim.robots["cube"]
        squeeze(sim, [10.0, 10.0, -1.0])
        sim.run(seconds=0.3)
        squeeze(sim, [0.0, -2.0, 0.0])
        sim.run(seconds=0.5)
        assert cube.position[0, 2] > 0.85
        assert (cube.position[1:, 2] < 0.7).all()


def test_a_hand_needs_a_palm_and_fingers():
    bare = HAND.format(fingers="", plugin=plugin("libgazebo_grasp_fix.so"))
    with pytest.raises(PluginWarning, match="palm_link"):
        simulate(bare)
    with pytest.raises(PluginWarning, match="gripper_link"):
        simulate(HAND.format(fingers="", plugin=plugin("libgazebo_grasp_fix.so", palm_link="palm")))
