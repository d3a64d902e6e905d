"""Parameters of tasks, and the start of their worlds."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from gazelle.clients.descriptions import find_file
from gazelle.drop_in.openai_ros.openai_ros_common import ROSLauncher
from gazelle.drop_in.openai_ros.running import simulator_runs
from gazelle_ros.base.text_files import read_text
from gazelle_ros.compat import rospy
from gazelle_ros.launch.values import load_yaml

_CONFIGURATION = "src/openai_ros/task_envs/{}/config"


def LoadYamlFileParamsTest(  # noqa: N802  # openai_ros' name
    rospackage_name: str, rel_path_from_package_to_file: str, yaml_file_name: str
) -> None:
    """Set all parameters of a YAML file in a package.

    Raises:
        MissingPackageError: There is no such package.
        ClientError: It has no such file.
        RosError: It is no YAML.
    """
    for name, value in _read(
        rospackage_name, rel_path_from_package_to_file, yaml_file_name
    ).items():
        rospy.set_param(f"/{name}", value)


def begin_task(space: str, file: str, package: str, launch_file: str) -> str | None:
    """Start a task's world unless a simulator runs, and set its parameters that are not set yet.

    openai_ros overwrites what launch files have set; here that stays.

    Args:
        space: Namespace of its parameters.
        file: YAML file with its parameters: folder below ``task_envs`` and name, without an ending.
        package: Package with its world.
        launch_file: Launch file that starts its world.

    Returns:
        The parameter ``ros_ws_abspath``, a workspace to find packages in; None if it is not set.
    """
    workspace = rospy.get_param(f"/{space}/ros_ws_abspath", None)
    if not simulator_runs():
        ROSLauncher(package, launch_file, workspace)
    folder, _, name = file.partition("/")
    values = _read("openai_ros", _CONFIGURATION.format(folder), f"{name}.yaml")
    for key, value in values.items():
        _complete(f"/{key}", value)
    return None if workspace is None else str(workspace)


def _read(package: str, folder: str, file: str) -> Mapping[str, Any]:
    path = find_file(f"{folder}/{file}", package)
    values: Mapping[str, Any] = load_yaml(read_text(path))
    return values


def _complete(name: str, value: Any) -> None:
    """Set a parameter, or those below it, that is not set."""
    if isinstance(value, Mapping):
        for key, inner in value.items():
            _complete(f"{name}/{key}", inner)
    elif not rospy.has_param(name):
        rospy.set_param(name, value)
