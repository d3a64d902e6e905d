"""Everything bundled loads through the readers; a warning fails the test (see pyproject.toml)."""

from __future__ import annotations

import pytest

import gazelle
from gazelle import assets
from gazelle.formats import load_model

LIKE_TURTLEBOT3 = set(assets.worlds()) - {"shapes", "rubble", "mud"}


@pytest.mark.parametrize("name", sorted(assets.worlds()))
def test_worlds_load(name):
    world = gazelle.load(assets.world(name))
    assert world.name == "default"
    assert [light.name for light in world.lights] == ["sun"]
    assert "ground_plane" in {model.name for model in world.models}
    assert world.camera is not None
    # The TurtleBot3 worlds ask for 150, the others have SDF's default.
    assert world.profile.ode.iters == (150 if name in LIKE_TURTLEBOT3 else 50)


@pytest.mark.parametrize("name", sorted(assets.models()))
def test_models_load(name):
    world = gazelle.load(assets.models()[name])
    assert world.models or name == "sun"


@pytest.mark.parametrize("name", sorted(assets.robots()))
def test_robots_load(name):
    (model,) = gazelle.load(assets.robot(name)).models
    assert model.name == name
    joints = {joint.name for joint in model.joints}
    assert {"wheel_left_joint", "wheel_right_joint"} <= joints
    assert len(model.plugins) >= 2
    sensors = {sensor.name for link in model.links for sensor in link.sensors}
    assert {"imu", "lds_lfcd_sensor"} <= sensors


def test_a_world_and_a_model_of_one_name_are_told_apart():
    names = [model.name for model in gazelle.load("turtlebot3_world").models]
    assert names == ["ground_plane", "ros_symbol"]
    assert load_model("turtlebot3_world").name == "ros_symbol"
    assert gazelle.load("table").models[0].name == "table"
