"""The worlds that gazebo_ros_pkgs tests itself with load, run, and say what is missing."""

from __future__ import annotations

import re
import warnings

import pytest
from world_table import REFUSED, WORLDS

import gazelle
from gazelle import FormatError

pytestmark = pytest.mark.corpus
FOLDER = "ros-simulation__gazebo_ros_pkgs/gazebo_plugins"
_PLUGIN = re.compile(r"\((lib\w+\.so)\) is not supported")
_SENSOR = re.compile(r"sensor '([^']+)' of type '\w+' is not measured yet")


@pytest.mark.parametrize("name", WORLDS)
def test_a_world_of_gazebo_ros_pkgs_runs_for_two_seconds(name, corpus):
    models, topics, missing = WORLDS[name]
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        with gazelle.Simulation(str(corpus / FOLDER / name)) as sim:
            sim.run(seconds=2.0)
            assert sim.time == pytest.approx(2.0, abs=2 * sim.physics.time_step)
            assert sorted(sim.robots) == sorted(models.split())
            outputs = [each for robot in sim.robots.values() for each in robot.outputs.values()]
            assert sorted(each.topic for each in outputs) == sorted(topics.split())
    said = "\n".join(str(each.message) for each in caught)
    # Each is named once.
    assert sorted(_PLUGIN.findall(said) + _SENSOR.findall(said)) == sorted(missing.split())


@pytest.mark.parametrize("name", REFUSED)
def test_a_world_that_cannot_be_read_says_why(name, corpus):
    with pytest.raises(FormatError, match=REFUSED[name]):
        gazelle.Simulation(str(corpus / FOLDER / name))


def test_the_table_has_all_worlds(corpus):
    folder = corpus / FOLDER
    found = {str(file.relative_to(folder)) for file in folder.rglob("*.world")}
    assert found == {*WORLDS, *REFUSED}
