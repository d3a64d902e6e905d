"""Every command ends on Ctrl-C and SIGTERM, waiting or working, and leaves no process behind."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
import uuid
from dataclasses import dataclass
from pathlib import Path

import pytest
from ports import free_port

from gazelle.cli.commands import COMMANDS
from gazelle.ros import Master

pytestmark = [
    pytest.mark.long,
    pytest.mark.skipif(sys.platform != "linux", reason="reads /proc"),
]

PROCESSOR_S = 2.0
"""Limit of processor time for the end of a command; the wall clock depends on other programs."""
WALL_S = 30.0
MARK = "GAZELLE_TEST_ENDING"


@dataclass(frozen=True)
class State:
    """A command line, and how to see that it has come so far.

    Attributes:
        words: After ``gazelle``; FOLDER stands for a folder of its own.
        sign: What it says then, a file ``FOLDER/...`` that it makes, or what it and its children have
            spent by then [s of the processor].
        master: Whether there is a ROS master.
        saved: A file that is there at the end.
        script: Whether it is a script, which ends as Python ends it.
    """

    words: str
    sign: str | float
    master: bool = False
    saved: str = ""
    script: bool = False


ATHWART = 0.1  # anywhere in a command that waits for nothing and is done in a moment
STATES: dict[str, list[State]] = {
    "demo": [State("demo --steps 1e9 --out FOLDER/runs", "robot:")],
    "run": [
        State("run empty", "step"),
        State("run empty --paused", "paused"),
        State("run empty --ros", "ROS node", master=True),
    ],
    "check": [State("check turtlebot3_world turtlebot3_burger", 0.3)],
    "convert": [State("convert turtlebot3_burger FOLDER/a.sdf", 0.3)],
    "map": [State("map turtlebot3_world FOLDER/map --resolution 0.01", 0.4)],
    "view": [
        State("view", "view http", master=True),
        State("view empty", "view http"),
    ],
    "picture": [State("picture turtlebot3_world FOLDER/a.png", 0.5)],
    "plot": [State("plot FOLDER/table.csv FOLDER/a.png", ATHWART)],
    "film": [
        State("film empty FOLDER/a.gif --for 1e6", "filming", saved="a.gif"),
        State("film empty FOLDER/a.mp4 --for 1e6 --size 64x64", "filming", saved="a.mp4"),
    ],
    "train": [
        State(
            "train TurtleBot3Stage1 --num-envs 16 --steps 1e9 --out FOLDER/runs",
            "FOLDER/runs/*/progress.csv",
            saved="runs/*/checkpoints/*/state.npz",
        ),
    ],
    "eval": [
        State("eval POLICY --task TurtleBot3Stage1 --episodes 200000", 2.0),
        State("eval POLICY --task TurtleBot3Stage1 --episodes 200000 --workers 2", 3.0),
    ],
    "new": [State("new task FOLDER/mine", ATHWART)],
    "study": [
        State(
            "study FOLDER/slow.py:run --workers 2 --out FOLDER/a.csv", "FOLDER/begun", saved="a.csv"
        )
    ],
    "export": [State("export FOLDER", ATHWART)],
    "deploy": [
        State("deploy POLICY", "waiting for it"),
        State("deploy POLICY", "guarded", master=True),
    ],
    "master": [State("master --port 0", "ROS_MASTER_URI")],
    "launch": [
        State("launch --wait FOLDER/a.launch", "waiting for a master"),
        State("launch FOLDER/a.launch", "process[", master=True),
    ],
    "exec": [
        State("exec FOLDER/node.py", "begun", script=True),
        State("exec FOLDER/node.py", "spinning", master=True, script=True),
    ],
    "shell": [State("shell -c 'echo begun; exec sleep 100'", "begun")],
    "topic": [
        State("topic echo /nothing", "WARNING", master=True),
        State("topic hz /nothing", "WARNING", master=True),
        State("topic pub /words std_msgs/String hello", "publishing", master=True),
        State("topic list", ATHWART),
    ],
    "service": [State("service list", ATHWART)],
    "node": [State("node ping /rosout", "node is", master=True)],
    "param": [State("param list", ATHWART)],
    "bridge": [State("bridge --port 0", "started", master=True)],
    "bag": [
        State("bag record -a -O FOLDER/a", "Recording", master=True, saved="a.bag"),
        State("bag info FOLDER/nothing.bag", ATHWART),
    ],
    "msg": [State("msg list", ATHWART)],
    "srv": [State("srv list", ATHWART)],
    "tasks": [State("tasks", ATHWART)],
    "robots": [State("robots", ATHWART)],
    "worlds": [State("worlds", ATHWART)],
    "plugins": [State("plugins", ATHWART)],
    "controllers": [State("controllers", ATHWART)],
    "completion": [State("completion bash", ATHWART)],
    "bench": [State("bench", ATHWART)],
}
NODE = """
import rospy
print("begun", flush=True)
rospy.init_node("robot")
print("spinning", flush=True)
rospy.spin()
"""
SLOW = """
import pathlib, time
def run(*, seed):
    pathlib.Path(__file__).with_name("begun").touch()
    time.sleep(100)
    return {}
"""
LAUNCH = """
<launch>
  <node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 a b 100"
    launch-prefix="/bin/sh -c 'exec sleep 100'" />
</launch>
"""


@pytest.fixture(scope="module")
def policy(tmp_path_factory):
    """A policy file that always drives straight on."""
    import numpy as np

    from gazelle.training.actor import Actor
    from gazelle.training.tasks import make_task

    folder = tmp_path_factory.mktemp("policy")
    weight, bias = np.zeros((26, 5), np.float32), np.array([0, 0, 1, 0, 0], np.float32)
    Actor((weight,), (bias,), "tanh", "greedy").save(folder / "robot.npz")
    env = make_task("TurtleBot3Stage1", 1, engine="planar")
    (folder / "robot.json").write_text(json.dumps(env.unwrapped.contract.to_dict()))
    env.close()
    return folder / "robot.npz"


class Running:
    """A command in a state.

    Args:
        state: Which.
        number: The signal that it will be sent.
        folder: Its own.
        words: What stands for other words in the command line.
    """

    def __init__(self, state, number, folder, words):
        self.master = Master(port=0) if state.master else None
        uri = self.master.uri if self.master else f"http://127.0.0.1:{free_port()}/"
        self.state, self.number, self.folder = state, number, folder
        for name, text in {"node.py": NODE, "slow.py": SLOW, "a.launch": LAUNCH}.items():
            (folder / name).write_text(text)
        self.mark = uuid.uuid4().hex
        line = state.words
        for name, value in words.items():
            line = line.replace(name, str(value))
        self.said = folder / "said.txt"
        with self.said.open("w") as out:
            self.process = subprocess.Popen(
                ["/bin/sh", "-c", f'exec "$0" -m gazelle {line}', sys.executable],
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=subprocess.STDOUT,
                cwd=folder,
                env=os.environ | {"ROS_MASTER_URI": uri, MARK: self.mark},
                start_new_session=True,
            )

    def __str__(self):
        return f"{self.state.words}, signal {self.number}: {self.said.read_text()[-2000:]}"

    @property
    def processor(self):
        """Return the processor time of the process itself [s], also after its end."""
        return spent(Path(f"/proc/{self.process.pid}"))[1]

    @property
    def ended(self):
        options = os.WEXITED | os.WNOHANG | os.WNOWAIT
        return os.waitid(os.P_PID, self.process.pid, options) is not None

    def there(self):
        """Return True once it has reached its state."""
        sign = self.state.sign
        if isinstance(sign, float):
            found = [spent(each) for each in Path("/proc").glob("[0-9]*")]
            return self.ended or sum(s for of, s in found if of == self.process.pid) >= sign
        if sign.startswith("FOLDER/"):
            return any(self.folder.glob(sign.removeprefix("FOLDER/")))
        return sign in self.said.read_text()

    def ask(self):
        """Send the signal; SIGTERM twice at once, as ``timeout`` does."""
        self.spent = self.processor
        os.kill(self.process.pid, self.number)
        if self.number == signal.SIGTERM:
            os.killpg(self.process.pid, self.number)

    def check(self):
        """Its end."""
        until(lambda: self.ended, self)
        ending = self.processor - self.spent
        code = self.process.wait()
        said = self.said.read_text()
        good = {0, 128 + self.number}
        if isinstance(self.state.sign, float) or self.state.script:
            good |= {1, -self.number}  # done by then, or Python was still starting or ending
        assert code in good, (code, str(self))
        if self.state.script and said.rstrip().endswith("KeyboardInterrupt"):
            said = said.replace("Traceback", "")
        for word in ("Traceback", "should not happen", "Fatal", "Exception ignored"):
            assert word not in said, str(self)
        assert ending < PROCESSOR_S, (ending, str(self))
        assert not self.state.saved or any(self.folder.glob(self.state.saved)), str(self)
        until(lambda: not self.left(), self)

    def left(self):
        """Processes that it left behind."""
        mark = f"{MARK}={self.mark}".encode()
        return [each for each in Path("/proc").glob("[0-9]*") if mark in environment(each)]

    def kill(self):
        for each in self.left():
            try:
                os.kill(int(each.name), signal.SIGKILL)
            except ProcessLookupError:
                continue
        self.process.wait()
        if self.master:
            self.master.close()


def environment(process):
    try:
        return (process / "environ").read_bytes()
    except OSError:
        return b""


def spent(process):
    """Session and processor's time [s] of a process."""
    try:
        stat = (process / "stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0, 0.0
    return int(stat[3]), (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")


def until(true, running, seconds=WALL_S):
    end = time.monotonic() + seconds
    while not true():
        assert time.monotonic() < end, str(running)
        time.sleep(0.02)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_ends_waiting_and_working(name, tmp_path, policy):
    running = []
    try:
        for place, state in enumerate(STATES[name]):
            for number in (signal.SIGINT, signal.SIGTERM):
                folder = tmp_path / f"{place}-{number}"
                folder.mkdir()
                words = {"FOLDER": folder, "POLICY": policy}
                running.append(Running(state, number, folder, words))
        for each in running:
            until(lambda each=each: each.there() or each.ended, each, 120.0)
            assert not each.ended or isinstance(each.state.sign, float), str(each)
            each.ask()
        for each in running:
            each.check()
    finally:
        for each in running:
            each.kill()
