"""Commands in their waiting and working states, for tests and tools that end them."""

from __future__ import annotations

import json
import os
from dataclasses import dataclass
from pathlib import Path

MARK = "GAZELLE_TEST_ENDING"
"""An environment variable that every process of one run inherits."""
FAULTS = ("Traceback", "should not happen", "Fatal", "Exception ignored")
"""Signs of a bad end in the output."""


@dataclass(frozen=True)
class State:
    """A command line, and how to see that it has come so far.

    Attributes:
        words: After ``gazelle``; FOLDER stands for a folder of its own.
        sign: What it says then, a file ``FOLDER/...`` that it makes, or what it and its children have
            spent by then [s of the processor].
        master: Whether there is a ROS master.
        saved: A file that is there at the end.
        script: Whether it is a program of the user's, which ends as it likes.
        resumed: A command line that goes on with what it left; RUN stands for a run's folder.
        resumed_sign: What that says then.
    """

    words: str
    sign: str | float
    master: bool = False
    saved: str = ""
    script: bool = False
    resumed: str = ""
    resumed_sign: str | float = 2.0


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
        State("film empty FOLDER/a.gif --for 1e5", "filming", saved="a.gif"),
        State("film empty FOLDER/a.mp4 --for 1e5 --size 64x64", "filming", saved="a.mp4"),
    ],
    "train": [
        State(
            "train TurtleBot3Stage1 --num-envs 16 --steps 1e9 --out FOLDER/runs",
            "FOLDER/runs/*/progress.csv",
            saved="runs/*/checkpoints/*/state.npz",
            resumed="train --resume RUN --steps 1e9",
            resumed_sign=1.0,
        ),
    ],
    "eval": [
        State("eval POLICY --task TurtleBot3Stage1 --episodes 200000", 2.0),
        State("eval POLICY --task TurtleBot3Stage1 --episodes 200000 --workers 2", 3.0),
    ],
    "new": [State("new task FOLDER/mine", ATHWART)],
    "study": [
        State(
            "study FOLDER/slow.py:run --seeds 3 --workers 2 --out FOLDER/a.csv",
            "FOLDER/begun",
            saved="a.csv",
            resumed="study FOLDER/slow.py:run --seeds 3 --workers 2 --out FOLDER/a.csv",
            resumed_sign=0.3,
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
    "shell": [State("shell -c 'echo begun; exec sleep 100'", "begun", script=True)],
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
    "runs": [State("runs FOLDER", ATHWART)],
    "doctor": [State("doctor", ATHWART)],
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
    folder = pathlib.Path(__file__).parent
    if seed:
        while not (folder / "a.csv").exists() or not (folder / "a.csv").stat().st_size:
            time.sleep(0.01)
        (folder / "begun").touch()
        time.sleep(100)
    return {}
"""
LAUNCH = """
<launch>
  <node pkg="tf" type="static_transform_publisher" name="a" args="0 0 0 0 0 0 a b 100"
    launch-prefix="/bin/sh -c 'exec sleep 100'" />
</launch>
"""
FILES = {"node.py": NODE, "slow.py": SLOW, "a.launch": LAUNCH}


def write_policy(folder):
    """Write a policy file that always drives straight on, and return its path."""
    import numpy as np

    from gazelle.training.actor import Actor
    from gazelle.training.tasks import make_task

    weight, bias = np.zeros((26, 5), np.float32), np.array([0, 0, 1, 0, 0], np.float32)
    Actor((weight,), (bias,), "tanh", "greedy").save(folder / "robot.npz")
    env = make_task("TurtleBot3Stage1", 1, engine="planar")
    (folder / "robot.json").write_text(json.dumps(env.unwrapped.contract.to_dict()))
    env.close()
    return folder / "robot.npz"


def complaints(state, said):
    """Return signs of a bad end in what a command printed."""
    if state.script and said.rstrip().endswith("KeyboardInterrupt"):
        said = said.replace("Traceback", "")
    return [word for word in FAULTS if word in said]


def left_behind(mark):
    """Return processes of a run, as folders of /proc."""
    text = f"{MARK}={mark}".encode()
    return [each for each in Path("/proc").glob("[0-9]*") if text in environment(each)]


def environment(process):
    try:
        return (process / "environ").read_bytes()
    except OSError:
        return b""


def spent_by_session(leader):
    """Return processor time of all processes of a session [s]."""
    found = [spent(each) for each in Path("/proc").glob("[0-9]*")]
    return sum(seconds for session, seconds in found if session == leader)


def spent(process):
    """Return session and processor time [s] of a process."""
    try:
        stat = (process / "stat").read_text().rpartition(")")[2].split()
    except OSError:
        return 0, 0.0
    return int(stat[3]), (int(stat[11]) + int(stat[12])) / os.sysconf("SC_CLK_TCK")
