"""The node ``joy_node``: a joystick of this machine on ``joy`` (http://wiki.ros.org/joy)."""

from __future__ import annotations

import logging
import os
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass

from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.diagnostics import ERROR, OK, DiagnosticPublisher
from gazelle_ros.builtin.joysticks.device import FOLDER, LinuxJoystick, joysticks
from gazelle_ros.builtin.joysticks.state import FULL_SCALE, JoystickState
from gazelle_ros.builtin.parameters import settings_of
from gazelle_ros.msgs import sensor_msgs, std_msgs
from gazelle_ros.node import Node
from gazelle_ros.time import Time

_LOG = logging.getLogger("gazelle.ros.joy")
_RETRY_S = 1.0
_LOOK_S = 0.2
_REPORT_S = 1.0
_WIDEST = 0.9


@dataclass(frozen=True, slots=True)
class JoySettings:
    """Parameters of ``joy_node``, with its defaults.

    Attributes:
        dev: Device of the joystick.
        dev_name: Name of the joystick, instead of the device.
        dev_ff: Device for force feedback, which there is not.
        deadzone: Part of an axis around its middle that counts as the middle.
        autorepeat_rate: Rate at which a state without changes is sent again [Hz]; 0 for never.
        coalesce_interval: Events of axes within this time are sent together [s].
        default_trig_val: Take the first values of axes.
        sticky_buttons: A press toggles a button.
    """

    dev: str = "/dev/input/js0"
    dev_name: str = ""
    dev_ff: str = "/dev/input/event0"
    deadzone: float = 0.05
    autorepeat_rate: float = 0.0
    coalesce_interval: float = 0.001
    default_trig_val: bool = False
    sticky_buttons: bool = False


class JoyNode:
    """State of a joystick on ``joy``, whenever it changes.

    Args:
        node: On the graph.

    Raises:
        Error: A parameter is wrong.
    """

    def __init__(self, node: Node) -> None:
        self._node = node
        self.settings = settings = settings_of(node, JoySettings)
        self._device = _device_of(settings)
        self._deadzone = _deadzone_of(settings)
        self._repeat_s = 1.0 / settings.autorepeat_rate if settings.autorepeat_rate > 0.0 else None
        self._joy = node.advertise("joy", sensor_msgs.msg.Joy, queue_size=1)
        self._diagnostics = DiagnosticPublisher(node, "Joystick Driver Status")
        self._reported = time.monotonic()
        self._events = self._sent = 0

    def run(self, stop: threading.Event) -> None:
        """Publish the joystick's state until shutdown; one that is not there is waited for."""
        warned = False
        while not stop.is_set() and not self._node.closed:
            self._report(is_open=False)
            try:
                with LinuxJoystick(self._device) as joystick:
                    _LOG.info("opened the joystick %s (%s)", self._device, joystick.name)
                    warned = False
                    self._follow(joystick, stop)
            except OSError as error:
                if not warned:
                    warned = True
                    _LOG.error(
                        "%s; retrying every second", _failure(self._device, error)
                    )  # no fault of the program
                stop.wait(_RETRY_S)

    def _follow(self, joystick: LinuxJoystick, stop: threading.Event) -> None:
        """Publish an open joystick's state until shutdown.

        Raises:
            OSError: It is gone.
        """
        state = JoystickState(
            self._deadzone, self.settings.sticky_buttons, self.settings.default_trig_val
        )
        self._report(is_open=True)
        due: float | None = None  # when to publish, at the latest
        pending = False
        while not stop.is_set() and not self._node.closed:
            now = time.monotonic()
            events = joystick.wait(min(_LOOK_S, _LOOK_S if due is None else due - now))
            self._events += len(events)
            at_once = [state.take(each) for each in events]  # of all, so no generator
            if any(at_once) or (not events and due is not None and time.monotonic() >= due):
                self._publish(state)
                due, pending = None, False
            elif events and not pending:
                due, pending = time.monotonic() + self.settings.coalesce_interval, True
            if due is None and self._repeat_s is not None:
                due = time.monotonic() + self._repeat_s
            if time.monotonic() - self._reported > _REPORT_S:
                self._report(is_open=True)

    def _publish(self, state: JoystickState) -> None:
        stamp = Time(nsecs=self._node.clock.now())
        self._joy.publish(
            sensor_msgs.msg.Joy(
                header=std_msgs.msg.Header(stamp=stamp, frame_id=self._device),
                axes=list(state.axes),
                buttons=list(state.buttons),
            )
        )
        self._sent += 1

    def _report(self, *, is_open: bool) -> None:
        now = time.monotonic()
        interval = max(now - self._reported, 1e-3)
        values = {
            "topic": self._joy.name,
            "device": self._device,
            "device name": self.settings.dev_name,
            "dead zone": self._deadzone,
            "autorepeat rate (Hz)": self.settings.autorepeat_rate,
            "coalesce interval (s)": self.settings.coalesce_interval,
            "recent joystick event rate (Hz)": self._events / interval,
            "recent publication rate (Hz)": self._sent / interval,
            "subscribers": self._joy.num_connections,
            "default trig val": self.settings.default_trig_val,
            "sticky buttons": self.settings.sticky_buttons,
        }
        level, text = (OK, "OK") if is_open else (ERROR, "Joystick not open.")
        self._diagnostics.publish(values, text, level)
        self._reported, self._events, self._sent = now, 0, 0


def main(arguments: Sequence[str]) -> int:
    """Publish a joystick's state until shutdown; returns the exit code."""
    return run_node(arguments, "joy_node", JoyNode)


def _device_of(settings: JoySettings) -> str:
    """Return the device: that of the name, or the default."""
    if not settings.dev_name:
        return settings.dev
    known = joysticks()
    found = next((path for path, name in known.items() if name == settings.dev_name), None)
    if found is None:
        _LOG.error(
            "there is no joystick '%s' but %s; %s is taken",
            settings.dev_name,
            ", ".join(f"'{each}'" for each in known.values()) or "none",
            settings.dev,
        )
    return found or settings.dev


def _deadzone_of(settings: JoySettings) -> float:
    """Return the dead zone, 0 to 0.9."""
    found = settings.deadzone
    if found >= 1.0:
        _LOG.warning("a deadzone of %g is taken for %g / 32767: it is a part of 1", found, found)
        found /= FULL_SCALE
    allowed = min(max(found, 0.0), _WIDEST)
    if allowed != found:
        _LOG.warning("a deadzone of %g is taken for %g", found, allowed)
    return allowed


def _failure(device: str, error: OSError) -> str:
    """Return why a device cannot be read, and what to do."""
    text = f"the joystick {device} cannot be read: {error.strerror or error}"
    if isinstance(error, PermissionError):
        return f"{text} (add yourself to the group 'input', or run: sudo chmod a+r {device})"
    others = [each for each in joysticks() if each != device]
    if others:
        return f"{text} (set ~dev to one of {', '.join(others)})"
    if not FOLDER.is_dir():
        return f"{text} (this machine shows no input devices, as in a container)"
    return text if os.path.exists(device) else f"{text} (no joystick is plugged in)"  # noqa: PTH110  # any text
