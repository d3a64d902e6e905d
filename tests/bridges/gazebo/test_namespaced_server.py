"""A gzserver in a namespace: what has no slash in front is in that namespace."""

from __future__ import annotations

import threading

import pytest
from graph_client import Client

import gazelle
from gazelle import formats
from gazelle.bridges.serving import RosServer
from gazelle_ros import Master, Node

PLANAR = "<plugin name='p' filename='libgazebo_ros_planar_move.so'>{}</plugin>"
ROBOT = """<robot name='r'><link name='base'><inertial><mass value='1'/>
<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>
<collision><geometry><box size='1 1 1'/></geometry></collision></link>
<link name='arm'><inertial><mass value='1'/>
<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link>
<joint name='j' type='revolute'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>
<limit effort='10' velocity='5' lower='-1' upper='1'/></joint>
<transmission name='t'><type>transmission_interface/SimpleTransmission</type>
<joint name='j'><hardwareInterface>hardware_interface/PositionJointInterface</hardwareInterface></joint>
<actuator name='a'><mechanicalReduction>1</mechanicalReduction></actuator></transmission>
<gazebo><plugin name='c' filename='libgazebo_ros_control.so'/></gazebo><gazebo>{}</gazebo></robot>"""
WORLD = """<sdf version='1.6'><world name='w'><model name='{}'><static>true</static><link name='l'/>
</model></world></sdf>"""


@pytest.fixture
def server():
    """Yield a client, and the node of a running simulator in the namespace /car."""
    world = formats.load_string(WORLD.format("wall"))
    with Master(port=0, rosout=False) as master, gazelle.Simulation(world, namespace="/car") as sim:
        node = Node("gazebo", namespace="/car", master_uri=master.uri)
        with RosServer(sim, node, None, world=0, monotonic_clock=False) as server:
            thread = threading.Thread(target=server.run)
            thread.start()
            client = Client(master.uri)
            yield client, node
            client.node.close()
            server.stop()
            thread.join()


def names_of(node):
    services = {each.name for each in node.services()}
    return services | {each.topic for each in (*node.subscriptions(), *node.publications())}


@pytest.mark.parametrize(
    ("asked", "tags", "topic", "manager"),
    [
        ("/", "", "/car/cmd_vel", "/car"),
        ("", "", "/car/cmd_vel", "/car/bot"),
        ("r1", "", "/car/r1/cmd_vel", "/car/r1"),
        ("/r2", "", "/r2/cmd_vel", "/r2"),
        ("/", "<robotNamespace>own</robotNamespace>", "/car/own/cmd_vel", "/car"),
        ("/", "<robotNamespace>/own</robotNamespace>", "/own/cmd_vel", "/car"),
        ("r1", "<commandTopic>/go</commandTopic>", "/go", "/car/r1"),
    ],
)
def test_names_are_resolved_in_the_namespace_of_the_node(server, asked, tags, topic, manager):
    client, node = server
    text = ROBOT.format(PLANAR.format(tags))
    answer = client.call(
        "/car/gazebo/spawn_urdf_model",
        "SpawnModel",
        model_name="bot",
        model_xml=text,
        robot_namespace=asked,
    )
    assert answer.success, answer.status_message
    assert {topic, f"{manager}/controller_manager/list_controllers"} <= names_of(node)


def test_frames_keep_their_names():
    world = formats.load_string(WORLD.format("wall"))
    robot = formats.load_model_string(ROBOT.format(PLANAR.format("")))
    with gazelle.Simulation(world, namespace="/car") as sim:
        spawned = sim.spawn(robot, namespace="")
        assert spawned.outputs["odom"].topic == "/car/odom"
        assert spawned.outputs["odom"].last.frame == "odom"
