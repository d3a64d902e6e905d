"""List and call services, as rosservice does, on any ROS 1 graph.

gazelle service list
gazelle service call /gazebo/pause_physics
gazelle service call /add_two_ints 1 2
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from typing import Any

from gazelle_ros.base.output import say
from gazelle_ros.cli.tools import SubCommands


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    listing = commands.add("list", "list services", _list, "", "-n /gazebo")
    listing.add_argument("space", nargs="?", metavar="/NAMESPACE")
    listing.add_argument("-n", "--nodes", action="store_true", help="show the nodes too")
    for name, purpose in (
        ("info", "show node, address, type and fields of a service"),
        ("type", "print the type of a service"),
        ("uri", "print the address of a service"),
        ("node", "print the node of a service"),
        ("args", "print the fields of the request"),
    ):
        commands.add(name, purpose, _one, "/gazebo/pause_physics").add_argument(
            "service", metavar="/SERVICE"
        )
    commands.add("find", "list the services of a type", _find, "std_srvs/Empty").add_argument(
        "type", metavar="PKG/TYPE"
    )
    call = commands.add(
        "call", "call a service", _call, "/gazebo/pause_physics", "/add_two_ints 1 2"
    )
    call.add_argument("service", metavar="/SERVICE")
    call.add_argument(
        "values", nargs="*", metavar="YAML", help="values of all fields, or one mapping"
    )
    call.add_argument("-v", "--verbose", action="store_true", help="print the request too")
    call.add_argument("--wait", action="store_true", help="wait for the service")


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _graph() -> Any:
    from gazelle_ros.tools.graph import GraphInspector

    return GraphInspector("rosservice")


def _list(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.services import list_services

    with _graph() as graph:
        for name, nodes in list_services(graph, args.space):
            sys.stdout.write(f"{name} {','.join(nodes)}\n" if args.nodes else f"{name}\n")
    return 0


def _one(args: argparse.Namespace) -> int:
    from gazelle_ros.tools import services

    answer = {
        "info": services.service_info,
        "type": services.service_type,
        "uri": services.service_uri,
        "node": services.service_node,
        "args": services.service_arguments,
    }[args.sub_command]
    with _graph() as graph:
        sys.stdout.write(answer(graph, args.service).rstrip("\n") + "\n")
    return 0


def _find(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.services import services_of_type

    with _graph() as graph:
        sys.stdout.write("\n".join(services_of_type(graph, args.type)) + "\n")
    return 0


def _call(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.publishing import documents, parse_arguments
    from gazelle_ros.tools.services import ServiceCaller
    from gazelle_ros.tools.watching import tool_node

    values = parse_arguments(args.values)
    with _graph() as graph, tool_node(graph) as node:
        if args.wait:
            node.wait_for_service(graph.resolve(args.service))
        caller = ServiceCaller(graph, node, args.service)
        if values or not caller.takes_values:
            _call_once(caller, values, verbose=args.verbose)
            return 0
        if sys.stdin.isatty():
            args.parser.error("give the values of the request")
        for each in documents(sys.stdin):
            _call_once(caller, each, verbose=args.verbose)
    return 0


def _call_once(caller: Any, values: list[Any], *, verbose: bool) -> None:
    request = caller.request(values)
    response = caller.call(request)
    if verbose:
        sys.stdout.write(f"{request}\n---\n")
    say(f"{response}\n")
