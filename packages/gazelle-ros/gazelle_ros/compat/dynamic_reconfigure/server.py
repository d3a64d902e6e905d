"""Server for changes of this node's parameters."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from gazelle_ros.compat.dynamic_reconfigure import DynamicReconfigureCallbackException
from gazelle_ros.compat.dynamic_reconfigure.encoding import (
    Config,
    decode_config,
    encode_config,
    encode_description,
    extract_params,
    initial_config,
)
from gazelle_ros.compat.rospy.names import resolve_name
from gazelle_ros.compat.rospy.params import get_param, set_param
from gazelle_ros.compat.rospy.service import Service
from gazelle_ros.compat.rospy.topics import Publisher
from gazelle_ros.msgs import dynamic_reconfigure


class Server:
    """Offers parameters for changing.

    Args:
        type: The module generated from a ``.cfg`` file: with ``defaults``, ``min``, ``max``,
            ``level`` and ``config_description``.
        callback: Called with the values and the bits of what changed; returns the values to
            take.
        namespace: Namespace of the parameters, below the node's name.
    """

    def __init__(
        self,
        type: Any,  # noqa: A002  # dynamic_reconfigure's interface
        callback: Callable[[Config, int], Config],
        namespace: str = "",
    ) -> None:
        self.mutex = threading.RLock()
        self.type = type
        self.callback = callback
        self.ns = f"~{namespace}/" if namespace else "~"
        self.description = encode_description(type)
        self.config = initial_config(encode_config(type.defaults), type.config_description)
        self._load()
        values = dynamic_reconfigure.msg.Config
        self.descr_topic = Publisher(
            f"{self.ns}parameter_descriptions",
            dynamic_reconfigure.msg.ConfigDescription,
            latch=True,
            queue_size=10,
        )
        self.descr_topic.publish(self.description)
        self.update_topic = Publisher(
            f"{self.ns}parameter_updates", values, latch=True, queue_size=10
        )
        self._change(self.config, _all_levels(type.level))
        self.set_service = Service(
            f"{self.ns}set_parameters",
            dynamic_reconfigure.srv.Reconfigure,
            self._handle_request,
        )

    def update_configuration(self, changes: dict[str, Any]) -> Config:
        """Set values, and return all of them as accepted."""
        with self.mutex:
            wanted = self.config.copy()
            wanted.update(changes)
            self._clamp(wanted)
            return self._change(wanted, self._level(wanted))

    def _load(self) -> None:
        for each in extract_params(self.type.config_description):
            name = each["name"]
            self.config[name] = get_param(resolve_name(self.ns + name), self.config[name])
        self._clamp(self.config)

    def _clamp(self, config: Config) -> None:
        for name, kind in ((e["name"], e["type"]) for e in self._described()):
            if kind in {"int", "double"}:
                config[name] = min(max(config[name], self.type.min[name]), self.type.max[name])

    def _described(self) -> list[dict[str, Any]]:
        return extract_params(self.type.config_description)

    def _level(self, config: Config) -> int:
        level = 0
        for each in self._described():
            if config[each["name"]] != self.config[each["name"]]:
                level |= each["level"]
        return level

    def _change(self, config: Config, level: int) -> Config:
        taken = self.callback(config, level)
        if taken is None:
            raise DynamicReconfigureCallbackException(
                "the callback returned None; it must return the values to take"
            )
        self.config = taken
        for each in self._described():
            set_param(resolve_name(self.ns + each["name"]), taken[each["name"]])
        self.update_topic.publish(encode_config(taken, flat=False))
        return taken

    def _handle_request(self, request: dynamic_reconfigure.srv.ReconfigureRequest) -> Any:
        changes = decode_config(request.config)
        with self.mutex:
            return {"config": encode_config(self.update_configuration(changes), flat=False)}


def _all_levels(levels: dict[str, int]) -> int:
    every = 0
    for level in levels.values():
        every |= level
    return every
