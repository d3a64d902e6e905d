"""Start nodes and launch files from Python, and end them all at the end."""

from __future__ import annotations

import logging
import threading
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from types import TracebackType
from typing import Any, Self
from xml.sax.saxutils import quoteattr

from gazelle.argument_checks import checked
from gazelle.clients.descriptions import find_file
from gazelle.clients.errors import ClientError
from gazelle.errors import did_you_mean
from gazelle_ros import names, net
from gazelle_ros.launch import LaunchPlan, Packages, load_launch, load_launch_text
from gazelle_ros.launch.finding import find_launch_file
from gazelle_ros.launch.runner import Launch, Options
from gazelle_ros.tools import nodes as node_tools
from gazelle_ros.tools.graph import GraphInspector

_WATCH_S = 0.1
_log = logging.getLogger("gazelle.clients")


@checked(ClientError, after=True)
class Processes:
    """Nodes and launch files that are ended with this; use it with ``with``.

    Args:
        master_uri: Of the master; by default ``ROS_MASTER_URI``. One is started if there is
            none.
    """

    def __init__(self, master_uri: str | None = None) -> None:
        self._uri = master_uri or net.default_master_uri()
        self._launches: list[_Running] = []

    def start_node(
        self,
        package: str,
        program: str,
        *,
        name: str | None = None,
        namespace: str = "/",
        arguments: str = "",
        parameters: Mapping[str, Any] | None = None,
        remaps: Mapping[str, str] | None = None,
        screen: bool = True,
    ) -> str:
        """Start a node; returns its full name.

        Args:
            package: Its package.
            program: Its name in the package.
            name: Of the node; the program's if None.
            namespace: Its namespace.
            arguments: Its command line.
            parameters: Private ones.
            remaps: New names by old ones.
            screen: Whether what it says goes to the screen; else to a log file.

        Raises:
            LaunchError: There is no such package or program.
        """
        short = name or program.removesuffix(".py")
        text = _launch_text(
            {
                "pkg": package,
                "type": program,
                "name": short,
                "ns": namespace,
                "args": arguments,
                "output": "screen" if screen else "log",
            },
            remaps or {},
        )
        full = names.canonical(f"{names.as_namespace(namespace)}{short}")
        self._set_parameters(full, parameters or {})
        self._start(full, load_launch_text(text, {}, name=full, packages=Packages()))
        return full

    def start_launch(
        self,
        path: str | Path,
        *,
        package: str | None = None,
        arguments: Mapping[str, Any] | None = None,
    ) -> str:
        """Start what a launch file asks for; returns a name to end it by.

        Args:
            path: A launch file; of a package if one is given.
            package: A ROS package.
            arguments: Values of its arguments.

        Raises:
            LaunchError: The file cannot be carried out; nothing is started.
        """
        packages = Packages()
        if package is None:
            file = find_file(path)
        else:
            file = find_launch_file(package, str(path), packages)
        given = {key: _text(value) for key, value in (arguments or {}).items()}
        name = f"{file.stem}-{len(self._launches) + 1}"
        self._start(name, load_launch(file, given, packages=packages))
        return name

    @property
    def running(self) -> list[str]:
        """Names of nodes and launch files that were started here and run still."""
        return [each.name for each in self._launches if each.runs]

    def nodes(self) -> list[str]:
        """Return the names of all nodes on the graph."""
        return node_tools.list_nodes(GraphInspector("clients", self._uri)).splitlines()

    def stop(self, name: str) -> None:
        """Stop the processes that were started under a name.

        Raises:
            ClientError: Nothing was.
        """
        found = [each for each in self._launches if each.name == name]
        if not found:
            known = [each.name for each in self._launches]
            raise ClientError(
                f"no running process is called '{name}'", hint=did_you_mean(name, known)
            )
        for each in found:
            each.close()
            self._launches.remove(each)

    def stop_all(self) -> None:
        """Stop everything that was started here, the youngest first."""
        while self._launches:
            self._launches.pop().close()

    def kill(self, *nodes: str) -> list[str]:
        """Request any nodes of the graph to shut down; returns those that did not answer."""
        return node_tools.kill(GraphInspector("clients", self._uri), nodes)

    def kill_all(self) -> list[str]:
        """Request all nodes of the graph to shut down, of any origin; see ``kill``."""
        return self.kill(*self.nodes())

    def kill_master(self) -> None:
        """Request the master to shut down.

        Raises:
            MasterUnreachableError: There is none.
        """
        GraphInspector("clients", self._uri).master.call("shutdown", "asked by a client")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop_all()

    def _start(self, name: str, plan: LaunchPlan) -> None:
        self._launches.append(_Running(name, plan, self._uri))

    def _set_parameters(self, node: str, parameters: Mapping[str, Any]) -> None:
        master = GraphInspector("clients", self._uri).master
        for key, value in parameters.items():
            master.set_param(f"{node}/{key}", value)


class _Running:
    """A launch that is watched beside the program."""

    def __init__(self, name: str, plan: LaunchPlan, uri: str) -> None:
        self.name = name
        options = replace(Options(), master_uri=uri)
        self._launch = Launch(plan, options, say=lambda text: _log.info("%s", text))
        try:
            self._launch.start()
        except BaseException:
            self._launch.close()
            raise
        self._thread = threading.Thread(target=self._watch, name=f"watch {name}", daemon=True)
        self._thread.start()

    @property
    def runs(self) -> bool:
        """True if any of its nodes is running."""
        return not self._launch.idle

    def close(self) -> None:
        """Stop its nodes."""
        self._launch.end()
        self._thread.join()
        self._launch.close()

    def _watch(self) -> None:
        while not self._launch.ended.wait(_WATCH_S):
            self._launch.poll()


def _launch_text(attributes: Mapping[str, str], remaps: Mapping[str, str]) -> str:
    inside = "".join(
        f"<remap from={quoteattr(old)} to={quoteattr(_text(new))}/>" for old, new in remaps.items()
    )
    node = " ".join(f"{key}={quoteattr(value)}" for key, value in attributes.items())
    return f"<launch><node {node}>{inside}</node></launch>"


def _text(value: Any) -> str:
    return str(value).lower() if isinstance(value, bool) else str(value)
