"""``libgazebo_ros_control_select_joints.so``: some joints of a robot under controllers."""

from __future__ import annotations

import pytest
from bridges.control.robot_graph import RobotGraph, robot_graph

import gazelle
from gazelle import formats
from gazelle.control import POSITION
from gazelle.control.values import JointTarget, JointTargets
from gazelle.description import World
from gazelle.errors import ControlWarning
from tests.control.arms import JOINTS, arm_text

ONE = "position_controllers/JointPositionController"
PLUGIN = """<plugin name="{space}" filename="libgazebo_ros_control_select_joints.so">
  <robotNamespace>{space}</robotNamespace>{joints}</plugin>"""


def text(*plugins):
    """Return the arm with one of these plugins for each (namespace, joints)."""
    whole = arm_text("Position")
    begin = whole.index("<plugin")
    end = whole.index("</plugin>") + len("</plugin>")
    made = "".join(
        PLUGIN.format(space=space, joints="" if joints is None else f"<joints>{joints}</joints>")
        for space, joints in plugins
    )
    return whole[:begin] + made + whole[end:]


def spawn(*plugins):
    sim = gazelle.Simulation(World("w"))
    return sim, sim.spawn(formats.load_model_string(text(*plugins)))


def controlled(manager):
    return list(manager.hardware.interfaces[POSITION].resources)


@pytest.mark.parametrize(
    ("joints", "there"),
    [
        ("elbow", ["elbow"]),
        ("elbow shoulder", JOINTS),
        ("\n  shoulder\n", ["shoulder"]),
        (None, JOINTS),
    ],
)
def test_the_joints_that_it_names_are_controlled(joints, there):
    _, robot = spawn(("/head", joints))
    assert controlled(robot.managers["/head"]) == there


def test_a_name_without_a_transmission_is_told_of():
    with pytest.warns(ControlWarning, match="names 'elbo'.*did you mean 'elbow'"):
        _, robot = spawn(("/head", "shoulder elbo"))
    assert controlled(robot.managers["/head"]) == ["shoulder"]


def test_two_of_them_share_a_robot():
    sim, robot = spawn(("/body", "shoulder"), ("/head", "elbow"))
    for space, joint, target in (("/body", "shoulder", 0.3), ("/head", "elbow", -0.4)):
        manager = robot.managers[space]
        assert controlled(manager) == [joint]
        manager.load("hold", {"type": ONE, "joint": joint})
        manager.start("hold")
        manager["hold"].inputs["command"].send(JointTarget(target))
    sim.run(1.0)
    assert robot.joints["shoulder"].position == pytest.approx(0.3, abs=1e-2)
    assert robot.joints["elbow"].position == pytest.approx(-0.4, abs=1e-2)


def test_each_has_gains_and_limits_of_its_own_namespace_on_a_graph():
    parameters = {
        "/body/gazebo_ros_control/pid_gains": {"shoulder": {"p": 200.0, "i": 0.0, "d": 40.0}},
        "/head/joint_limits": {
            "elbow": {"has_position_limits": True, "min_position": -0.1, "max_position": 0.1}
        },
        "/body/hold": {"type": ONE, "joint": "shoulder"},
        "/head/hold": {"type": ONE, "joint": "elbow"},
    }
    urdf = text(("/body", "shoulder"), ("/head", "elbow"))
    with robot_graph(urdf, parameters=parameters, namespace="/body", start=False) as graph:
        head = RobotGraph(graph.node, graph.sim, graph.server, "/head")
        for each in (graph, head):
            assert each.call("load_controller", name="hold")
            assert each.switch(["hold"])
        robot = graph.sim.robots["two_link_arm"]
        assert robot.settings["pid_gains"].value["shoulder"]["p"] == 200.0
        assert robot.settings["/head/joint_limits"].value["elbow"]["max_position"] == 0.1
        robot.managers["/head"]["hold"].inputs["command"].send(JointTarget(2.0))
        graph.sim.run(0.5)
        assert robot.joints["elbow"].position == pytest.approx(0.1, abs=1e-2)


BASE = """<robot name="carrier" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find hector_components_description)/urdf/{file}.urdf.xacro.xml"/>
  <xacro:property name="vlp16_calibration"><origin xyz="0 0 0.1" rpy="0 0 0"/></xacro:property>
  <link name="base"><inertial><mass value="20"/>
    <inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <xacro:{macro} parent="base" name="head" scaling="1"><origin xyz="0 0 0.3" rpy="0 0 0"/></xacro:{macro}>
</robot>"""
HEADS = {
    "vlp16_mount": ("spinning_sensor_mount_macro", ["head_spin_joint"]),
    "xm430_sensor_head": ("xm430_sensor_head_macro", ["head_pitch_joint", "head_yaw_joint"]),
}


@pytest.mark.corpus
@pytest.mark.slow
@pytest.mark.parametrize("file", HEADS)
@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")  # what else these files hold
def test_sensor_heads_of_the_corpus_turn(file, corpus, tmp_path, monkeypatch):
    macro, joints = HEADS[file]
    text = BASE.format(file=file, macro=macro)
    if file == "xm430_sensor_head":
        text = text.replace(' scaling="1"', "")
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(corpus))
    path = tmp_path / "carrier.urdf.xacro"
    path.write_text(text, encoding="utf-8")
    sim = gazelle.Simulation(World("w"))
    robot = sim.spawn(formats.load_model(path))
    manager = robot.managers["/head_control"]
    (kind,) = {
        name for name, each in manager.hardware.interfaces.items() if each.claims and each.resources
    }
    assert sorted(manager.hardware.interfaces[kind].resources) == joints
    word = kind.split("/")[1].removesuffix("JointInterface")
    of = f"{word.lower()}_controllers/JointGroup{word}Controller"
    manager.load("turn", {"type": of, "joints": joints})
    manager.start("turn")
    manager["turn"].inputs["command"].send(JointTargets([0.2] * len(joints)))
    sim.run(0.5)
    assert abs(robot.joints[joints[0]].position) > 0.02
