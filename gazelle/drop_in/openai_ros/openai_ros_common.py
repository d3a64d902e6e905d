"""Start an environment with all that it needs."""

from __future__ import annotations

import os
from pathlib import Path

from gazelle.drop_in.gym.core import Env
from gazelle.drop_in.gym.envs.registration import make
from gazelle.drop_in.openai_ros.sources import missing_package
from gazelle.drop_in.openai_ros.task_envs.task_envs_list import RegisterOpenAI_Ros_Env
from gazelle.drop_in.shared import background
from gazelle_ros.compat import rospy
from gazelle_ros.launch.errors import MissingPackageError
from gazelle_ros.launch.packages import Packages

_STEPS = 10000


def StartOpenAI_ROS_Environment(  # noqa: N802  # openai_ros' name
    task_and_robot_environment_name: str, max_episode_steps: int = _STEPS
) -> Env | None:
    """Register an environment of openai_ros, start its world and robot, and make it.

    Args:
        task_and_robot_environment_name: Such as ``TurtleBot3World-v0``.
        max_episode_steps: After which an episode is cut.

    Returns:
        The environment; None, and a line in the log, if openai_ros has none of that name.

    Raises:
        MissingPackageError: A package that it launches is not there.
    """
    name = task_and_robot_environment_name
    if not RegisterOpenAI_Ros_Env(task_env=name, max_episode_steps=max_episode_steps):
        return None
    return make(name)


class ROSLauncher:
    """Starts a launch file of a package; what it starts ends with the script.

    Args:
        rospackage_name: The package.
        launch_file_name: The file in it.
        ros_ws_abspath: A workspace; its ``src`` is searched for the package too, if it is there.

    Raises:
        MissingPackageError: There is no such package; nothing is downloaded.
        LaunchError: The file cannot run.
    """

    def __init__(
        self, rospackage_name: str, launch_file_name: str, ros_ws_abspath: str | None = None
    ) -> None:
        self._rospackage_name = rospackage_name
        self._launch_file_name = launch_file_name
        _add_workspace(ros_ws_abspath)
        folder = Packages().find(rospackage_name)
        if folder is None:
            folder = self.DownloadRepo(rospackage_name, ros_ws_abspath)
        rospy.loginfo(f"starting {launch_file_name} of {folder}")
        file = folder / "launch" / launch_file_name
        # What it starts ends before this node does, because it needs the node's master.
        rospy.on_shutdown(background.stop_all)
        if file.is_file():
            background.processes().start_launch(file)
        else:  # elsewhere in the package, or nowhere
            background.processes().start_launch(launch_file_name, package=rospackage_name)

    def DownloadRepo(  # noqa: N802  # openai_ros' name
        self, package_name: str, ros_ws_abspath: str | None = None
    ) -> Path:
        """Raise an error that names the missing package and its source; openai_ros clones it.

        Raises:
            MissingPackageError: Always.
        """
        error: MissingPackageError = missing_package(package_name, ros_ws_abspath)
        raise error


def _add_workspace(workspace: str | None) -> None:
    """Search a workspace's sources for packages, after those that ROS_PACKAGE_PATH names."""
    sources = None if workspace is None else Path(workspace).expanduser() / "src"
    if sources is None or not sources.is_dir():
        return
    known = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    if str(sources) not in known:
        os.environ["ROS_PACKAGE_PATH"] = os.pathsep.join([*filter(None, known), str(sources)])
