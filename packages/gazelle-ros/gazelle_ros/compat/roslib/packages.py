"""Folders of packages, where roslib keeps them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from gazelle_ros.errors import RosError
from gazelle_ros.launch.packages import Packages

ROS_PACKAGE_PATH = "ROS_PACKAGE_PATH"


class ROSPkgException(Exception):  # noqa: N818  # roslib's names
    """Root of the errors about packages."""


class InvalidROSPkgException(ROSPkgException):
    """There is no such package."""


class MultipleNodesException(ROSPkgException):
    """More than one program has the name."""


def get_pkg_dir(
    package: str,
    required: bool = True,  # noqa: FBT001, FBT002  # roslib's interface
    ros_root: Any = None,
    ros_package_path: str | None = None,
) -> str | None:
    """Return the folder of a package.

    Raises:
        InvalidROSPkgException: It is required, and there is none.
    """
    del ros_root
    environment = None if ros_package_path is None else {ROS_PACKAGE_PATH: ros_package_path}
    try:
        return str(Packages(environment).folder(package))
    except RosError as error:
        if required:
            raise InvalidROSPkgException(str(error)) from None
        return None


def get_dir_pkg(d: str) -> tuple[str | None, str | None]:
    """Return folder and name of the package that a folder is in; None if it is in none."""
    for folder in (Path(d).resolve(), *Path(d).resolve().parents):
        if (folder / "package.xml").is_file() or (folder / "manifest.xml").is_file():
            return str(folder), folder.name
    return None, None


def find_node(pkg: str, node_type: str, rospack: Any = None) -> list[str]:
    """Return programs of a node."""
    del rospack
    return [str(path) for path in Packages().programs(pkg, node_type)]


def find_resource(
    pkg: str, resource_name: str, filter_fn: Any = None, rospack: Any = None
) -> list[str]:
    """Return files of a name in a package."""
    del rospack
    folder = get_pkg_dir(pkg)
    found = [str(path) for path in Path(folder or ".").rglob(resource_name) if path.is_file()]
    return [path for path in found if filter_fn is None or filter_fn(path)]


def resource_file(package: str, subdir: str, resource_name: str) -> str:
    """Return the path of a file in a folder of a package."""
    return str(Path(get_pkg_dir(package) or ".") / subdir / resource_name)
