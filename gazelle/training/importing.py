"""Modules that register tasks of the user's own, found again when the run is opened."""

from __future__ import annotations

import importlib
import importlib.util
import os
import sys
import warnings
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from importlib import metadata
from pathlib import Path
from typing import Any

from gazelle.errors import PluginWarning, TaskError, did_you_mean
from gazelle_ros.base.path_texts import can_be_path, shortened

GROUP = "gazelle.tasks"
"""Entry points of this group name a module that registers tasks, or a function that does."""

_loaded: set[str] = set()


@dataclass(frozen=True, slots=True)
class TaskModule:
    """A module that registers tasks."""

    name: str
    """As it is imported, such as ``my_package.tasks``."""
    folder: str | None = None
    """Folder of its outermost package, if it is not among installed packages."""

    @staticmethod
    def find(text: str) -> TaskModule:
        """Return the module that a user means.

        Args:
            text: ``my_package.tasks``, installed or in the current folder, or a ``.py`` file.

        Raises:
            TaskError: There is no such module or file.
        """
        if not can_be_path(text):
            raise TaskError(f"'{shortened(text)}' is neither a module nor a file")
        if text.endswith(".py") or "/" in text:
            return _of_file(Path(text))
        here = Path.cwd()
        if not all(part.isidentifier() for part in text.split(".")):
            raise TaskError(
                f"'{text}' is not the name of a module",
                hint="expected one such as my_package.tasks, or a file such as my_tasks.py",
            )
        if _is_in(here, text):
            return TaskModule(text, str(here))
        top = text.partition(".")[0]
        if _is_in(here, top):
            names = [
                ".".join(path.relative_to(here).with_suffix("").parts)
                for path in (here / top).rglob("*.py")
            ]
            hint = did_you_mean(text, names)
            raise TaskError(f"there is no module '{text}' in {here}", hint=hint)
        if _spec_of(top) is None:
            near = [path.stem for path in here.glob("*.py")]
            near += [path.parent.name for path in here.glob("*/__init__.py")]
            raise TaskError(
                f"there is no module '{top}' here or among the installed packages",
                hint=did_you_mean(top, near) if near else "go to its folder, or install it",
            )
        return TaskModule(text)

    def text(self) -> str:
        """Return a text from which `find` makes this module: its name, or its file."""
        if self.folder is None or ("." in self.name and Path(self.folder) == Path.cwd()):
            return self.name
        path = Path(self.folder).joinpath(*self.name.split("."))
        file = path / "__init__.py" if path.is_dir() else path.with_suffix(".py")
        return os.path.relpath(file) if file.is_relative_to(Path.cwd()) else str(file)

    def is_loaded(self) -> bool:
        """Return True if this process has imported it, from its folder where it has one."""
        module = sys.modules.get(self.name)
        file = getattr(module, "__file__", None)
        if module is None or self.folder is None:
            return module is not None
        return file is not None and Path(file).resolve().is_relative_to(Path(self.folder).resolve())

    def load(self) -> None:
        """Import it, which registers its tasks.

        Raises:
            TaskError: It is not there any more, or it fails.
        """
        if self.folder is not None and self.folder not in sys.path:
            sys.path.insert(0, self.folder)
            importlib.invalidate_caches()
        try:
            importlib.import_module(self.name)
        except ModuleNotFoundError as error:
            if error.name is None or not f"{self.name}.".startswith(f"{error.name}."):
                raise TaskError(f"{self.name} needs the module '{error.name}'") from error
            where = f" in {self.folder}" if self.folder else ""
            raise TaskError(
                f"there is no module '{error.name}'{where}",
                hint="say where the task is now with --import MODULE",
            ) from error
        except Exception as error:
            raise TaskError(
                f"{self.name} cannot be imported: {type(error).__name__}: {error}",
                hint=f"try: python -c 'import {self.name}'",
            ) from error


def load_all(modules: Iterable[TaskModule | str]) -> tuple[TaskModule, ...]:
    """Find and import modules, as `TaskModule` has it; returns them."""
    found = tuple(
        module if isinstance(module, TaskModule) else TaskModule.find(module) for module in modules
    )
    for module in found:
        module.load()
    return found


def load_entry_points() -> None:
    """Load the entry points of installed packages; one that fails is skipped with a warning."""
    for entry in metadata.entry_points(group=GROUP):
        if entry.value in _loaded:
            continue
        _loaded.add(entry.value)
        try:
            loaded = entry.load()
            if callable(loaded):
                loaded()
        except Exception as error:  # noqa: BLE001  # of another package: it must not stop ours
            warnings.warn(
                f"the tasks of the entry point '{entry.name}' ({entry.value}) cannot be "
                f"registered: {type(error).__name__}: {error}",
                PluginWarning,
                stacklevel=2,
            )


def modules_to_list(modules: Iterable[TaskModule]) -> list[dict[str, str | None]]:
    """Return modules as plain values for JSON."""
    return [{"module": module.name, "folder": module.folder} for module in modules]


def modules_from_list(values: Iterable[Mapping[str, Any]]) -> tuple[TaskModule, ...]:
    """Restore the modules that `modules_to_list` wrote."""
    return tuple(TaskModule(str(value["module"]), value["folder"]) for value in values)


def _of_file(file: Path) -> TaskModule:
    """Return the module of a file, from the outermost folder that is a package on."""
    if not file.is_file():
        near = [str(path) for path in file.parent.glob("*.py")]
        hint = did_you_mean(str(file), near) if near else "expected a Python file"
        raise TaskError(f"there is no file '{file}'", hint=hint)
    folder = file.resolve().parent
    parts = [] if file.stem == "__init__" else [file.stem]
    while (folder / "__init__.py").is_file():
        parts.insert(0, folder.name)
        folder = folder.parent
    return TaskModule(".".join(parts), str(folder))


def _is_in(folder: Path, name: str) -> bool:
    place = folder.joinpath(*name.split("."))
    return place.with_suffix(".py").is_file() or place.is_dir()


def _spec_of(top: str) -> object:
    try:
        return importlib.util.find_spec(top)
    except ValueError:  # a module without a spec, such as __main__
        return None
