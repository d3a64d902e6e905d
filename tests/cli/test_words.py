"""Words that users type first: ROS's commands, a shell with them, and the tab key."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys

import pytest
from ports import free_port

from gazelle.cli.commands import COMMANDS
from gazelle.cli.completion import script_for
from gazelle_ros import Master, Node, load_message
from gazelle_ros.tool_names import COMMANDS as TOOLS
from gazelle_ros.tool_names import translated


@pytest.fixture
def graph(monkeypatch):
    with Master(port=0, rosout=False) as master, Node("n", master_uri=master.uri) as node:
        node.advertise("/words", load_message("std_msgs/String"))
        node.set_param("/answer", 42)
        monkeypatch.setenv("ROS_MASTER_URI", master.uri)
        yield master


@pytest.mark.parametrize("before", [[], ["exec"]])
@pytest.mark.parametrize(
    ("words", "said"),
    [
        ("rostopic list", "/words"),
        ("rosnode list", "/n"),
        ("rosparam get /answer", "42"),
        ("rosservice list", ""),
        ("rosmsg show std_msgs/Bool", "bool data"),
        ("rossrv show std_srvs/Trigger", "bool success"),
        ("roslaunch --nodes turtlebot3_teleop turtlebot3_teleop_key.launch", "/turtlebot3_teleop_"),
    ],
)
def test_ros_words_do_what_they_do_in_ros(graph, cli, before, words, said):
    code, out, err = cli(*before, *words.split())
    assert (code, err) == (0, "")
    assert said in out


@pytest.mark.parametrize(
    "words", ["rospack find turtlebot3_description", "rosrun rospack rospack find xacro"]
)
@pytest.mark.parametrize("before", [[], ["exec"]])
def test_words_that_are_programs_take_the_place_of_the_process(before, words):
    command = [sys.executable, "-m", "gazelle.cli.main", *before, *words.split()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 0, done.stderr
    assert os.path.isdir(done.stdout.strip())  # noqa: PTH112  # a text that a program printed


@pytest.mark.parametrize("words", [["roscore"], ["exec", "roscore"]])
def test_roscore_is_a_core(words, tmp_path):
    port = free_port()
    env = os.environ | {"ROS_HOME": str(tmp_path)}
    command = [sys.executable, "-m", "gazelle.cli.main", *words, "-p", str(port)]
    with subprocess.Popen(command, env=env, stdout=subprocess.PIPE, text=True) as process:
        try:
            for line in process.stdout:
                if "started core service [/rosout]" in line:
                    break
            assert process.poll() is None
        finally:
            process.send_signal(signal.SIGINT)
            process.stdout.read()
        assert process.wait(60) == 0


def test_a_script_of_the_name_of_a_tool_is_run(tmp_path):
    """In a process of its own, in which the modules of ROS stay."""
    (tmp_path / "rostopic").write_text("print('my own')")
    command = [sys.executable, "-m", "gazelle", "exec", "rostopic"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (0, "my own\n")


def test_other_words_stay():
    assert translated(["run", "rostopic"]) == ["run", "rostopic"]
    assert translated([]) == []


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        (("run", "nosuch.world"), "'gazelle worlds'"),
        (("run", "emtpy"), "did you mean 'empty'?"),
        (("run", "./nosuch.world"), "there is nothing of that name"),
        (("check", "./nosuch.sdf"), "there is nothing of that name"),
    ],
)
def test_the_hint_for_a_missing_file_is_short(cli, tmp_path, monkeypatch, arguments, expected):
    monkeypatch.chdir(tmp_path)
    for place in range(30):
        (tmp_path / f"something_else_{place}.txt").write_text("")
    code, out, err = cli(*arguments)
    assert code == 1
    assert expected in out + err
    assert "something_else" not in out + err
    assert len(out + err) < 400


needs_bash = pytest.mark.skipif(shutil.which("bash") is None, reason="there is no bash")


@needs_bash
def test_in_the_shell_the_commands_are_gazelles(tmp_path):
    env = os.environ | {"XDG_CACHE_HOME": str(tmp_path), "SHELL": shutil.which("bash")}
    command = [sys.executable, "-m", "gazelle.cli.main", "shell", "-c"]
    text = "which roscore roslaunch rostopic; rosmsg show std_msgs/Bool; python -c 'import rospy'; exit 3"
    done = subprocess.run([*command, text], env=env, capture_output=True, text=True, check=False)
    assert done.returncode == 3, done.stderr
    *places, shown = done.stdout.split("\n", 3)
    assert all(place.startswith(str(tmp_path)) for place in places)
    assert shown.strip() == "bool data"
    assert done.stderr == ""


@needs_bash
def test_an_interactive_shell_reads_the_users_settings_and_completes(tmp_path):
    pty = pytest.importorskip("pty")
    (tmp_path / ".bashrc").write_text("PATH=/usr/bin:/bin\nmine=from_bashrc\nPS1='> '\n")
    env = os.environ | {"HOME": str(tmp_path), "SHELL": shutil.which("bash"), "TERM": "dumb"}
    env |= {"XDG_CACHE_HOME": str(tmp_path)}
    keys, terminal = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle.cli.main", "shell"],
        env=env, stdin=terminal, stdout=terminal, stderr=terminal, start_new_session=True,
    )  # fmt: skip
    out = b""
    os.write(keys, b"echo $mine; which rostopic; complete -p rostopic; exit\n")
    os.close(terminal)
    while True:
        try:
            data = os.read(keys, 4096)
        except OSError:
            break
        if not data:
            break
        out += data
    assert process.wait(60) == 0
    os.close(keys)
    text = out.decode()
    assert "(gazelle) " in text
    assert "from_bashrc" in text
    assert f"{tmp_path}/gazelle/programs/" in text
    assert "_gazelle_complete rostopic" in text


def completed(script, *words):
    """Return bash's completion after these words."""
    line = " ".join(f"'{word}'" for word in words)
    text = f"{script}\nCOMP_WORDS=({line}); COMP_CWORD={len(words) - 1}\n_gazelle_complete\n"
    text += 'printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "-c", text], capture_output=True, text=True, check=True)
    assert done.stderr == ""
    return set(done.stdout.split())


@needs_bash
def test_the_tab_key_completes(tmp_path, graph, monkeypatch):
    program = tmp_path / "gazelle"
    program.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m gazelle.cli.main "$@"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
    script = script_for("bash")
    assert completed(script, "gazelle", "") >= {*COMMANDS, *TOOLS}
    assert completed(script, "gazelle", "la") == {"launch"}
    assert "--screen" in completed(script, "gazelle", "launch", "--")
    assert completed(script, "roslaunch", "--scr") == {"--screen"}
    assert completed(script, "gazelle", "rosbag", "pl") == {"play"}
    assert completed(script, "rosbag", "pl") == {"play"}
    assert completed(script, "gazelle", "bag", "record", "--spl") == {"--split"}
    assert completed(script, "rostopic", "ech") == {"echo"}
    assert completed(script, "rostopic", "echo", "/wo") == {"/words"}
    assert completed(script, "gazelle", "param", "get", "/ans") == {"/answer"}
    assert completed(script, "gazelle", "completion", "z") == {"zsh"}
    monkeypatch.chdir(tmp_path)
    assert completed(script, "gazelle", "run", "gaz") == {"gazelle"}


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_the_script_is_printed(cli, shell):
    code, out, err = cli("completion", shell)
    assert (code, err) == (0, "")
    assert "complete -o filenames -F _gazelle_complete gazelle" in out
    assert " rostopic " not in out.splitlines()[-1]


@pytest.mark.parametrize("shell", ["bash", "zsh"])
def test_the_script_is_understood(cli, shell):
    if shutil.which(shell) is None:
        pytest.skip(f"there is no {shell}")
    _, out, _ = cli("completion", shell)
    subprocess.run([shell, "-n"], input=out, text=True, check=True)
