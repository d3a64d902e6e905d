"""A launch that a script starts and ends."""

from __future__ import annotations

import atexit
import contextlib
import signal
import threading
from collections.abc import Callable, Iterable
from types import FrameType
from typing import Any

from gazelle_ros import net
from gazelle_ros.base.errors import Error
from gazelle_ros.base.interrupts import SignalRelay
from gazelle_ros.compat.roslaunch.core import Node, RLException, printlog
from gazelle_ros.compat.roslaunch.nodeprocess import (
    DEFAULT_TIMEOUT_SIGINT,
    DEFAULT_TIMEOUT_SIGTERM,
)
from gazelle_ros.compat.roslaunch.plans import load_plan, plan_of, required
from gazelle_ros.compat.roslaunch.pmon import Process, ProcessListener
from gazelle_ros.compat.rosmaster.master_api import NUM_WORKERS
from gazelle_ros.launch.describing import summary
from gazelle_ros.launch.process import NodeProcess, StopTimeouts
from gazelle_ros.launch.runner import Launch, Options
from gazelle_ros.master.proxy import MasterProxy

_LOOK_S = 0.05
_SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")


class ROSLaunchParent:
    """A launch of files, of texts, or of nodes that are added while it runs.

    Nodes are watched by a thread, and ended with `shutdown`, with Ctrl-C and other signals, at the end of
    the process, and even if the process is killed.

    Args:
        run_id: The name of the run, from `rlutil.get_or_generate_uuid`.
        roslaunch_files: Paths, or pairs of a path and its arguments.
        is_core: Start a master; there must be none.
        port: The master's, if it is not that of ROS_MASTER_URI.
        local_only: Accepted; nodes run on this machine.
        process_listeners: Called at the end of nodes.
        verbose: Accepted, and not needed.
        force_screen: All nodes write to the screen.
        force_log: No node writes to the screen.
        is_rostest: Accepted, and not needed.
        roslaunch_strs: Texts of launch files.
        num_workers: Accepted, and not needed.
        timeout: Accepted, and not needed.
        master_logger_level: Accepted, and not needed.
        show_summary: Write parameters and nodes to the screen.
        force_required: The launch ends when any node ends.
        sigint_timeout: Seconds a node may take to end after SIGINT.
        sigterm_timeout: Seconds it may take after SIGTERM.

    Raises:
        RLException: A time is not above 0.
    """

    def __init__(
        self,
        run_id: str,
        roslaunch_files: list[Any],
        is_core: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
        port: int | None = None,
        local_only: bool = False,  # noqa: FBT001, FBT002, ARG002
        process_listeners: Iterable[ProcessListener] | None = None,
        verbose: bool = False,  # noqa: FBT001, FBT002, ARG002
        force_screen: bool = False,  # noqa: FBT001, FBT002
        force_log: bool = False,  # noqa: FBT001, FBT002
        is_rostest: bool = False,  # noqa: FBT001, FBT002, ARG002
        roslaunch_strs: list[str] | None = None,
        num_workers: int = NUM_WORKERS,  # noqa: ARG002
        timeout: float | None = None,  # noqa: ARG002
        master_logger_level: Any = False,  # noqa: FBT002, ARG002
        show_summary: bool = True,  # noqa: FBT001, FBT002
        force_required: bool = False,  # noqa: FBT001, FBT002
        sigint_timeout: float = DEFAULT_TIMEOUT_SIGINT,
        sigterm_timeout: float = DEFAULT_TIMEOUT_SIGTERM,
    ) -> None:
        for name, value in (("sigint", sigint_timeout), ("sigterm", sigterm_timeout)):
            if not value > 0:
                raise RLException(f"{name}_timeout must be a positive number, received {value:f}")
        self.run_id = run_id
        self.roslaunch_files, self.roslaunch_strs = roslaunch_files, roslaunch_strs
        self.is_core, self.port = is_core, port
        self.process_listeners = list(process_listeners or ())
        self.show_summary, self.force_required = show_summary, force_required
        self._options = Options(
            screen=force_screen,
            log=force_log,
            run_id=run_id,
            patience=StopTimeouts(float(sigint_timeout), float(sigterm_timeout)),
            core_survives=True,
            nodes_survive=True,
        )
        if port:
            self._options.master_uri = net.uri_of(self._options.host, port)
        self.runner: Runner | None = None

    def start(self, auto_terminate: bool = True) -> None:  # noqa: FBT001, FBT002  # roslaunch's interface
        """Start the master if there is none, and the nodes.

        Args:
            auto_terminate: End when all nodes have ended.

        Raises:
            RLException: It cannot be started; nothing runs then.
        """
        if self.is_core and _answers(self._options.master_uri):
            raise RLException(
                f"roscore cannot run as another roscore/master is already running at "
                f"{self._options.master_uri}"
            )
        try:
            plan = load_plan(list(self.roslaunch_files), self.roslaunch_strs)
            if self.force_required:
                required(plan)
            if self.show_summary and (plan.nodes or plan.parameters):
                printlog(summary(plan))
            runner = Runner(Launch(plan, self._options, say=printlog), self.process_listeners)
            runner.start(auto_terminate=auto_terminate and not self.is_core)
        except Error as error:
            raise RLException(str(error)) from None
        self.runner = runner

    def spin_once(self) -> None:
        """Check all nodes once."""
        if self.runner is not None:
            self.runner.spin_once()

    def spin(self) -> None:
        """Wait until the launch has ended.

        Raises:
            RLException: It was not started.
        """
        if self.runner is None:
            raise RLException("parent not started yet")
        try:
            self.runner.spin()
        finally:
            self.shutdown()

    def shutdown(self) -> None:
        """Stop all nodes, and the master if this launch started it."""
        if self.runner is not None:
            self.runner.stop()


def _answers(uri: str) -> bool:
    proxy = MasterProxy(uri, "/roslaunch")
    try:
        with contextlib.suppress(Error):
            proxy.greet()
            return True
    finally:
        proxy.close()
    return False


class Runner:
    """Watches a launch with a thread.

    Args:
        launch: Launch to watch.
        listeners: Called at the end of nodes.
    """

    def __init__(self, launch: Launch, listeners: Iterable[ProcessListener] = ()) -> None:
        self._launch = launch
        self._listeners = list(listeners)
        self._stop = threading.Lock()
        self._stopped = False
        self._auto_terminate = False
        self._thread = threading.Thread(target=self._watch, name="roslaunch", daemon=True)
        self._before: dict[int, Any] = {}
        self._relay: SignalRelay | None = None
        self._over = False
        launch.listeners.append(self._on_exit)

    def start(self, *, auto_terminate: bool) -> None:
        """Start the launch.

        Raises:
            Error: It cannot be started; nothing runs then.
        """
        self._auto_terminate = auto_terminate
        try:
            self._launch.start()
        except BaseException:
            self._launch.close()
            raise
        atexit.register(self.stop)
        self._take_signals()
        self._thread.start()

    def add_process_listener(self, listener: ProcessListener) -> None:
        """Add a listener to the end of nodes."""
        self._listeners.append(listener)

    def launch_node(self, node: Node) -> tuple[Process | None, bool]:
        """Start one more node; gives its process, and whether that went well."""
        try:
            process = self._launch.launch_node(plan_of(node))
        except Error as error:
            printlog(str(error))
            return None, False
        node.process_name = process.name
        return Process(process, self._launch.forget), True

    def spin_once(self) -> None:
        """Check all nodes once."""
        self._launch.poll()

    def spin(self) -> None:
        """Wait until the launch has ended."""
        self._launch.ended.wait()

    def stop(self) -> None:
        """Stop the launch."""
        with self._stop:
            if self._stopped:
                return
            self._stopped = True
            atexit.unregister(self.stop)
            self._launch.end()
            if self._thread.is_alive() and self._thread is not threading.current_thread():
                self._thread.join()
            self._launch.close()
        self._give_back_signals()

    def _watch(self) -> None:
        while not self._launch.ended.wait(_LOOK_S):
            self._launch.poll()
            if self._auto_terminate and self._launch.idle and not self._launch.has_master:
                self._launch.end()

    def _on_exit(self, process: NodeProcess, code: int) -> None:
        for listener in self._listeners:
            listener.process_died(process.name, code)

    # Signals -----------------------------------------------------------------------------------

    def _take_signals(self) -> None:
        """Stop nodes at signals, then call their earlier handlers."""
        if threading.current_thread() is not threading.main_thread():
            return
        self._relay = SignalRelay(self._end)
        for name in _SIGNALS:
            number = getattr(signal, name, None)
            if number is not None:
                self._before[number] = signal.signal(number, self._on_signal)

    def _give_back_signals(self) -> None:
        if threading.current_thread() is not threading.main_thread():
            return
        for number, before in self._before.items():
            if signal.getsignal(number) == self._on_signal:
                signal.signal(number, signal.SIG_DFL if before is None else before)
        self._before = {}
        if self._relay is not None:
            self._relay.close()
            self._relay = None

    def _end(self, number: int) -> None:
        """Stop nodes, then call the signal's earlier handler in the main thread."""
        self.stop()
        self._over = True
        signal.pthread_kill(threading.main_thread().ident or 0, number)

    def _on_signal(self, number: int, frame: FrameType | None) -> None:
        # The main thread may hold any lock now, so another one ends the nodes.
        if not self._over:
            if self._relay is not None:
                self._relay.post(number)
            return
        before: Callable[..., Any] | int | None = self._before.get(number)
        if callable(before):
            before(number, frame)
        elif before == signal.SIG_DFL:
            signal.signal(number, signal.SIG_DFL)
            signal.raise_signal(number)
