"""The one node of a process, as rospy has it: how it begins and how it ends."""

from __future__ import annotations

import atexit
import contextlib
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.interrupts import SignalRelay
from gazelle_ros.compat.rospy.exceptions import ROSInitException

if TYPE_CHECKING:
    from gazelle_ros.clock import TimeSource
    from gazelle_ros.node import Node

Hook = Callable[..., Any]
_PATIENCE_S = 5.0


class NodeProcessState:
    """State that the modules of rospy share.

    Attributes:
        node: The node; None before `init_node`.
        own_clock: Source of the time without a node; None if that is not known.
        shutdown: Set as soon as the node is to end.
        ready: Set while the node runs.
    """

    def __init__(self) -> None:
        self.node: Node | None = None
        self.own_clock: TimeSource | None = None
        self.shutdown = threading.Event()
        self.ready = threading.Event()
        self.waiting: list[Callable[[], None]] = []
        self.before: list[Hook] = []
        self.clients: list[Hook] = []
        self.after: list[Hook] = []
        self._lock = threading.RLock()
        self._done = threading.Event()
        self._ender: int | None = None
        self._hooking: int | None = None
        self._previous: dict[int, Any] = {}
        self._relay: SignalRelay | None = None

    def require(self) -> Node:
        """Return the node.

        Raises:
            ROSInitException: There is none yet.
        """
        if self.node is None:
            raise ROSInitException("client code must call rospy.init_node() first")
        return self.node

    @property
    def clock(self) -> TimeSource:
        """The node's clock.

        Raises:
            ROSInitException: There is no node yet.
        """
        if self.node is None and self.own_clock is not None:
            return self.own_clock
        if self.node is None:
            raise ROSInitException("time is not initialized. Have you called init_node()?")
        return self.node.clock

    def adopt(self, node: Node) -> None:
        """Set the node, and run the deferred actions."""
        self.node = node
        node.on_shutdown.append(self._on_node_shutdown)
        atexit.register(self._at_exit)

    def start(self) -> None:
        """Run the deferred actions."""
        self.ready.set()
        waiting, self.waiting = self.waiting, []
        for each in waiting:
            each()

    def when_ready(self, action: Callable[[], None]) -> None:
        """Call a function now, or once there is a node."""
        with self._lock:
            if self.node is None:
                self.waiting.append(action)
                return
        action()

    # The end ---------------------------------------------------------------------------------

    def end(self, reason: str) -> None:
        """Shut down: hooks first, then the node.

        Only the first call has an effect. Only the first call does it.
        """
        with self._lock:
            if self._ender is not None:
                return
            self._ender = threading.get_ident()
            self.shutdown.set()
        try:
            self._hooking = self._ender
            self._run(self.clients)
            self._run(self.before, reason)
            self._hooking = None
            self._run(self.after, reason)
        finally:
            if self.node is not None:
                with contextlib.suppress(Exception):
                    self.node.close()
            self._done.set()

    @property
    def over(self) -> bool:
        """True if waiting and sleeping must stop; hooks of a shutdown may still do both."""
        return self.shutdown.is_set() and not self.hooking

    @property
    def hooking(self) -> bool:
        """True on the thread that runs the user's shutdown hooks."""
        return self._hooking == threading.get_ident()

    def wait_ended(self) -> None:
        """Wait for the end of an end that another thread is busy with."""
        if self.shutdown.is_set() and self._ender not in {None, threading.get_ident()}:
            self._done.wait(_PATIENCE_S)

    def _run(self, hooks: list[Hook], *arguments: str) -> None:
        for hook in list(hooks):
            try:
                hook(*arguments)
            except Exception:  # noqa: BLE001  # the other hooks shall run too
                sys.stderr.write(f"signal_shutdown hook error[{traceback.format_exc()}]\n")

    def _on_node_shutdown(self, reason: str) -> None:
        self.end(f"external shutdown request from [{reason}]")

    def _at_exit(self) -> None:
        self.end("atexit")
        self.wait_ended()

    # Signals ---------------------------------------------------------------------------------

    def catch_signals(self) -> None:
        """Shut the node down at Ctrl-C and when the process is terminated."""
        self._relay = SignalRelay(self._end_apart)
        for number in (signal.SIGTERM, signal.SIGINT):
            self._previous[number] = signal.signal(number, self._on_signal)

    def _on_signal(self, number: int, frame: Any) -> None:
        # The main thread may hold any lock now, that of the event too, so another one does it all.
        if self._relay is not None:
            self._relay.post(number)
        previous = self._previous.get(number)
        if callable(previous):
            with contextlib.suppress(KeyboardInterrupt):
                previous(number, frame)

    def _end_apart(self, number: int) -> None:
        """Shut down on a thread that Python waits for, since hooks may take long."""
        threading.Thread(target=self.end, args=(f"signal-{number}",), name="shutdown").start()

    def reset(self) -> None:
        """Reset all state of the process; the node must be closed."""
        with contextlib.suppress(ValueError):  # only the main thread may set signals
            for number, previous in self._previous.items():
                signal.signal(number, previous)
        if self._relay is not None:
            self._relay.close()
        atexit.unregister(self._at_exit)
        self.__init__()  # type: ignore[misc]


process = NodeProcessState()
