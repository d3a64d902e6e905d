"""Whether MuJoCo is installed whole: two of its distributions write into one folder.

``mujoco-core`` is what Gazelle asks for; ``mujoco`` (asked for by mink, gymnasium-robotics,
mujoco-warp and others) up to 3.17 brings the same folder ``mujoco``, and 4.0 brings its own version of
``mujoco-core``. Whichever is installed later overwrites the other's files, uninstalling one takes
away the other's, and ``pip check`` finds nothing wrong.
"""

from __future__ import annotations

import importlib
import re
from importlib.metadata import PackageNotFoundError, version

from gazelle.errors import EngineError

_CORE, _BUNDLE = "mujoco-core", "mujoco"
_LEAST = (4, 0, 1)  # 4.0.0 factorises sparse Hessians wrongly

_HINT = (
    "repair it with these two commands: 'pip uninstall -y mujoco mujoco-core' and "
    "'pip install --force-reinstall --no-deps \"mujoco-core>=4.0.1\"'; "
    "packages that ask for 'mujoco' run with that too"
)


def check_installation() -> None:
    """Raise what is wrong with the installed MuJoCo, if anything.

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
        raise EngineError(f"MuJoCo cannot be imported{reason}", hint=_HINT) from error
    if mixed or (core and found != core):
        reason = mixed or f": mujoco-core {core} is installed, and its folder holds {found}"
        raise EngineError(f"MuJoCo is damaged{reason}", hint=_HINT)
    if _numbers(found) < _LEAST:
        raise EngineError(
            f"MuJoCo {found} is too old for Gazelle, which needs 4.0.1 or newer", hint=_HINT
        )


def _installed(name: str) -> str:
    """The version of a distribution; empty if it is not there."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def _numbers(text: str) -> tuple[int, ...]:
    return tuple(int(number) for number in re.findall(r"\d+", text)[:3])
