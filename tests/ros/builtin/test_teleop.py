"""Robots are driven by keys in a terminal, which is as it was afterwards."""

from __future__ import annotations

import contextlib
import itertools
import os
import signal
import subprocess
import sys
import time

import pytest
from hypothesis import given
from hypothesis import strategies as st
from ros.graph import until

from gazelle_ros import Master, MasterProxy, Node, WallClock, load_message
from gazelle_ros.base.errors import RosError
from gazelle_ros.builtin.teleop.keyboard import DOWN, LEFT, RIGHT, UP, Keyboard
from gazelle_ros.builtin.teleop.turtlebot3 import LIMITS, StepwiseDrive
from gazelle_ros.builtin.teleop.twist import KeyDrive
from gazelle_ros.xmlrpc.client import BlockingClient

termios = pytest.importorskip("termios")
pty = pytest.importorskip("pty")

TURTLEBOT3 = ("turtlebot3_teleop", "turtlebot3_teleop_key")
TWIST = ("teleop_twist_keyboard", "teleop_twist_keyboard.py")


class Typist:
    """A program in a terminal of its own, and somebody who types."""

    def __init__(self, arguments, uri):
        self._keys, terminal = pty.openpty()
        self.terminal = terminal
        self.before = termios.tcgetattr(terminal)
        self.process = subprocess.Popen(
            [sys.executable, "-m", "gazelle_ros.cli.main", *arguments],
            env=os.environ | {"ROS_MASTER_URI": uri},
            stdin=terminal,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            preexec_fn=_take_terminal,  # noqa: PLW1509  # there is no other way
        )

    def type(self, text):
        os.write(self._keys, text.encode())

    @property
    def quiet(self):
        """Whether the terminal waits for no line, and shows no keys."""
        return not termios.tcgetattr(self.terminal)[3] & (termios.ICANON | termios.ECHO)

    def close(self):
        self.process.kill()
        self.process.communicate()
        os.close(self._keys)
        os.close(self.terminal)


def _take_terminal():
    """Make standard input the terminal whose Ctrl-C reaches the process."""
    import fcntl

    os.setsid()
    fcntl.ioctl(0, termios.TIOCSCTTY, 0)


@pytest.fixture
def master():
    with Master(port=0, rosout=False) as running:
        yield running


@pytest.fixture
def heard(master):
    got = []
    with Node("robot", master_uri=master.uri, clock=WallClock()) as node:
        node.subscribe("/cmd_vel", load_message("geometry_msgs/Twist"), got.append)
        yield got


@pytest.fixture
def typist(master):
    made = []

    def start(*arguments):
        made.append(Typist(arguments, master.uri))
        until(lambda: made[-1].quiet)
        return made[-1]

    yield start
    for each in made:
        each.close()


@pytest.mark.long
@pytest.mark.parametrize("end", ["ctrl-c", "terminate"])
def test_a_turtlebot3_is_driven(typist, heard, end):
    person = typist("exec", *TURTLEBOT3)
    until(lambda: heard)
    person.type("www" + UP + "aa")
    until(lambda: (round(heard[-1].linear.x, 6), round(heard[-1].angular.z, 6)) == (0.04, 0.2))
    steps = [after.linear.x - before.linear.x for before, after in itertools.pairwise(heard)]
    assert max(steps) < 0.0051, "the speed goes up step by step"
    person.type(" ")
    until(lambda: heard[-1].linear.x == heard[-1].angular.z == 0.0)
    person.type("x")
    until(lambda: heard[-1].linear.x < 0.0)
    if end == "ctrl-c":
        person.type("\x03")
    else:
        person.process.terminate()
    assert person.process.wait(60) == 0
    assert termios.tcgetattr(person.terminal) == person.before
    until(lambda: heard[-1].linear.x == 0.0)


@pytest.mark.long
def test_any_robot_is_driven(typist, heard):
    person = typist("exec", *TWIST, "_speed:=1.0", "cmd_vel:=/cmd_vel")

    def connected():
        person.type("k")
        time.sleep(0.1)
        return heard

    until(connected)
    for key, wanted in (
        ("i", (1.0, 0.0, 0.0, 0.0)),
        ("j", (0.0, 0.0, 0.0, 1.0)),
        ("qO", (1.1, -1.1, 0.0, 0.0)),
        ("t", (0.0, 0.0, 1.1, 0.0)),
        ("k", (0.0, 0.0, 0.0, 0.0)),
    ):
        person.type(key)
        until(lambda wanted=wanted: heard and values(heard[-1]) == pytest.approx(wanted))
    person.type("i\x03")
    assert person.process.wait(60) == 0
    until(lambda: values(heard[-1]) == (0.0, 0.0, 0.0, 0.0))
    assert termios.tcgetattr(person.terminal) == person.before


def values(twist):
    return twist.linear.x, twist.linear.y, twist.linear.z, twist.angular.z


@pytest.mark.long
def test_the_launch_file_drives_too(typist, heard, monkeypatch):
    monkeypatch.delenv("TURTLEBOT3_MODEL", raising=False)
    person = typist("launch", "turtlebot3_teleop", "turtlebot3_teleop_key.launch", "model:=waffle")
    until(lambda: heard)
    person.type("w" * 40)
    until(lambda: round(heard[-1].linear.x, 6) == 0.26)
    person.type("\x03")
    assert person.process.wait(60) == 0
    assert termios.tcgetattr(person.terminal) == person.before


@pytest.mark.long
def test_the_launcher_gives_the_terminal_back_of_a_node_that_was_killed(typist, master):
    person = typist("launch", "turtlebot3_teleop", "turtlebot3_teleop_key.launch")
    proxy = MasterProxy(master.uri, "/test")
    until(lambda: "/cmd_vel" in proxy.system_state()[0])
    with contextlib.closing(
        BlockingClient(proxy.lookup_node("/turtlebot3_teleop_keyboard"))
    ) as node:
        os.kill(node.call("getPid", "/test")[2], signal.SIGKILL)
    assert person.process.wait(60) == 0
    assert termios.tcgetattr(person.terminal) == person.before
    proxy.close()


def test_without_a_terminal_it_says_so(master):
    done = subprocess.run(
        [sys.executable, "-m", "gazelle_ros.cli.main", "exec", *TURTLEBOT3],
        env=os.environ | {"ROS_MASTER_URI": master.uri},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 1
    assert "standard input is not a terminal" in done.stderr
    assert "Traceback" not in done.stderr


def test_keys_are_told_apart(monkeypatch):
    keys, terminal = pty.openpty()
    with open(terminal, closefd=False) as stream:  # a number, no path
        monkeypatch.setattr(sys, "stdin", stream)
        before = termios.tcgetattr(terminal)
        with Keyboard() as keyboard:
            assert keyboard.wait(0.01) == []
            os.write(keys, f"w{UP}{LEFT}\x1b[3~é ".encode())
            assert keyboard.wait(60.0) == ["w", UP, LEFT, "\x1b[3~", "é", " "]
            signal.raise_signal(signal.SIGCONT)
        assert termios.tcgetattr(terminal) == before
        with contextlib.suppress(KeyError), Keyboard():
            raise KeyError  # whatever happens
        assert termios.tcgetattr(terminal) == before
    os.close(terminal)
    os.close(keys)


def test_a_file_is_no_terminal(tmp_path, monkeypatch):
    (tmp_path / "f").write_text("www")
    with (tmp_path / "f").open() as stream:
        monkeypatch.setattr(sys, "stdin", stream)
        with pytest.raises(RosError, match="terminal"):
            Keyboard()


@given(
    st.sampled_from(sorted(LIMITS)),
    st.lists(st.sampled_from(["w", "x", "a", "d", "s", " ", UP, DOWN, LEFT, RIGHT, "?"])),
)
def test_speeds_stay_within_the_models_limits(model, keys):
    drive = StepwiseDrive(LIMITS[model])
    last = (0.0, 0.0)
    for key in keys:
        drive.press(key)
        sent = drive.advance()
        assert abs(sent[0]) <= LIMITS[model][0]
        assert abs(sent[1]) <= LIMITS[model][1]
        if key not in {"s", " "}:
            assert abs(sent[0] - last[0]) <= 0.005 + 1e-9
            assert abs(sent[1] - last[1]) <= 0.05 + 1e-9
        last = sent
    for _ in range(200):
        drive.advance()
    assert drive.sent == drive.target


def test_opposite_keys_lead_back_to_rest():
    drive = StepwiseDrive(LIMITS["burger"])
    for key in "w" * 7 + "x" * 7 + "a" * 3 + "d" * 3:
        assert drive.press(key)
    assert drive.target == (0.0, 0.0)
    assert not drive.press("?")


def test_speeds_of_the_twist_keyboard_are_bounded():
    drive = KeyDrive(limits=(0.6, 1.0))
    assert all(drive.press("q") for _ in range(5))
    assert (drive.speed, drive.turn) == (0.6, 1.0)
