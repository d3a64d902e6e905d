"""Names of topics: topics of a plugin's file in its namespace."""

from __future__ import annotations

from typing import Protocol

from gazelle.description import Parameters


class _Namespaced(Protocol):
    namespace: str


class _Host(Protocol):
    @property
    def ports(self) -> _Namespaced:
        """Ports of the world."""


class Spawned(Protocol):
    """A model in a running simulation."""

    namespace: str

    @property
    def simulation(self) -> _Host:
        """That it is in."""


def namespace_of(robot: Spawned, parameters: Parameters, otherwise: str = "") -> str:
    """Return the namespace of a plugin: its ``robotNamespace``, else the one it was spawned in.

    As Gazebo gives the latter to plugins without the tag, an empty tag keeps it away. One without a
    slash in front is in the namespace of the simulation.

    Args:
        robot: Owner of the plugin.
        parameters: Of the plugin.
        otherwise: If neither says anything; many of Gazebo's plugins take the model's name.
    """
    given = "robotNamespace" in parameters
    own = (parameters.get("robotNamespace", "") if given else robot.namespace) or otherwise
    base = robot.simulation.ports.namespace
    return f"{base}/{own}" if base and not own.startswith("/") else own


def absolute(namespace: str, name: str) -> str:
    """Return a topic's full name; one that begins with a slash is full already."""
    if name.startswith("/"):
        return name
    parts = [*namespace.split("/"), *name.split("/")]
    return "/" + "/".join(part for part in parts if part)
