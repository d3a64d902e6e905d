"""Packages on ROS_PACKAGE_PATH."""

from __future__ import annotations

import builtins
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Self

from gazelle_ros.compat.rospkg.common import PACKAGE_FILE, ResourceNotFound
from gazelle_ros.compat.rospkg.environment import get_ros_paths
from gazelle_ros.compat.rospkg.manifest import InvalidManifest, Manifest, parse_manifest_file
from gazelle_ros.errors import RosError
from gazelle_ros.launch.packages import Packages
from gazelle_ros.messages import search

__all__ = [
    "InvalidManifest",
    "Manifest",
    "ResourceNotFound",
    "RosPack",
    "RosStack",
    "expand_to_packages",
    "get_package_name",
    "list_by_path",
]


class RosPack:
    """The packages of this process.

    Args:
        ros_paths: Folders to search, by default ROS_PACKAGE_PATH.
    """

    def __init__(self, ros_paths: Iterable[str] | None = None) -> None:
        self._built_in = ros_paths is None
        self.ros_paths = get_ros_paths() if ros_paths is None else list(ros_paths)
        self._packages = Packages({"ROS_PACKAGE_PATH": os.pathsep.join(self.ros_paths)})

    @classmethod
    def get_instance(cls, ros_paths: Iterable[str] | None = None) -> Self:
        """Return an object for these folders."""
        return cls(ros_paths)

    def list(self) -> list[str]:
        """Return names of all packages in the folders; by default with those built in."""
        if self._built_in:
            return list(self._packages.folders())
        return list(search.find_packages(os.pathsep.join(self.ros_paths)))

    def get_path(self, name: str) -> str:
        """Return the folder of a package.

        Raises:
            ResourceNotFound: There is none.
        """
        try:
            return str(self._packages.folder(name))
        except RosError:
            raise ResourceNotFound(name, ros_paths=self.ros_paths) from None

    def get_manifest(self, name: str) -> Manifest:
        """Return the content of its ``package.xml``.

        Raises:
            ResourceNotFound: There is no such package.
            InvalidManifest: It is malformed.
        """
        return parse_manifest_file(self.get_path(name))

    def get_depends(self, name: str, implicit: bool = True) -> builtins.list[str]:  # noqa: FBT001, FBT002  # rospkg's interface
        """Return the dependencies of a package; with `implicit` theirs, too.

        Raises:
            ResourceNotFound: There is no such package.
        """
        found: dict[str, None] = {}
        waiting = [each.name for each in self.get_manifest(name).depends]
        while waiting:
            each = waiting.pop(0)
            if each in found:
                continue
            found[each] = None
            if implicit and self._packages.installed(each) is not None:
                waiting += [depend.name for depend in self.get_manifest(each).depends]
        return [*found]

    def get_depends_on(self, name: str, implicit: bool = True) -> builtins.list[str]:  # noqa: FBT001, FBT002
        """Return packages that need a package."""
        return [each for each in self.list() if name in self.get_depends(each, implicit)]

    def get_rosdeps(self, package: str, implicit: bool = True) -> builtins.list[str]:  # noqa: FBT001, FBT002
        """Return the dependencies of a package that are not on ROS_PACKAGE_PATH."""
        own = set(self.list())
        return [each for each in self.get_depends(package, implicit) if each not in own]

    def stack_of(self, package: str) -> None:
        """Return None: there are no stacks any more.

        Raises:
            ResourceNotFound: There is no such package.
        """
        self.get_path(package)


class RosStack(RosPack):
    """Stacks are no more; there is none."""

    def list(self) -> list[str]:
        """Return an empty list."""
        return []


def get_package_name(path: str) -> str | None:
    """Return the name of the package that a path is in; None if it is in none."""
    place = Path(path).resolve()
    for folder in (place, *place.parents):
        if (folder / PACKAGE_FILE).is_file():
            return parse_manifest_file(str(folder)).name
    return None


def list_by_path(manifest_name: str, path: str, cache: dict[str, str]) -> list[str]:
    """Return names of the packages below a folder; their folders go into `cache`."""
    del manifest_name
    found = search.find_packages(path)
    cache.update({name: str(folder) for name, folder in found.items()})
    return list(found)


def expand_to_packages(
    names: Iterable[str], rospack: RosPack, rosstack: RosStack
) -> tuple[list[str], list[str]]:
    """Return those of the names that are packages, and the others.

    There are no stacks to expand.
    """
    del rosstack
    wanted, known = list(names), set(rospack.list())
    return [each for each in wanted if each in known], [e for e in wanted if e not in known]
