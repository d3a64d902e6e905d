"""Descriptions of robots, with xacro expanded."""

from __future__ import annotations

from collections.abc import Sequence

from gazelle.clients.descriptions import load_urdf, read_urdf
from gazelle.drop_in.frobs_rl.common.connection import (
    in_folder,
    log_error,
    node,
    parameter,
    reporting,
    xacro_arguments,
)
from gazelle.errors import Error


@reporting
def urdf_load_from_pkg(
    pkg_name: str,
    model_name: str,
    param_name: str,
    folder: str = "/urdf",
    ns: str | None = None,
    args_xacro: Sequence[str] | None = None,
) -> None:
    """Load the description in a package's file into a parameter; returns whether it succeeded.

    Args:
        pkg_name: The package.
        model_name: The file, URDF or xacro.
        param_name: The parameter.
        folder: Folder of the file in the package.
        ns: Namespace of the parameter.
        args_xacro: Such as ``["camera:=true"]``.
    """
    load_urdf(
        node(),
        in_folder(folder, model_name),
        package=pkg_name,
        xacro_args=xacro_arguments(args_xacro),
        parameter=parameter(ns, param_name),
    )


@reporting
def urdf_load_from_path(
    model_path: str, param_name: str, ns: str | None = None, args_xacro: Sequence[str] | None = None
) -> None:
    """Load the description in a file into a parameter; returns whether it succeeded."""
    load_urdf(
        node(),
        model_path,
        xacro_args=xacro_arguments(args_xacro),
        parameter=parameter(ns, param_name),
    )


def urdf_parse_from_pkg(
    pkg_name: str,
    model_name: str,
    folder: str = "/urdf",
    args_xacro: Sequence[str] | None = None,
) -> str | None:
    """Return the description in a package's file; None, with a logged error, if it is invalid."""
    return _parsed(in_folder(folder, model_name), pkg_name, args_xacro)


def urdf_parse_from_path(model_path: str, args_xacro: Sequence[str] | None = None) -> str | None:
    """Return the description in a file; None, with a logged error, if it is invalid."""
    return _parsed(model_path, None, args_xacro)


def _parsed(path: str, package: str | None, words: Sequence[str] | None) -> str | None:
    try:
        return read_urdf(path, package=package, xacro_args=xacro_arguments(words))
    except Error as error:
        log_error(f"the description is not read: {error}")
        return None
