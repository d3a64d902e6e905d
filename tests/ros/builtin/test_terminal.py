"""Programs for a terminal run without one where there is no display."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from ros.graph import until

from gazelle_ros.builtin.on_path import offer
from gazelle_ros.builtin.terminal import programs, real_terminal

pytestmark = pytest.mark.skipif(os.name != "posix", reason="there are no such terminals")


@pytest.fixture
def env(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    made = {"PATH": os.environ["PATH"], "HOME": str(tmp_path), "ROS_HOME": str(tmp_path / "ros")}
    assert offer(made) is not None
    return made


def logs(env):
    return sorted((Path(env["ROS_HOME"]) / "log").glob("*.log"))


def run(command, env):
    return subprocess.run(
        command, shell=True, env=env, capture_output=True, text=True, timeout=60, check=False
    )


@pytest.mark.parametrize(
    "command",
    [
        "xterm -e echo 'hello you'",
        "xterm -hold -geometry 80x20+0+0 -T title -e echo 'hello you'",
        "xterm -e 'echo hello you'",
        "konsole --noclose -e bash -c 'echo hello you'",
    ],
)
def test_the_program_runs_and_writes_to_a_log(env, command):
    done = run(command, env)
    assert (done.returncode, done.stdout) == (0, "")
    (log,) = logs(env)
    assert log.read_text() == "hello you\n"
    (line,) = done.stderr.splitlines()
    assert "there is no display" in line
    assert str(log) in line


@pytest.mark.parametrize(
    "command",
    [
        "gnome-terminal -- sh -c 'sh ~/wait; echo hello'",
        "gnome-terminal --tab -e 'sh -c \"sh ~/wait; echo hello\"'",
        "xfce4-terminal --command='sh -c \"sh ~/wait; echo hello\"'",
    ],
)
def test_terminals_of_desktops_return_at_once(env, command):
    home = Path(env["HOME"])
    (home / "wait").write_text("while [ ! -e ~/go ]; do sleep 0.05; done\n")
    assert run(command, env).returncode == 0
    (log,) = logs(env)
    assert log.read_text() == ""
    (home / "go").touch()
    until(lambda: log.read_text() == "hello\n")


def test_the_exit_code_and_the_signals_are_those_of_the_program(env):
    assert run("xterm -e sh -c 'exit 7'", env).returncode == 7
    process = subprocess.Popen(["xterm", "-e", "sleep", "100"], env=env, stderr=subprocess.DEVNULL)
    until(lambda: Path(f"/proc/{process.pid}/comm").read_text() == "sleep\n")
    process.send_signal(signal.SIGTERM)
    assert process.wait(60) == -signal.SIGTERM


def test_what_cannot_be_run_is_said(env):
    done = run("xterm -e no_such_program a b", env)
    assert done.returncode == 127
    assert "'no_such_program' cannot be run" in done.stderr
    done = run("xterm", env)
    assert done.returncode == 1
    assert "no program to run" in done.stderr


def test_a_terminal_that_can_show_its_window_is_started(env, tmp_path):
    place = tmp_path / "bin"
    place.mkdir()
    (place / "xterm").write_text('#!/bin/sh\necho real "$@"\n')
    (place / "xterm").chmod(0o755)
    shown = env | {"DISPLAY": ":0", "PATH": f"{env['PATH']}{os.pathsep}{place}"}
    assert run("xterm -e roscore -v", shown).stdout == "real -e roscore -v\n"
    assert real_terminal("xterm", shown) == str(place / "xterm")
    done = run("konsole -e echo hello", shown)
    assert "it is not installed" in done.stderr


@pytest.mark.parametrize(
    ("name", "words", "found"),
    [
        ("xterm", ["-e", "a", "-e", "b"], [["a", "-e", "b"]]),
        ("xterm", ["-e", "roslaunch a b"], [["/bin/sh", "-c", "roslaunch a b"]]),
        ("xterm", ["-e", "sh"], [["sh"]]),
        ("xterm", ["-bg", "red"], []),
        ("xterm", ["-e"], []),
        ("gnome-terminal", ["--tab", "-e", "a b", "--tab", "-e", "c d"], 2 * [None]),
        ("gnome-terminal", ["--command=a b"], [["/bin/sh", "-c", "a b"]]),
        ("gnome-terminal", ["-e", "a b", "-x", "c", "d"], [["/bin/sh", "-c", "a b"], ["c", "d"]]),
    ],
)
def test_command_lines_are_taken_apart(name, words, found):
    got = programs(name, words)
    assert len(got) == len(found)
    assert all(want in (None, each) for want, each in zip(found, got, strict=True))


@pytest.mark.parametrize("prefix", ["xterm -hold -e nice -n 1", "gnome-terminal -x"])
def test_nodes_with_the_prefix_run(tmp_path, prefix):
    package = tmp_path / "robot"
    package.mkdir()
    (package / "package.xml").write_text("<package><name>robot</name></package>")
    program = package / "node.sh"
    program.write_text("#!/bin/sh\necho from the node\nexec sleep 100\n")
    program.chmod(0o755)
    file = tmp_path / "a.launch"
    file.write_text(
        f'<launch><node pkg="robot" type="node.sh" name="n" launch-prefix="{prefix}"/></launch>'
    )
    env = {key: value for key, value in os.environ.items() if "DISPLAY" not in key}
    env |= {"ROS_PACKAGE_PATH": str(tmp_path), "ROS_HOME": str(tmp_path / "ros")}
    command = [sys.executable, "-m", "gazelle_ros.cli.main", "launch", "--port", "0", str(file)]
    from gazelle_ros import Master

    with Master(port=0, rosout=False) as master:
        command[5] = str(master.port)
        with subprocess.Popen(command, env=env, stderr=subprocess.PIPE, text=True) as process:
            line = process.stderr.readline()
            assert "there is no display" in line
            log = Path(line.rpartition("writes to ")[2].strip())
            until(lambda: log.exists() and log.read_text() == "from the node\n")
            process.send_signal(signal.SIGINT)
            assert process.wait(60) == 0
