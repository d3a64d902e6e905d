"""Python modules of the packages on ROS_PACKAGE_PATH, as their ``setup.py`` files or install spaces have them."""

from __future__ import annotations

import functools
import importlib.util
from importlib.machinery import ModuleSpec
from pathlib import Path

from gazelle_ros.compat.setup_files import PythonCode, python_code
from gazelle_ros.messages.search import find_packages, package_path

_SITES = {"site-packages", "dist-packages"}


def named_spec(name: str) -> ModuleSpec | None:
    """Return the spec of a module that a ``setup.py`` names, or None.

    Args:
        name: Its dotted name.
    """
    code = _all_code(package_path())
    folder = code.packages.get(name)
    if folder is not None:
        return _package(name, folder)
    file = code.modules.get(name)
    if file is not None:
        return importlib.util.spec_from_file_location(name, file)
    parents = [at.parent for inner, at in code.packages.items() if inner.rpartition(".")[0] == name]
    return _namespace(name, parents) if parents else None


def usual_spec(name: str) -> ModuleSpec | None:
    """Return the spec of code that no ``setup.py`` names: at ``src/NAME``, or in an install space."""
    folder = find_packages().get(name)
    source = None if folder is None else folder / "src" / name
    if source and (source / "__init__.py").is_file():
        return _package(name, source)
    for site in _sites(package_path()):
        if (site / name / "__init__.py").is_file():
            return _package(name, site / name)
        if (site / f"{name}.py").is_file():
            return importlib.util.spec_from_file_location(name, site / f"{name}.py")
    return None


def comes_after(spec: ModuleSpec) -> bool:
    """Return whether a module is one that packages of a workspace hide, as they are first on ROS's path."""
    return spec.origin is not None and not _SITES.isdisjoint(Path(spec.origin).parts)


def _package(name: str, folder: Path) -> ModuleSpec | None:
    init = folder / "__init__.py"
    if not init.is_file():
        return _namespace(name, [folder])
    return importlib.util.spec_from_file_location(
        name, init, submodule_search_locations=[str(folder)]
    )


def _namespace(name: str, folders: list[Path]) -> ModuleSpec:
    found = ModuleSpec(name, None, is_package=True)
    found.submodule_search_locations = [str(folder) for folder in dict.fromkeys(folders)]
    return found


@functools.cache
def _all_code(path: str) -> PythonCode:
    """Return the code of all packages; the first package that names a module has it."""
    packages: dict[str, Path] = {}
    modules: dict[str, Path] = {}
    for folder in find_packages(path).values():
        code = python_code(folder)
        for name, at in code.packages.items():
            packages.setdefault(name, at)
        for name, at in code.modules.items():
            modules.setdefault(name, at)
    return PythonCode(packages, modules)


@functools.cache
def _sites(path: str) -> list[Path]:
    """Return folders of Python modules of install spaces, which have packages in ``share``."""
    folders = find_packages(path).values()
    spaces = dict.fromkeys(each.parent.parent for each in folders if each.parent.name == "share")
    kinds = sorted(_SITES)
    return [
        site for at in spaces for kind in kinds for site in sorted(at.glob(f"lib/python3*/{kind}"))
    ]
