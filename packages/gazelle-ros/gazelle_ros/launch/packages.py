"""Find packages, the files in them, and the programs of their nodes.

Packages are looked up on ROS_PACKAGE_PATH, then among those built in. Programs are looked up where
catkin puts them (``lib/PACKAGE`` of an install or devel space), then in the package's own folder, as
http://wiki.ros.org/rosbash#rosrun does.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from pathlib import Path

from gazelle_ros.base.bundled_packages import published
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.base.path_texts import can_be_path
from gazelle_ros.base.program import program_name
from gazelle_ros.builtin import registry
from gazelle_ros.launch.errors import LaunchError, MissingPackageError
from gazelle_ros.messages import search

_SKIPPED = {"build", "__pycache__", "node_modules"}
_SCRIPT_SUFFIXES = ("", ".py")


class Packages:
    """The packages of an environment.

    Args:
        environment: Source of ROS_PACKAGE_PATH and CMAKE_PREFIX_PATH; by default the process's.
    """

    def __init__(self, environment: Mapping[str, str] | None = None) -> None:
        self._environment = os.environ if environment is None else environment

    @property
    def path(self) -> str:
        """ROS_PACKAGE_PATH."""
        return self._environment.get("ROS_PACKAGE_PATH", "")

    def installed(self, package: str) -> Path | None:
        """Return the folder of a package on ROS_PACKAGE_PATH; None if it is not there."""
        return search.find_packages(self.path).get(package)

    def find(self, package: str) -> Path | None:
        """Return the folder of a package, installed or built in, if it has one."""
        found = self.installed(package)
        if found is None:
            known = registry.package(package)
            found = known.folder if known is not None else None
        return found or registry.stand_in(package)

    def folders(self) -> dict[str, Path]:
        """Return the folder of each package that has one, installed or built in, by name."""
        found = {name: self.find(name) for name in registry.names_with_folders()}
        built_in = {name: folder for name, folder in found.items() if folder is not None}
        return dict(sorted((built_in | search.find_packages(self.path)).items()))

    def folder(self, package: str) -> Path:
        """Return the folder of a package, installed or built in.

        Raises:
            MissingPackageError: It is neither.
        """
        found = self.find(package)
        if found is None:
            raise self.missing(package)
        return found

    def missing(self, package: str) -> MissingPackageError:
        """Return the error for a missing package, with a hint."""
        known = [*search.find_packages(self.path), *registry.packages()]
        close = did_you_mean(package, known)
        hint = "add the folder it is in to ROS_PACKAGE_PATH"
        if not self.path:
            hint += ", which is not set"
        if close.startswith("did you mean"):
            hint = f"{close} Else {hint}"
        return MissingPackageError(f"there is no package '{package}'", package=package, hint=hint)

    def locate(self, package: str, path: str, *, followed: bool = False) -> str:
        """Return the path that ``$(find PACKAGE)PATH`` stands for; `path` may be empty.

        As in roslaunch, a slash joins the two whether there is one or not. Programs and resources
        of an install or devel space come before those of the sources.

        Args:
            package: Name of the package.
            path: Path after it, up to a blank or the next ``$(``.
            followed: Whether another ``$(`` follows the path.

        Raises:
            MissingPackageError: There is no such package.
        """
        folder = self.folder(package)
        relative = path.replace("\\", "/").removeprefix("/")
        if followed:
            return os.path.join(folder, relative)  # noqa: PTH118  # keeps the slash at its end
        if not relative:
            return str(folder)
        for space in self._spaces(package, folder):
            program = space / "lib" / package / Path(relative).name
            if _is_program(program):
                return str(program)
        if not _is_program(folder / relative):
            for space in self._spaces(package, folder):
                resource = space / "share" / package / relative
                if can_be_path(resource) and resource.exists():
                    return str(resource)
        text = os.path.join(folder, relative)  # noqa: PTH118  # keeps the text as it is
        found = published(text)
        return text if found == Path(text) else str(found)

    def programs(self, package: str, kind: str) -> list[Path]:
        """Return the candidates for a node's program, the best first."""
        folder = self.find(package)
        if folder is None:
            return []
        places = [space / "lib" / package / kind for space in self._spaces(package, folder)]
        found = [path for path in places if can_be_path(path) and path.is_file()]
        found += sorted(_files_named(folder, kind), key=lambda path: not _is_program(path))
        return found

    def program(self, package: str, kind: str) -> Path | None:
        """Return a node's program; None if there is none that can run."""
        for path in self.programs(package, kind):
            if _is_program(path) or is_python(path):
                return path
        return None

    def program_names(self, package: str) -> list[str]:
        """Return the names of a package's programs, for hints."""
        folder = self.find(package)
        found: set[str] = set()
        if folder is not None:
            roots = [folder, *(s / "lib" / package for s in self._spaces(package, folder))]
            for root in roots:
                found.update(path.name for path in _files(root) if _is_program(path))
        known = registry.package(package)
        return sorted(found | set(known.nodes if known is not None else ()))

    def missing_program(self, package: str, kind: str) -> LaunchError:
        """Return the error for a node without a program, with a hint."""
        if self.find(package) is None and registry.package(package) is None:
            return self.missing(package)
        rejected = self.programs(package, kind)
        if rejected:
            hint = f"make it executable: chmod +x {rejected[0]}"
            return LaunchError(f"'{kind}' of package '{package}' cannot be executed", hint=hint)
        known = self.program_names(package)
        if known:
            hint = did_you_mean(kind, known)
        elif self.installed(package) is None:
            hint = f"Gazelle brings no programs of it; {self._contents(package)}"
        else:
            hint = _unbuilt(kind)
        return LaunchError(f"package '{package}' has no program '{kind}'", hint=hint)

    def unnamed_program(self, package: str) -> LaunchError:
        """Return the error for a package without the name of a program beside it."""
        known = self.program_names(package)
        hint = f"there are: {', '.join(known)}" if known else self._contents(package)
        return LaunchError(f"'{package}' is a package: name one of its programs too", hint=hint)

    def _contents(self, package: str) -> str:
        """Return the launch files of a built-in package, for hints."""
        folder = self.find(package)
        files = sorted(path.name for path in folder.glob("launch/*.launch")) if folder else []
        if not files:
            return "add the folder that the package is in to ROS_PACKAGE_PATH"
        return f"it has launch files: {program_name()} launch {package} {' | '.join(files)}"

    def _spaces(self, package: str, folder: Path) -> Iterator[Path]:
        """Yield install and devel spaces that may hold a package, the nearest first.

        Spaces of CMAKE_PREFIX_PATH with another copy of it are left out: it lies over that one.
        """
        seen: set[Path] = set()
        prefixes = self._environment.get("CMAKE_PREFIX_PATH", "").split(os.pathsep)
        spaces = [Path(prefix) for prefix in prefixes if prefix]
        candidates = [space for space in spaces if not _holds_another(space, package, folder)]
        if folder.parent.name == "share":
            candidates.insert(0, folder.parent.parent)
        workspace = next((parent for parent in folder.parents if parent.name == "src"), None)
        if workspace is not None:
            candidates += [workspace.parent / "devel", workspace.parent / "install"]
            candidates.append(workspace.parent / "devel" / ".private" / package)
        for space in candidates:
            if space not in seen:
                seen.add(space)
                yield space


def _holds_another(space: Path, package: str, folder: Path) -> bool:
    """Return whether a space has a package of this name in another folder than this."""
    other = space / "share" / package
    if not (can_be_path(other) and (other / "package.xml").is_file()):
        return False
    return not (folder.is_dir() and other.samefile(folder))


def is_python(path: Path) -> bool:
    """Return whether a file is a Python script: by its suffix, else by its first line."""
    if path.suffix == ".py":
        return True
    if path.suffix not in _SCRIPT_SUFFIXES:
        return False
    try:
        with path.open("rb") as file:
            first = file.readline(200)
    except OSError:
        return False
    return first.startswith(b"#!") and b"python" in first


def _is_program(path: Path) -> bool:
    return can_be_path(path) and path.is_file() and os.access(path, os.X_OK)


def _files_named(root: Path, name: str) -> Iterator[Path]:
    return (path for path in _files(root) if path.name == name)


def _files(root: Path) -> Iterator[Path]:
    """Yield all files below a folder, except those of hidden folders and of builds."""
    for folder, folders, files in os.walk(root):
        folders[:] = sorted(f for f in folders if f[0] != "." and f not in _SKIPPED)
        for name in sorted(files):
            yield Path(folder, name)


def _unbuilt(kind: str) -> str:
    """Return a note why a package without programs may lack one of this name."""
    if kind.endswith(".py"):
        return "the package has no programs; is its 'scripts' folder missing?"
    return "it is written in C++ and not built here"
