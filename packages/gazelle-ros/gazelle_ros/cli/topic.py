"""List, print and publish topics, as rostopic does, on any ROS 1 graph.

gazelle topic list -v
gazelle topic echo /scan -n 1 --noarr
gazelle topic pub -r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'
gazelle topic hz /scan
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterable
from typing import Any

from gazelle_ros.base.argument_types import positive_float, positive_int
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.cli.tools import SubCommands

_TOOL = "rostopic"


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    _configure_list(commands)
    for name, purpose in (
        ("info", "show type, publishers and subscribers of a topic"),
        ("type", "print the type of a topic"),
    ):
        commands.add(name, purpose, _ONE[name], "/scan").add_argument("topic", metavar="/TOPIC")
    commands.add("find", "list the topics of a type", _find, "sensor_msgs/LaserScan").add_argument(
        "type", metavar="PKG/TYPE"
    )
    _configure_echo(commands)
    _configure_pub(commands)
    _configure_rates(commands)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _configure_list(commands: SubCommands) -> None:
    parser = commands.add("list", "list topics", _list, "", "-v /robot")
    parser.add_argument("space", nargs="?", metavar="/NAMESPACE")
    parser.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="show types and numbers of publishers and subscribers",
    )
    only = parser.add_mutually_exclusive_group()
    only.add_argument("-p", "--publishers", action="store_true", help="only topics with publishers")
    only.add_argument(
        "-s", "--subscribers", action="store_true", help="only topics with subscribers"
    )
    parser.add_argument("--host", action="store_true", help="group by machine")
    parser.add_argument("-b", "--bag", metavar="FILE", help="list the topics of a bag")


def _configure_echo(commands: SubCommands) -> None:
    parser = commands.add(
        "echo", "print messages", _echo, "/scan -n 1 --noarr", "/odom/pose/pose/position"
    )
    parser.add_argument("topic", nargs="?", metavar="/TOPIC[/FIELD]")
    parser.add_argument(
        "-n",
        dest="count",
        type=positive_int,
        metavar="COUNT",
        help="stop after this number of messages",
    )
    parser.add_argument("-p", dest="plot", action="store_true", help="print comma-separated values")
    parser.add_argument("-b", "--bag", metavar="FILE", help="read from a bag")
    parser.add_argument("-a", "--all", action="store_true", help="print all topics of the bag")
    parser.add_argument(
        "-c", "--clear", action="store_true", help="clear the screen before each message"
    )
    parser.add_argument(
        "-w", dest="width", type=positive_int, help="width of numbers in characters"
    )
    parser.add_argument("--filter", metavar="EXPR", help="a Python expression of the message m")
    parser.add_argument("--nostr", action="store_true", help="leave out strings")
    parser.add_argument("--noarr", action="store_true", help="leave out arrays")
    parser.add_argument("--offset", action="store_true", help="times relative to now [s]")


def _configure_pub(commands: SubCommands) -> None:
    parser = commands.add(
        "pub",
        "publish messages",
        _publish,
        "-r 10 /cmd_vel geometry_msgs/Twist '{linear: {x: 0.2}}'",
        "--once /name std_msgs/String hello",
    )
    parser.add_argument("topic", metavar="/TOPIC")
    parser.add_argument("type", metavar="PKG/TYPE")
    parser.add_argument(
        "values", nargs="*", metavar="YAML", help="values of all fields, or one mapping"
    )
    how = parser.add_mutually_exclusive_group()
    how.add_argument(
        "-r",
        "--rate",
        type=positive_float,
        metavar="HZ",
        help="publish repeatedly at this rate [Hz]",
    )
    how.add_argument("-1", "--once", action="store_true", help="publish one message and exit")
    parser.add_argument("-f", "--file", metavar="FILE", help="read messages from a YAML file")
    parser.add_argument(
        "-l", "--latch", action="store_true", help="latch the message for late subscribers"
    )
    parser.add_argument("-v", "--verbose", action="store_true", help="print the messages")
    parser.add_argument(
        "-s",
        "--substitute-keywords",
        action="store_true",
        help="replace 'now' and 'auto' in each message",
    )
    parser.add_argument("--use-rostime", action="store_true", help="stamp with simulated time")


def _configure_rates(commands: SubCommands) -> None:
    hertz = commands.add("hz", "measure the rate of a topic", _hz, "/scan", "/scan /odom -w 100")
    hertz.add_argument("topics", nargs="+", metavar="/TOPIC")
    hertz.add_argument("--filter", metavar="EXPR", help="a Python expression of the message m")
    hertz.add_argument(
        "--wall-time", action="store_true", help="use wall time instead of simulated time"
    )
    size = commands.add("bw", "measure the bandwidth of a topic", _bw, "/camera/image_raw")
    size.add_argument("topic", metavar="/TOPIC")
    delay = commands.add("delay", "measure the delay since the stamps of messages", _delay, "/scan")
    delay.add_argument("topic", metavar="/TOPIC")
    for parser, default in ((hertz, -1), (size, 100), (delay, -1)):
        parser.add_argument(
            "-w", "--window", type=int, default=default, help="number of messages to average over"
        )
    for parser in (hertz, delay):
        parser.add_argument("--tcpnodelay", action="store_true", help="request TCP_NODELAY")


def _graph() -> Any:
    from gazelle_ros.tools.graph import GraphInspector

    return GraphInspector(_TOOL)


def _list(args: argparse.Namespace) -> int:
    if args.bag:
        from gazelle_ros.bags import Bag

        with Bag(args.bag) as bag:
            sys.stdout.write("".join(f"{topic}\n" for topic in bag.topics()))
        return 0
    from gazelle_ros.tools.listing import list_topics

    with _graph() as graph:
        list_topics(
            graph,
            sys.stdout,
            args.space,
            verbose=args.verbose,
            publishers=not args.subscribers,
            subscribers=not args.publishers,
            by_host=args.host,
        )
    return 0


def _info(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.listing import topic_info

    with _graph() as graph:
        sys.stdout.write(topic_info(graph, args.topic) + "\n")
    return 0


def _type(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.listing import topic_type

    with _graph() as graph:
        sys.stdout.write(topic_type(graph, args.topic) + "\n")
    return 0


_ONE = {"info": _info, "type": _type}


def _find(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.listing import topics_of_type

    with _graph() as graph:
        sys.stdout.write("\n".join(topics_of_type(graph, args.type)) + "\n")
    return 0


def _echo(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.echoing import EchoOptions, echo, echo_bag, filter_of

    if args.topic is None and not (args.bag and args.all):
        args.parser.error("give a topic")
    if args.all and not args.bag:
        args.parser.error("--all is for bags: give --bag FILE")
    options = EchoOptions(
        count=args.count,
        plot=args.plot,
        no_strings=args.nostr,
        no_arrays=args.noarr,
        clear=args.clear,
        offset=args.offset,
        width=args.width,
        keep=filter_of(args.filter) if args.filter else None,
    )
    if args.bag:
        with stopping() as stop:
            topic = None if args.all else args.topic
            echo_bag(args.bag, topic, sys.stdout, options, stop)
        return 0
    with _graph() as graph, stopping() as stop:
        echo(graph, args.topic, sys.stdout, options, stop)
    return 0


def _publish(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.publishing import MessagePublisher, parse_arguments, publish

    if args.values and args.file:
        args.parser.error("give values or --file, not both")
    values = parse_arguments(args.values)
    with _graph() as graph, stopping() as stop:
        publisher = MessagePublisher(
            graph,
            args.topic,
            args.type,
            sys.stdout,
            stop,
            latch=args.rate is None or args.latch,
            verbose=args.verbose,
            ros_time=args.use_rostime,
        )
        try:
            publish(
                publisher,
                values,
                _source(args, takes_values=publisher.takes_values and not values),
                hertz=args.rate,
                once=args.once,
                latch=args.latch,
                fresh=args.substitute_keywords,
            )
        finally:
            publisher.close()
    return 0


def _source(args: argparse.Namespace, *, takes_values: bool) -> Iterable[list[Any]] | None:
    """Return the source of messages other than the command line, if any."""
    from gazelle_ros.tools.publishing import documents, file_documents

    if args.file:
        return file_documents(args.file)
    if not takes_values:
        return None
    if sys.stdin.isatty():
        args.parser.error("give the values of the message")
    return documents(sys.stdin)


def _hz(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.echoing import filter_of
    from gazelle_ros.tools.rates import measure_rates

    with _graph() as graph, stopping() as stop:
        measure_rates(
            graph,
            args.topics,
            sys.stdout,
            stop,
            window=args.window,
            keep=filter_of(args.filter) if args.filter else None,
            wall_time=args.wall_time,
            tcp_nodelay=args.tcpnodelay,
        )
    return 0


def _bw(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.rates import measure_size

    with _graph() as graph, stopping() as stop:
        measure_size(graph, args.topic, sys.stdout, stop, window=args.window)
    return 0


def _delay(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.rates import measure_delay

    with _graph() as graph, stopping() as stop:
        measure_delay(
            graph,
            args.topic,
            sys.stdout,
            stop,
            window=args.window,
            tcp_nodelay=args.tcpnodelay,
        )
    return 0
