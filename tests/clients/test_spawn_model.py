"""The program spawn_model of gazebo_ros, with all its flags."""

from __future__ import annotations

import contextlib
import io
import os
import re
import signal
import subprocess
import sys
import threading

import pytest
from ros.graph import until

from gazelle.clients.spawn_model import main
from gazelle.errors import RosError
from gazelle_ros import load_message

BALL = """<sdf version="1.6"><model name="ball"><link name="link"><inertial><mass>2</mass></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link></model></sdf>"""
ARM = """<?xml version="1.0"?><!-- an arm --><robot name="arm">
<link name="base"><inertial><mass value="9"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="lift" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="1" velocity="1"/></joint>
<link name="upper"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><mesh filename="package://nothing/arm.stl"/></geometry></visual></link>
<gazebo><plugin name="states" filename="libgazebo_ros_joint_state_publisher.so">
<jointName>lift</jointName></plugin></gazebo>
</robot>"""


@pytest.fixture
def spawn(graph, monkeypatch):
    """Return the program on the graph, with the world paused."""
    monkeypatch.setenv("ROS_MASTER_URI", graph.master.uri)
    graph.gazebo.pause()
    return lambda *arguments: main(list(arguments))


@pytest.fixture
def ball(tmp_path):
    file = tmp_path / "ball.sdf"
    file.write_text(BALL, encoding="utf-8")
    return str(file)


def test_a_file_is_spawned_where_the_flags_say(spawn, graph, ball):
    flags = ["-x", "1", "-y", "-0.5", "-z", "2e-1", "-R", "0", "-P", "0", "-Y", "+1.57"]
    assert spawn("-file", ball, "-sdf", "-model", "b1", *flags) == 0
    pose = graph.sim.robots["b1"].pose
    assert (pose.x, pose.y, pose.z) == pytest.approx((1.0, -0.5, 0.2))
    assert pose.yaw == pytest.approx(1.57)


def test_a_pose_may_be_given_in_another_models_frame(spawn, graph, ball):
    graph.gazebo.set_model_state("r1", (0.5, 0.5, 0.0))
    assert spawn("-sdf", "-file", ball, "-model", "b", "-reference_frame", "r1", "-x", "1") == 0
    assert graph.sim.robots["b"].pose.x == pytest.approx(1.5)


def test_a_name_that_is_taken_ends_with_one_and_says_so(spawn, ball, capsys):
    assert spawn("-sdf", "-file", ball, "-model", "b") == 0
    assert spawn("-sdf", "-file", ball, "-model", "b") == 1
    said = capsys.readouterr()
    assert "Spawn status: SpawnModel: Failure - entity already exists." in said.out
    assert "Spawn service failed. Exiting." in said.err


def test_a_parameter_is_spawned_with_its_joints_and_namespace(spawn, graph):
    graph.gazebo.node.set_param("/robot_description", ARM)
    flags = ("-param", "robot_description", "-urdf", "-model", "arm", "-J", "lift", "0.7")
    with pytest.warns(UserWarning, match="arm"):
        assert spawn(*flags, "-robot_namespace", "/cell") == 0
    robot = graph.sim.robots["arm"]
    assert robot.joints["lift"].position == pytest.approx(0.7)
    assert [each.topic for each in robot.outputs.values()] == ["/cell/joint_states"]


def test_the_namespace_of_the_node_is_the_robots(spawn, graph):
    graph.gazebo.node.set_param("/tb/robot_description", ARM)
    with pytest.warns(UserWarning, match="arm"):
        assert spawn("-param", "robot_description", "-urdf", "-model", "a", "__ns:=/tb") == 0
    outputs = graph.sim.robots["a"].outputs.values()
    assert [each.topic for each in outputs] == ["/tb/joint_states"]


def test_meshes_may_be_looked_for_among_models(spawn, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO(ARM))
    with pytest.warns(UserWarning, match="model://nothing/arm.stl"):
        assert spawn("-stdin", "-urdf", "-model", "a", "-package_to_model") == 0


def test_a_model_of_gazebos_folders_is_found_by_its_name(spawn, graph, tmp_path, monkeypatch):
    folder = tmp_path / "my_ball"
    folder.mkdir()
    (folder / "model.sdf").write_text(BALL, encoding="utf-8")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path))
    assert spawn("-database", "my_ball", "-sdf", "-model", "mine", "-z", "3") == 0
    assert graph.sim.robots["mine"].pose.z == pytest.approx(3.0)


def test_the_world_runs_on_if_wanted(spawn, graph, ball):
    assert graph.sim.paused
    assert spawn("-sdf", "-file", ball, "-model", "b", "-unpause") == 0
    assert not graph.sim.paused


@pytest.mark.long
def test_it_waits_for_another_model(spawn, graph, ball):
    flags = ("-sdf", "-file", ball, "-model", "second", "-wait", "first")
    waiter = threading.Thread(target=spawn, args=flags)
    waiter.start()
    waiter.join(0.3)
    assert waiter.is_alive()
    assert "second" not in graph.sim.robots
    assert spawn("-sdf", "-file", ball, "-model", "first") == 0
    waiter.join(60.0)
    assert "second" in graph.sim.robots


@pytest.mark.long
def test_a_bond_takes_the_model_away_at_the_end(graph, ball):
    program = [sys.executable, "-m", "gazelle_ros.builtin.start", "gazebo_ros", "spawn_model"]
    process = subprocess.Popen(
        [*program, "-sdf", "-file", ball, "-model", "guest", "-b"],
        env=os.environ | {"ROS_MASTER_URI": graph.master.uri},
    )
    until(lambda: "guest" in graph.sim.robots)
    process.send_signal(signal.SIGINT)
    assert process.wait(60) == 0
    assert "guest" not in graph.sim.robots


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (("-file", "/no/such.sdf"), "cannot be read"),
        (("-param", "/nothing"), "holds no description"),
        (("-database", "no_such_model"), "no_such_model"),
        (("-stdin",), "empty"),
    ],
)
def test_what_cannot_be_spawned_is_said(spawn, flags, words, monkeypatch):
    monkeypatch.setattr(sys, "stdin", io.StringIO(" "))
    with pytest.raises(RosError, match=words):
        spawn("-sdf", "-model", "m", *flags)


@pytest.mark.parametrize(
    "flags", ["-sdf -file f", "-sdf -urdf -file f -model m", "-sdf -model m", "-file f -model m"]
)
def test_a_command_line_that_says_too_little_or_too_much_is_refused(spawn, flags):
    with pytest.raises(SystemExit) as caught:
        spawn(*flags.split())
    assert caught.value.code == 2


def test_it_says_what_the_original_says(spawn, graph, ball, capsys):
    heard = []
    graph.gazebo.node.subscribe("/rosout", load_message("rosgraph_msgs/Log"), heard.append)
    assert spawn("-sdf", "-file", ball, "-model", "talked_about", "-unpause") == 0
    lines = [line.partition("]: ")[2] for line in capsys.readouterr().out.splitlines()]
    assert lines == [
        f"Loading model XML from file {ball}",
        "Waiting for service /gazebo/spawn_sdf_model",
        "Calling service /gazebo/spawn_sdf_model",
        "Spawn status: SpawnModel: Successfully spawned entity",
        "Unpausing physics",
    ]
    until(lambda: [each.msg for each in heard if "spawn_model" in each.name] == lines)
    assert {each.level for each in heard if "spawn_model" in each.name} == {2}


@pytest.mark.parametrize(
    ("source", "said"),
    [
        (["-param", "/arm"], "ros parameter /arm"),
        (["-stdin"], "stdin"),
        (["-database", "arm"], "Gazebo Model Database"),
    ],
)
def test_it_says_where_the_description_is_from(spawn, graph, monkeypatch, capsys, source, said):
    plain = re.sub(r"<visual>.*</visual>", "", ARM, flags=re.DOTALL)
    graph.gazebo.node.set_param("/arm", plain)
    monkeypatch.setattr("sys.stdin", io.StringIO(plain))
    with contextlib.suppress(RosError):  # URDF from the database is none
        spawn("-urdf", *source, "-model", "arm", "-J", "lift", "0.5")
    out = capsys.readouterr().out
    assert f"Loading model XML from {said}\n" in out
    if "-database" not in source:
        assert "Set model configuration status: " in out
