"""Folders of logs, and working folders of nodes (http://wiki.ros.org/ROS/EnvironmentVariables)."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path

from gazelle_ros.launch.errors import LaunchError


def ros_home(environment: Mapping[str, str] | None = None) -> Path:
    """Return ROS_HOME, else ``~/.ros``."""
    env = os.environ if environment is None else environment
    given = env.get("ROS_HOME")
    return Path(given) if given else Path.home() / ".ros"


def log_folder(run_id: str) -> Path:
    """Return the folder of a run's logs, created if need be.

    Raises:
        LaunchError: It cannot be made.
    """
    given = os.environ.get("ROS_LOG_DIR")
    base = Path(given) if given else ros_home() / "log"
    return made(base / run_id if run_id else base)


def made(folder: Path) -> Path:
    """Create the folder, and return it.

    Raises:
        LaunchError: It cannot be made.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise LaunchError(
            f"the folder {folder} cannot be made: {error.strerror}",
            hint="set ROS_HOME or ROS_LOG_DIR to a folder that you may write to",
        ) from None
    return folder
