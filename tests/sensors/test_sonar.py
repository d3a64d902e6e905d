"""Sonars against geometry."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Parameters, Pose
from gazelle.engines import make_engine
from gazelle.errors import FormatError
from gazelle.sensors import Sonar, SonarModel

DOWN = Pose()
AHEAD = Pose(pitch=-math.pi / 2)  # -z of the sensor looks along x of the link


def sonar_on(*others, settings=None, pose=DOWN, height=1.0):
    world = scenes.world(scenes.box(size=(0.02, 0.02, 0.02), pose=Pose(z=height)), *others)
    engine = make_engine("mujoco", world)
    return SonarModel(settings or Sonar("cone", 0.1, 4.0, 0.5), engine, "box::link", pose, 0, "s")


def test_it_looks_down_its_own_z_axis_and_reports_the_nearest():
    model = sonar_on(scenes.ground())
    assert model.measure()[0, 0] == pytest.approx(1.0, abs=1e-6)
    reading = model.reading(model.measure()[0], 3)
    assert reading.stamp == 3
    assert reading.field_of_view == pytest.approx(2.0 * math.atan2(0.5, 3.9))


def test_turned_it_looks_ahead_and_sees_a_box_at_its_rim_only_in_the_cone():
    half = math.atan2(0.5, 3.9)
    seen = scenes.box("seen", pose=Pose(x=2.0, y=2.0 * math.tan(half) + 0.05, z=1.0), static=True)
    missed = scenes.box("seen", pose=Pose(x=2.0, y=2.0 * math.tan(half) + 0.15, z=1.0), static=True)
    assert sonar_on(seen, pose=AHEAD).measure()[0, 0] == pytest.approx(1.9, abs=0.02)
    assert sonar_on(missed, pose=AHEAD).measure()[0, 0] == 4.0


def test_nothing_is_the_largest_range_and_too_near_the_smallest():
    assert sonar_on().measure()[0, 0] == 4.0
    near = scenes.box("near", size=(0.1, 0.4, 0.4), pose=Pose(x=0.1, z=1.0), static=True)
    assert sonar_on(near, pose=AHEAD).measure()[0, 0] == pytest.approx(0.1)


@pytest.mark.parametrize("static", [False, True])
def test_it_does_not_see_the_link_that_it_is_on(static):
    carrier = scenes.box(size=(0.4, 0.4, 0.4), pose=Pose(z=1.0), static=static)
    world = scenes.world(scenes.ground(), carrier)
    engine = make_engine("mujoco", world)
    model = SonarModel(Sonar("cone", 0.0, 4.0, 0.5), engine, "box::link", DOWN, 0, "s")
    assert model.measure()[0, 0] == pytest.approx(1.0, abs=1e-6)


def test_a_sphere_looks_everywhere():
    above = scenes.box("above", size=(1.0, 1.0, 0.2), pose=Pose(z=2.6), static=True)
    model = sonar_on(above, settings=Sonar("sphere", 0.1, 4.0, 0.5))
    assert model.measure()[0, 0] == pytest.approx(1.5, abs=0.02)


def test_a_range_that_does_not_grow_is_an_error():
    inner = Parameters("sonar", children=(Parameters("min", "2"), Parameters("max", "1")))
    with pytest.raises(FormatError, match="must grow from 0, found 2 to 1"):
        Sonar.read(Parameters("sensor", children=(inner,)))


def test_all_worlds_are_measured_at_once():
    world = scenes.world(scenes.ground(), scenes.box(size=(0.02,) * 3, pose=Pose(z=1.0)))
    engine = make_engine("mujoco", world, 3)
    heights = np.array([[0.0, 0.0, 0.5], [0.0, 0.0, 1.5], [0.0, 0.0, 9.0]])
    engine.models["box"].set_placement(heights, (0, 0, 0, 1))
    model = SonarModel(Sonar("cone", 0.1, 4.0, 0.5), engine, "box::link", DOWN, 0, "s")
    np.testing.assert_allclose(model.measure()[:, 0], [0.5, 1.5, 4.0], atol=1e-6)
