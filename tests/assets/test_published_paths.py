"""Bundled packages are laid out like the originals as far as their content is bundled."""

from __future__ import annotations

import subprocess
import sys
from xml.etree import ElementTree as ET

import pytest

import gazelle
from gazelle import assets, formats
from gazelle.bridges.gazebo.server import find_world
from gazelle.errors import FormatError, ResolveError
from gazelle.formats.resolve import Resolver
from gazelle_ros.base import bundled_packages
from gazelle_ros.builtin import xacro
from gazelle_ros.launch import LaunchError, load_launch
from gazelle_ros.launch.packages import Packages

REAL = [
    *(f"turtlebot3_gazebo/worlds/turtlebot3_stage_{number}.world" for number in (1, 2, 3, 4)),
    "turtlebot3_gazebo/worlds/turtlebot3_world.world",
    "turtlebot3_gazebo/models/turtlebot3_square/model.sdf",
    "turtlebot3_gazebo/models/turtlebot3_square/goal_box/model.sdf",
    "turtlebot3_gazebo/models/turtlebot3_plaza/model.sdf",
    "turtlebot3_gazebo/models/turtlebot3_world/model.config",
    "turtlebot3_bringup/launch/includes/description.launch.xml",
    "turtlebot3_bringup/launch/turtlebot3_remote.launch",
    "turtlebot3_navigation/param/costmap_common_params_burger.yaml",
    "turtlebot3_slam/config/gmapping_params.yaml",
    "turtlebot_gazebo/launch/includes/kobuki.launch.xml",
    "kobuki_description/urdf/kobuki_standalone.urdf.xacro",
    "fetch_gazebo/launch/include/fetch.launch.xml",
    "fetch_description/robots/fetch.urdf",
]
ELSEWHERE = [
    "turtlebot3_gazebo/worlds/empty.world",
    "turtlebot3_gazebo/models/turtlebot3_plaza/goal_box/model.sdf",
    "turtlebot3_navigation/param/dwa_local_planner_params_waffle_pi.yaml",
    "turtlebot_gazebo/worlds/maze_loop_brick.world",
    "fetch_gazebo/worlds/simple_grasp.sdf",
    "fetch_gazebo/models/demo_cube/model.sdf",
    "rosbot_gazebo/worlds/turtlebot_playground.world",
    "rosbot_description/urdf/rosbot.xacro",
    "rrbot_description/urdf/rrbot.xacro",
    "ur_description/urdf/ur5_robot.urdf.xacro",
]
MISSING = {
    "turtlebot3_gazebo/models/turtlebot3_burger/model.sdf": "turtlebot3_burger.urdf.xacro",
    "turtlebot3_gazebo/worlds/turtlebot3_stage_5.world": "did you mean 'turtlebot3_stage_",
    "turtlebot3_gazebo/worlds/zoo.world": "worlds has turtlebot3_house.world, turtlebot3_stage_1.world",
    "turtlebot_gazebo/worlds/playground.world": "turtlebot2_maze",
    "fetch_gazebo/worlds/test_zone.sdf": "pick_and_place",
    "stage_ros/world/willow-erratic.world": "depot",
    "kobuki_maze_rl/worlds/Kobuki_maze/model.sdf": "kobuki_maze.world",
}


@pytest.mark.parametrize("path", REAL)
def test_scripts_find_files_where_they_are_published(path):
    assert (assets.root() / path).is_file()


@pytest.mark.parametrize("path", [*REAL, *ELSEWHERE])
def test_launch_files_and_descriptions_find_files_where_they_are_published(path):
    package, _, inner = path.partition("/")
    located = Packages({}).locate(package, f"/{inner}")
    assert bundled_packages.published(located).is_file()
    found = Resolver(environ={}).find(f"package://{path}")
    assert found is not None
    assert found.is_file()
    assert found.samefile(located)


@pytest.mark.parametrize("path", [each for each in ELSEWHERE if "/worlds/" in each])
def test_the_server_opens_worlds_by_paths_put_together(path):
    assert gazelle.load(find_world(str(assets.root() / path))).models is not None


@pytest.mark.parametrize(("path", "hint"), MISSING.items())
def test_what_is_not_bundled_is_told_with_what_is(path, hint):
    with pytest.raises(ResolveError) as caught:
        find_world(str(assets.root() / path))
    assert hint in str(caught.value)
    assert "holds less than its namesake" in str(caught.value)


@pytest.mark.parametrize("uri", ["goal_box", "turtlebot3_square/goal_box", "turtlebot3_plaza"])
def test_models_are_found_by_name(uri):
    assert gazelle.load(f"model://{uri}").models


def including(path):
    return (
        '<robot name="r" xmlns:xacro="http://www.ros.org/wiki/xacro">'
        f'<xacro:include filename="$(find {path.replace("/", ")/", 1)}"/></robot>'
    )


def test_xacro_includes_by_published_paths(tmp_path, monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    file = tmp_path / "r.urdf.xacro"
    file.write_text(including("rrbot_description/urdf/rrbot.xacro"))
    assert formats.load_model(file).links
    assert "<link" in xacro.expand(file, {})


def test_xacro_says_what_is_bundled(tmp_path, monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    file = tmp_path / "r.urdf.xacro"
    file.write_text(including("turtlebot3_description/urdf/turtlebot3_burgr.urdf.xacro"))
    said = "did you mean 'turtlebot3_burger.urdf.xacro'"
    with pytest.raises(FormatError, match=said):
        formats.load_model(file)
    with pytest.raises(gazelle.Error, match=said):
        xacro.expand(file, {})


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ('<include file="$(find turtlebot_gazebo)/launch/includes/create.launch.xml"/>', "kobuki"),
        ('<include file="$(find fetch_gazebo)/launch/playground.launch"/>', "simple_grasp"),
        ('<rosparam file="$(find turtlebot3_slam)/config/gmapping.yaml"/>', "gmapping_params"),
        ('<param name="a" textfile="$(find fetch_description)/robots/fetch.urd"/>', "fetch.urdf"),
    ],
)
def test_launch_files_say_what_is_bundled(tmp_path, monkeypatch, line, hint):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    file = tmp_path / "a.launch"
    file.write_text(f"<launch>{line}</launch>")
    with pytest.raises(LaunchError) as caught:
        load_launch(file)
    assert hint in str(caught.value)


@pytest.mark.parametrize("manifest", sorted(assets.root().glob("*/package.xml")))
def test_manifests_name_what_is_there_and_what_is_not(manifest):
    export = ET.parse(manifest).getroot().find("export/gazelle")
    for each in [] if export is None else export:
        path = manifest.parent / each.get("path", "")
        if each.tag == "file":
            assert not path.exists(), "the file is there itself"
            assert (manifest.parent / each.get("at")).exists()
        elif each.tag == "missing":
            assert not path.exists()


LAUNCHES = sorted(
    str(file.relative_to(assets.root())) for file in assets.root().glob("*/*/*.launch")
)


@pytest.mark.parametrize("path", LAUNCHES)
def test_launch_files_can_be_read_with_their_defaults(path, monkeypatch):
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)
    package = path.partition("/")[0]
    arguments = {"robot": "robot_0", "x": "0", "y": "0"} if package == "fleet_stage" else {}
    plan = load_launch(assets.root() / path, arguments)
    assert plan.nodes or plan.parameters


@pytest.mark.long
@pytest.mark.parametrize(
    "words", ["turtlebot3_gazebo turtlebot3_autorace.launch", "turtlebot_gazebo playground.launch"]
)
def test_a_launch_file_that_is_not_bundled_is_one_error(words):
    command = [sys.executable, "-m", "gazelle", "launch", *words.split()]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1
    assert "has no launch file" in done.stderr
