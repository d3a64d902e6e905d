"""Resolution of ``model://``, ``package://``, ``file://`` and relative names to files.

For a model the folders given are searched, then those around the file that name it
directly, then what comes with Gazelle, and last all folders around the file. For a package
the first folder given that has it anywhere counts, as with rospack; then those around the
file, and what comes with Gazelle is last. Nothing is ever fetched from a network, and only files below folders that the user gave
(as arguments or in the environment), below the folders around the file being read, and
those that come with Gazelle are opened.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from importlib import resources
from pathlib import Path
from urllib.parse import unquote

from gazelle.formats import packages
from gazelle.formats.near_names import near_miss
from gazelle_ros.base.bundled_packages import published
from gazelle_ros.base.path_texts import can_be_path, expanded

MODEL_VARIABLES = (
    "GAZEBO_MODEL_PATH",
    "GAZEBO_RESOURCE_PATH",
    "GZ_SIM_RESOURCE_PATH",
    "IGN_GAZEBO_RESOURCE_PATH",
    "SDF_PATH",
    "STAGEPATH",
)
PACKAGE_VARIABLE = "ROS_PACKAGE_PATH"
NEIGHBOUR_LEVELS = 4

_PACKAGED = ("*/models/", "*/models/*/")
"""Folders of bundled packages that hold models."""
_GIVE = "give its folder as a path, or in GAZEBO_MODEL_PATH"
_NETWORK = ("http://", "https://", "fuel://", "ftp://")


class Resolver:
    """Finds files and folders by the names that robot files give them.

    Args:
        paths: Folders to look in before all others: packages, models, workspaces, or
            folders that hold them.
        environ: Environment variables; those of the process when None.
        file: The file being read: the folders around it are searched too.
    """

    def __init__(
        self,
        paths: Sequence[str | os.PathLike[str]] = (),
        environ: Mapping[str, str] | None = None,
        *,
        file: Path | None = None,
    ) -> None:
        self._environ = os.environ if environ is None else environ
        self.paths = tuple(expanded(path).absolute() for path in paths)
        self._indices: dict[Path, packages.Index] = {}
        self._listings: dict[Path, packages.Listing] = {}
        self._crawled: dict[Path, dict[str, Path]] = {}
        self._models_in: list[Path] | None = None
        self._readable_in: list[Path] | None = None
        self._linked: list[Path] = []
        self._packages: dict[str, Path | None] = {}
        self._models: dict[str, Path | None] = {}
        self._around: list[Path] = []
        self._reads_own = False
        if file is not None:
            self.look_around(file)

    def look_around(self, file: Path) -> None:
        """Search the folders around this file as well.

        A file of Gazelle's own means Gazelle's own models and packages, whatever else is there.
        """
        if not self._around:
            self._reads_own = file.is_relative_to(self.assets)
        for folder in _ancestors(file):
            if folder not in self._around:
                self._around.append(folder)
                self._models_in = self._readable_in = None
                self._packages = {name: at for name, at in self._packages.items() if at}
                self._models = {name: at for name, at in self._models.items() if at}

    def find(self, uri: str, base: Path | None = None) -> Path | None:
        """Return the file or folder of a URI or path, or None.

        Args:
            uri: ``model://``, ``package://``, ``file://``, an absolute or a relative path.
            base: Folder that a relative path starts from.
        """
        if not can_be_path(uri.strip().partition("://")[2] or uri):
            return None
        for candidate in self._candidates(uri.strip(), base):
            found = self._allowed(candidate)
            if found is not None:
                return found
        return None

    def looked_in(self, uri: str, base: Path | None = None) -> str:
        """Return a close name, or where ``find`` searches for such a URI, for a message."""
        if uri.startswith(_NETWORK):
            return "network addresses are never fetched"
        for path in self._candidates(uri.strip(), base):
            if can_be_path(path) and path.exists():
                return f"{path} lies outside of the folders that may be read; {_GIVE}"
        close = self.near_miss(uri, base)
        if close is not None:
            return close
        if uri.startswith("package://"):
            variable, folders = PACKAGE_VARIABLE, self._package_roots()
        elif uri.startswith("model://"):
            variable, folders = MODEL_VARIABLES[0], self._model_roots()
        else:
            return "looked beside the file"
        shown = ", ".join(str(folder) for folder in folders[:6]) or "no folder"
        state = "" if self._environ.get(variable) else f"; {variable} is not set"
        return f"looked in {shown}{state}"

    def near_miss(self, uri: str, base: Path | None) -> str | None:
        """Return a hint with a similar URI or path; None if there is none."""
        return near_miss(uri.strip(), base, self._folder, self._names)

    def _folder(self, name: str) -> Path | None:
        return self.package(name) or self.model(name)

    def _names(self) -> set[str]:
        """Return the names of all packages and models that are known."""
        names = {folder.name for folder in (self.assets / "models").iterdir()}
        for root in self._given_roots():
            names.update(self._crawl(root))
        for root in self._around:
            index = self._index(root)
            names.update(index.models, index.packages)
        return names

    def package(self, name: str) -> Path | None:
        """Return the folder of a ROS package, or None."""
        if name not in self._packages:
            self._packages[name] = self._find_package(name)
        return self._packages[name]

    def model(self, name: str) -> Path | None:
        """Return the folder of a Gazebo model, or None."""
        if name not in self._models:
            self._models[name] = self._find_model(name)
        return self._models[name]

    def readable(self, path: Path) -> bool:
        """Return whether the path, links followed, is below a folder that may be read."""
        try:
            real = path.resolve()
        except (OSError, RuntimeError, ValueError):
            return False
        return any(real.is_relative_to(root) for root in self._readable_roots())

    def _allowed(self, path: Path) -> Path | None:
        path = published(path, self.assets)
        try:
            return path if path.exists() and self.readable(path) else None
        except (OSError, ValueError):
            return None

    def _candidates(self, uri: str, base: Path | None) -> Iterator[Path]:
        if uri.startswith(_NETWORK):
            yield from self._local_copy(uri)
            return
        scheme, separator, rest = uri.partition("://")
        if not separator:
            scheme, rest = ("file", uri.removeprefix("file:"))
        # Gazebo takes the name as it stands; others write %20 for a blank
        for path in dict.fromkeys((rest, unquote(rest))):
            name, _, inner = path.partition("/")
            if scheme in {"model", "package"}:
                yield from self._below(name, inner, scheme)
            elif scheme == "file":
                yield from self._plain(path, base)

    def _below(self, name: str, inner: str, scheme: str) -> Iterator[Path]:
        """Yield folders.

        As in Gazebo, ``model://`` may also name a package, and vice versa.
        """
        first, second = (self.model, self.package)
        if scheme == "package":
            first, second = second, first
        for find in (first, second):
            folder = find(name)
            if folder is not None:
                yield folder / inner if inner else folder
        for root in self._model_roots():
            yield root / name / inner if inner else root / name

    def _plain(self, path: str, base: Path | None) -> Iterator[Path]:
        plain = expanded(path)
        if plain.is_absolute():
            yield plain
            return
        if base is not None:
            yield base / plain
        for root in self._model_roots():
            yield root / plain

    def _local_copy(self, uri: str) -> Iterator[Path]:
        """Yield local models of the same name as one on the network."""
        parts = [unquote(part) for part in uri.split("/")]
        if "models" in parts[:-1]:
            at = parts.index("models")
            folder = self.model(parts[at + 1])
            inner = parts[at + 2 :]
            if inner and inner[0] in {"tip", *map(str, range(100))}:
                inner = inner[1:]
            if inner and inner[0] == "files":
                inner = inner[1:]
            if folder is not None:
                yield folder.joinpath(*inner)

    def _find_package(self, name: str) -> Path | None:
        if not _plain_name(name):
            return None
        bundled = self.assets / name
        if self._reads_own and (bundled / "package.xml").is_file():
            return bundled
        for root in self._given_roots():
            # the first root that has it anywhere, as rospack finds it
            found = self._flat(root, name) or self._crawl(root).get(name)
            if found is not None:
                self._linked_to(found)
                return found
        return (
            next(filter(None, (self._flat(root, name) for root in self._around)), None)
            or self._scanned(self._around[::-1], "packages", name)
            or (bundled if (bundled / "package.xml").is_file() else None)
        )

    @staticmethod
    def _flat(root: Path, name: str) -> Path | None:
        """Return the package at its usual place, which spares the search."""
        if packages.is_package(root, name):
            return root
        for folder in (root, root / "src"):
            if not packages.is_searched(folder):
                return None
            if packages.is_package(folder / name, name):
                return folder / name
        return None

    def _crawl(self, root: Path) -> dict[str, Path]:
        if root not in self._crawled:
            self._crawled[root] = packages.crawl(root)
        return self._crawled[root]

    def _linked_to(self, package: Path) -> None:
        """Allow files of a package that a workspace has as a link."""
        if not self.readable(package):
            self._linked.append(package.resolve())
            self._readable_in = None

    def _find_model(self, name: str) -> Path | None:
        if not _plain_name(name):
            return None
        bundled = self.bundled_model(name)
        if bundled is not None and self._reads_own:
            return bundled
        return (
            _flat_model(name, self._model_roots())
            or self._scanned(self._given_roots(), "models", name)
            or bundled
            or self._scanned(self._around[::-1], "models", name)
        )

    def bundled_model(self, name: str) -> Path | None:
        """Return the folder of a model that comes with Gazelle, or None."""
        if not _plain_name(name):
            return None
        places = [self.assets / "models" / name]
        places += [folder for pattern in _PACKAGED for folder in self.assets.glob(pattern + name)]
        return next((folder for folder in places if (folder / "model.config").is_file()), None)

    def given_model(self, name: str) -> Path | None:
        """Return the folder of a model directly in one of ``paths``, or None."""
        return _flat_model(name, self.paths) if _plain_name(name) else None

    def environment_model(self, name: str) -> Path | None:
        """Return the folder of a model directly in a folder of the environment, or None."""
        roots = [*self._variable_roots, *self._split(PACKAGE_VARIABLE)]
        return _flat_model(name, roots) if _plain_name(name) else None

    def _scanned(self, roots: list[Path], kind: str, name: str) -> Path | None:
        """Return a package or model anywhere below the roots: the slowest search, so the last."""
        for root in roots:
            index = self._index(root)
            found = (index.models if kind == "models" else index.packages).get(name)
            if found is not None:
                return found
        return None

    def _index(self, root: Path) -> packages.Index:
        if root not in self._indices:
            self._indices[root] = packages.scan(root, self._listings)
        return self._indices[root]

    def _split(self, variable: str) -> list[Path]:
        parts = self._environ.get(variable, "").split(os.pathsep)
        return [expanded(part) for part in parts if Path(part).is_absolute()]

    @cached_property
    def _variable_roots(self) -> list[Path]:
        return [path for variable in MODEL_VARIABLES for path in self._split(variable)]

    @cached_property
    def assets(self) -> Path:
        """The folder of the robots, models and worlds that come with Gazelle."""
        return Path(str(resources.files("gazelle"))) / "assets"

    def _package_roots(self) -> list[Path]:
        return [*self.paths, *self._split(PACKAGE_VARIABLE), *self._around]

    def _model_roots(self) -> list[Path]:
        if self._models_in is None:
            exported = [
                path
                for root in self._package_roots()
                if (root / "package.xml").is_file()
                for path in packages.exported_model_paths(root)
            ]
            self._models_in = [*self.paths, *self._variable_roots, *exported, *self._around]
        return self._models_in

    def _given_roots(self) -> list[Path]:
        return [*self.paths, *self._split(PACKAGE_VARIABLE)]

    def _readable_roots(self) -> list[Path]:
        if self._readable_in is None:
            roots = [*self._model_roots(), *self._split(PACKAGE_VARIABLE), self.assets]
            self._readable_in = [*self._linked, *(root.resolve() for root in roots)]
        return self._readable_in


def _flat_model(name: str, roots: Sequence[Path]) -> Path | None:
    for root in roots:
        for folder in (root / name, root / "models" / name, root):
            if folder.name == name and (folder / "model.config").is_file():
                return folder
    return None


def _plain_name(name: str) -> bool:
    return bool(name) and name not in {".", ".."} and os.sep not in name and can_be_path(name)


def _ancestors(file: Path) -> list[Path]:
    """Return the folders around a file, nearest first, short of a home or a top-level folder.

    They are counted from the package that the file is in, however deep it lies there.
    """
    if not can_be_path(file):
        return []
    start = file.absolute()
    folders = [start] if start.is_dir() and start.name else []
    above = list(start.parents)
    inside = next((i for i, each in enumerate(above) if (each / "package.xml").is_file()), 0)
    for folder in above[: NEIGHBOUR_LEVELS + inside]:
        too_wide = len(folder.parts) <= 2 or folder == Path.home()
        if too_wide and folders:
            break
        folders.append(folder)
    return folders
