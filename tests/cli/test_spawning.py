"""``--spawn`` puts robots where there is room, or where they are wanted."""

from __future__ import annotations

import argparse

import numpy as np
import pytest

import gazelle
from gazelle.cli.spawning import SpawnRequest, parse_spawn, spawn

BURGER = "turtlebot3_burger"


def test_a_place_is_read_from_behind_the_robots_name():
    assert parse_spawn("my_robot.urdf") == SpawnRequest("my_robot.urdf")
    found = parse_spawn("a/b@c.urdf@-2,0.5,1.5")
    assert found.robot == "a/b@c.urdf"
    assert found.pose.position == (-2.0, 0.5, 0.0)
    assert found.pose.rpy == pytest.approx((0.0, 0.0, 1.5))


@pytest.mark.parametrize("text", ["r@", "r@1", "r@1,x", "r@1,2,3,4", "@1,2", "r@nan,0"])
def test_what_is_no_place_is_refused(text):
    with pytest.raises(argparse.ArgumentTypeError, match="ROBOT@X,Y"):
        parse_spawn(text)


def test_a_robot_is_put_beside_the_pillar_at_the_origin_and_resets_to_there():
    with gazelle.Simulation("turtlebot3_world") as sim:
        assert "starts at 0.5,0" in spawn(sim, SpawnRequest(BURGER))
        sim.run(0.5)
        assert sim.robots[BURGER].pose.position == pytest.approx((0.5, 0.0, 0.0), abs=1e-3)
        sim.robots[BURGER].set_pose((2.0, 0.5, 0.0))
        sim.reset()
        assert sim.robots[BURGER].pose.position == pytest.approx((0.5, 0.0, 0.0), abs=1e-3)


def test_robots_stay_where_there_is_room_and_where_they_are_wanted():
    with gazelle.Simulation("turtlebot3_stage_1") as sim:
        assert spawn(sim, SpawnRequest(BURGER)) == ""
        assert sim.robots[BURGER].pose.position == (0.0, 0.0, 0.0)
        assert spawn(sim, parse_spawn(f"{BURGER}@-1,1")) == ""
        assert sim.robots[f"{BURGER}_2"].pose.position == (-1.0, 1.0, 0.0)


def test_the_second_of_a_name_has_another_one_and_topics_of_its_own():
    with gazelle.Simulation("empty") as sim:
        for _ in range(2):
            spawn(sim, SpawnRequest(BURGER))
        first, second = sim.robots[BURGER], sim.robots[f"{BURGER}_2"]
        assert (first.namespace, second.namespace) == ("/", f"/{BURGER}_2")
        apart = np.subtract(first.pose.position, second.pose.position)
        assert np.hypot(*apart[:2]) > 0.3
