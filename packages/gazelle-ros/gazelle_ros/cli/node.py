"""List, show, ping and stop nodes, as rosnode does, on any ROS 1 graph.

gazelle node list
gazelle node info /gazebo
gazelle node ping -c 3 /move_base
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from typing import Any

from gazelle_ros.base.argument_types import positive_int
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.cli.tools import SubCommands, answer

_CLEANUP = (
    "Warning: these might include alive and functioning nodes, e.g. in unstable networks.\n"
    "Cleanup will purge all information about these nodes from the master.\n"
    "Please type y or n to continue:\n"
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    listing = commands.add("list", "list nodes", _list, "", "-a")
    listing.add_argument("space", nargs="?", metavar="/NAMESPACE")
    listing.add_argument(
        "-u", "--uris", action="store_true", help="show addresses instead of names"
    )
    listing.add_argument("-a", "--all", action="store_true", help="show addresses and names")
    info = commands.add("info", "show topics, services and connections of nodes", _info, "/gazebo")
    info.add_argument("nodes", nargs="+", metavar="/NODE")
    info.add_argument("-q", "--quiet", action="store_true", help="do not query the nodes")
    ping = commands.add("ping", "test whether a node responds", _ping, "-c 3 /move_base", "--all")
    ping.add_argument("node", nargs="?", metavar="/NODE")
    ping.add_argument("-a", "--all", action="store_true", help="ping all nodes once")
    ping.add_argument(
        "-c", dest="count", type=positive_int, metavar="COUNT", help="number of pings"
    )
    kill = commands.add("kill", "stop nodes", _kill, "/move_base")
    kill.add_argument("nodes", nargs="*", metavar="/NODE")
    kill.add_argument("-a", "--all", action="store_true", help="stop all nodes")
    machine = commands.add("machine", "list machines, or the nodes of a machine", _machine)
    machine.add_argument("machine", nargs="?", metavar="HOST")
    cleanup = commands.add("cleanup", "unregister nodes that do not respond", _cleanup)
    cleanup.add_argument("-y", "--yes", action="store_true", help="do not ask for confirmation")


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _graph() -> Any:
    from gazelle_ros.tools.graph import GraphInspector

    return GraphInspector("rosnode")


def _list(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import list_nodes

    with _graph() as graph:
        uris = args.uris or args.all
        sys.stdout.write(list_nodes(graph, args.space, uris=uris, names=args.all))
    return 0


def _info(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import node_info

    with _graph() as graph:
        for node in args.nodes:
            sys.stdout.write(node_info(graph, node, quiet=args.quiet))
    return 0


def _ping(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import ping

    if bool(args.node) == args.all:
        args.parser.error("give a node, or --all")
    with _graph() as graph, stopping() as stop:
        nodes = graph.nodes() if args.all else [args.node]
        if args.all:
            names = "".join(f" * {node}\n" for node in nodes)
            sys.stdout.write(f"Will ping the following nodes: \n{names}\n")
        else:
            sys.stdout.write(f"rosnode: node is [{graph.resolve(args.node)}]\n")
        count = 1 if args.all else args.count
        answers = [
            ping(graph, node, sys.stdout, stop, count=count, complain=_complain) for node in nodes
        ]
    return 0 if all(answers) else 1


def _kill(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import kill

    if args.nodes and args.all:
        args.parser.error("give nodes or --all, not both")
    with _graph() as graph:
        known = graph.nodes()
        chosen = _chosen(args, graph, known)
        if not chosen:
            return 1
        for node in chosen:
            if node not in known:
                raise graph.unknown("node", node, known)
        if len(chosen) > 1:
            sys.stdout.write("killing:\n" + "".join(f" * {node}\n" for node in chosen))
        else:
            sys.stdout.write(f"killing {chosen[0]}\n")
        failed = kill(graph, chosen)
    if failed:
        _complain("ERROR: Failed to kill:\n" + "\n".join(f" * {node}" for node in failed))
        return 1
    sys.stdout.write("killed\n")
    return 0


def _chosen(args: argparse.Namespace, graph: Any, known: list[str]) -> list[str]:
    """Return the nodes to shut down; without a name, the user is asked."""
    if args.all:
        return known
    if args.nodes:
        return [graph.resolve(node) for node in args.nodes]
    if not known:
        _complain("No nodes running")
        return []
    lines = "".join(f"{number}. {node}\n" for number, node in enumerate(known, 1))
    question = f"{lines}\nPlease enter the number of the node you wish to kill.\n> "
    said = answer(question, {str(number) for number in range(1, len(known) + 1)})
    return [] if said is None else [known[int(said) - 1]]


def _machine(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import machines, nodes_on

    with _graph() as graph:
        found = machines(graph) if args.machine is None else nodes_on(graph, args.machine)
    sys.stdout.write("\n".join(found) + "\n")
    return 0


def _cleanup(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.nodes import dead_nodes, unregister

    with _graph() as graph:
        dead = dead_nodes(graph)
        if not dead:
            return 0
        names = "".join(f" * {node}\n" for node in dead)
        sys.stdout.write(f"Unable to contact the following nodes:\n{names}")
        if not args.yes and answer(_CLEANUP, {"y", "n"}) != "y":
            sys.stdout.write("aborting\n")
            return 1
        for node in dead:
            sys.stdout.write(f"Unregistering {node}\n")
        unregister(graph, dead)
        sys.stdout.write("done\n")
    return 0


def _complain(text: str) -> None:
    sys.stderr.write(f"{text}\n")
