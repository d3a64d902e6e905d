"""Controllers of the parameter ``controller_list``."""

from __future__ import annotations

import pytest

from gazelle.bridges.moveit.controller_list import controllers_of
from gazelle_ros import Master, Node


@pytest.mark.parametrize(
    ("entry", "action"),
    [
        ({"name": "", "action_ns": "joint_trajectory_action"}, "/joint_trajectory_action"),
        ({"name": "arm", "action_ns": "follow"}, "arm/follow"),
        ({"name": "arm"}, "arm"),
    ],
)
def test_a_controller_has_an_action_by_its_name(entry, action):
    whole = {**entry, "type": "FollowJointTrajectory", "joints": ["a"]}
    assert [each.action for each in _controllers(whole).values()] == [action]


def test_a_controller_without_any_name_is_left_out(caplog):
    assert _controllers({"type": "FollowJointTrajectory", "joints": ["a"]}) == {}
    assert "action_ns and joints are needed" in caplog.text


def _controllers(entry):
    with Master(port=0, rosout=False) as master, Node("group", master_uri=master.uri) as node:
        node.set_param("~controller_list", [entry])
        return controllers_of(node)
