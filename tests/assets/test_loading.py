"""Everything bundled loads through the readers; a warning fails the test (see pyproject.toml)."""

from __future__ import annotations

import pytest

import gazelle
from gazelle import assets
from gazelle.builders import office
from gazelle.formats import load_model

# The office is built, the hall of the fleet and the depot are of Stage.
BUILT = {"office", "fleet", "depot"}
OF_TASKS = {
    "fetch_table",
    "fetch_cube",
    "fetch_puck",
    *("turtlebot2_maze", "turtlebot2_wall", "kobuki_maze", "kobuki_boxes"),
    *("rosbot_playground", "summit_xl_room", "turtlebot3_camera", "drone_field", "wamv_channel"),
}
LIKE_GAZEBO = {"shapes", "rubble", "mud", "elevator_ros", "gazebo_ros_range", "pick_and_place"}
LIKE_TURTLEBOT3 = set(assets.worlds()) - LIKE_GAZEBO - BUILT - OF_TASKS
WHEELS = "wheel_left_joint wheel_right_joint"
# Joints, number of plugins, sensors.
PARTS = {
    "turtlebot3": (WHEELS, 2, "imu lds_lfcd_sensor"),
    "courier": (WHEELS, 2, "laser"),
    "ackermann_base": ("rear_wheel_joint front_steer_joint", 1, ""),
    "arm6": ("axis_1 axis_6 finger_joint other_finger_joint", 1, ""),
    "fetch": (
        "torso_lift_joint wrist_roll_joint l_gripper_finger_joint",
        2,
        "base_laser head_camera",
    ),
    "rrbot": ("joint1 joint2", 1, "head_hokuyo_sensor"),
}
FOUR_WHEELS = (
    "front_left_wheel_joint front_right_wheel_joint back_left_wheel_joint back_right_wheel_joint"
)
SIX_AXES = "joint_1 joint_2 joint_3 joint_4 joint_5 joint_6"
# Joints that move.
OPENAI_ROS = {
    "cartpole": "foot_joint pole_joint",
    "kobuki": "wheel_left_joint wheel_right_joint",
    "rosbot": FOUR_WHEELS,
    "abb_irb120": SIX_AXES,
    "abb_irb140": SIX_AXES,
    "parrot_ardrone": "",
    "wamv": "",
    "monoped": "haa_joint hfe_joint kfe_joint",
    "ur5": (
        "shoulder_pan_joint shoulder_lift_joint elbow_joint wrist_1_joint wrist_2_joint"
        " wrist_3_joint"
    ),
    "summit_xl": FOUR_WHEELS,
    "moving_cube": "inertia_wheel_roll_joint",
}


@pytest.mark.parametrize("name", sorted(set(assets.worlds()) - BUILT))
def test_worlds_load(name):
    world = gazelle.load(assets.world(name))
    assert world.name == "default"
    assert [light.name for light in world.lights] == ["sun"]
    assert "ground_plane" in {model.name for model in world.models}
    assert world.camera is not None
    # The TurtleBot3 worlds ask for 150, the others have SDF's default.
    assert world.profile.ode.iters == (150 if name in LIKE_TURTLEBOT3 else 50)


def test_the_office_is_what_the_builders_make():
    world = gazelle.load(assets.world("office"))
    built = office(seed=7)
    assert world.name == built.name == "office"
    assert [model.name for model in world.models] == [model.name for model in built.models]


@pytest.mark.parametrize("name", sorted(assets.models()))
def test_models_load(name):
    world = gazelle.load(assets.models()[name])
    assert world.models or name == "sun"


@pytest.mark.parametrize("name", sorted(set(assets.robots()) - set(OPENAI_ROS)))
def test_robots_load(name):
    (model,) = gazelle.load(assets.robot(name)).models
    assert model.name == name
    joints, plugins, sensors = PARTS.get(name, PARTS["turtlebot3"])
    assert set(joints.split()) <= {joint.name for joint in model.joints}
    assert len(model.plugins) >= plugins
    found = {sensor.name for link in model.links for sensor in link.sensors}
    assert set(sensors.split()) <= found


@pytest.mark.parametrize("name", sorted(OPENAI_ROS))
def test_robots_of_openai_ros_load(name):
    (model,) = gazelle.load(assets.robot(name)).models
    assert model.name == name
    joints = [joint.name for joint in model.joints if joint.type != "fixed"]
    assert sorted(joints) == sorted(OPENAI_ROS[name].split())


def test_a_world_and_a_model_of_one_name_are_told_apart():
    names = [model.name for model in gazelle.load("turtlebot3_world").models]
    assert names == ["ground_plane", "ros_symbol"]
    assert load_model("turtlebot3_world").name == "ros_symbol"
    assert gazelle.load("table").models[0].name == "table"
