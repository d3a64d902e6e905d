"""Lookup of bundled files by name, and by the folders of ROS and Gazebo."""

from __future__ import annotations

import pytest
from lxml import etree

from gazelle import assets
from gazelle.errors import ResolveError


def test_everything_named_is_a_file():
    for found in (assets.worlds(), assets.robots(), assets.models()):
        assert found
        assert all(path.is_file() for path in found.values())


def test_worlds_by_name():
    stages = {f"turtlebot3_stage_{number}" for number in (1, 2, 3, 4)}
    gazebos = {"empty", "shapes", "rubble", "mud", "elevator_ros", "gazebo_ros_range"}
    tables = {"pick_and_place"}
    indoors = {"furnished_room", "office", "turtlebot3_world", "turtlebot3_house", "fleet", "depot"}
    tasks = {"turtlebot2_maze", "turtlebot2_wall", "kobuki_maze", "kobuki_boxes"}
    tasks |= {"rosbot_playground", "summit_xl_room", "turtlebot3_camera", "drone_field"}
    tasks |= {"wamv_channel"}
    tasks |= {"fetch_table", "fetch_cube", "fetch_puck"}
    assert stages | gazebos | tables | indoors | tasks == set(assets.worlds())
    assert assets.world("empty") == assets.root() / "worlds" / "empty.world"


@pytest.mark.parametrize(
    ("pick", "wrong", "right"),
    [
        (assets.robot, "turtlebot3_burgr", "turtlebot3_burger"),
        (assets.world, "turtlebot3_stage1", "turtlebot3_stage_1"),
    ],
)
def test_a_wrong_name_is_answered_with_the_right_one(pick, wrong, right):
    with pytest.raises(ResolveError, match=f"'{wrong}'.*did you mean '{right}'"):
        pick(wrong)


def test_models_are_described():
    for name, path in assets.models().items():
        config = etree.parse(str(path.with_name("model.config"))).getroot()
        assert config.findtext("name") == name
        assert config.findtext("sdf") == "model.sdf"
        assert len(config.findtext("description")) > 10


PACKAGES = [
    f"{robot}_{kind}" for robot in ("courier", "turtlebot3") for kind in ("description", "gazebo")
]
PACKAGES += ["rrbot_description", "rrbot_gazebo", "rrbot_control"]
PACKAGES += ["courier_control", "ackermann_base_description", "ackermann_base_control"]
PACKAGES += ["arm6_description", "arm6_control"]
PACKAGES += ["fetch_description", "fetch_gazebo", "fetch_moveit_config", "fetch_train"]


@pytest.mark.parametrize("package", PACKAGES)
def test_packages_carry_their_names(package):
    manifest = etree.parse(str(assets.root() / package / "package.xml")).getroot()
    assert manifest.findtext("name") == package
    assert manifest.findtext("license") == "Apache-2.0"


LAUNCHES = {
    "turtlebot3_stage_1": (0.0, 0.0),
    "turtlebot3_stage_2": (0.0, 0.0),
    "turtlebot3_stage_3": (0.0, 0.0),
    "turtlebot3_stage_4": (-0.7, 0.0),
    "turtlebot3_world": (-2.0, -0.5),
    "turtlebot3_empty_world": (0.0, 0.0),
}


@pytest.mark.parametrize("name", LAUNCHES)
def test_launch_files_start_the_robot_where_published(name):
    file = assets.root() / "turtlebot3_gazebo" / "launch" / f"{name}.launch"
    launch = etree.parse(str(file)).getroot()
    arguments = {arg.get("name"): arg.get("default") for arg in launch.findall("arg")}
    found = tuple(float(arguments[f"{axis}_pos"]) for axis in "xyz")
    assert found == (*LAUNCHES[name], 0.0)
    world = launch.find("include/arg[@name='world_name']").get("value")
    assert (file.parent / world.removeprefix("$(dirname)/")).resolve().is_file()
    spawned = launch.find("node").get("args").split()[2]
    assert spawned == ("turtlebot3_burger" if "stage" in name else "turtlebot3_$(arg")
