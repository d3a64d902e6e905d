"""Robot descriptions and parameters from files and packages."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from gazelle.clients.errors import ClientError
from gazelle_ros import Node
from gazelle_ros.base.path_texts import can_be_path, expanded, shortened
from gazelle_ros.base.text_files import read_text
from gazelle_ros.builtin import xacro
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.values import load_yaml


def read_urdf(
    path: str | Path,
    *,
    package: str | None = None,
    xacro_args: Mapping[str, str] | None = None,
) -> str:
    """Return the text of a URDF file, with xacro expanded.

    Args:
        path: A file; within the package's folder if one is given.
        package: A ROS package, found as ``$(find ...)`` finds it.
        xacro_args: Values of xacro's arguments.

    Raises:
        ClientError: There is no such package or file.
        RosError: Xacro cannot expand it.
    """
    file = find_file(path, package)
    if file.suffix == ".xacro" or xacro_args:
        return xacro.expand(file, xacro_args or {})
    return read_text(file)


def load_urdf(
    node: Node,
    path: str | Path,
    *,
    package: str | None = None,
    xacro_args: Mapping[str, str] | None = None,
    parameter: str = "robot_description",
) -> str:
    """Load the text of a URDF file, with xacro expanded, into a parameter; returns the text.

    Args:
        node: Sets it.
        path: A file; within the package's folder if one is given.
        package: A ROS package.
        xacro_args: Values of xacro's arguments.
        parameter: Its name.

    Raises:
        ClientError: There is no such package or file.
        RosError: Xacro cannot expand it.
    """
    text = read_urdf(path, package=package, xacro_args=xacro_args)
    node.set_param(parameter, text)
    return text


def load_parameters(
    node: Node, path: str | Path, *, package: str | None = None, namespace: str = ""
) -> None:
    """Set all parameters of a YAML file.

    Args:
        node: Sets them.
        path: A file; within the package's folder if one is given.
        package: A ROS package.
        namespace: Put before their names.

    Raises:
        ClientError: There is no such package or file, or it holds no names with values.
        RosError: It is not valid YAML.
    """
    file = find_file(path, package)
    values = load_yaml(read_text(file))
    if not isinstance(values, dict):
        raise ClientError("a file of parameters is names with values", file=str(file))
    for name, value in values.items():
        node.set_param(f"{namespace.rstrip('/')}/{name}" if namespace else name, value)


def find_file(path: str | Path, package: str | None = None) -> Path:
    """Return a file, or one within a package.

    Raises:
        ClientError: There is no such package or file.
    """
    file = expanded(path)
    if package is not None:
        file = Packages().folder(package) / str(path).lstrip("/")
    if not can_be_path(file) or not file.is_file():
        where = f" in the package '{package}'" if package else ""
        raise ClientError(f"there is no file '{shortened(str(path))}'{where}")
    return file
