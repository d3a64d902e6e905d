"""Table of what the corpus' launch files bring up."""

from launching import Expected

_BURGER = "/cmd_vel /imu /joint_states /odom /scan /tf"
_MESHES = "package://turtlebot3_description/meshes/bases/burger_base.stl"


def _under(names, topics):
    """Return the same topics of several robots."""
    return " ".join(f"/{name}{topic}" for name in names for topic in topics.split())


def _tuned(topic, *names):
    """Return the topics of dynamic_reconfigure servers below a topic."""
    return " ".join(
        f"{topic}/{name}/parameter_{what}" for name in names for what in ("descriptions", "updates")
    )


def _links(prefix, text):
    """Return ``parent>child`` with a prefix before both."""
    return " ".join(
        ">".join(f"{prefix}{frame}" for frame in pair.split(">")) for pair in text.split()
    )


_BURGER_LINKS = (
    "base_footprint>base_link base_link>base_scan base_link>caster_back_link "
    "base_link>imu_link base_link>wheel_left_link base_link>wheel_right_link"
)
_TRICYCLE_LINKS = (
    "base_link>chassis base_link>front_steering base_link>left_wheel base_link>right_wheel "
    "front_steering>front_wheel"
)
_PIONEER_LINKS = (
    "base_link>chassis chassis>battery0 chassis>front_camera chassis>front_laser "
    "chassis>left_hub chassis>right_hub chassis>sonar chassis>swivel chassis>top "
    "left_hub>left_wheel right_hub>right_wheel swivel>center_wheel center_wheel>center_hubcap"
)
_TWO = ("r1", "r2")
_THREE = ("tb3_0", "tb3_1", "tb3_2")

QUICK = [
    Expected(
        "turtlebot3_gazebo turtlebot3_world.launch",
        models="ground_plane ros_symbol turtlebot3_burger",
        topics=_BURGER,
        frames="odom>base_footprint",
        missing=(_MESHES,),
    ),
    Expected(
        "rrbot_gazebo rrbot_world.launch",
        models="ground_plane rrbot",
        topics="/rrbot/camera1/camera_info /rrbot/camera1/image_raw "
        "/rrbot/camera1/image_raw/compressed /rrbot/laser/scan",
    ),
    Expected(
        "kobuki_gazebo kobuki_empty_world.launch",
        models="ground_plane mobile_base",
        topics="/joint_states /mobile_base/commands/motor_power "
        "/mobile_base/commands/reset_odometry /mobile_base/commands/velocity "
        "/mobile_base/events/bumper /mobile_base/events/cliff /mobile_base/sensors/imu_data "
        "/mobile_base/sensors/core /mobile_base_nodelet_manager/bond "
        "/odom /tf /tf_static",
        frames="odom>base_footprint base_footprint>base_link base_link>caster_back_link "
        "base_link>caster_front_link base_link>cliff_sensor_front_link "
        "base_link>cliff_sensor_left_link base_link>cliff_sensor_right_link base_link>gyro_link "
        "base_link>wheel_left_link base_link>wheel_right_link",
    ),
]

SLOW = [
    Expected(
        "turtlebot3_gazebo turtlebot3_stage_1.launch",
        models="ground_plane turtlebot3_burger turtlebot3_square",
        topics=_BURGER,
        frames="odom>base_footprint",
    ),
    Expected(
        "turtlebot3_gazebo turtlebot3_house.launch",
        models="ground_plane turtlebot3 turtlebot3_house",
        topics=_BURGER,
        frames="odom>base_footprint",
        missing=("model://mailbox/meshes/mailbox.dae", "model://table_marble"),
    ),
    Expected(
        "turtlebot3_gazebo multi_turtlebot3.launch",
        models="ground_plane tb3_0 tb3_1 tb3_2 turtlebot3_house",
        topics=_under(_THREE, "/cmd_vel /imu /joint_states /odom /scan") + " /tf /tf_static",
        frames="odom>base_footprint "
        + " ".join(_links(f"{name}/", _BURGER_LINKS) for name in _THREE),
        missing=(_MESHES,),
    ),
    Expected(
        "gazebo_ros shapes_world.launch",
        models="box cylinder ground_plane sphere",
        topics="",
    ),
    Expected(
        "gazebo_ros elevator_world.launch",
        models="elevator floors ground_plane",
        topics="/elevator",
    ),
    Expected("gazebo_ros mud_world.launch", models="block ground_plane mud", topics=""),
    Expected(
        "gazebo_ros range_world.launch",
        models="model_1 model_2",
        topics="/sonar /sonar2",
    ),
    Expected(
        "gazebo_ros rubble_world.launch",
        models="beam_0 beam_2 brick_0 brick_28 ground_plane",
        topics="",
    ),
    Expected(
        "gazebo_plugins tricycle_drive_scenario.launch",
        models="ground_plane r1 r2",
        topics=_under(_TWO, "/cmd_vel /joint_states /odom") + " /tf /tf_static",
        frames="odom>base_link base_link>r1/odom base_link>r2/odom "
        + " ".join(_links(f"{name}/", _TRICYCLE_LINKS) for name in _TWO),
    ),
    Expected(
        "gazebo_plugins multi_robot_scenario.launch",
        models="ground_plane r1 r2",
        # Both robots' cameras are named without a namespace, so they share their topics, as in Gazebo.
        topics=_under(_TWO, "/cmd_vel /front_laser/scan /joint_states /odom")
        + " /front_camera/camera_info /front_camera/image_raw /front_camera/image_raw/compressed"
        " /tf /tf_static",
        frames="odom>base_link base_link>r1/odom base_link>r2/odom "
        + " ".join(_links(f"{name}/", _PIONEER_LINKS) for name in _TWO),
        missing=("nodes of 'rviz' are left out", "a box without size is left out"),
    ),
]

# Husky's description includes these whether it uses them or not; the corpus has none of them.
HUSKY_INCLUDES = {
    "fath_pivot_mount_description": ("lockmount",),
    "flir_camera_description": ("flir_blackflys",),
    "lms1xx": ("sick_lms1xx",),
    "realsense2_description": ("_d415", "_d435", "_d435i"),
    "velodyne_description": ("VLP-16",),
}
HUSKY = Expected(
    "husky_gazebo empty_world.launch",
    models="ground_plane husky",
    topics="/imu/data /imu/data/bias /joint_states /navsat/fix /navsat/vel /tf /tf_static "
    + _tuned("/imu/data", "accel", "rate", "yaw")
    + " "
    + _tuned("/navsat/fix", "position", "velocity", "status")
    + " /husky_velocity_controller/cmd_vel /husky_velocity_controller/cmd_vel_out "
    "/husky_velocity_controller/odom /odometry/filtered /set_pose /diagnostics "
    "/e_stop /cmd_vel /joy_teleop/cmd_vel /joy_teleop/joy /kb_teleop/cmd_vel /twist_marker_server/cmd_vel "
    + _tuned("", "husky_velocity_controller"),
    frames="odom>base_link base_link>base_footprint base_link>front_bumper_link base_link>imu_link "
    "base_link>inertial_link base_link>rear_bumper_link base_link>top_chassis_link "
    "base_link>top_plate_link base_link>user_rail_link top_plate_link>top_plate_front_link "
    "top_plate_link>top_plate_rear_link base_link>front_left_wheel_link "
    "base_link>front_right_wheel_link base_link>rear_left_wheel_link "
    "base_link>rear_right_wheel_link",
    missing=("there is no package 'interactive_marker_twist_server'",),
    left_out=1,
)

REFUSED = {
    "husky_gazebo husky_playpen.launch": ("there is no package 'fath_pivot_mount_description'",),
    "gazebo_ros willowgarage_world.launch": ("willowgarage",),
    "gazebo_plugins test_single_pendulum.launch": ("there is no package 'gazebo'",),
    "gazebo_plugins balance.launch": ("there is no package 'gazebo_tests'",),
}
