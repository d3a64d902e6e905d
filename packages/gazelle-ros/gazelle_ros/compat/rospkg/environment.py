"""Folders that the environment names."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path


def get_ros_root(env: Mapping[str, str] | None = None) -> str | None:
    """Return the value of ROS_ROOT."""
    return (os.environ if env is None else env).get("ROS_ROOT")


def get_ros_package_path(env: Mapping[str, str] | None = None) -> str | None:
    """Return the value of ROS_PACKAGE_PATH."""
    return (os.environ if env is None else env).get("ROS_PACKAGE_PATH")


def get_ros_paths(env: Mapping[str, str] | None = None) -> list[str]:
    """Return the search path of packages."""
    found = [get_ros_root(env), *(get_ros_package_path(env) or "").split(os.pathsep)]
    return [each for each in found if each]


def get_ros_home(env: Mapping[str, str] | None = None) -> str:
    """Return the folder of the user's ROS files."""
    return (os.environ if env is None else env).get("ROS_HOME") or str(Path.home() / ".ros")


def get_log_dir(env: Mapping[str, str] | None = None) -> str:
    """Return the folder of logs."""
    named = (os.environ if env is None else env).get("ROS_LOG_DIR")
    return named or str(Path(get_ros_home(env)) / "log")


def get_test_results_dir(env: Mapping[str, str] | None = None) -> str:
    """Return the folder of test results."""
    named = (os.environ if env is None else env).get("ROS_TEST_RESULTS_DIR")
    return named or str(Path(get_ros_home(env)) / "test_results")


def on_ros_path(p: str, env: Mapping[str, str] | None = None) -> bool:
    """Return whether a path is below one of the folders."""
    place = Path(p).resolve()
    return any(place.is_relative_to(Path(each).resolve()) for each in get_ros_paths(env))
