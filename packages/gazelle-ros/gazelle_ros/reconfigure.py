"""A dynamic_reconfigure server on a node (http://wiki.ros.org/dynamic_reconfigure)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Protocol

from gazelle_ros.msgs import dynamic_reconfigure
from gazelle_ros.node import Node

_LISTS = {bool: "bools", int: "ints", str: "strs", float: "doubles"}
_MESSAGES = {
    bool: "BoolParameter",
    int: "IntParameter",
    str: "StrParameter",
    float: "DoubleParameter",
}
_WORDS = {bool: "bool", int: "int", str: "str", float: "double"}

Values = dict[str, Any]


class TunedValue(Protocol):
    """A number, flag or text that can be changed."""

    @property
    def name(self) -> str:
        """Name of the value."""

    @property
    def default(self) -> Any:
        """Default value: its type, bool, int, str or float, is that of all values."""

    @property
    def least(self) -> Any:
        """Smallest value."""

    @property
    def most(self) -> Any:
        """Largest value."""

    @property
    def description(self) -> str:
        """Description for people."""


class Tuned(Protocol):
    """Values that are changed together, from any thread."""

    @property
    def tunables(self) -> Mapping[str, TunedValue]:
        """Values that can be changed."""

    @property
    def values(self) -> Values:
        """Current values."""

    def send(self, /, **requested: Any) -> Values:
        """Set some values; returns the values in effect."""


class ReconfigureServer:
    """Offers a tuning, and keeps what holds on the parameter server.

    Args:
        node: Serves and publishes.
        namespace: Of the service and the topics.
        tuning: Parameters that can be changed.
    """

    def __init__(self, node: Node, namespace: str, tuning: Tuned) -> None:
        self._tuning, self._node, self._namespace = tuning, node, namespace
        self._descriptions = node.advertise(
            f"{namespace}/parameter_descriptions",
            dynamic_reconfigure.msg.ConfigDescription,
            latch=True,
        )
        self._updates = node.advertise(
            f"{namespace}/parameter_updates", dynamic_reconfigure.msg.Config, latch=True
        )
        self._service = node.serve(
            f"{namespace}/set_parameters",
            dynamic_reconfigure.srv.Reconfigure,
            self._set,
        )
        self._descriptions.publish(self._describe())
        self._publish_values(tuning.values)

    def close(self) -> None:
        """Remove it from the graph."""
        self._service.close()
        self._descriptions.close()
        self._updates.close()

    def _set(
        self, request: dynamic_reconfigure.srv.ReconfigureRequest
    ) -> dict[str, dynamic_reconfigure.msg.Config]:
        """Set known values; other names are ignored, as by the original."""
        requested = {
            each.name: each.value
            for kind in _LISTS.values()
            for each in getattr(request.config, kind)
            if each.name in self._tuning.tunables
        }
        return {"config": self._publish_values(self._tuning.send(**requested))}

    def _publish_values(self, values: Values) -> dynamic_reconfigure.msg.Config:
        config = _config(values)
        self._updates.publish(config)
        for name, value in values.items():
            self._node.set_param(f"{self._namespace}/{name}", value)
        return config

    def _describe(self) -> dynamic_reconfigure.msg.ConfigDescription:
        description = dynamic_reconfigure.msg.ConfigDescription()
        group = dynamic_reconfigure.msg.Group(name="Default", type="", parent=0, id=0)
        describe = dynamic_reconfigure.msg.ParamDescription
        for parameter in self._tuning.tunables.values():
            group.parameters.append(
                describe(
                    name=parameter.name,
                    type=_WORDS[type(parameter.default)],
                    level=1,
                    description=parameter.description,
                    edit_method="",
                )
            )
        description.groups.append(group)
        parameters = self._tuning.tunables.values()
        description.max = _config({each.name: each.most for each in parameters})
        description.min = _config({each.name: each.least for each in parameters})
        description.dflt = _config({each.name: each.default for each in parameters})
        return description


def _config(values: Values) -> dynamic_reconfigure.msg.Config:
    config = dynamic_reconfigure.msg.Config()
    for name, value in values.items():
        kind = next(each for each in _LISTS if isinstance(value, each))
        getattr(config, _LISTS[kind]).append(
            getattr(dynamic_reconfigure.msg, _MESSAGES[kind])(name=name, value=value)
        )
    config.groups.append(
        dynamic_reconfigure.msg.GroupState(name="Default", state=True, id=0, parent=0)
    )
    return config
