"""Names of topics: what a plugin's file asks for, in the namespace that it is in."""

from __future__ import annotations

from typing import Protocol

from gazelle.description import Parameters


class Spawned(Protocol):
    """A model in a running simulation."""

    namespace: str


def namespace_of(robot: Spawned, parameters: Parameters, otherwise: str = "") -> str:
    """The namespace of a plugin: its ``robotNamespace``, else the one it was spawned in.

    As Gazebo gives the latter to plugins without the tag, an empty tag keeps it away.

    Args:
        robot: Whose plugin it is.
        parameters: Of the plugin.
        otherwise: If neither says anything; many of Gazebo's plugins take the model's name.
    """
    given = "robotNamespace" in parameters
    return (parameters.get("robotNamespace", "") if given else robot.namespace) or otherwise


def absolute(namespace: str, name: str) -> str:
    """A topic's full name; one that begins with a slash is full already."""
    if name.startswith("/"):
        return name
    parts = [*namespace.split("/"), *name.split("/")]
    return "/" + "/".join(part for part in parts if part)
