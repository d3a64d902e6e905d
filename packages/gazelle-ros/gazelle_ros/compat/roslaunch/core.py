"""Nodes, tests, parameters and machines, as scripts make them."""

from __future__ import annotations

import sys
import uuid
from collections.abc import Iterable
from typing import Any

from gazelle_ros import names, net

PHASE_SETUP, PHASE_RUN, PHASE_TEARDOWN = "setup", "run", "teardown"
_OUTPUTS = ("log", "screen", None)
_FOLDERS = ("ROS_HOME", "node", None)

Pairs = Iterable[tuple[str, str]]


class RLException(Exception):  # noqa: N818  # roslaunch's name
    """A launch is not possible, and why."""


def printlog(msg: str) -> None:
    """Write a line to the screen."""
    sys.stdout.write(f"{msg}\n")


printlog_bold = printlog


def printerrlog(msg: str) -> None:
    """Write a line to the screen's error output."""
    sys.stderr.write(f"{msg}\n")


def generate_run_id() -> str:
    """Return a new name for a run."""
    return str(uuid.uuid1())


class Param:
    """A parameter to set.

    Args:
        key: Its name.
        value: Its value.
    """

    __hash__ = None  # type: ignore[assignment]  # it can change

    def __init__(self, key: str, value: Any) -> None:
        self.key = names.canonical(key)
        self.value = value

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Param):
            return NotImplemented
        return (self.key, self.value) == (other.key, other.value)

    def __str__(self) -> str:
        return f"{self.key}={self.value}"

    def __repr__(self) -> str:
        return f"{self.key}={self.value!r}"


class Machine:
    """A machine nodes run on.

    Args:
        name: Name in launch files.
        address: Its address.
        rest: Accepted, and not needed: nodes run on this machine.
    """

    def __init__(self, name: str, address: str, *rest: Any, **more: Any) -> None:
        del rest, more
        self.name, self.address = name, address

    def __str__(self) -> str:
        return f"Machine(name[{self.name}] address[{self.address}])"


class Master:
    """The master of a launch.

    Args:
        type_: Accepted, and not needed.
        uri: Its address, by default what ROS_MASTER_URI says.
        auto: Accepted, and not needed.
    """

    ROSMASTER = "rosmaster"

    def __init__(self, type_: str | None = None, uri: str | None = None, auto: Any = None) -> None:
        self.auto = auto
        self.type = type_ or Master.ROSMASTER
        self.uri = uri or net.default_master_uri()

    def get_host(self) -> str:
        """Return the host in its address."""
        return net.split_uri(self.uri)[0]

    def get_port(self) -> int:
        """Return the port in its address."""
        return net.split_uri(self.uri)[1]

    def get(self) -> Any:
        """Return a proxy of its API."""
        from xmlrpc.client import ServerProxy

        return ServerProxy(self.uri)

    def is_running(self) -> bool:
        """Return whether it answers."""
        from gazelle_ros.errors import RosError
        from gazelle_ros.master.proxy import MasterProxy

        proxy = MasterProxy(self.uri, "/roslaunch")
        try:
            proxy.greet()
        except RosError:
            return False
        finally:
            proxy.close()
        return True


class Node:
    """A node to start.

    Args:
        package: Its package.
        node_type: Its program.
        name: Its name; by default the program's.
        namespace: Namespace of its name.
        machine_name: Accepted; nodes run on this machine.
        args: Its command line.
        respawn: Start it again when it ends.
        respawn_delay: Seconds before that.
        remap_args: Pairs of names.
        env_args: Pairs of variables and values.
        output: ``screen`` or ``log``.
        cwd: ``ROS_HOME`` or ``node``.
        launch_prefix: Prefix of the command line.
        required: End the launch when it ends.
        filename: The launch file it is from.

    Raises:
        ValueError: Package or type are empty, or a value is none of those above.
    """

    def __init__(
        self,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        respawn: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
        respawn_delay: float = 0.0,
        remap_args: Pairs | None = None,
        env_args: Pairs | None = None,
        output: str | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        required: bool = False,  # noqa: FBT001, FBT002  # roslaunch's interface
        filename: str = "<unknown>",
    ) -> None:
        self.package, self.type = package, node_type
        self.name = name or None
        self.namespace = names.as_namespace(names.canonical("/" + (namespace or "/")))
        self.machine_name = machine_name or None
        self.machine: Machine | None = None
        self.args = args or ""
        self.respawn, self.respawn_delay, self.required = respawn, respawn_delay, required
        self.remap_args, self.env_args = list(remap_args or ()), list(env_args or ())
        self.output = output
        self.cwd = "ROS_HOME" if cwd == "ros_home" else cwd
        self.launch_prefix = launch_prefix or None
        self.filename = filename
        self.process_name: str | None = None
        self._check()

    def _check(self) -> None:
        if self.respawn and self.required:
            raise ValueError("respawn and required cannot both be set to true")
        if self.name and "/" in self.name:
            raise ValueError("node name cannot contain a namespace")
        for label, value in (("package", self.package), ("type", self.type)):
            if not value.strip():
                raise ValueError(f"{label} must be non-empty")
        if self.output not in _OUTPUTS:
            raise ValueError("output must be one of 'log', 'screen'")
        if self.cwd not in _FOLDERS:
            raise ValueError("cwd must be one of 'ROS_HOME', 'node'")


class Test(Node):
    """A test node to run.

    Args:
        test_name: Name of the test.
        package: Its package.
        node_type: Its program.
        name: The node's name; by default the test's.
        namespace: Namespace of its name.
        machine_name: Accepted; nodes run on this machine.
        args: Its command line.
        remap_args: Pairs of names.
        env_args: Pairs of variables and values.
        time_limit: Seconds it may take.
        cwd: ``ROS_HOME`` or ``node``.
        launch_prefix: Prefix of the command line.
        retry: Number of retries after a failure.
        filename: The launch file it is from.

    Raises:
        ValueError: A value makes no sense.
    """

    __test__ = False  # it is no test of pytest's

    def __init__(
        self,
        test_name: str,
        package: str,
        node_type: str,
        name: str | None = None,
        namespace: str = "/",
        machine_name: str | None = None,
        args: str = "",
        remap_args: Pairs | None = None,
        env_args: Pairs | None = None,
        time_limit: float | None = None,
        cwd: str | None = None,
        launch_prefix: str | None = None,
        retry: int | None = None,
        filename: str = "<unknown>",
    ) -> None:
        super().__init__(
            package,
            node_type,
            name=name or test_name,
            namespace=namespace,
            machine_name=machine_name,
            args=args,
            remap_args=remap_args,
            env_args=env_args,
            output="log",
            cwd=cwd,
            launch_prefix=launch_prefix,
            filename=filename,
        )
        self.test_name = test_name
        self.retry = retry or 0
        self.time_limit = 60.0 if time_limit is None else float(time_limit)
        if not self.time_limit > 0:
            raise ValueError("'time-limit' must be a positive number")
