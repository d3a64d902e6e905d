"""Plugins that push, hold and join."""

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle import Pose
from gazelle.errors import PluginWarning, SimulationError
from gazelle.simulation.values import LinkName, LinkPair, Push

FORCE = plugin("libgazebo_ros_force.so", bodyName="core", topicName="push")
F3D = plugin("libgazebo_ros_f3d.so", bodyName="core", topicName="felt", frameName="map")


def test_a_force_on_command_acts_until_the_next():
    with simulate(block(plugin=FORCE, gravity=False), ground=False) as sim:
        robot = sim.robots["cube"]
        assert robot.inputs["push"].topic == "/push"
        robot.inputs["push"].send(Push((2.0, 0.0, 0.0), (0.0, 0.0, 0.01)))
        sim.run(seconds=1.0)
        assert robot.twist.linear[0] == pytest.approx(2.0, rel=1e-3)
        assert robot.twist.angular[2] == pytest.approx(1.0, rel=1e-3)
        robot.inputs["push"].send(Push(np.zeros(3), np.zeros(3)))
        sim.run(seconds=1.0)
        assert robot.twist.linear[0] == pytest.approx(2.0, rel=1e-3)


def test_a_force_adds_to_others_and_worlds_have_their_own():
    with simulate(block(plugin=FORCE, gravity=False), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        robot.inputs["push"].send(Push((1.0, 0.0, 0.0), np.zeros(3)), np.array([1]))
        robot.links["core"].apply_wrench(force=(0.0, 1.0, 0.0), duration=0.5)
        state = sim.snapshot()
        sim.run(seconds=1.0)
        motion = robot.motion().linear
        assert motion[0] == pytest.approx([0.0, 0.5, 0.0], abs=1e-3)
        assert motion[1] == pytest.approx([1.0, 0.5, 0.0], abs=2e-3)
        sim.restore(state)
        sim.run(seconds=1.0)
        assert robot.motion().linear == pytest.approx(motion, abs=1e-9)


def test_a_reset_ends_the_force():
    with simulate(block(plugin=FORCE, gravity=False), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        robot.inputs["push"].send(Push((1.0, 0.0, 0.0), np.zeros(3)))
        sim.run(seconds=0.5)
        sim.reset(worlds=[0])
        sim.run(seconds=0.5)
        assert robot.motion().linear[:, 0] == pytest.approx([0.0, 1.0], abs=2e-3)
        sim.reset()
        sim.run(seconds=0.5)
        assert robot.motion().linear == pytest.approx(0.0, abs=1e-9)


def test_the_force_on_a_body_is_its_weight_in_the_air_and_nothing_on_the_ground():
    with simulate(block(plugin=F3D)) as sim:
        output = sim.robots["cube"].outputs["felt"]
        assert (output.topic, output.frame) == ("/felt", "map")
        sim.step()
        assert output.last.force[0] == pytest.approx([0.0, 0.0, -9.8], abs=1e-3)
        sim.run(seconds=2.0)
        assert output.last.force[0] == pytest.approx(0.0, abs=0.02)


def test_the_force_on_a_body_holds_what_pushes_and_turns_it():
    with simulate(block(plugin=F3D + FORCE, gravity=False), ground=False) as sim:
        robot = sim.robots["cube"]
        robot.inputs["push"].send(Push((3.0, 0.0, 0.0), (0.0, 0.2, 0.0)))
        sim.run(seconds=0.5)
        felt = robot.outputs["felt"].last
        assert felt.force[0] == pytest.approx([3.0, 0.0, 0.0], abs=1e-6)
        assert felt.torque[0] == pytest.approx([0.0, 0.2, 0.0], abs=1e-6)


MOVE = plugin("libgazebo_ros_force_based_move.so", robotBaseFrame="core", odometryRate="10")


@pytest.mark.long
def test_a_pushed_base_reaches_its_velocity_and_keeps_to_its_odometry():
    with simulate(block(plugin=MOVE, gravity=False), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        heard = []
        robot.outputs["odom"].subscribe(heard.append)
        robot.inputs["cmd_vel"].send(linear=[0.5, -0.5])
        sim.run(seconds=1.0)
        assert robot.motion().linear[:, 0] == pytest.approx([0.5, -0.5], abs=1e-3)
        assert len(heard) == pytest.approx(10, abs=1)
        assert heard[-1].position[:, 2] == pytest.approx(0.0, abs=1e-6)
        assert heard[-1].pose_variance[5] == 0.01
        robot.inputs["cmd_vel"].send(angular=1.0)
        sim.run(seconds=1.0)
        assert robot.motion().angular[:, 2] == pytest.approx(1.0, abs=1e-3)
        assert heard[-1].pose_variance[5] == 100.0
        assert robot.outputs["odom_tf"].last.transforms[0].child_frame == "core"


def test_the_gain_decides_how_hard_a_base_is_pushed():
    tags = MOVE.replace("</plugin>", "<x_velocity_p_gain>2</x_velocity_p_gain></plugin>")
    with simulate(block(plugin=tags, gravity=False), ground=False) as sim:
        sim.robots["cube"].inputs["cmd_vel"].send(linear=1.0)
        sim.run(seconds=0.5)
        # m dv/dt = gain (1 - v) with m = 1.
        assert sim.robots["cube"].twist.linear[0] == pytest.approx(1 - np.exp(-1.0), abs=2e-3)


def test_the_odometry_of_a_pushed_base_starts_anew_after_a_reset():
    with simulate(block(plugin=MOVE, gravity=False), ground=False) as sim:
        robot = sim.robots["cube"]
        robot.inputs["cmd_vel"].send(linear=0.5)
        sim.run(seconds=0.5)
        state = sim.snapshot()
        moved = robot.outputs["odom"].last.position.copy()
        sim.reset()
        assert robot.outputs["odom"].last.position == pytest.approx(0.0, abs=1e-9)
        sim.restore(state)
        assert robot.outputs["odom"].last.position == pytest.approx(moved)


FINGERS = """<model name="hand"><link name="palm"><inertial><mass>1</mass></inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>palm</child></joint>
<link name="a"><pose>0 0.1 0 0 0 0</pose><inertial><mass>0.2</mass><inertia><ixx>0.01</ixx>
<iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
<joint name="ja" type="revolute"><parent>palm</parent><child>a</child><axis><xyz>0 0 1</xyz>
</axis></joint><link name="b"><pose>0 -0.1 0 0 0 0</pose><inertial><mass>0.2</mass><inertia>
<ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
<joint name="jb" type="revolute"><parent>palm</parent><child>b</child><axis><xyz>0 0 1</xyz>
<limit><lower>-1</lower><upper>1</upper></limit></axis></joint>{plugin}</model>"""
MIMIC = {"joint": "ja", "mimicJoint": "jb", "multiplier": "-1.0", "offset": "0.1"}


@pytest.mark.parametrize(
    "filename",
    [
        "libroboticsgroup_gazebo_mimic_joint_plugin.so",
        "libroboticsgroup_upatras_gazebo_mimic_joint_plugin.so",
    ],
)
def test_a_joint_follows_another(filename):
    with simulate(FINGERS.format(plugin=plugin(filename, **MIMIC)), ground=False, nworld=2) as sim:
        joints = sim.robots["hand"].joints
        joints["ja"].velocity = np.array([0.4, -0.2])
        sim.run(seconds=1.0)
        led, following = joints["ja"].positions()[:, 0], joints["jb"].positions()[:, 0]
        assert led == pytest.approx([0.4, -0.2], abs=0.01)
        assert following == pytest.approx(0.1 - led, abs=2e-3)


def test_a_joint_follows_by_a_motor_when_it_has_gains():
    tags = plugin("libroboticsgroup_gazebo_mimic_joint_plugin.so", **MIMIC, hasPID="")
    with simulate(FINGERS.format(plugin=tags), ground=False) as sim:
        joints = sim.robots["hand"].joints
        joints["ja"].position = 0.5
        sim.run(seconds=1.0)
        assert joints["jb"].position == pytest.approx(0.1 - joints["ja"].position, abs=0.01)


def test_a_joint_follows_by_pid_once_it_is_told_the_gains():
    tags = plugin("libroboticsgroup_gazebo_mimic_joint_plugin.so", **MIMIC, hasPID="true")
    with simulate(FINGERS.format(plugin=tags), ground=False, nworld=2) as sim:
        robot = sim.robots["hand"]
        setting = robot.settings["gazebo_ros_control/pid_gains/jb"]
        assert setting.name == "/gazebo_ros_control/pid_gains/jb"
        with pytest.raises(SimulationError, match="numbers"):
            setting.send({"p": "much"})
        setting.send({"p": 2.0, "i": 5.0, "d": 0.0})
        robot.joints["ja"].position = np.array([-0.2, -0.1])
        sim.step()
        # Without i_clamp there are no sums: one step of an effort of p times what lacks.
        pushed = robot.joints["jb"].velocities()[:, 0]
        assert pushed / [0.3, 0.2] == pytest.approx(0.002 / 0.01, rel=0.2)
        sim.run(seconds=0.2)
        state = sim.snapshot()
        sim.run(seconds=0.2)
        expected = robot.joints["jb"].positions()
        sim.restore(state)
        sim.run(seconds=0.2)
        assert robot.joints["jb"].positions() == pytest.approx(expected)


def test_a_joint_within_its_sensitiveness_is_left_alone():
    tags = {**MIMIC, "hasPID": "1", "sensitiveness": "0.5"}
    tags = plugin("libroboticsgroup_gazebo_mimic_joint_plugin.so", **tags)
    with simulate(FINGERS.format(plugin=tags), ground=False) as sim:
        robot = sim.robots["hand"]
        robot.settings["gazebo_ros_control/pid_gains/jb"].send({"p": 2.0})
        sim.run(seconds=0.2)
        assert robot.joints["jb"].position == pytest.approx(0.0, abs=1e-6)


def test_a_joint_does_not_follow_beyond_its_stops():
    tags = plugin("libmimic_joint_plugin.so", **MIMIC)
    with simulate(FINGERS.format(plugin=tags), ground=False) as sim:
        joints = sim.robots["hand"].joints
        joints["ja"].position = -2.0
        sim.step()
        assert joints["jb"].position == pytest.approx(1.0, abs=1e-3)


def test_a_joint_follows_one_that_follows_another_in_the_same_step():
    third = """<link name="c"><pose>0 0.2 0 0 0 0</pose><inertial><mass>0.2</mass></inertial></link>
      <joint name="jc" type="revolute"><parent>palm</parent><child>c</child>
      <axis><xyz>0 0 1</xyz></axis></joint>"""
    chain = plugin("libmimic_joint_plugin.so", joint="jb", mimicJoint="jc", multiplier="2")
    first = plugin("libmimic_joint_plugin.so", **MIMIC)
    with simulate(
        FINGERS.format(plugin=third + first + chain.replace('p"', 'q"', 1)), ground=False, nworld=3
    ) as sim:
        joints = sim.robots["hand"].joints
        joints["ja"].position = np.array([0.2, -0.3, -2.0])
        sim.step()
        assert joints["jb"].positions()[:, 0] == pytest.approx([-0.1, 0.4, 1.0], abs=1e-6)
        assert joints["jc"].positions()[:, 0] == pytest.approx([-0.2, 0.8, 2.0], abs=1e-6)


def test_joints_of_all_kinds_follow_side_by_side():
    tags = plugin("libmimic_joint_plugin.so", **MIMIC)
    pushed = plugin("libmimic_joint_plugin.so", **MIMIC, hasPID="1")
    hand = FINGERS.format(plugin=tags)
    other = FINGERS.format(plugin=pushed).replace('name="hand"', 'name="other"')
    with simulate(hand + other, ground=False) as sim:
        robots = sim.robots["hand"], sim.robots["other"]
        for robot in robots:
            robot.joints["ja"].position = 0.5
        sim.run(seconds=1.0)
        for robot in robots:
            joints = robot.joints
            assert joints["jb"].position == pytest.approx(0.1 - joints["ja"].position, abs=0.01)


def test_what_a_mimic_joint_lacks_is_named():
    with pytest.raises(PluginWarning, match="mimicJoint"):
        simulate(FINGERS.format(plugin=plugin("libmimic_joint_plugin.so", joint="ja")))
    with pytest.raises(PluginWarning, match="jc"):
        simulate(
            FINGERS.format(plugin=plugin("libmimic_joint_plugin.so", joint="jc", mimicJoint="jb"))
        )


def test_a_disabled_link_stays_until_it_is_pushed():
    tags = plugin("libroboticsgroup_gazebo_disable_link_plugin.so", link="core")
    with simulate(block(plugin=tags), nworld=2) as sim:
        robot = sim.robots["cube"]
        sim.run(seconds=0.5)
        assert robot.position[:, 2] == pytest.approx(0.5)
        sim.reset()
        sim.run(seconds=0.5)
        assert robot.position[:, 2] == pytest.approx(0.5)


ATTACHER = plugin("libgazebo_ros_link_attacher.so")
OTHER = block(gravity=False).replace('"cube"', '"other"').replace("0 0 0.5", "1 0 0.5")


def test_a_model_is_laid_to_rest_in_the_worlds_that_are_asked():
    with simulate(block(), ATTACHER, ground=False, nworld=2) as sim:
        cube = sim.robots["cube"]
        rest = sim.ports.services["setstatic"]
        assert rest.topic == "/link_attacher_node/setstatic"
        cube.set_twist((1.0, 0.0, 0.0), (0.0, 0.0, 1.0))
        assert rest.call(LinkName("cube", "core"), np.array([1]))
        sim.run(seconds=0.5)
        assert cube.position[0] == pytest.approx([0.5, 0.0, 0.5 - 9.8 * 0.125], abs=0.01)
        assert cube.position[1] == pytest.approx([0.0, 0.0, 0.5], abs=1e-9)
        assert not rest.call(LinkName("nobody", "core"))
        assert not rest.call(LinkName("cube", "nothing"))


BOUNCING = """<surface><bounce><restitution_coefficient>0.5</restitution_coefficient><threshold>0
</threshold></bounce></surface>"""


@pytest.mark.parametrize("surface", ["", BOUNCING], ids=["rigid", "bouncing"])
def test_others_pass_through_a_model_laid_to_rest(surface):
    """As in the fork, by ``SetCollideMode("none")``."""
    falling = block().replace('"cube"', '"other"').replace("0 0 0.5", "0 0 3")
    falling = falling.replace("</collision>", f"{surface}</collision>")
    with simulate(block(), falling, ATTACHER, nworld=2) as sim:
        rest = sim.ports.services["setstatic"]
        assert rest.call(LinkName("cube", "core"), np.array([1]))
        sim.run(seconds=4.0)
        heights = np.stack([sim.robots[name].position[:, 2] for name in ("cube", "other")])
        assert heights == pytest.approx(np.array([[0.1, 0.5], [0.3, 0.1]]), abs=1e-3)
        sim.spawn(sim.robots["other"].description, name="third", pose=Pose(x=3.0))
        sim.reset()
        sim.run(seconds=4.0)
        heights = np.stack([sim.robots[name].position[:, 2] for name in ("cube", "other")])
        assert heights == pytest.approx(np.array([[0.1, 0.5], [0.3, 0.1]]), abs=1e-3)


def test_a_static_model_lets_others_through():
    fixed = block().replace('"cube"', '"wall"')
    fixed = fixed.replace("<link ", "<static>1</static><link ", 1)
    falling = block().replace("0 0 0.5", "0 0 3")
    with simulate(fixed, falling, ATTACHER) as sim:
        assert sim.ports.services["setstatic"].call(LinkName("wall", "core"))
        sim.run(seconds=2.0)
        assert sim.robots["cube"].position[0, 2] == pytest.approx(0.1, abs=1e-3)
        assert sim.robots["wall"].position[0, 2] == pytest.approx(0.5)


def test_links_are_joined_and_parted_in_the_worlds_that_are_asked():
    with simulate(block(gravity=False), OTHER, ATTACHER, ground=False, nworld=2) as sim:
        attach, detach = (sim.ports.services[name] for name in ("attach", "detach"))
        assert attach.topic == "/link_attacher_node/attach"
        pair = LinkPair("cube", "core", "other", "core")
        assert attach.call(pair, np.array([1]))
        sim.robots["cube"].set_twist((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        sim.robots["cube"].links["core"].apply_wrench(force=(0.0, 0.0, 1.0))
        sim.run(seconds=0.5)
        assert abs(sim.robots["other"].position[0, 2] - 0.5) < 1e-6
        assert abs(sim.robots["other"].position[1, 2] - 0.5) > 1e-3
        assert detach.call(pair)
        assert not detach.call(LinkPair("cube", "core", "nobody", "core"))
        assert not attach.call(LinkPair("cube", "core", "other", "nothing"))
