"""Runner of a plan: starts a master, parameters and nodes; watches and ends them."""

from __future__ import annotations

import contextlib
import itertools
import signal
import threading
import time
import uuid
from collections.abc import Callable
from dataclasses import dataclass, field

from gazelle_ros import net
from gazelle_ros.base.closing import Closeable
from gazelle_ros.errors import ApiError, MasterUnreachableError, RosError
from gazelle_ros.launch import core, folders, machines, setup
from gazelle_ros.launch.errors import LaunchError
from gazelle_ros.launch.guard import LaunchWatchdog
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import LaunchPlan, NodePlan
from gazelle_ros.launch.process import NodeProcess, Start, StopTimeouts, stop_all
from gazelle_ros.launch.programs import (
    Program,
    Skipped,
    find_program,
    node_arguments,
    node_environment,
    prefixed_command,
)
from gazelle_ros.launch.server import LaunchServer
from gazelle_ros.master.proxy import MasterProxy
from gazelle_ros.master.server import require_free

CALLER = "/roslaunch"
_WATCH_S = 0.05

Say = Callable[[str], None]


@dataclass(slots=True, kw_only=True)
class Options:
    """Options for running a plan."""

    master_uri: str = field(default_factory=net.default_master_uri)
    host: str = field(default_factory=net.default_host)
    core: bool = False
    """Start a master; there must be none."""
    wait: bool = False
    """Wait for a master instead of starting one."""
    screen: bool = False
    """All nodes write to the screen."""
    log: bool = False
    """No node writes to the screen."""
    patience: StopTimeouts = field(default_factory=StopTimeouts)
    run_id: str = ""
    core_survives: bool = False
    """True if a master that the launch started outlives it if it is killed, as with roslaunch."""
    nodes_survive: bool = False
    """True if the nodes do, as with roslaunch."""


class Launch(Closeable):
    """A running plan.

    ::

        with Launch(plan, say=print) as launch:
            launch.start()
            code = launch.spin()

    Args:
        plan: Plan of the launch.
        options: Options of the launch.
        say: Gets lines for people.
        packages: Packages of the programs.

    Attributes:
        processes: The nodes' processes, in the order of the plan.
        ended: Set it to end the launch.
        listeners: Called with a process and its exit code when it ends by itself.
    """

    def __init__(
        self,
        plan: LaunchPlan,
        options: Options | None = None,
        *,
        say: Say,
        packages: Packages | None = None,
    ) -> None:
        self.plan = plan
        self.options = options or Options()
        self.processes: list[NodeProcess] = []
        self.ended = threading.Event()
        self.listeners: list[Callable[[NodeProcess, int], object]] = []
        self.master_uri = self.options.master_uri
        self.run_id = self.options.run_id
        self._say = say
        self._packages = packages or Packages()
        self._core: list[NodeProcess] = []
        self._server: LaunchServer | None = None
        self._proxy = MasterProxy(self.master_uri, CALLER)
        self._numbers = itertools.count(1)
        self._due: dict[NodeProcess, float] = {}
        self._reported: set[NodeProcess] = set()
        self._failed = False
        self._guard = LaunchWatchdog()
        self._lock = threading.RLock()

    # Beginning ---------------------------------------------------------------------------

    def start(self) -> None:
        """Start the master if there is none, set parameters, start nodes.

        Raises:
            LaunchError: A required node or all nodes have no program, or a parameter is invalid
                set. No node runs then.
            MasterUnreachableError: There is no master, and it is not for this machine to start one.
        """
        machines.check(self.plan)
        programs = self._find_programs()
        if not (self.options.core_survives and self.options.nodes_survive):
            self._guard.start()
        self._reach_master()
        self._serve()
        setup.prepare(self.plan, self._proxy, self._packages)
        if self._core and core.await_rosout(self._proxy):
            self._say("started core service [/rosout]")
        with self._lock:
            self.processes += [self._process(node, program) for node, program in programs]
            for process in self.processes:
                if self.ended.is_set():
                    break
                self._start(process)

    def launch_node(self, node: NodePlan) -> NodeProcess:
        """Start one more node.

        Raises:
            LaunchError: It has no program, or is left out on purpose.
        """
        program = find_program(node, self._packages)
        if isinstance(program, Skipped):
            raise LaunchError(f"nodes of '{program.package}' are left out: {program.reason}")
        with self._lock:
            if self.ended.is_set():
                raise LaunchError("the launch has ended")
            process = self._process(node, program)
            self.processes.append(process)
            self._start(process)
        return process

    def forget(self, process: NodeProcess) -> None:
        """Stop a node and watch it no more."""
        with self._lock:
            if process in self.processes:
                self.processes.remove(process)
            self._due.pop(process, None)
        stop_all([process], self.options.patience)
        self._guard.forget(process.pid)

    def _find_programs(self) -> list[tuple[NodePlan, Program]]:
        """Return the programs of all nodes that have one.

        As with roslaunch those without are named and left out, unless one is required; where
        none has one, nothing is begun.
        """
        found: list[tuple[NodePlan, Program]] = []
        skipped: dict[str, Skipped] = {}
        missing: list[LaunchError] = []
        for node in self.plan.nodes:
            try:
                program = find_program(node, self._packages)
            except LaunchError as error:
                if node.required:
                    raise
                missing.append(error)
                continue
            if isinstance(program, Skipped):
                skipped.setdefault(program.package, program)
            else:
                found.append((node, program))
        for each in skipped.values():
            self._say(f"nodes of '{each.package}' are left out: {each.reason}")
        if missing and not found and not skipped:
            raise missing[0]
        for fault in missing:
            self._say(f"ERROR: a node is left out: {fault}")
        return found

    def _reach_master(self) -> None:
        if self.options.core or not self._find_master():
            self._start_master()
        self._find_run_id()

    def _find_master(self) -> bool:
        """Return whether a master answers; wait for one if that is wanted."""
        said = False
        while True:
            try:
                self._proxy.greet()
            except MasterUnreachableError:
                if not self.options.wait:
                    return False
            else:
                return True
            if not said:
                said = True
                self._say(f"waiting for a master at {self.master_uri}")
            if self.ended.wait(0.5):
                raise LaunchError("ended while it waited for a master")

    def _start_master(self) -> None:
        """Start the master and rosout, both at once, each as a process of its own."""
        host, port, _ = net.split_uri(self.master_uri)
        if not machines.is_local(host):
            raise MasterUnreachableError(
                f"no master answers at {self.master_uri}",
                hint="ROS_MASTER_URI names another machine; start one there, or unset it",
            )
        require_free(self.options.host, port)
        self.run_id = self.run_id or str(uuid.uuid1())
        self._say("auto-starting new master")
        program = core.master_program(self.options.host, port, self.run_id)
        with self._lock:
            self._core.append(self._process(core.MASTER, program, "master"))
            self._core.append(self._process(core.ROSOUT, core.ROSOUT_PROGRAM))
            for process in self._core:
                self._start(process)
        core.await_master(self._proxy, self._core[0])
        self._say(f"started a master at {self.master_uri}")

    def _find_run_id(self) -> None:
        try:
            known = str(self._proxy.get_param("/run_id"))
        except ApiError:
            known = self.run_id or str(uuid.uuid1())
            self._proxy.set_param("/run_id", known)
        if self.run_id and known != self.run_id:
            raise LaunchError(
                f"run_id on the master is {known}, not {self.run_id}",
                hint="leave out --run_id to join the run of that master",
            )
        self.run_id = known

    def _serve(self) -> None:
        self._server = LaunchServer(
            lambda: [*self._core, *self.processes], self.end, self.options.host
        )
        self._proxy.set_param(self._server.key, self._server.uri)
        self._say(f"started launch server {self._server.uri}")

    def _process(self, node: NodePlan, program: Program, name: str = "") -> NodeProcess:
        logs = folders.log_folder(self.run_id)
        home = folders.made(folders.ros_home())
        name = name or f"{node.full_name.strip('/')}-{next(self._numbers)}"
        file = name.replace("/", "-")
        to_screen = (node.output == "screen" or self.options.screen) and not self.options.log
        arguments = prefixed_command(node, program)
        arguments += node_arguments(node, logs / f"{file}.log")
        folder = program.folder if node.cwd == "node" and program.folder else home
        start = Start(
            tuple(arguments),
            node_environment(node, self.master_uri),
            folder,
            None if to_screen else logs / f"{file}-stdout.log",
        )
        return NodeProcess(node, name, start)

    def _start(self, process: NodeProcess) -> None:
        if process.spawned:
            self._guard.forget(process.pid)
        process.start()
        core = process in self._core
        if not (self.options.core_survives if core else self.options.nodes_survive):
            self._guard.watch(process.pid)
        self._reported.discard(process)
        self._say(f"process[{process.name}]: started with pid [{process.pid}]")

    # Watching ----------------------------------------------------------------------------

    def spin(self) -> int:
        """Watch the nodes until all have ended, a required one ended, or `ended` is set.

        Returns:
            1 if a required node failed, else 0.
        """
        while not self.ended.wait(_WATCH_S):
            self.poll()
            if self.idle:
                if self.processes:
                    self._say("all nodes have ended, and so does the launch")
                    break
                if not self._core:
                    break
        return int(self._failed)

    @property
    def idle(self) -> bool:
        """True if no node runs and none will: all have ended, and none will be respawned."""
        with self._lock:
            nodes = self.processes
            return self._due.keys().isdisjoint(nodes) and self._reported.issuperset(nodes)

    @property
    def has_master(self) -> bool:
        """True if it started the master."""
        return bool(self._core)

    @property
    def failed(self) -> bool:
        """True if a required node failed."""
        return self._failed

    def poll(self) -> None:
        """Check all processes once: report ended ones, and respawn those that are due."""
        with self._lock:
            self._poll()

    def _poll(self) -> None:
        now = time.monotonic()
        for process in (*self._core, *self.processes):
            code = process.poll()
            if code is None or process in self._due:
                continue
            if process not in self._reported:
                self._reported.add(process)
                self._report(process, code)
            if process.plan.required:
                self._end_required(process, code)
                return
            if process.plan.respawn:
                self._due[process] = (process.ended_at or now) + process.plan.respawn_delay
        for process, when in list(self._due.items()):
            if when <= now and not self.ended.is_set():
                del self._due[process]
                self._say(f"[{process.name}] restarting process")
                self._start(process)

    def _report(self, process: NodeProcess, code: int) -> None:
        log = process.how.log
        where = f"\nlog file: {log}" if log is not None else ""
        if code == 0:
            self._say(f"[{process.name}] process has finished cleanly{where}")
        else:
            command = " ".join(process.how.arguments)
            self._say(
                f"[{process.name}] process has died [pid {process.pid}, exit code {code}, "
                f"cmd {command}].{where}"
            )
        for listener in list(self.listeners):
            listener(process, code)

    def _end_required(self, process: NodeProcess, code: int) -> None:
        self._failed = code != 0
        self._say(f"REQUIRED process [{process.name}] has ended: the launch ends too")
        self.ended.set()

    # Ending ------------------------------------------------------------------------------

    def end(self, reason: str = "") -> None:
        """Request the launch to end; it does when `spin` returns and it is closed."""
        if reason:
            self._say(reason)
        self.ended.set()

    def close(self) -> None:
        """Stop all nodes, then remove what this launch put on the master, then stop the master."""
        self.ended.set()
        with self._lock:
            nodes, ending = list(self.processes), list(reversed(self._core))
        for process in stop_all(nodes, self.options.patience):
            self._say(f"[{process.name}] did not end on SIGINT")
        if self._server is not None:
            if not self._core:
                with contextlib.suppress(RosError):
                    self._proxy.delete_param(self._server.key)
            self._server.close()
            self._server = None
        for process in ending:  # by SIGTERM, which is quiet even while Python starts
            stop_all([process], self.options.patience, signal.SIGTERM)
        self._core = []
        self._guard.close()
        self._proxy.close()
