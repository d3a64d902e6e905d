"""The master and rosout of a launch are processes, called as ROS calls them."""

from __future__ import annotations

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from ports import free_port
from processes import is_running
from ros.graph import until
from whole import needs_gazelle

from gazelle_ros import Master, MasterProxy
from gazelle_ros.errors import RosError
from gazelle_ros.launch import LaunchPlan, Packages
from gazelle_ros.launch.runner import Launch, Options
from gazelle_ros.tool_names import process_name

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are looked up in /proc")

SLEEP = "#!/bin/sh\nexec sleep 100\n"


class Family:
    """A command, and the processes that it started, by the names that killall knows."""

    def __init__(self, arguments, uri, home):
        env = os.environ | {"ROS_MASTER_URI": uri, "ROS_HOME": str(home)}
        command = [sys.executable, "-m", "gazelle_ros.cli.main", *map(str, arguments)]
        self.out = home / "out"
        with self.out.open("w") as out:
            self.process = subprocess.Popen(command, env=env, stdout=out, stderr=out)
        self.master = MasterProxy(uri, "/test")
        self.children = {}

    def ready(self, *names):
        """Wait for children of these names."""
        until(lambda: self._look().keys() >= set(names))
        return self.children

    def numbers(self):
        pid = self.process.pid
        return Path(f"/proc/{pid}/task/{pid}/children").read_text().split()

    def _look(self):
        for number in self.numbers():
            self.children[comm(number)] = int(number)
        return self.children

    def answers(self):
        with contextlib.suppress(RosError):
            return self.master.get_pid()
        return None

    def close(self):
        self.process.kill()
        self.process.wait()
        for pid in self.children.values():
            with contextlib.suppress(ProcessLookupError):
                os.killpg(pid, signal.SIGKILL)
        self.master.close()


def comm(pid):
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/comm").read_text().strip()
    return ""


@pytest.fixture
def free_uri():
    return f"http://127.0.0.1:{free_port()}/"


@pytest.fixture
def start(free_uri, tmp_path):
    made = []

    def run(*arguments):
        made.append(Family(arguments, free_uri, tmp_path))
        return made[-1]

    yield run
    for each in made:
        each.close()


@pytest.fixture
def file(workspace, script, tmp_path):
    script("sleep.sh", SLEEP)
    path = tmp_path / "f.launch"
    path.write_text('<launch><node pkg="robot" type="sleep.sh" name="s"/></launch>')
    return path


@pytest.fixture(params=["launch", "core"])
def begun(request, start, file):
    """Return a launch with a node, or a roscore; and the names of its children."""
    if request.param == "core":
        family, names = start("launch", "--core"), ("rosmaster", "rosout")
    else:
        family, names = start("launch", file), ("rosmaster", "rosout", "sleep")
    family.ready(*names)
    until(lambda: "started core service [/rosout]" in family.out.read_text())
    return family


def test_processes_bear_their_names(begun):
    family = begun
    core = "--core" in Path(f"/proc/{family.process.pid}/cmdline").read_text()
    assert comm(family.process.pid) == ("roscore" if core else "roslaunch")
    assert family.answers() == family.children["rosmaster"]
    for name in ("rosmaster", "rosout"):
        words = Path(f"/proc/{family.children[name]}/cmdline").read_text()
        assert name in words, "where there is no /proc, the command line tells"
    port = family.master.uri.rstrip("/").rpartition(":")[2]
    words = Path(f"/proc/{family.children['rosmaster']}/cmdline").read_text().split("\0")
    assert " ".join(words).find(f"rosmaster --core -p {port}") > 0


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_nothing_is_left_behind(begun, number):
    family = begun
    family.process.send_signal(number)
    assert family.process.wait(60) == 0
    assert all(not is_running(pid) for pid in family.children.values())
    assert "Traceback" not in family.out.read_text()
    assert family.out.read_text().endswith("done\n")


@pytest.mark.parametrize("seconds", [0.05, 0.2, 0.45])
def test_nothing_is_left_behind_of_a_launch_that_just_begins(start, file, seconds, tmp_path):
    family = start("launch", "--pid", tmp_path / "pid", file)
    until((tmp_path / "pid").exists)
    time.sleep(seconds)
    family._look()
    family.process.send_signal(signal.SIGTERM)
    family.process.wait(60)
    assert all(not is_running(pid) for pid in family.children.values())
    assert family.answers() is None
    assert "Traceback" not in family.out.read_text()


def test_the_master_survives_its_launcher(begun):
    family = begun
    before = family.answers()
    family.process.kill()
    family.process.wait()
    if "sleep" in family.children:
        until(lambda: not is_running(family.children["sleep"]))
    assert family.answers() == before
    assert is_running(family.children["rosout"])
    until(lambda: family.master.system_state()[0].get("/rosout_agg") == ["/rosout"])


@pytest.mark.long
def test_nodes_survive_a_killed_roslaunch_as_with_ros(start, file):
    """Who types roslaunch gets what ROS does; ``gazelle launch`` ends its nodes, see above."""
    family = start("roslaunch", file)
    family.ready("rosmaster", "rosout", "sleep")
    before = family.answers()
    family.process.kill()
    family.process.wait()
    time.sleep(2.0)
    assert is_running(family.children["sleep"])
    assert is_running(family.children["rosout"])
    assert family.answers() == before


HELPER = "rosout roslaunch rosmaster gzserver robot_state_publisher gzclient"
ROBOT = "<robot name='r'><link name='base'/></robot>".replace("<", "&lt;")


@needs_gazelle
@pytest.mark.skipif(shutil.which("killall") is None, reason="there is no killall")
def test_a_helper_script_finds_all_by_their_names(start, tmp_path):
    """Among them names of more than the 15 letters that Linux keeps, and the simulator's."""
    state = ("robot_state_publisher", "robot_state_publisher")
    nodes = [*[("gazebo_ros", kind) for kind in ("gzserver", "gazebo", "gzclient")], state]
    body = "".join(
        f'<node pkg="{package}" type="{kind}" name="n{place}"/>'
        for place, (package, kind) in enumerate(nodes)
    )
    path = tmp_path / "all.launch"
    path.write_text(f'<launch><param name="robot_description" value="{ROBOT}"/>{body}</launch>')
    family = start("launch", path)
    family.ready("rosmaster", "rosout", "gzserver", "robot_state_pub", "gzclient")
    pid = family.process.pid
    until(lambda: len(family.numbers()) == 7)  # the guard, too
    until(lambda: [comm(each) for each in family.numbers()].count("gzserver") == 2)
    # Signal 0 is sent and does nothing: others may run their own on this machine.
    command = ["killall", "-v", "-s", "0", *HELPER.split()]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, "each name was found"
    found = set(re.findall(r"\((\d+)\)", done.stdout + done.stderr))
    guard = {each for each in family.numbers() if comm(each).startswith("python")}
    assert {str(pid), *family.numbers()} - found == guard


def test_the_launch_ends_with_its_master(begun):
    family = begun
    os.kill(family.children["rosmaster"], signal.SIGKILL)
    assert family.process.wait(60) == 1
    assert all(not is_running(pid) for pid in family.children.values())
    assert "REQUIRED process [master]" in family.out.read_text()


def test_the_launch_ends_when_the_master_is_asked_to(begun):
    family = begun
    family.master.call("shutdown", "a test asks")
    assert family.process.wait(60) == 0
    assert all(not is_running(pid) for pid in family.children.values())


def test_rosout_comes_again(begun):
    family = begun
    first = family.children.pop("rosout")
    os.kill(first, signal.SIGKILL)
    until(lambda: family._look().get("rosout", first) != first)
    assert family.process.poll() is None


def test_a_core_needs_a_free_port(start, master_elsewhere):
    family = start("launch", "--core", "--port", master_elsewhere.port)
    assert family.process.wait(60) == 1
    assert f"a ROS master runs there already, process {os.getpid()}" in family.out.read_text()


@pytest.fixture
def master_elsewhere():
    with Master(port=0) as master:
        yield master


def test_a_master_that_was_there_stays(file, start, master_elsewhere):
    family = start("launch", "--port", master_elsewhere.port, file)
    family.ready("sleep")
    assert family.children.keys().isdisjoint({"rosmaster", "rosout"})
    family.process.send_signal(signal.SIGINT)
    assert family.process.wait(60) == 0
    assert MasterProxy(master_elsewhere.uri, "/test").get_pid() == os.getpid()


def test_what_nodes_log_first_reaches_everybody(free_uri, tmp_path, monkeypatch):
    """Rosout is there when the nodes are started."""
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    options = Options(master_uri=free_uri)
    with Launch(LaunchPlan(), options, say=lambda _: None, packages=Packages()) as launch:
        launch.start()
        proxy = MasterProxy(free_uri, "/test")
        assert proxy.system_state()[1]["/rosout"] == ["/rosout"]
        assert proxy.get_param("/run_id") == launch.run_id
        assert proxy.get_param("/rosversion").startswith("1.")


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["launch", "a.launch"], "roslaunch"),
        (["launch", "--nodes-survive", "--verbose", "a.launch"], "roslaunch"),
        (["launch", "--core", "-p", "1"], "roscore"),
        (["launch", "--screen", "--test", "a.test"], "rostest"),
        (["master"], "rosmaster"),
        (["topic", "echo", "/a"], "rostopic"),
        (["exec", "a.py"], None),
        (["train"], None),
        ([], None),
    ],
)
def test_processes_are_called_as_in_ros(words, name):
    assert process_name(words) == name
