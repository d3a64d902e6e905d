"""Robots' own launch files, unchanged, bring up all their nodes, and the robots drive to a goal.

``GAZELLE_ROBOTS`` names a folder with checkouts of husky, jackal, jackal_simulator, turtlebot_apps,
rosbot_description, navigation_tutorials, ridgeback, ridgeback_simulator, dingo and dingo_simulator. The rows
of the table in docs/reference/ros.md::

    GAZELLE_CORPUS=... GAZELLE_ROBOTS=... pytest -m slow -s tests/bridges/launch/test_drives.py
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from launch_drives import DESCRIPTIONS, DRIVES, ride
from launching import stub_packages

pytestmark = [pytest.mark.corpus, pytest.mark.slow, pytest.mark.timeout(900)]


# Of these packages the corpus has a part only, which would hide those that come with Gazelle.
PARTS = {"ros__xacro", "ros-controls__ros_controllers"}


@pytest.mark.parametrize("drive", DRIVES, ids=lambda each: each.name)
def test_a_robot_drives_to_a_goal(drive, corpus, tmp_path):
    robots = Path(os.environ.get("GAZELLE_ROBOTS", corpus))
    whole = [each for each in corpus.iterdir() if each.is_dir() and each.name not in PARTS]
    paths = [robots, *sorted(whole), stub_packages(tmp_path, DESCRIPTIONS)]
    outcome = ride(drive, corpus, os.pathsep.join(map(str, paths)), tmp_path)
    print(f"\n| {drive.name} | {outcome} |")
    assert outcome.reached, outcome
    assert outcome.off < 0.4
    assert outcome.left_out == ()
    assert outcome.ended == ()
