"""Selection of the build of compiled modules that a process uses."""

from __future__ import annotations

import importlib
import os
import platform
import sys
from collections.abc import Iterable
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from typing import Final

from gazelle.errors import EngineError

BUILDS: Final = ("baseline", "avx2", "checked", "python")
_HERE: Final = Path(__file__).parent


def search_path(path: Iterable[str]) -> list[str]:
    """Return the search path for a package's modules: compiled ones before their sources."""
    homes = list(path)
    builds = [] if BUILD == "python" else [BUILD, "baseline"] if BUILD == "avx2" else [BUILD]
    return [f"{home}/_{build}" for build in builds for home in homes] + homes


def _chosen() -> str:
    """Return the forced build, else the fastest one that exists and that the processor can run.

    Raises:
        EngineError: There is no such build, or nothing is built.
    """
    forced = os.environ.get("GAZELLE_NATIVE", "")
    if forced and forced not in BUILDS:
        raise EngineError(f"GAZELLE_NATIVE must be one of {', '.join(BUILDS)}, not {forced!r}")
    if forced:
        _require(forced)
        return forced
    _require("baseline")
    return "avx2" if _is_built("avx2") and _has_avx2() else "baseline"


def _require(build: str) -> None:
    if build == "python":
        from gazelle.native.interpreted import install

        install()
    elif not _is_built(build):
        raise EngineError(
            f"Gazelle's compiled modules are not built for {platform.machine()} ({build})",
            hint="install again where it was installed from a checkout: pip install -e .",
        )


def _is_built(build: str) -> bool:
    return any((_HERE / f"_{build}" / f"loop{end}").exists() for end in EXTENSION_SUFFIXES)


def _has_avx2() -> bool:
    """Return whether the processor has AVX2, from a module that runs on any."""
    package = sys.modules[__package__]
    package.__path__ = [str(_HERE / "_baseline"), *package.__path__]
    return bool(importlib.import_module("gazelle.native.processor").has_avx2())


BUILD: Final = _chosen()
"""The build that this process uses."""
