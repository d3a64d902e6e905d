"""Modules such as ``demo.cfg.DemoConfig``, made by the ``.cfg`` files of a package."""

from __future__ import annotations

import importlib.abc
from importlib.machinery import ModuleSpec
from pathlib import Path
from types import ModuleType

from gazelle_ros.messages.search import find_packages

SUFFIX = "Config"


def cfg_files(package: str) -> dict[str, Path]:
    """Return the ``.cfg`` files of a package on ROS_PACKAGE_PATH, by their modules' names."""
    folder = find_packages().get(package)
    if folder is None:
        return {}
    found = [*folder.glob("*.cfg"), *folder.glob("cfg/**/*.cfg")]
    return {file.stem + SUFFIX: file for file in found if _generates(file)}


def has_cfg(package: str) -> bool:
    """Return whether a package has ``.cfg`` files."""
    return bool(cfg_files(package))


def _generates(file: Path) -> bool:
    """Return whether a file is one of dynamic_reconfigure's, and not another program's settings."""
    try:
        return b"dynamic_reconfigure" in file.read_bytes()
    except OSError:
        return False


class CfgLoader(importlib.abc.Loader):
    """Loads ``PACKAGE.cfg`` and the modules in it."""

    def create_module(self, spec: ModuleSpec) -> ModuleType:
        """Return an empty package, or the module of a ``.cfg`` file.

        Raises:
            ModuleNotFoundError: There is no such file.
            FormatError: It fails.
        """
        package, _, *member = spec.name.split(".")
        if not member:
            return ModuleType(spec.name, f"What can be reconfigured in {package}.")
        from gazelle_ros.compat.dynamic_reconfigure.generated import load_cfg

        return load_cfg(package, member[0])

    def exec_module(self, module: ModuleType) -> None:
        """Do nothing: the module is complete already."""
