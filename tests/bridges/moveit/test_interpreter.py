"""Commands in words, as of ``moveit_commander_cmdline.py``, against ``move_group``."""

import io
import logging
import os
import subprocess
import sys

import numpy as np
import pytest
from bridges.moveit.commander_graph import ARM, commander_graph
from ros.graph import until

from gazelle.drop_in.moveit_client.commander_prompt import CommandCompleter, converse, main
from gazelle_ros.builtin.registry import main_of

FAIL, WARN, SUCCESS, INFO, DEBUG = range(1, 6)
OK = (DEBUG, "OK")
READY = [0.0, -0.8, 0.0, 1.2, 0.0, -0.4, 0.0]


@pytest.fixture(scope="module")
def graph():
    with commander_graph() as found:
        yield found


@pytest.fixture(scope="module")
def moveit(graph):
    return graph[1]


@pytest.fixture
def told(moveit, tmp_path, monkeypatch):
    """Yield an interpreter that uses the arm, in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    made = moveit.MoveGroupCommandInterpreter()
    assert made.execute("use arm") == OK
    arm = made.get_active_group()
    arm.set_max_velocity_scaling_factor(1.0)
    arm.set_max_acceleration_scaling_factor(1.0)
    arm.set_planning_time(30.0)
    yield made
    arm.set_named_target("ready")
    assert arm.go()


def where(told):
    return told.get_active_group().get_current_joint_values()


def arrives(told, values):
    until(lambda: np.allclose(where(told), values, atol=1e-3), 60.0)


def test_levels_are_moveits(moveit):
    level = moveit.MoveGroupInfoLevel
    assert (level.FAIL, level.WARN, level.SUCCESS, level.INFO, level.DEBUG) == (1, 2, 3, 4, 5)
    made = moveit.MoveGroupCommandInterpreter
    assert made.DEFAULT_FILENAME == "move_group.cfg"
    assert made.GO_DIRS["down"] == (2, -1)


def test_a_group_comes_first(moveit):
    made = moveit.MoveGroupCommandInterpreter()
    assert made.get_active_group() is None
    level, text = made.execute("joints")
    assert level == INFO
    assert text.startswith("Known commands:")
    assert "must call the 'use' or the 'load' command first" in text
    assert made.execute("use previous") == OK
    level, text = made.execute("use nothing")
    assert (level, text[:28]) == (FAIL, "Unable to initialize nothing")
    assert made.execute("USE arm") == OK
    assert made.execute("use arm_with_torso") == OK
    assert made.execute("groups") == (INFO, "arm\narm_with_torso")
    assert [*made.get_loaded_groups()] == ["arm", "arm_with_torso"]
    assert made.execute("which") == (INFO, "arm_with_torso")
    assert made.execute("use previous") == OK
    assert made.execute("id") == (INFO, "arm")


def test_what_is_known_is_told(told):
    level, text = told.execute("joints")
    assert (level, text.split("\n")[1]) == (INFO, f"0 = {ARM[0]}")
    assert told.execute("eef") == (INFO, "gripper_link")
    assert told.execute("help")[1] == told.get_help()
    level, text = told.execute("current")
    assert text.startswith("joints = [")
    assert "gripper_link pose = [" in text
    assert "gripper_link RPY = " in text
    level, text = told.execute("group_state")
    assert text.count("<joint name=") == len(ARM)
    assert f'<joint name="{ARM[1]}" value="-0.8"/>' in text
    assert told.execute("tolerance") == (
        INFO, "Joint = 0.0001, Position = 0.0001, Orientation = 0.001",
    )  # fmt: skip
    assert told.execute("tol 0.01") == (SUCCESS, "OK")
    assert told.execute("tol")[1] == "Joint = 0.01, Position = 0.01, Orientation = 0.01"
    assert told.execute("time 7.5") == (SUCCESS, "OK")
    assert told.execute("time") == (INFO, "7.5")
    told.execute("time 30")
    assert told.execute("time soon") == (WARN, "Unable to parse planning duration value 'soon'")
    assert told.execute("tol much") == (WARN, "Unable to parse tolerance value 'much'")
    assert told.execute("planner RRT") == (SUCCESS, "Planner is now RRT")
    assert told.get_active_group().get_planner_id() == "RRT"
    told.get_active_group().set_planner_id("")


def test_values_have_names(told):
    group = told.get_active_group()
    assert told.execute("x = [1 -2.5 3e-1 0 0 0 0]")[0] == SUCCESS
    assert group.get_remembered_joint_values()["x"] == [1.0, -2.5, 0.3, 0, 0, 0, 0]
    assert told.execute("Home = x") == (SUCCESS, "Home is now the same as x")
    assert told.execute("x[1] = 4") == (SUCCESS, "Updated x[1]")
    assert group.get_remembered_joint_values()["x"][1] == 4.0
    assert group.get_remembered_joint_values()["Home"][1] == -2.5
    assert told.execute("show Home") == (INFO, "[1.0 -2.5 0.3 0.0 0.0 0.0 0.0]")
    assert told.execute("Home") == told.execute("show Home")
    assert told.execute("vars")[1].strip("[]").split() == ["x", "Home"]
    assert "x = [1.0 4.0" in told.execute("show")[1]
    assert told.execute("record here") == (
        SUCCESS, "Remembered current joint values under the name here",
    )  # fmt: skip
    np.testing.assert_allclose(group.get_remembered_joint_values()["here"], READY, atol=1e-9)
    assert told.execute("rand any")[0] == SUCCESS
    assert len(group.get_remembered_joint_values()["any"]) == len(ARM)
    assert told.execute("delete any") == (SUCCESS, "Forgot joint values under the name any")
    assert told.execute("show any") == (WARN, "Joint values for any are not known")
    for wrong in (
        "y = nothing",
        "y[0] = 1",
        "any",
        "fly me to the moon",
        "allow much true",
        "go",
        "rotate 1 2",
    ):
        assert told.execute(wrong) == (WARN, f"Unknown command: '{wrong}'")
    assert told.execute("x[9] = 1")[0] == WARN
    assert told.execute("x = [1 2-3]")[0] == WARN


def test_it_goes_where_it_is_told(told):
    assert told.execute(f"away = [0.4 {' '.join(map(str, READY[1:]))}]")[0] == SUCCESS
    assert told.execute("go away") == (SUCCESS, "Moved to away")
    arrives(told, [0.4, *READY[1:]])
    assert told.execute("go ready") == (SUCCESS, "Moved to ready")
    arrives(told, READY)
    assert told.execute("go nowhere")[0] == WARN
    before = told.get_active_group().get_current_pose().pose.position
    assert told.execute("go up 0.05") == (SUCCESS, "Moved up by 0.05 m")
    until(
        lambda: (
            told.get_active_group().get_current_pose().pose.position.z
            == pytest.approx(before.z + 0.05, abs=1e-3)
        ),
        60.0,
    )
    assert told.execute("go up far") == (WARN, "Unable to parse distance 'far'")
    assert told.execute("go rand")[0] in (SUCCESS, FAIL)


def test_it_goes_to_poses(told):
    group = told.get_active_group()
    assert told.execute("go ready")[0] == SUCCESS
    arrives(told, READY)
    pose, angles = group.get_current_pose().pose, group.get_current_rpy()
    there = [pose.position.x, pose.position.y + 0.05, pose.position.z, *angles]
    level, text = told.execute("go " + " ".join(map(str, there)))
    assert level == SUCCESS
    assert text.startswith("Moved to pose target\n")
    until(lambda: abs(group.get_current_pose().pose.position.y - there[1]) < 1e-3, 60.0)
    assert told.execute("go 1 2 3 4 5 six") == (WARN, "Unable to parse pose '1 2 3 4 5 six'")
    assert told.execute("rotate 0 0 up")[0] == WARN
    assert told.execute("rotate " + " ".join(map(str, angles))) == (SUCCESS, "Rotation complete")
    level, text = told.execute("go 9 0 0 0 0 0")
    assert level == FAIL


def test_a_plan_is_made_and_then_followed(told):
    assert told.execute("execute") == (WARN, "No motion plan computed")
    assert told.execute("plan") == (INFO, "No previous plan")
    told.execute(f"away = [-0.3 {' '.join(map(str, READY[1:]))}]")
    assert told.execute("plan away") == (SUCCESS, "Planned to away")
    assert "joint_trajectory" in told.execute("plan")[1]
    assert told.execute("execute") == (SUCCESS, "Plan submitted for execution")
    arrives(told, [-0.3, *READY[1:]])
    assert told.execute("plan nowhere")[0] == WARN
    assert told.execute("execute") == (WARN, "No motion plan computed")
    told.execute("beyond = [0 0 0 0 0 9 0]")
    assert told.execute("plan beyond")[0] == WARN


def test_files_of_commands(told, tmp_path, moveit, capsys, caplog):
    told.execute("Spot = [1 2 3 4 5 6 7]")
    assert told.execute("save") == OK
    assert (tmp_path / "move_group.cfg").read_text().startswith("use arm\nSpot = [1.0 2.0")
    other = moveit.MoveGroupCommandInterpreter()
    assert other.execute("load") == OK
    assert other.get_active_group().get_remembered_joint_values()["Spot"][6] == 7.0
    (tmp_path / "cmd").mkdir()
    (tmp_path / "cmd" / "tidy").write_text("use arm  # comes first\n\n# nothing\nx = Spot\nfly\n")
    assert other.execute("trace on") == OK
    assert other.execute("trace") == (INFO, "trace is on")
    with caplog.at_level(logging.WARNING, "rosout"):
        assert other.execute("tidy") == OK
    assert "cmd/tidy:1:  use arm  # comes first" in capsys.readouterr().out
    assert "cmd/tidy:5: fly: Unknown command: 'fly'" in caplog.text
    assert other.get_active_group().get_remembered_joint_values()["x"][0] == 1.0
    assert other.execute("load missing") == (WARN, "Unable to load cmd/missing")
    assert other.execute("load a b") == (WARN, "Unable to parse load command")
    assert other.execute("save a b") == (WARN, "Unable to parse save command")
    fault = "Unable to save no/such/folder: No such file or directory"
    assert other.execute("save no/such/folder") == (WARN, fault)
    (tmp_path / "again").write_text("load again\n")
    assert other.execute("load again") == OK
    assert "it loads itself" in caplog.text


def test_the_rest(told, moveit):
    assert told.execute("stop") == OK
    assert told.execute("allow replanning true") == OK
    assert told.execute("allow looking false") == OK
    assert told.execute("wait 0.01") == (SUCCESS, "0.01 seconds passed")
    assert told.execute("wait long") == (WARN, "Unable to wait 'long' seconds")
    assert told.execute("wait -1") == (WARN, "Unable to wait '-1' seconds")
    assert told.execute("constrain") == (SUCCESS, "Cleared path constraints")
    assert told.execute("constrain upright") == (WARN, "Not connected to a database.")
    assert told.execute("database") == (INFO, "Not connected to a database")
    assert told.execute("database here 1") == (WARN, "Unable to connect to 'here:1'")
    assert told.execute("pick nothing") == (FAIL, "Failed while trying to pick object nothing")
    assert told.execute("place nothing") == (FAIL, "Failed while trying to place object nothing")
    assert told.execute("ground") == (INFO, "Added ground")
    scene = moveit.PlanningSceneInterface()
    assert scene.get_attached_objects()["ground"].link_name == "base_link"
    scene.clear()
    words = told.get_keywords()
    assert words["use"] == moveit.RobotCommander().get_group_names()
    assert "up" in words["go"]
    assert words["allow"] == ["replanning", "looking"]


def test_words_are_ended():
    completer = CommandCompleter()
    completer.words = {"go": ["up", "down"], "groups": [], "use": ["arm"]}
    assert completer.end("g", "g", 0) == "go "
    assert completer.end("g", "g", 1) == "groups "
    assert completer.end("g", "g", 2) is None
    assert completer.end("go ", "", 0) == "down "
    assert completer.end("go u", "u", 0) == "up "
    assert completer.end("", "", 2) == "use "


LINES = "id\n\nhost\nfly\nquit\nid\n"


def check_talk(said, master):
    assert "Waiting for commands" in said
    assert said.count("arm> arm\n") == 1
    assert f"Master is '{master}'" in said
    assert "Unknown command: 'fly'" in said
    assert said.endswith("Bye bye!\n")


def test_the_prompt(told, monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", io.StringIO(LINES))
    converse(told, "http://here:1")
    check_talk(capsys.readouterr().out, "http://here:1")


@pytest.mark.long
@pytest.mark.usefixtures("told")
def test_the_program(graph):
    assert main_of("moveit_commander", "moveit_commander_cmdline.py") is main
    master = graph[0].node.master_uri
    program = [
        sys.executable,
        "-m",
        "gazelle",
        "exec",
        "moveit_commander",
        "moveit_commander_cmdline.py",
    ]
    done = subprocess.run([*program, "arm"], input=f"current\n{LINES}", text=True, capture_output=True, check=True,
                          env=os.environ | {"ROS_MASTER_URI": master}, timeout=60)  # fmt: skip
    check_talk(done.stdout, master)
    assert "gripper_link RPY = " in done.stdout
