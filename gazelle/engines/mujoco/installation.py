"""Checks of the installed MuJoCo and MuJoCo Warp: two distributions write into one folder.

``mujoco-core`` is what Gazelle requires; ``mujoco`` (required by mink, gymnasium-robotics,
mujoco-warp and others) up to 3.17 contains the same folder ``mujoco``, and 4.0 its own version of
``mujoco-core``. Whichever is installed later overwrites the other's files, uninstalling one takes
away the other's, and ``pip check`` finds nothing wrong. ``mujoco-warp`` requires
``mujoco``, so it is installed without its dependencies, and those apart.
"""

from __future__ import annotations

import importlib
import re
from importlib.metadata import PackageNotFoundError, version

from gazelle.errors import EngineError

_CORE, _BUNDLE = "mujoco-core", "mujoco"
_LEAST = (4, 0, 1)  # 4.0.0 factorises sparse Hessians wrongly

_REPAIR_HINT = (
    "repair it with these two commands: 'pip uninstall -y mujoco mujoco-core' and "
    "'pip install --force-reinstall --no-deps \"mujoco-core>=4.0.1\"'; "
    "packages that require 'mujoco' run with that too"
)


def check_installation() -> None:
    """Raise an error if the installed MuJoCo cannot be used.

    Raises:
        EngineError: Files of two versions are mixed, or the version is too old.
    """
    core, bundle = _installed(_CORE), _installed(_BUNDLE)
    mixed = ""
    if core and bundle and core != bundle:
        mixed = (
            f": mujoco-core {core} and mujoco {bundle} share a folder, and one overwrote the other"
        )
    try:
        found = str(importlib.import_module("mujoco").__version__)
        importlib.import_module("mujoco.batch")
    except (AttributeError, ImportError, OSError) as error:
        reason = mixed or f": {error}"
        raise EngineError(f"MuJoCo cannot be imported{reason}", hint=_REPAIR_HINT) from error
    if mixed or (core and found != core):
        reason = mixed or f": mujoco-core {core} is installed, and its folder holds {found}"
        raise EngineError(f"MuJoCo is damaged{reason}", hint=_REPAIR_HINT)
    if _numbers(found) < _LEAST:
        raise EngineError(
            f"MuJoCo {found} is too old for Gazelle, which needs 4.0.1 or newer", hint=_REPAIR_HINT
        )


def _installed(name: str) -> str:
    """Return the version of a distribution; empty if it is not installed."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(number) for number in re.findall(r"\d+", text)[:3])


_WARP_HINT = (
    "install it with these two commands: 'pip install \"gazelle[warp]\"' and "
    "'pip install --no-deps \"mujoco-warp>=4\"'; without '--no-deps' pip would put another MuJoCo over "
    "Gazelle's"
)


def check_packages() -> None:
    """Raise an error if a package is missing or incompatible, and start Warp without its log.

    Raises:
        EngineError: A package is missing, cannot be imported, or another MuJoCo lies over Gazelle's.
    """
    check_installation()
    for package, module in (("warp-lang", "warp"), ("mujoco-warp", "mujoco_warp")):
        try:
            found = importlib.import_module(module)
        except (ImportError, OSError) as error:
            raise EngineError(
                f"the engine 'mujoco-warp' needs the package '{package}', which cannot be imported: "
                f"{error}",
                hint=_WARP_HINT,
            ) from error
        if module == "warp":
            found.config.log_level = max(found.config.log_level, found.LOG_ERROR)
    if not hasattr(found, "OverflowType"):
        raise EngineError(
            "this MuJoCo Warp is too old: Gazelle needs 4.0 or newer", hint=_WARP_HINT
        )
