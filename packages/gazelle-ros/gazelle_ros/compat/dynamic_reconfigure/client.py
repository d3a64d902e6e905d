"""Changes the parameters of another node."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle_ros.compat.dynamic_reconfigure import (
    DynamicReconfigureCallbackException,
    DynamicReconfigureParameterException,
)
from gazelle_ros.compat.dynamic_reconfigure.encoding import (
    Config,
    decode_config,
    decode_description,
    encode_config,
    extract_params,
)
from gazelle_ros.compat.rospy.exceptions import ServiceException
from gazelle_ros.compat.rospy.names import resolve_name
from gazelle_ros.compat.rospy.service import ServiceProxy, wait_for_service
from gazelle_ros.compat.rospy.state import process
from gazelle_ros.compat.rospy.topics import Subscriber
from gazelle_ros.msgs import dynamic_reconfigure

Callback = Callable[[Any], Any]
_TRUE, _FALSE = {"true", "1", "yes", "on"}, {"false", "0", "no", "off"}


class Client:
    """Follows and changes the parameters of a node.

    Args:
        name: Of the node.
        timeout: The longest wait for it [s]; None for ever.
        config_callback: Called with the values whenever they change.
        description_callback: Called with the descriptions of the parameters.

    Raises:
        ROSException: The node is not there in time.
    """

    def __init__(
        self,
        name: str,
        timeout: float | None = None,
        config_callback: Callback | None = None,
        description_callback: Callback | None = None,
    ) -> None:
        self.name = name
        self.config: Config | None = None
        self.param_description: list[dict[str, Any]] | None = None
        self.group_description: Config | None = None
        self.config_callback = config_callback
        self.description_callback = description_callback
        self._news = threading.Condition()
        kind = dynamic_reconfigure.srv.Reconfigure
        service = resolve_name(f"{name}/set_parameters")
        wait_for_service(service, timeout)
        self._set_service = ServiceProxy(service, kind)
        described = dynamic_reconfigure.msg.ConfigDescription
        values = dynamic_reconfigure.msg.Config
        self._subscribers = (
            Subscriber(f"{name}/parameter_descriptions", described, self._described),
            Subscriber(f"{name}/parameter_updates", values, self._updated),
        )

    def get_configuration(self, timeout: float | None = None) -> Config | None:
        """Return the values; None if they do not come in time [s]."""
        self._wait(lambda: self.config is not None, timeout)
        return self.config

    def get_parameter_descriptions(
        self, timeout: float | None = None
    ) -> list[dict[str, Any]] | None:
        """Return the description of each parameter; None if it does not come in time [s]."""
        self._wait(lambda: self.param_description is not None, timeout)
        return self.param_description

    def get_group_descriptions(self, timeout: float | None = None) -> Config | None:
        """Return the groups of parameters; None if they do not come in time [s]."""
        self._wait(lambda: self.group_description is not None, timeout)
        return self.group_description

    def _wait(self, done: Callable[[], bool], timeout: float | None) -> None:
        with self._news:
            self._news.wait_for(lambda: done() or process.shutdown.is_set(), timeout)

    def update_configuration(self, changes: dict[str, Any]) -> Config:
        """Set values; returns all of them as the node accepted them.

        Raises:
            DynamicReconfigureParameterException: There is no such parameter, or it cannot have
                the value.
            DynamicReconfigureCallbackException: The node refused.
        """
        described = self.get_parameter_descriptions(5.0) or []
        kinds = {each["name"]: each["type"] for each in described}
        cast = {
            name: value if name == "groups" else _cast(name, kinds, value)
            for name, value in changes.items()
        }
        try:
            answer = self._set_service(encode_config(cast, flat=False))
        except ServiceException as error:
            raise DynamicReconfigureCallbackException("service call failed") from error
        self.config = decode_config(answer.config, self.group_description)
        return self.config

    def update_groups(self, changes: dict[str, bool]) -> Config:
        """Enable and disable groups of parameters; see `update_configuration`."""
        groups = self.get_configuration() or Config()
        tree = groups.get("groups", Config())
        _switch(tree, changes)
        return self.update_configuration({"groups": tree})

    def close(self) -> None:
        """Stop following the node."""
        for subscriber in self._subscribers:
            subscriber.unregister()

    def get_config_callback(self) -> Callback | None:
        """Return the callback for values."""
        return self.config_callback

    def set_config_callback(self, value: Callback | None) -> None:
        """Call another function with the values, and at once if they are known."""
        self.config_callback = value
        if value is not None and self.config is not None:
            value(self.config)

    def get_description_callback(self) -> Callback | None:
        """Return the callback for descriptions."""
        return self.description_callback

    def set_description_callback(self, value: Callback | None) -> None:
        """Call another function with the descriptions, and at once if they are known."""
        self.description_callback = value
        if value is not None and self.param_description is not None:
            value(self.param_description)

    def _updated(self, message: dynamic_reconfigure.msg.Config) -> None:
        with self._news:
            self.config = decode_config(message, self.group_description)
            self._news.notify_all()
        if self.config_callback is not None:
            self.config_callback(self.config)

    def _described(self, message: dynamic_reconfigure.msg.ConfigDescription) -> None:
        with self._news:
            self.group_description = decode_description(message)
            self.param_description = extract_params(self.group_description)
            self._news.notify_all()
        if self.description_callback is not None:
            self.description_callback(self.param_description)


def _switch(group: dict[str, Any], changes: dict[str, bool]) -> None:
    for name, each in group.get("groups", {}).items():
        if name in changes:
            each["state"] = changes[name]
        _switch(each, changes)


def _cast(name: str, kinds: dict[str, str], value: Any) -> Any:
    """Convert a value to its parameter's type, from what users write."""
    kind = kinds.get(name)
    if kind is None:
        raise DynamicReconfigureParameterException(f"don't know parameter: {name}")
    try:
        if kind == "bool":
            word = str(value).strip().lower()
            if word not in _TRUE | _FALSE:
                raise ValueError("neither true nor false")  # noqa: TRY301  # one text for all types
            return word in _TRUE
        return {"int": int, "str": str, "double": float}[kind](value)
    except (KeyError, ValueError, TypeError) as error:
        text = f"can't set parameter '{name}' of type {kind} to {value!r}: {error}"
        raise DynamicReconfigureParameterException(text) from None
