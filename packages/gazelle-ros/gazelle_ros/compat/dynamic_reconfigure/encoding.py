"""Parameters between dicts and messages."""

from __future__ import annotations

from typing import Any, Self

from gazelle_ros.compat.dynamic_reconfigure import DynamicReconfigureParameterException
from gazelle_ros.messages import load_message
from gazelle_ros.msgs import dynamic_reconfigure

_FIELDS = {"bool": "bools", "int": "ints", "str": "strs", "double": "doubles"}
_CLASSES = {"bool": "Bool", "int": "Int", "str": "Str", "double": "Double"}
_PYTHON: dict[str, Any] = {"bool": bool, "int": int, "str": str, "double": float}


class Config(dict[str, Any]):
    """Values by name; reached as attributes, too."""

    def __getattr__(self, name: str) -> Any:
        if name in self:
            return self[name]
        raise AttributeError(name)

    def __setattr__(self, name: str, value: Any) -> None:
        self[name] = value

    def copy(self) -> Self:
        """Return the same values in another object."""
        return type(self)(self)


def _message(name: str) -> Any:
    return load_message(f"dynamic_reconfigure/{name}")


def _kind(name: str, value: Any) -> str:
    """Return the kind of a value's parameter."""
    for kind, python in _PYTHON.items():
        if type(value) is python:
            return kind
    raise DynamicReconfigureParameterException(f"{name} has a value of no known type: {value!r}")


def encode_config(config: dict[str, Any], flat: bool = True) -> Any:  # noqa: FBT001, FBT002  # dynamic_reconfigure's interface
    """Return the ``Config`` message of values.

    Raises:
        DynamicReconfigureParameterException: A value is of no known type.
    """
    message = _message("Config")()
    for name, value in config.items():
        if name == "groups":
            if not flat:
                _put_groups(message, value)
            continue
        kind = _kind(name, value)
        getattr(message, _FIELDS[kind]).append(
            _message(f"{_CLASSES[kind]}Parameter")(name=name, value=value)
        )
    return message


def _put_groups(message: dynamic_reconfigure.msg.Config, group: dict[str, Any]) -> None:
    message.groups.append(
        _message("GroupState")(
            name=group["name"], state=group["state"], id=group["id"], parent=group["parent"]
        )
    )
    for each in group.get("groups", {}).values():
        _put_groups(message, each)


def decode_config(msg: dynamic_reconfigure.msg.Config, description: Any = None) -> Config:
    """Return the values of a ``Config`` message.

    Args:
        msg: The message.
        description: Of the groups; with it, they are among the values.
    """
    config = Config(
        {each.name: each.value for field in _FIELDS.values() for each in getattr(msg, field)}
    )
    if description is not None:
        config["groups"] = initial_groups(description)
        states = {(each.id, each.name): each.state for each in msg.groups}
        _set_states(config["groups"], states)
    return config


def _set_states(group: dict[str, Any], states: dict[tuple[int, str], bool]) -> None:
    group["state"] = states.get((group["id"], group["name"]), group["state"])
    for each in group["groups"].values():
        _set_states(each, states)


def initial_groups(group: dict[str, Any]) -> Config:
    """Return the state of a described group and those in it."""
    return Config(
        name=group["name"],
        state=group.get("state", True),
        id=group["id"],
        parent=group["parent"],
        type=group.get("type", ""),
        parameters=Config({each["name"]: each["default"] for each in group["parameters"]}),
        groups=Config({each["name"]: initial_groups(each) for each in group["groups"]}),
    )


def initial_config(msg: dynamic_reconfigure.msg.Config, description: Any = None) -> Config:
    """Return the values of a message, and the groups of a description."""
    return decode_config(msg, description)


def extract_params(group: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the parameters described in a group and those in it."""
    found = list(group["parameters"])
    for each in group["groups"]:
        found += extract_params(each)
    return found


def encode_description(descr: Any) -> Any:
    """Return the ``ConfigDescription`` message of a generated module."""
    message = _message("ConfigDescription")()
    message.max = encode_config(descr.max)
    message.min = encode_config(descr.min)
    message.dflt = encode_config(descr.defaults)
    _put_group(message, descr.config_description)
    return message


def _put_group(message: Any, group: dict[str, Any]) -> None:
    describe = _message("ParamDescription")
    message.groups.append(
        _message("Group")(
            name=group["name"],
            type=group.get("type", ""),
            id=group["id"],
            parent=group["parent"],
            parameters=[
                describe(
                    name=each["name"],
                    type=each["type"],
                    level=each["level"],
                    description=each["description"],
                    edit_method=each["edit_method"],
                )
                for each in group["parameters"]
            ],
        )
    )
    for each in group["groups"]:
        _put_group(message, each)


def decode_description(msg: dynamic_reconfigure.msg.ConfigDescription) -> Config:
    """Return the groups of a ``ConfigDescription`` message, as nested dicts."""
    least, most, usual = (decode_config(each) for each in (msg.min, msg.max, msg.dflt))
    groups = {}
    for each in msg.groups:
        parameters = [
            {
                "name": param.name,
                "min": least.get(param.name),
                "max": most.get(param.name),
                "default": usual.get(param.name),
                "type": param.type,
                "description": param.description,
                "edit_method": param.edit_method,
                "level": param.level,
            }
            for param in each.parameters
        ]
        groups[each.id] = Config(
            name=each.name,
            type=each.type,
            id=each.id,
            parent=each.parent,
            parameters=parameters,
            groups=[],
            state=True,
        )
    for number, group in groups.items():
        if group["parent"] in groups and group["parent"] != number:
            groups[group["parent"]]["groups"].append(group)
    return groups.get(0, Config(name="Default", id=0, parent=0, parameters=[], groups=[]))
