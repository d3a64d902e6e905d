"""ROS's commands and modules in programs that scripts start."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from gazelle_ros.builtin.on_path import offer

pytestmark = pytest.mark.skipif(os.name != "posix", reason="the programs are for shells")


@pytest.fixture
def surroundings(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "a place"))
    env = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "PYTHONPATH": "elsewhere"}
    assert offer(env) is not None
    return env


def said(command, env):
    done = subprocess.run(
        command, shell=True, env=env, capture_output=True, text=True, timeout=60, check=False
    )
    return done.returncode, done.stdout.strip(), done.stderr.strip()


def test_a_command_is_found_by_its_name_and_by_python(surroundings):
    shown = (0, "bool data", "")
    assert said("rosmsg show std_msgs/Bool", surroundings) == shown
    assert said('python "$(which rosmsg)" show std_msgs/Bool', surroundings) == shown


@pytest.mark.long
def test_commands_are_programs_of_packages_too(surroundings):
    code, folder, _ = said("rospack find topic_tools", surroundings)
    assert code == 0
    assert os.path.isdir(folder)  # noqa: PTH112  # a text that a program printed
    assert said("rospack find nowhere", surroundings)[0] == 1
    assert "Usage: xacro" in said("rosrun xacro xacro --help", surroundings)[1]


def test_pythons_that_are_started_import_ros(surroundings):
    for python in ("python", "python3", sys.executable):
        told = said(f"{python} -c 'import rospy; print(rospy.__file__)'", surroundings)
        assert told[0] == 0, told
        assert "compat" in told[1]


def test_offering_twice_changes_nothing_more(surroundings):
    once = dict(surroundings)
    offer(surroundings)
    assert surroundings == once
    assert once["PYTHONPATH"].endswith(f"{os.pathsep}elsewhere")


def test_without_a_place_to_write_nothing_is_changed(tmp_path, monkeypatch):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "file"))
    env = {"PATH": "/bin"}
    assert offer(env) is None
    assert env == {"PATH": "/bin"}


@pytest.mark.skipif(sys.platform != "linux", reason="there is no /proc")
def test_what_runs_can_be_ended_by_its_name(surroundings, tmp_path):
    env = surroundings | {"ROS_MASTER_URI": "http://127.0.0.1:9"}
    for command, name in (
        (["rosmaster", "-p", "0"], "rosmaster"),
        ([sys.executable, "-m", "gazelle_ros.builtin.start", "gazebo_ros", "spawn_model"], "spawn"),
    ):
        arguments = [] if name == "rosmaster" else ["-sdf", "-stdin", "-model", "m", "-wait", "m"]
        process = subprocess.Popen(
            [*command, *arguments], env=env, stdin=subprocess.PIPE, stderr=subprocess.DEVNULL
        )
        seen = ""
        while process.poll() is None and not seen.startswith(name):
            seen = Path(f"/proc/{process.pid}/comm").read_text(encoding="utf-8")
        process.kill()
        process.communicate()
        assert seen.startswith(name)
