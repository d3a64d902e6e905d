"""The ``xacro`` program, and the package as it is in ROS 1."""

from __future__ import annotations

import contextlib
import sys
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from gazelle_ros.base import xacro_engine
from gazelle_ros.base.errors import Error, RosError
from gazelle_ros.launch.packages import Packages

_FOLDER = Path(__file__).resolve().parent / "share" / "xacro"
_NO_EFFECT = {"--inorder", "-i", "--xacro-ns"}
"""Options of older versions that are the default now."""


def main(arguments: Sequence[str]) -> int:
    """Expand a file to standard output, or to that of ``-o``; returns the exit code."""
    # Spawners pass on what roslaunch gave them, such as __name:=.
    kept = [each for each in arguments if each not in _NO_EFFECT and not each.startswith("__")]
    sys.argv = ["xacro", *kept]
    # The program lies in the package's folder, where it has the name of the module.
    sys.path[:] = [each for each in sys.path if Path(each or ".").resolve() != _FOLDER]
    with as_in_ros1() as xacro:
        try:
            xacro.main()
        except SystemExit as stop:
            return stop.code if isinstance(stop.code, int) else 1 if stop.code else 0
    return 0


def expand(file: str | Path, arguments: Mapping[str, str]) -> str:
    """Return the text of a file with xacro expanded.

    Args:
        file: URDF with or without xacro.
        arguments: Values of its ``<xacro:arg>``.

    Raises:
        RosError: It cannot be expanded.
    """
    with as_in_ros1() as xacro:
        try:
            document = xacro.process_file(str(file), mappings=dict(arguments))
        except Exception as error:
            raise RosError(f"xacro cannot expand it: {error}", file=str(file)) from error
    return str(document.toprettyxml(indent="  "))


@contextlib.contextmanager
def as_in_ros1() -> Iterator[Any]:
    """Adapt the package to ROS 1's packages and names while it lasts; yields the package."""
    xacro = xacro_engine.engine()
    packages, reported, plain = Packages(), set[str](), xacro.eval_extension

    def find(package: str) -> str:
        return str(packages.folder(package))

    def report(tag: str, node: Any) -> None:
        del node
        if tag not in reported and xacro.verbosity > 0:
            reported.add(tag)
            place = f"{xacro.filestack[-1]}: " if xacro.filestack and xacro.filestack[-1] else ""
            xacro.warning(
                f"{place}<{tag}> {xacro_engine.NO_PREFIX}; write <{xacro_engine.PREFIX}{tag}>"
            )

    def eval_extension(text: str) -> Any:
        try:
            return plain(text)
        except xacro.XacroException as error:
            if isinstance(error.exc, Error):
                raise xacro.XacroException(str(error.exc)) from error.exc
            raise

    names = {"eval_extension": eval_extension, **_older_names(xacro)}
    with (
        xacro_engine.adapted(find, report),
        xacro_engine.replaced(vars(xacro), names),
    ):
        yield xacro


def _older_names(xacro: Any) -> dict[str, Any]:
    """Return what scripts call that is no longer in the package."""
    context = xacro.substitution_args_context

    def set_context(values: Mapping[str, Any] | None = None) -> None:
        context["arg"] = dict(values or {})

    def unchanged(document: Any, *_: Any, **__: Any) -> Any:
        return document

    return {
        "get_substitution_args_context": lambda: context,
        "load_mappings": sys.modules["xacro.cli"].load_mappings,
        "process_includes": unchanged,
        "set_substitution_args_context": set_context,
    }
