"""Every goal of every stage can be reached by the published robot, whose only speed is 0.15 m/s."""

import numpy as np
import pytest
from reach import reached

from gazelle.envs.turtlebot3.rules import STAGES, stage_goals


def search(stage, **options):
    rules = STAGES[stage]
    return reached(rules.world, rules.start, stage_goals(stage).points, **options)


@pytest.mark.long
@pytest.mark.parametrize("stage", STAGES)
def test_every_goal_can_be_reached_within_an_episode(stage):
    found = search(stage)
    lost = stage_goals(stage).points[~found]
    assert not len(lost), f"{len(lost)} goals cannot be reached, such as {lost[:3]}"


@pytest.mark.parametrize("begin", [17, 31, 44])
def test_every_goal_of_stage_3_can_be_reached_whichever_way_the_ring_stands(begin):
    assert search(3, begin=begin).all()


@pytest.mark.long
def test_the_search_finds_what_cannot_be_reached():
    """A ring of 0.5 rad/s is faster than the robot: none gets out between its pillars."""
    found = search(3, spin=0.5, limit=150)
    points = stage_goals(3).points
    assert np.linalg.norm(points[~found], axis=1).min() > 0.6
    assert (~found).sum() > 100
