"""rospy in this process, on a master of its own, anew for each test."""

import sys

import pytest

import gazelle_ros as ros


@pytest.fixture
def rospy(master, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    monkeypatch.setattr(sys, "argv", ["test"])
    with ros.install():
        import rospy

        from gazelle_ros.compat.rospy import client

        client.reset()
        yield rospy
        client.reset()


@pytest.fixture
def node(rospy):
    """Return rospy, with its node initialised."""
    rospy.init_node("probe", disable_signals=True)
    return rospy
