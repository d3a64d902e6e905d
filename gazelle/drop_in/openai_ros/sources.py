"""Sources of the packages that openai_ros clones when it runs."""

from __future__ import annotations

from gazelle_ros.launch.errors import MissingPackageError

_CONSTRUCT = "bitbucket.org/theconstructcore"
_SOURCES = {
    "moving_cube_description": f"{_CONSTRUCT}/moving_cube",
    "rosbot_gazebo": f"{_CONSTRUCT}/rosbot_husarion",
    "rosbot_description": f"{_CONSTRUCT}/rosbot_husarion",
    "fetch_gazebo": f"{_CONSTRUCT}/fetch_tc",
    "fetch_simple_description": f"{_CONSTRUCT}/fetch_simple_simulation",
    "cartpole_description": f"{_CONSTRUCT}/cart_pole",
    "cartpole_v0_training": f"{_CONSTRUCT}/cart_pole",
    "legged_robots_sims": f"{_CONSTRUCT}/hopper",
    "iri_wam_gazebo": f"{_CONSTRUCT}/iri_wam",
    "drone_construct": f"{_CONSTRUCT}/parrot_ardrone",
    "sawyer_gazebo": f"{_CONSTRUCT}/sawyer_full",
    "shadow_gazebo": f"{_CONSTRUCT}/shadow_robot_smart_grasping_sandbox",
    "summit_xl_gazebo": f"{_CONSTRUCT}/summit_xl",
    "gym_construct": f"{_CONSTRUCT}/open_ai_gym_construct",
    "turtlebot_gazebo": f"{_CONSTRUCT}/turtlebot",
    "turtlebot3_gazebo": f"{_CONSTRUCT}/turtlebot3",
    "robotx_gazebo": f"{_CONSTRUCT}/vmrc",
}


def missing_package(package: str, workspace: str | None = None) -> MissingPackageError:
    """Return the error that names a missing package and its source for openai_ros.

    Args:
        package: Its name.
        workspace: The parameter ``ros_ws_abspath``; its ``src`` was searched.
    """
    source = _SOURCES.get(package)
    places = "ROS_PACKAGE_PATH" if workspace is None else f"ROS_PACKAGE_PATH or {workspace}/src"
    hint = f"put it on {places}; nothing is downloaded here"
    if source is not None:
        hint += f", openai_ros takes it from {source}"
    return MissingPackageError(f"there is no package '{package}'", package=package, hint=hint)
