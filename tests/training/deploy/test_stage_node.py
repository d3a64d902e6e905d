"""The nodes of turtlebot3_dqn: they learn, tell the graph, and drive to the published goals."""

from __future__ import annotations

import os
import subprocess
import sys

import pytest
from fake_robot import wait_for

from gazelle.ros import Node, load_message
from gazelle.ros.builtin import bundled

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
    """Stage 1 in the simulator, on a graph; the policy goes straight to the goal."""
    run = subprocess.Popen(
        [sys.executable, "-m", "gazelle", "run", "turtlebot3_stage_1", "--ros", "--rate", "4",
         "--spawn", "turtlebot3_burger"],
        env=environment(master), stdout=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        done = subprocess.run(
            [sys.executable, "-m", "gazelle", "exec", "turtlebot3_dqn", "turtlebot3_dqn_stage_1",
             f"_run:={homing}", "_goals:=3"],
            env=environment(master), capture_output=True, text=True, timeout=120, check=False,
        )  # fmt: skip
    finally:
        run.terminate()
        run.wait(60)
    assert done.returncode == 0, done.stderr
    assert done.stderr.count("reached, ") == 3, done.stderr
    assert "(0.6, 0)  reached" in done.stderr  # the course's first goal
    wait_for(lambda: len(results) >= 3, "three results")


def environment(master):
    return os.environ | {"ROS_MASTER_URI": master.uri}
