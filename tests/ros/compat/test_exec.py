"""`gazelle exec`: a script for ROS 1 as a process of its own."""

import os
import signal
import subprocess
import sys
import time

import pytest

COMMAND = [
    sys.executable,
    "-c",
    "import sys; from gazelle_ros.cli.main import main; sys.exit(main())",
]
TALKER = """
import sys, rospy
from std_msgs.msg import String
rospy.init_node("talker")
pub = rospy.Publisher("chatter", String, queue_size=10, latch=True)
rospy.on_shutdown(lambda: print("last words", flush=True))
pub.publish(rospy.get_param("~text", "none"))
print("ready", rospy.myargv(sys.argv)[1:], __name__, flush=True)
rospy.spin()
print("after spin", flush=True)
"""


@pytest.fixture
def execute(tmp_path, master):
    running = []

    def start(text, *arguments, options=()):
        script = tmp_path / "script.py"
        script.write_text(text)
        env = {**os.environ, "ROS_MASTER_URI": master.uri, "PYTHONUNBUFFERED": "1"}
        process = subprocess.Popen(
            [*COMMAND, "exec", *options, str(script), *arguments],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            env=env,
        )
        running.append(process)
        return process

    yield start
    for process in running:
        process.kill()
        process.communicate()


def test_a_node_runs_talks_and_ends_at_ctrl_c(execute, make_node):
    from gazelle_ros.messages import load_message

    process = execute(TALKER, "chatter:=/told", "_text:=hello", "--flag", "__name:=other")
    assert process.stdout.readline() == "ready ['--flag'] __main__\n"
    listener = make_node("listener")
    assert listener.wait_for_message("/told", load_message("std_msgs/String"), 60.0).data == "hello"
    assert listener.get_param("/other/text") == "hello"
    process.send_signal(signal.SIGINT)
    out, err = process.communicate(timeout=120)
    assert out == "last words\nafter spin\n"
    assert err == ""
    assert process.returncode == 0


@pytest.mark.parametrize(
    ("text", "code", "said"),
    [
        ("import sys; sys.exit(3)", 3, ""),
        ("import sys; sys.exit('no')", 1, "no\n"),
        ("1 / 0", 1, "ZeroDivisionError: division by zero\n"),
        ("x = (", 1, "SyntaxError: '(' was never closed\n"),
    ],
)
def test_a_script_ends_as_python_would_end_it(execute, text, code, said):
    process = execute(text)
    _, err = process.communicate(timeout=120)
    assert process.returncode == code
    assert err.endswith(said)
    assert "compat/script.py" not in err


def test_a_missing_script_is_one_line(execute):
    process = subprocess.run(
        [*COMMAND, "exec", "/nowhere/x.py"], capture_output=True, text=True, check=False
    )
    assert process.returncode == 1
    assert process.stderr.count("\n") == 1
    assert "cannot read the script" in process.stderr


def test_python_before_a_script_is_passed_over(tmp_path):
    script = tmp_path / "words.py"
    script.write_text("import sys; print(sys.argv[1:])")
    command = [*COMMAND, "exec", "python3", str(script), "a", "b:=c"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("['a', 'b:=c']\n", "")


def test_sleep_can_mean_simulated_time(execute, make_node):
    from gazelle_ros.messages import load_message
    from gazelle_ros.time import Time

    driver = make_node("driver")
    driver.set_param("/use_sim_time", True)
    clock = load_message("rosgraph_msgs/Clock")
    publisher = driver.advertise("/clock", clock, queue_size=10)
    text = (
        "import rospy, time\nrospy.init_node('s')\nprint('go', flush=True)\n"
        "time.sleep(60)\nprint('slept', flush=True)\n"
    )
    process = execute(text, options=["--sim-sleep"])
    assert process.stdout.readline() == "go\n"
    # It may begin to sleep late: time goes on as long as it sleeps.
    for second in range(1, 10_000):
        publisher.publish(clock(Time(second)))
        time.sleep(0.01)
        if process.poll() is not None:
            break
    out, _ = process.communicate(timeout=120)
    assert out == "slept\n"


def test_a_script_for_python_2_is_one_line_that_says_what_to_change(execute):
    process = execute("import rospy\nprint 'hello'\n")
    out, err = process.communicate(timeout=120)
    assert process.returncode == 1
    assert out == ""
    first, second = err.splitlines()
    assert "script.py:2: this is written for Python 2 (SyntaxError: Missing parentheses" in first
    assert second == "  hint: write print('hello')"


def test_debug_shows_the_whole_traceback_and_scripts_keep_their_own(execute):
    process = execute("import sys; print(sys.argv[1:]); import Queue", "--debug", "x")
    out, err = process.communicate(timeout=120)
    assert out == "['--debug', 'x']\n"
    assert "Traceback" not in err
    process = execute("import Queue", options=["--debug"])
    _, err = process.communicate(timeout=120)
    assert "compat/script.py" in err
    assert err.endswith("No module named 'Queue'\n")


def test_a_close_name_is_offered_for_a_missing_script(execute, tmp_path):
    execute("").communicate(timeout=120)
    done = subprocess.run(
        [*COMMAND, "exec", str(tmp_path / "scrpt.py")], capture_output=True, text=True, check=False
    )
    assert "did you mean 'script.py'" in done.stderr


@pytest.mark.long
def test_a_package_and_a_program_stand_for_a_script(tmp_path, master):
    package = tmp_path / "ws" / "robot" / "scripts"
    package.mkdir(parents=True)
    (package.parent / "package.xml").write_text("<package><name>robot</name></package>")
    (package / "told").write_text("#!/usr/bin/env python\nimport rospy, sys; print(sys.argv[1:])\n")
    (package / "shell").write_text("#!/bin/sh\necho shell $1\nexit 4\n")
    for file in package.iterdir():
        file.chmod(0o755)
    env = {**os.environ, "ROS_PACKAGE_PATH": str(tmp_path / "ws"), "ROS_MASTER_URI": master.uri}

    def run(*words):
        return subprocess.run(
            [*COMMAND, "exec", *words], capture_output=True, text=True, check=False, env=env
        )

    assert run("robot", "told", "a", "b:=c").stdout == "['a', 'b:=c']\n"
    done = run("robot", "shell", "x")
    assert (done.stdout, done.returncode) == ("shell x\n", 4)
    assert "has no program 'tolt'" in run("robot", "tolt").stderr
    assert "did you mean 'told'" in run("robot", "tolt").stderr
