"""The nodes of turtlebot3_dqn: they learn, tell the graph, and drive to the published goals."""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time

import pytest
from fake_robot import wait_for

from gazelle.clients import Gazebo
from gazelle_ros import Node, WallClock, load_message
from gazelle_ros.builtin import bundled

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="needs POSIX signals")


@pytest.fixture
def results(master):
    """Yield the messages on ``result``."""
    heard = []
    with Node("listener", master_uri=master.uri) as node:
        kind = load_message("std_msgs/Float32MultiArray")
        node.subscribe("result", kind, lambda message: heard.append(tuple(message.data)))
        yield heard


def test_the_package_has_the_nodes_of_the_course():
    found = bundled.package("turtlebot3_dqn")
    assert set(found.nodes) == {
        "action_graph",
        "result_graph",
        *(f"turtlebot3_dqn_stage_{stage}" for stage in range(1, 5)),
    }


@pytest.mark.long
def test_a_training_tells_the_graph_scores_and_values(master, results, tmp_path, monkeypatch):
    from gazelle.training import train

    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    train(
        "TurtleBot3Stage1",
        algo="dqn",
        steps=6000,
        num_envs=32,
        out=tmp_path,
        callbacks=["gazelle.training.graph_results:GraphResults"],
    )
    wait_for(lambda: results, "a result")
    assert all(len(each) == 2 and abs(each[1]) < 1e3 for each in results)
    with Node("watch", master_uri=master.uri) as node:
        wait_for(lambda: "/result" not in dict(node.master.published_topics()), "its end")


@pytest.mark.long
def test_the_node_goes_to_published_goals_one_after_another(master, results, tmp_path, homing):
    """Stage 1 in the simulator, on a graph; the policy goes straight to the goal.

    Time stands until the node has acted on a scan, so that no busy machine makes it lose one.
    """
    said, acts = tmp_path / "said.txt", []
    words = ["exec", "turtlebot3_dqn", "turtlebot3_dqn_stage_1", f"_run:={homing}", "_goals:=3"]
    with (
        said.open("w") as out,
        Node("driver", master_uri=master.uri, clock=WallClock()) as node,
        started(master, "run", "turtlebot3_stage_1", "--ros", "--paused",
                "--spawn", "turtlebot3_burger"),
        Gazebo(node, timeout=60.0) as gazebo,
    ):  # fmt: skip
        node.subscribe("get_action", load_message("std_msgs/Float32MultiArray"), acts.append)
        assert gazebo.time == 0.0  # by now nodes that start go by simulated time
        with started(master, *words, stderr=out) as driving:
            drive(gazebo, driving, acts)
    assert driving.returncode == 0, said.read_text()
    assert said.read_text().count("reached, ") == 3, said.read_text()
    assert "(0.6, 0)  reached" in said.read_text()  # the course's first goal
    wait_for(lambda: len(results) >= 3, "three results")


STEPS = 200
"""From one scan to the next, 0.2 s."""


def drive(gazebo, driving, acts):
    """Advance by a scan whenever the node has acted on the last, until it has ended."""
    while driving.poll() is None:
        before = len(acts)
        gazebo.step(STEPS)
        end = time.monotonic() + 1.0  # it does not act before it is armed, nor at a goal
        while len(acts) == before and driving.poll() is None and time.monotonic() < end:
            time.sleep(0.002)


@contextlib.contextmanager
def started(master, *words, **streams):
    process = subprocess.Popen(
        [sys.executable, "-m", "gazelle", *words],
        env=environment(master),
        stdout=subprocess.DEVNULL,
        **streams,
    )
    try:
        yield process
    finally:
        process.terminate()
        process.wait(60)


def environment(master):
    return os.environ | {"ROS_MASTER_URI": master.uri}
