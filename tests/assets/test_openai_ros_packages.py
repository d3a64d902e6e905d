"""The packages that openai_ros and frobs_rl launch: by their names, and with nothing missing in them."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path

import pytest

import gazelle
from gazelle import assets
from gazelle_ros.launch import load_launch
from gazelle_ros.launch.plan import ParameterCommand


@dataclass(frozen=True)
class Launched:
    """What openai_ros launches for one of its robots."""

    package: str
    worlds: tuple[str, ...] = ("start_world.launch",)
    model: str = ""  # the robot's name in the world
    controllers: str = ""  # that the environment switches off and on
    space: str = ""


PACKAGES = [
    Launched(
        "cartpole_description",
        model="cartpole_v0",
        controllers="joint_state_controller foot_joint_velocity_controller pole_joint_velocity_controller",
        space="/cartpole_v0",
    ),
    Launched(
        "moving_cube_description",
        model="moving_cube",
        controllers="joint_state_controller inertia_wheel_roll_joint_velocity_controller",
        space="/moving_cube",
    ),
    Launched(
        "turtlebot_gazebo",
        worlds=("start_world_maze_loop_brick.launch", "start_world_wall.launch"),
        model="mobile_base",
    ),
    Launched("turtlebot3_gazebo", model="turtlebot3"),
    Launched("drone_construct", model="sjtu_drone"),
    Launched("robotx_gazebo", model="wamv"),
    Launched("kobuki_maze_rl", model="kobuki_robot"),
    Launched("rosbot_gazebo", worlds=("start_world_maze.launch",), model="rosbot"),
    Launched("summit_xl_gazebo", model="summit_xl"),
    Launched(
        "legged_robots_sims",
        model="monoped",
        controllers="joint_state_controller haa_joint_position_controller"
        " hfe_joint_position_controller kfe_joint_position_controller",
        space="/monoped",
    ),
]


@pytest.fixture(params=PACKAGES, ids=lambda each: each.package)
def case(request):
    return request.param


def plan_of(case, file):
    plan = load_launch(assets.root() / case.package / "launch" / file)
    assert plan.notices == []
    return plan


def words(plan, kind):
    (found,) = [node for node in plan.nodes if node.type == kind]
    return shlex.split(found.arguments)


def test_worlds_are_there_and_load(case):
    for file in case.worlds:
        name = words(plan_of(case, file), "gzserver")[-1]
        path = Path(name)
        world = gazelle.load(path if path.is_absolute() else assets.world(path.stem))
        assert world.models


def test_the_robot_is_spawned_by_its_name(case):
    plan = plan_of(case, "put_robot_in_world.launch")
    spawned = words(plan, "spawn_model")
    assert spawned[spawned.index("-model") + 1] == case.model
    (described,) = [
        each for each in plan.parameters.values() if isinstance(each.value, ParameterCommand)
    ]
    command = shlex.split(described.value.text)
    arguments = dict(word.split(":=") for word in command[2:])
    (model,) = gazelle.formats.load(command[1], xacro_args=arguments).models
    under_control = any("ros_control" in plugin.filename for plugin in model.plugins)
    assert under_control == bool(case.controllers)


def test_controllers_that_the_environment_switches_are_spawned_and_described(case):
    plan = plan_of(case, "put_robot_in_world.launch")
    if not case.controllers:
        assert all(node.type != "spawner" for node in plan.nodes)
        return
    assert words(plan, "spawner") == case.controllers.split()
    for name in case.controllers.split():
        assert f"{case.space}/{name}/type" in plan.parameters
