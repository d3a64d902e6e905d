"""Stable-Baselines3 and torch, which are an extra."""

from __future__ import annotations

import importlib
from typing import Any

from gazelle.errors import MissingExtraError


def stable_baselines3(module: str = "") -> Any:
    """Return the package, or a module of it.

    Raises:
        MissingExtraError: It is not installed.
    """
    return _imported("stable_baselines3", module)


def torch(module: str = "") -> Any:
    """Return the package, or a module of it.

    Raises:
        MissingExtraError: It is not installed.
    """
    return _imported("torch", module)


def _imported(package: str, module: str) -> Any:
    try:
        return importlib.import_module(f"{package}.{module}" if module else package)
    except ModuleNotFoundError as error:
        if error.name != package:
            raise
        raise MissingExtraError(package.replace("_", "-"), "train") from error
