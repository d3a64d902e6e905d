"""A dynamic_reconfigure server on a node (http://wiki.ros.org/dynamic_reconfigure)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from gazelle.ros import Node, load_message, load_service

_LISTS = {bool: "bools", int: "ints", str: "strs", float: "doubles"}
_MESSAGES = {
    bool: "BoolParameter",
    int: "IntParameter",
    str: "StrParameter",
    float: "DoubleParameter",
}
_WORDS = {bool: "bool", int: "int", str: "str", float: "double"}

Values = dict[str, Any]


@dataclass(frozen=True, slots=True)
class Parameter:
    """A parameter that can be changed while its owner runs.

    Attributes:
        name: Its name.
        default: Its type is that of the parameter: bool, int, str or float.
        least: Smallest value.
        most: Largest value.
        description: For people.
    """

    name: str
    default: Any
    least: Any
    most: Any
    description: str

    def clamp(self, value: Any) -> Any:
        """The allowed value that is nearest."""
        kind = type(self.default)
        if kind in (bool, str):
            return kind(value)
        return kind(min(max(value, self.least), self.most))


class ReconfigureServer:
    """Offers parameters under a namespace.

    Args:
        node: Serves and publishes.
        namespace: Where ``set_parameters`` and its topics are.
        parameters: What can be changed.
        change: Called with all values; returns those that hold then.
        values: Those that hold now.
    """

    def __init__(
        self,
        node: Node,
        namespace: str,
        parameters: Sequence[Parameter],
        change: Callable[[Values], Values],
        values: Values,
    ) -> None:
        self._parameters = {parameter.name: parameter for parameter in parameters}
        self._change = change
        self._values = dict(values)
        self._node, self._namespace = node, namespace
        self._descriptions = node.advertise(
            f"{namespace}/parameter_descriptions", _message("ConfigDescription"), latch=True
        )
        self._updates = node.advertise(
            f"{namespace}/parameter_updates", _message("Config"), latch=True
        )
        self._service = node.serve(
            f"{namespace}/set_parameters",
            load_service("dynamic_reconfigure/Reconfigure"),
            self._set,
        )
        self._descriptions.publish(self._describe())
        self._updates.publish(_config(self._values))

    def close(self) -> None:
        """Take it off the graph."""
        self._service.close()
        self._descriptions.close()
        self._updates.close()

    def _set(self, request: Any) -> Any:
        wanted = dict(self._values)
        for kind in _LISTS.values():
            for each in getattr(request.config, kind):
                if each.name in self._parameters:
                    wanted[each.name] = self._parameters[each.name].clamp(each.value)
        self._values = self._change(wanted)
        config = _config(self._values)
        self._updates.publish(config)
        return {"config": config}

    def _describe(self) -> Any:
        description = _message("ConfigDescription")()
        group = _message("Group")(name="Default", type="", parent=0, id=0)
        describe = _message("ParamDescription")
        for parameter in self._parameters.values():
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
        parameters = self._parameters.values()
        description.max = _config({each.name: each.most for each in parameters})
        description.min = _config({each.name: each.least for each in parameters})
        description.dflt = _config({each.name: each.default for each in parameters})
        return description


def _message(name: str) -> Any:
    return load_message(f"dynamic_reconfigure/{name}")


def _config(values: Values) -> Any:
    config = _message("Config")()
    for name, value in values.items():
        kind = next(each for each in _LISTS if isinstance(value, each))
        getattr(config, _LISTS[kind]).append(_message(_MESSAGES[kind])(name=name, value=value))
    config.groups.append(_message("GroupState")(name="Default", state=True, id=0, parent=0))
    return config
