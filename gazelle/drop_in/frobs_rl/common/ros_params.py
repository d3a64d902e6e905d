"""Set parameters from YAML files; each helper returns whether it succeeded."""

from __future__ import annotations

from gazelle.clients.descriptions import load_parameters
from gazelle.drop_in.frobs_rl.common.connection import in_folder, node, reporting


@reporting
def ros_load_yaml_from_pkg(pkg_name: str, file_name: str, ns: str = "/") -> None:
    """Set all parameters of a file in the folder ``config`` of a package."""
    file = in_folder("config", file_name)
    load_parameters(node(), file, package=pkg_name, namespace=_namespace(ns))


@reporting
def ros_load_yaml_from_path(file_path: str, ns: str = "/") -> None:
    """Set all parameters of a file."""
    load_parameters(node(), file_path, namespace=_namespace(ns))


def _namespace(ns: str | None) -> str:
    return "/" + (ns or "").strip("/")
