"""rospkg's interface: packages on ROS_PACKAGE_PATH."""

from __future__ import annotations

import builtins
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

from lxml import etree

from gazelle.ros.errors import RosError
from gazelle.ros.launch.packages import Packages
from gazelle.ros.messages import search

MANIFEST_FILE = "manifest.xml"
PACKAGE_FILE = "package.xml"
STACK_FILE = "stack.xml"
_DEPENDS = ("depend", "build_depend", "exec_depend", "run_depend", "build_export_depend")


class ResourceNotFound(Exception):  # noqa: N818  # rospkg's names
    """There is no such package.

    Args:
        msg: Its name, or a text.
        ros_paths: Where it was looked for.
    """

    def __init__(self, msg: str, ros_paths: list[str] | None = None) -> None:
        super().__init__(msg)
        self.ros_paths = ros_paths

    def __str__(self) -> str:
        text = str(self.args[0])
        for place, path in enumerate(self.ros_paths or ()):
            text += f"\nROS path [{place}]={path}"
        return text


class InvalidManifest(Exception):  # noqa: N818
    """A ``package.xml`` is malformed."""


@dataclass
class Depend:
    """A package another one needs."""

    name: str


@dataclass
class Manifest:
    """What a ``package.xml`` says."""

    name: str = ""
    version: str = ""
    description: str = ""
    license: str = ""
    author: str = ""
    depends: list[Depend] = field(default_factory=list)
    exports: list[Any] = field(default_factory=list)
    is_catkin: bool = True

    def get_export(self, tag: str, attr: str, convert: bool = True) -> list[str]:  # noqa: FBT001, FBT002  # rospkg's interface
        """Values of an attribute in ``<export>``."""
        del convert
        return [each.get(attr) for each in self.exports if each.tag == tag and each.get(attr)]


def parse_manifest_file(dirpath: str, manifest_name: str = PACKAGE_FILE) -> Manifest:
    """Read a package's manifest.

    Raises:
        InvalidManifest: It cannot be read.
    """
    path = Path(dirpath) / manifest_name
    try:
        root = etree.parse(path, etree.XMLParser(resolve_entities=False)).getroot()
    except (OSError, etree.XMLSyntaxError) as error:
        raise InvalidManifest(f"[{path}] {error}") from None

    def text(tag: str) -> str:
        return (root.findtext(tag) or "").strip()

    needed = dict.fromkeys(
        (element.text or "").strip() for tag in _DEPENDS for element in root.findall(tag)
    )
    export = root.find("export")
    return Manifest(
        name=text("name"),
        version=text("version"),
        description=text("description"),
        license=text("license"),
        author=text("author"),
        depends=[Depend(name) for name in needed if name],
        exports=[] if export is None else list(export),
    )


class RosPack:
    """The packages of this process.

    Args:
        ros_paths: Folders to search, by default ROS_PACKAGE_PATH.
    """

    def __init__(self, ros_paths: Iterable[str] | None = None) -> None:
        self.ros_paths = get_ros_paths() if ros_paths is None else list(ros_paths)
        self._packages = Packages({"ROS_PACKAGE_PATH": os.pathsep.join(self.ros_paths)})

    @classmethod
    def get_instance(cls, ros_paths: Iterable[str] | None = None) -> Self:
        """An object for these folders."""
        return cls(ros_paths)

    def list(self) -> list[str]:
        """Names of all packages."""
        return list(search.find_packages(os.pathsep.join(self.ros_paths)))

    def get_path(self, name: str) -> str:
        """The folder of a package.

        Raises:
            ResourceNotFound: There is none.
        """
        try:
            return str(self._packages.folder(name))
        except RosError:
            raise ResourceNotFound(name, ros_paths=self.ros_paths) from None

    def get_manifest(self, name: str) -> Manifest:
        """What its ``package.xml`` says.

        Raises:
            ResourceNotFound: There is no such package.
            InvalidManifest: It is malformed.
        """
        return parse_manifest_file(self.get_path(name))

    def get_depends(self, name: str, implicit: bool = True) -> builtins.list[str]:  # noqa: FBT001, FBT002  # rospkg's interface
        """Packages a package needs; with `implicit` those they need, too.

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
        """Packages that need a package."""
        return [each for each in self.list() if name in self.get_depends(each, implicit)]

    def get_rosdeps(self, package: str, implicit: bool = True) -> builtins.list[str]:  # noqa: FBT001, FBT002
        """What a package needs that is not on ROS_PACKAGE_PATH."""
        own = set(self.list())
        return [each for each in self.get_depends(package, implicit) if each not in own]

    def stack_of(self, package: str) -> None:
        """Nothing: stacks are no more.

        Raises:
            ResourceNotFound: There is no such package.
        """
        self.get_path(package)


class RosStack(RosPack):
    """Stacks are no more; there is none."""

    def list(self) -> list[str]:
        """Nothing."""
        return []


def get_package_name(path: str) -> str | None:
    """The name of the package that a path is in; None if it is in none."""
    place = Path(path).resolve()
    for folder in (place, *place.parents):
        if (folder / PACKAGE_FILE).is_file():
            return parse_manifest_file(str(folder)).name
    return None


def get_ros_root(env: Mapping[str, str] | None = None) -> str | None:
    """What ROS_ROOT says."""
    return (os.environ if env is None else env).get("ROS_ROOT")


def get_ros_package_path(env: Mapping[str, str] | None = None) -> str | None:
    """What ROS_PACKAGE_PATH says."""
    return (os.environ if env is None else env).get("ROS_PACKAGE_PATH")


def get_ros_paths(env: Mapping[str, str] | None = None) -> list[str]:
    """The folders packages are searched in."""
    found = [get_ros_root(env), *(get_ros_package_path(env) or "").split(os.pathsep)]
    return [each for each in found if each]


def get_ros_home(env: Mapping[str, str] | None = None) -> str:
    """Where ROS keeps files of the user."""
    return (os.environ if env is None else env).get("ROS_HOME") or str(Path.home() / ".ros")


def get_log_dir(env: Mapping[str, str] | None = None) -> str:
    """Where logs go."""
    named = (os.environ if env is None else env).get("ROS_LOG_DIR")
    return named or str(Path(get_ros_home(env)) / "log")


def get_test_results_dir(env: Mapping[str, str] | None = None) -> str:
    """Where results of tests go."""
    named = (os.environ if env is None else env).get("ROS_TEST_RESULTS_DIR")
    return named or str(Path(get_ros_home(env)) / "test_results")


def on_ros_path(p: str, env: Mapping[str, str] | None = None) -> bool:
    """Whether a path is below one of the folders."""
    place = Path(p).resolve()
    return any(place.is_relative_to(Path(each).resolve()) for each in get_ros_paths(env))
