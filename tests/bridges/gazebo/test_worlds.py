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


def test_the_bundled_world_of_range_finders_measures_its_wall_and_ball():
    with gazelle.Simulation("gazebo_ros_range") as sim:
        posts = [sim.robots[name].outputs for name in ("sonar_post", "infrared_post")]
        outputs = [each for outputs in posts for each in outputs.values()]
        assert [each.topic for each in outputs] == ["/sonar", "/sonar2"]
        heard = [[], []]
        for output, values in zip(outputs, heard, strict=True):
            output.subscribe(values.append)
        sim.run(seconds=1.0)
        assert [len(values) for values in heard] == [
            pytest.approx(10, abs=1),
            pytest.approx(20, abs=1),
        ]
        assert heard[0][-1].distance[0] == pytest.approx(2.0, abs=0.03)
        assert heard[1][-1].distance[0] == pytest.approx(0.5, abs=0.01)
