"""libgazebo_ros_control.so on a graph: robots of a simulation, commanded by clients of ros_control."""

import itertools
import re

import pytest
from bridges.control.robot_graph import RobotGraph, robot_graph
from control.arms import JOINTS, arm_text
from ros.graph import until

from gazelle.builders import add_transmissions
from gazelle.control.actuators import ACTUATOR_STATE
from gazelle.errors import ControlWarning
from gazelle.formats import load_model_string, load_string
from gazelle_ros import load_message, load_service

STATES = ("joints", "joint_state_controller/JointStateController")
EFFORT = "effort_controllers/JointEffortController"
POSITION = "position_controllers/JointGroupPositionController"
SERVICE = "/arm/controller_manager/list_controllers"


def services(graph):
    return graph.node.master.system_state()[2]


def topics(graph):
    published, subscribed, _ = graph.node.master.system_state()
    return {*published, *subscribed}


def controlled():
    """Return a free joint with a transmission and the plugin."""
    plugin = '<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>'
    return add_transmissions(FREE).replace("</robot>", f"{plugin}</robot>")


def test_controllers_of_a_spawned_robot_are_in_its_namespace():
    with robot_graph(arm_text()) as graph:
        heard = graph.listen("joint_states", "sensor_msgs/JointState")
        graph.spawn(*STATES, publish_rate=50)
        until(lambda: len(heard) > 2, 60)
        assert heard[0].name == sorted(JOINTS)
        gaps = [
            round((b.header.stamp - a.header.stamp).to_sec(), 3)
            for a, b in itertools.pairwise(heard)
        ]
        assert all(gap == pytest.approx(0.02, abs=0.0015) for gap in gaps)
        assert len(heard[0].position) == len(heard[0].velocity) == len(heard[0].effort) == 2


def test_an_effort_moves_a_joint():
    with robot_graph(arm_text()) as graph:
        graph.spawn("push", EFFORT, joint="elbow")
        publisher, number = graph.talk("push/command", "std_msgs/Float64")
        publisher.publish(number(3.0))
        elbow = graph.sim.robots["two_link_arm"].joints["elbow"]
        until(lambda: elbow.position > 0.3, 60)


def test_a_position_is_taken_while_the_world_is_paused_and_held_after():
    with robot_graph(arm_text("Position"), start=False) as graph:
        graph.spawn("hold", POSITION, joints=JOINTS)
        assert graph.states == {"hold": "running"}
        publisher, numbers = graph.talk("hold/command", "std_msgs/Float64MultiArray")
        until(lambda: publisher.num_connections, 30)
        publisher.publish(numbers(data=[0.5, -0.25]))
        robot = graph.sim.robots["two_link_arm"]

        def held():
            graph.sim.step()
            return robot.joints["shoulder"].position == pytest.approx(0.5, abs=1e-3)

        until(held, 60)
        graph.sim.step(100)
        assert robot.joints["elbow"].position == pytest.approx(-0.25, abs=1e-3)


def test_gains_and_limits_come_from_the_parameter_server():
    parameters = {
        "/arm/gazebo_ros_control/pid_gains": {"elbow": {"p": 1.0, "i": 0.0, "d": 0.1}},
        "/arm/joint_limits": {"elbow": {"has_effort_limits": True, "max_effort": 0.25}},
    }
    with robot_graph(arm_text("Position"), parameters=parameters, start=False) as graph:
        settings = graph.sim.robots["two_link_arm"].settings
        assert settings["pid_gains"].value["elbow"]["p"] == 1.0
        assert settings["joint_limits"].value["elbow"]["max_effort"] == 0.25


@pytest.mark.parametrize("use", [True, False])
def test_whether_transmissions_count_comes_from_the_parameter_server(use):
    given = {"/arm/gazebo_ros_control/use_transmissions": use}
    with robot_graph(arm_text("Effort"), parameters=given, start=False) as graph:
        robot = graph.sim.robots["two_link_arm"]
        assert robot.settings["use_transmissions"].value is use
        assert (ACTUATOR_STATE in robot.controllers.hardware.interfaces) is use


BARE = re.compile("<transmission.*</transmission>", re.DOTALL)


def bare_world():
    """Return the arm as SDF, which has no transmissions."""
    urdf = BARE.sub("", arm_text())
    return load_string(urdf, name="arm")


@pytest.mark.parametrize("name", ["/arm/robot_description", "/robot_description"])
def test_a_robot_without_transmissions_waits_for_its_description(name):
    with robot_graph(world=bare_world(), parameters={"/robot_description": ""}) as graph:
        assert SERVICE not in services(graph)
        graph.node.set_param(name, arm_text())
        until(lambda: SERVICE in services(graph), 30)
        graph.spawn("push", EFFORT, joint="elbow")


def test_a_robot_that_goes_takes_its_controllers_along():
    with robot_graph(arm_text()) as graph:
        graph.spawn(*STATES, publish_rate=50)
        assert SERVICE in services(graph)
        delete = load_service("gazebo_msgs/DeleteModel")
        client = graph.node.client("/gazebo/delete_model", delete)
        assert client.call(delete._request_class("two_link_arm"), timeout=30).success
        until(lambda: SERVICE not in services(graph), 30)


def test_robots_in_one_world_have_managers_of_their_own():
    left, right = (
        arm_text().replace('name="two_link_arm"', f'name="{side}"').replace("/arm<", f"/{side}<")
        for side in ("left", "right")
    )
    with robot_graph(left, right, namespace="/left") as graph:
        graph.spawn("push", EFFORT, joint="elbow")
        other = RobotGraph(graph.node, graph.sim, graph.server, "/right")
        assert graph.states == {"push": "running"}
        assert other.states == {}


def test_two_managers_in_one_namespace_are_one_too_many():
    texts = [arm_text(), arm_text().replace('name="two_link_arm"', 'name="twin"')]
    with (
        pytest.warns(ControlWarning, match="/arm/controller_manager"),
        robot_graph(*texts) as graph,
    ):
        graph.spawn("push", EFFORT, joint="elbow")


def test_controllers_go_on_after_a_reset_of_the_world():
    with robot_graph(arm_text("Position")) as graph:
        graph.spawn("hold", POSITION, joints=JOINTS)
        publisher, numbers = graph.talk("hold/command", "std_msgs/Float64MultiArray")
        publisher.publish(numbers(data=[0.5, 0.5]))
        elbow = graph.sim.robots["two_link_arm"].joints["elbow"]
        until(lambda: elbow.position == pytest.approx(0.5, abs=1e-2), 60)
        empty = load_service("std_srvs/Empty")
        graph.node.client("/gazebo/reset_world", empty).call(empty._request_class(), timeout=30)
        assert elbow.position == pytest.approx(0.0, abs=1e-2)
        assert graph.states == {"hold": "running"}
        publisher.publish(load_message("std_msgs/Float64MultiArray")(data=[0.25, 0.25]))
        until(lambda: elbow.position == pytest.approx(0.25, abs=1e-2), 60)


FREE = """<robot name="free"><link name="base"><inertial><mass value="5"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link><link name="arm"><inertial>
<mass value="1"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/></joint></robot>"""


@pytest.mark.parametrize("when", ["asked for", "spawned"])
def test_a_manager_that_comes_after_the_graph_has_its_services(when):
    with robot_graph(world=bare_world(), parameters={"/robot_description": ""}) as graph:
        service = "/free/controller_manager/list_controllers"
        robot = graph.sim.spawn(load_model_string(FREE if when == "asked for" else controlled()))
        if when == "asked for":
            assert service not in services(graph)
            manager = robot.controllers
            manager.load("hinge_controller", {"type": EFFORT, "joint": "hinge"})
        until(lambda: service in services(graph), 30)
        assert sum(name == service for name in services(graph)) == 1
        if when == "asked for":
            assert "/free/hinge_controller/command" in topics(graph)
        graph.sim.delete("free")
        until(lambda: service not in services(graph), 30)
