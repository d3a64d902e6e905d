"""The nodelet ``cmd_vel_mux``: the velocity command of highest priority (http://wiki.ros.org/yocs_cmd_vel_mux)."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gazelle_ros.base.errors import FormatError, RosError
from gazelle_ros.base.text_files import read_text
from gazelle_ros.base.tuned_fields import tunable
from gazelle_ros.builtin.arguments import CallbackWork, run_node
from gazelle_ros.builtin.mux_inputs import MuxInput, mux_input
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.clock import SECOND
from gazelle_ros.launch.values import load_yaml
from gazelle_ros.msgs import geometry_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.publishing import Publisher
from gazelle_ros.subscribing import Subscriber

IDLE = "idle"
_HIGHEST = 2**31 - 1
_LOOK_S = 0.02
"""Time between two looks for sources that fell silent [s]."""


@dataclass(slots=True)
class Control:
    """The source whose commands pass.

    Attributes:
        holder: The source; None while there is none.
    """

    holder: MuxInput | None = None

    def expire(self, now: int) -> bool:
        """Release control if its holder has been silent for its timeout at a time [ns].

        Returns:
            Whether it was released.
        """
        if self.holder is None:
            return False
        silent = now - self.holder.stamp
        if 0 <= silent < self.holder.timeout * SECOND:
            return False
        self.holder = None
        return True

    def request(self, source: MuxInput, now: int) -> bool:
        """Return whether a command that a source sends at a time [ns] passes.

        It does if no source has control, the source itself has, or one of lower priority.
        """
        source.stamp = now
        if self.holder is None or source.priority > self.holder.priority:
            self.holder = source
        return self.holder is source


@dataclass(frozen=True, slots=True)
class CmdVelMuxSettings:
    """Place of the description of the sources.

    Attributes:
        yaml_cfg_file: A YAML file.
        yaml_cfg_data: YAML text, which comes before the file.
    """

    yaml_cfg_file: str = tunable("", description="YAML file with the sources")
    yaml_cfg_data: str = tunable("", description="YAML text with the sources")


class CmdVelMux(CallbackWork):
    """Commands of several topics on one, and on ``~active`` the name of the source in control.

    Args:
        node: On the graph, with the parameter ``~yaml_cfg_file``.

    Raises:
        Error: The file is not there, or malformed.
    """

    def __init__(self, node: Node) -> None:
        super().__init__(node)
        self._lock = threading.Lock()
        self._output: Publisher | None = None
        self._subscribers: list[Subscriber] = []
        self.inputs: list[MuxInput] = []
        self.control = Control()
        self._active = node.advertise("~active", std_msgs.msg.String, queue_size=1, latch=True)
        self._publish_active(IDLE)
        settings = settings_of(node, CmdVelMuxSettings)
        self._configure(settings)
        self._tuned = TunedSettings(node, settings, self._configure)

    def run(self, stop: threading.Event) -> None:
        """Watch for sources that fall silent, until shutdown."""
        while not self.node.closed and not stop.wait(_LOOK_S):
            with self._lock:
                self._expire(self.node.clock.now())

    def _configure(self, settings: CmdVelMuxSettings) -> None:
        """Take the sources from a description, in place of those before."""
        where = settings.yaml_cfg_file or self.node.resolve("~yaml_cfg_data")
        output, inputs = _read(settings, where)
        with self._lock:
            for each in self._subscribers:
                each.close()
            if self._output is None or self._output.name != self.node.resolve(f"~{output}"):
                if self._output is not None:
                    self._output.close()
                self._output = self.node.advertise(f"~{output}", geometry_msgs.msg.Twist)
            self.inputs = inputs
            if self.control.holder is not None:
                self.control.holder = None
                self._publish_active(IDLE)
        self._subscribers = [
            self.node.subscribe(f"~{each.topic}", geometry_msgs.msg.Twist, self._taker(each))
            for each in inputs
        ]

    def _taker(self, source: MuxInput) -> Callable[[geometry_msgs.msg.Twist], None]:
        def take(message: geometry_msgs.msg.Twist) -> None:
            with self._lock:
                now = self.node.clock.now()
                self._expire(now)
                before = self.control.holder
                if not self.control.request(source, now):
                    return
                if before is not source:
                    self._publish_active(source.name)
                if self._output is not None:
                    self._output.publish(message)

        return take

    def _expire(self, now: int) -> None:
        if self.control.expire(now):
            self._publish_active(IDLE)

    def _publish_active(self, name: str) -> None:
        self._active.publish(std_msgs.msg.String(data=name))


def main(arguments: Sequence[str]) -> int:
    """Pass on the command of highest priority until shutdown; returns the exit code."""
    return run_node(arguments, "cmd_vel_mux", CmdVelMux)


def _read(settings: CmdVelMuxSettings, where: str) -> tuple[str, list[MuxInput]]:
    """Return the topic of the output and the sources of a description."""
    text = settings.yaml_cfg_data
    if not text:
        if not settings.yaml_cfg_file:
            raise RosError("no sources are configured", hint="set ~yaml_cfg_file to a YAML file")
        try:
            text = read_text(Path(settings.yaml_cfg_file))
        except (OSError, ValueError, FormatError) as error:
            raise RosError(f"the configuration file '{where}' cannot be read: {error}") from None
    found: Any = load_yaml(text, where)
    listed = found.get("subscribers") if isinstance(found, dict) else None
    if not isinstance(listed, list) or not listed:
        raise RosError(f"{where} has no list 'subscribers' of name, topic, timeout and priority")
    output = found.get("publisher", "output")
    if not isinstance(output, str) or not output:
        raise RosError(f"the publisher of {where} must be a topic, not {output!r:.60}")
    inputs = [
        mux_input(f"subscribers[{number}] of {where}", each, highest=_HIGHEST, ignored=("short_desc",))
        for number, each in enumerate(listed)
    ]  # fmt: skip
    return output, inputs
