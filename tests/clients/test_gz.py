"""The program gz, as scripts call it, steers a simulator on the graph."""

from __future__ import annotations

import threading

import pytest

import gazelle
from gazelle.bridges import serve_ros
from gazelle.clients.gz import main
from gazelle.ros import Master


@pytest.fixture
def sim(monkeypatch):
    with Master(port=0, rosout=False) as master, gazelle.Simulation("turtlebot3_stage_1") as made:
        made.spawn("turtlebot3_burger", name="r1", namespace="/")
        monkeypatch.setenv("ROS_MASTER_URI", master.uri)
        with serve_ros(made, master.uri) as door:
            running = threading.Thread(target=door.run)
            running.start()
            yield made
            door.stop()
            running.join()


def test_steps_pause_the_world_and_are_made_when_it_returns(sim):
    assert main(["world", "-p", "1"]) == 0
    before = sim.time
    assert main(["world", "-m", "100"]) == 0
    assert sim.time == pytest.approx(before + 0.1)
    assert main(["world", "-p", "0"]) == 0
    assert main(["world", "-s"]) == 0
    assert sim.paused


def test_resets_put_back_the_models(sim):
    sim.robots["r1"].set_pose((1.0, 0.0, 0.0))
    assert main(["world", "-p", "1", "-o"]) == 0
    assert sim.robots["r1"].pose.position[0] == pytest.approx(0.0, abs=1e-6)
    assert main(["world", "-r"]) == 0
    assert sim.time == 0.0


def test_physics_and_models(sim, capsys):
    assert main(["physics", "-u", "500", "-s", "0.002", "-g", "0,0,-3.7"]) == 0
    assert sim.physics.time_step == 0.002
    assert sim.physics.gravity[2] == -3.7
    assert main(["model", "-m", "r1", "-p"]) == 0
    assert len(capsys.readouterr().out.split()) == 6
    assert main(["model", "-m", "r1", "-d"]) == 0
    assert "r1" not in sim.robots
