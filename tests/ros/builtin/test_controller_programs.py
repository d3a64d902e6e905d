"""spawner, unspawner, controller_manager and controller_group, as launch files start them."""

from __future__ import annotations

import os
import signal
import subprocess
import sys

import pytest
from ros.builtin.manager_stand_in import ManagerStandIn
from ros.graph import until

from gazelle_ros import load_message
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.nodes import kill

BOOL = load_message("std_msgs/Bool")
JOINTS = {"effort": "elbow", "position": "elbow"}


@pytest.fixture
def robot(make_node):
    node = make_node("robot")
    for name in ("effort", "position", "wrist"):
        node.set_param(f"/{name}/type", "kind/A")
    return node


@pytest.fixture
def manager(robot):
    return ManagerStandIn(robot, joints=JOINTS)


@pytest.fixture
def start(master, tmp_path):
    """Yield a function that starts a program of the package controller_manager."""
    made = []

    def run(kind, *arguments, **env):
        words = [sys.executable, "-m", "gazelle_ros.builtin.start", "controller_manager", kind]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        env = os.environ | {"ROS_MASTER_URI": master.uri} | env
        made.append(subprocess.Popen([*words, *arguments], env=env, cwd=tmp_path, **pipes))
        return made[-1]

    yield run
    for process in made:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.fixture
def said(start):
    """Return a function for the output of a program that ends by itself."""

    def run(kind, *arguments, **env):
        return start(kind, *arguments, **env).communicate(timeout=30)[0]

    return run


def ends(process, end=signal.SIGINT):
    process.send_signal(end)
    assert process.wait(30) == 0


# spawner ----------------------------------------------------------------------------------------


def test_a_spawner_loads_and_starts_all_at_once_and_takes_down_backwards(start, manager):
    process = start("spawner", "effort", "wrist")
    until(lambda: manager.states == {"effort": "running", "wrist": "running"}, 30)
    ends(process)
    assert manager.states == {}
    assert manager.calls == [
        ("load", "effort", True),
        ("load", "wrist", True),
        ("switch", ("effort", "wrist"), (), 2, True),
        ("switch", (), ("effort", "wrist"), 2, True),
        ("unload", "wrist", True),
        ("unload", "effort", True),
    ]


@pytest.mark.parametrize("how", ["SIGTERM", "rosnode kill"])
def test_a_spawner_takes_down_however_it_is_ended(start, manager, master, how):
    process = start("spawner", "wrist", "__name:=mine")
    until(lambda: manager.states == {"wrist": "running"}, 30)
    if how == "SIGTERM":
        process.terminate()
    else:
        with GraphInspector("test", master.uri) as graph:
            kill(graph, ["/mine"])
    assert process.wait(30) == 0
    assert manager.states == {}


def test_a_spawner_starts_what_could_be_loaded(start, manager):
    process = start("spawner", "missing", "wrist")
    until(lambda: manager.states == {"wrist": "running"}, 30)
    ends(process)
    assert "Failed to load missing" in process.stdout.read()


@pytest.mark.long
def test_controllers_that_conflict_are_not_started(start, manager):
    process = start("spawner", "effort", "position")
    until(lambda: manager.calls and manager.calls[-1][0] == "switch", 30)
    assert manager.states == {"effort": "initialized", "position": "initialized"}
    ends(process)
    assert "Failed to start controllers: effort, position" in process.stdout.read()
    assert manager.states == {}


@pytest.mark.long
def test_stopped_only_loads(start, manager):
    process = start("spawner", "--stopped", "wrist")
    until(lambda: manager.states == {"wrist": "initialized"}, 30)
    ends(process)
    assert manager.states == {}
    assert not any(call[0] == "switch" and call[1] for call in manager.calls)


@pytest.mark.parametrize(
    ("arguments", "env"),
    [
        (["--namespace", "/left"], {}),
        (["--namespace=left/"], {}),
        ([], {"ROS_NAMESPACE": "left"}),
        (["__ns:=/left"], {}),
    ],
)
def test_a_spawner_finds_the_manager_of_its_namespace(start, robot, arguments, env):
    robot.set_param("/left/wrist/type", "kind/A")
    left, other = ManagerStandIn(robot, "/left/controller_manager"), ManagerStandIn(robot)
    process = start("spawner", "wrist", *arguments, **env)
    until(lambda: left.states == {"wrist": "running"}, 30)
    ends(process)
    assert other.calls == []


def test_a_spawner_waits_for_a_manager_and_for_a_topic(start, robot):
    publisher = robot.advertise("/ready", BOOL, latch=True)
    process = start("spawner", "--wait-for", "/ready", "--no-timeout", "wrist")
    manager = ManagerStandIn(robot)
    until(lambda: publisher.num_connections, 30)
    publisher.publish(BOOL(False))
    assert manager.calls == []
    publisher.publish(BOOL(True))
    until(lambda: manager.states == {"wrist": "running"}, 30)
    ends(process)


def test_a_spawner_gives_up_without_a_manager(said, robot):
    text = said("spawner", "--timeout", "0.2", "wrist")
    assert "couldn't find the expected controller_manager ROS interface" in text


def test_a_spawner_waits_on_while_simulated_time_has_not_begun(start, robot):
    robot.set_param("/use_sim_time", True)
    process = start("spawner", "--timeout", "0.1", "wrist")
    for line in process.stdout:
        if "Waiting for /clock to be available" in line:
            break
    manager = ManagerStandIn(robot)
    until(lambda: manager.states == {"wrist": "running"}, 30)
    ends(process)


def test_a_spawner_takes_the_controllers_of_a_yaml_file(start, manager, robot, tmp_path):
    (tmp_path / "arm.yaml").write_text("knee: {type: kind/A, joint: k}\nhip: {type: kind/B}\n")
    process = start("spawner", "arm.yaml", "wrist")
    until(lambda: list(manager.states) == ["knee", "hip", "wrist"], 30)
    assert robot.get_param("/knee/joint") == "k"
    until(lambda: set(manager.states.values()) == {"running"}, 30)
    ends(process)


def test_a_spawner_wants_a_controller(start):
    assert start("spawner", "--stopped").wait(30) == 2


# unspawner --------------------------------------------------------------------------------------


@pytest.mark.long
def test_an_unspawner_keeps_controllers_stopped_and_starts_them_again(start, manager):
    manager.states = {"wrist": "running", "effort": "running", "position": "stopped"}
    process = start("unspawner", "wrist", "position", "unknown")
    until(lambda: manager.states["wrist"] == "stopped", 30)
    assert manager.states["effort"] == "running"
    manager.states["wrist"] = "running"
    until(lambda: manager.states["wrist"] == "stopped", 30)
    ends(process)
    assert manager.states == {"wrist": "running", "effort": "running", "position": "stopped"}


# controller_manager -----------------------------------------------------------------------------


@pytest.mark.long
def test_the_command_says_what_came_of_it(said, manager):
    command = "controller_manager"
    assert said(command, "list") == "No controllers are loaded in mechanism control\n"
    assert said(command, "list-types") == said(command, "lt") == "kind/A\nkind/B\n"
    assert said(command, "load", "wrist", "missing") == (
        "Loaded 'wrist'\nError when loading 'missing'\n"
    )
    assert said(command, "start", "wrist") == "Started ['wrist'] successfully\n"
    assert said(command, "start", "wrist") == "Error when starting ['wrist'] and stopping []\n"
    assert said(command, "lc") == (
        "'wrist' - 'hardware_interface::EffortJointInterface' ( running )\n"
    )
    assert said(command, "unload", "wrist") == "Error when unloading 'wrist'\n"
    assert said(command, "stop", "wrist") == "Stopped ['wrist'] successfully\n"
    assert said(command, "unload", "wrist") == "Unloaded 'wrist' successfully\n"


@pytest.mark.long
def test_the_command_spawns_kills_and_reloads(said, manager):
    command = "controller_manager"
    assert said(command, "spawn", "wrist", "effort") == (
        "Loaded 'wrist'\nLoaded 'effort'\n"
        "Started ['wrist'] successfully\nStarted ['effort'] successfully\n"
    )
    assert said(command, "reload-libraries", "--restore") == (
        "Restore: True\nSuccessfully reloaded libraries\nControllers restored to original state\n"
    )
    assert manager.states == {"wrist": "running", "effort": "running"}
    assert said(command, "kill", "wrist") == (
        "Stopped ['wrist'] successfully\nUnloaded 'wrist' successfully\n"
    )
    assert said(command, "reload-libraries") == "Restore: False\nSuccessfully reloaded libraries\n"
    assert manager.states == {}


def test_a_command_that_it_does_not_know_shows_those_it_does(start, manager):
    process = start("controller_manager", "dance")
    assert process.wait(30) == 1
    assert "reload-libraries" in process.stdout.read()


# controller_group -------------------------------------------------------------------------------


@pytest.mark.long
def test_groups_are_listed_spawned_and_switched(said, manager, robot):
    groups = {"b": ["position", "wrist"], "a": ["effort", "wrist"], "bad": ["effort", "position"]}
    robot.set_param("/controller_groups", groups)
    group = "controller_group"
    assert said(group, "list") == (
        "Number of groups: 3\n  a\n      effort\n      wrist\n"
        "  b\n      position\n      wrist\n  bad\n      effort\n      position\n"
    )
    assert said(group, "spawn", "a") == (
        "Loaded 'effort'\nLoaded 'wrist'\n"
        "Started ['effort'] successfully\nStarted ['wrist'] successfully\n"
    )
    assert said(group, "switch", "b") == (
        "Loaded 'position'\nStarted ['position'] successfully\nStopped ['effort'] successfully\n"
    )
    assert said(group, "switch", "bad") == (
        "Error when starting ['effort'] and stopping ['wrist']\n"
    )
    assert "There is no controller defined in group none" in said(group, "switch", "none")


def test_a_spawner_whose_manager_went_first_ends_without_a_warning(start, manager, robot):
    process = start("spawner", "effort", "wrist")
    until(lambda: manager.states == {"effort": "running", "wrist": "running"}, 30)
    robot.close()
    ends(process)
    said = process.stdout.read()
    assert "error" not in said
    assert "[WARN]" not in said
    assert "The controller manager is gone" in said
