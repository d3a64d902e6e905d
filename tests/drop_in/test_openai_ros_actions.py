"""openai_ros' drone and WAM-V by their names: what they observe and command."""

from __future__ import annotations

from types import SimpleNamespace

import pytest
from drop_in.parameters import on_a_graph

from gazelle.drop_in.openai_ros.task_envs.geometry import point


@pytest.fixture
def drone():
    made = on_a_graph("ParrotDroneGoto-v0")
    made.commands = []
    made.move_base = lambda linear, angular: made.commands.append(
        (linear.x, linear.y, linear.z, angular)
    )
    return made


def test_actions_go_along_the_axes_both_ways(drone):
    for action in range(6):
        drone._set_action(action)
    half = 0.5
    assert drone.commands == [
        (half, 0, 0, 0),
        (-half, 0, 0, 0),
        (0, half, 0, 0),
        (0, -half, 0, 0),
        (0, 0, half, 0),
        (0, 0, -half, 0),
    ]
    assert drone.last_action == "DOWN"


def test_places_are_cut_and_angles_are_rounded(drone):
    drone.gt_pose = SimpleNamespace(
        position=point(1.9, -0.9, 2.2), orientation=SimpleNamespace(x=0.1, y=0.0, z=0.0, w=0.995)
    )
    drone.sonar = SimpleNamespace(range=3.26)
    assert drone._get_obs() == [1, 0, 2, 0.2, 0.0, 0.0, 3.3]


def test_actions_of_the_vessel_turn_and_push():
    vessel, commands = on_a_graph("WamvNavTwoSetsBuoys-v0"), []
    vessel.set_propellers_speed = lambda right, left, time_sleep: commands.append(
        (right, left, time_sleep)
    )
    for action in range(4):
        vessel._set_action(action)
    assert commands == [(1, 1, 1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1)]
