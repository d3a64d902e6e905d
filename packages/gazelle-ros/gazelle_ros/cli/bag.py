"""Record, play and inspect bag files, as rosbag does.

gazelle bag record -O drive /scan /odom
gazelle bag play drive.bag --clock -r 2 /scan:=/old_scan
gazelle bag info drive.bag
gazelle bag filter drive.bag scans.bag "topic == '/scan'"
gazelle bag to-mcap drive.bag drive.mcap
"""  # this is the text of --help

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable
from typing import Any

from gazelle_ros.cli.tools import SubCommands


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    from gazelle_ros.bags.commandline import add_compression, configure_play, configure_record

    commands = SubCommands(parser)
    configure_record(commands.add("record", "record topics", _record, "-O drive /scan /odom", "-a"))
    configure_play(
        commands.add("play", "play back bags", _play, "drive.bag --clock -r 2 /scan:=/old_scan")
    )
    info = commands.add("info", "show the contents of bags", _info, "drive.bag")
    info.add_argument("bags", nargs="+", metavar="BAG")
    info.add_argument("-y", "--yaml", action="store_true", help="print YAML")
    info.add_argument("-k", "--key", help="print only this key of the YAML")
    info.add_argument("--freq", action="store_true", help="show the rates of topics")
    checking = commands.add(
        "check", "compare the message types of a bag with the bundled ones", _check
    )
    checking.add_argument("bag", metavar="BAG")
    filtering = commands.add(
        "filter",
        "copy the messages for which an expression is true",
        _filter,
        "drive.bag scans.bag \"topic == '/scan'\"",
    )
    filtering.add_argument("source", metavar="IN")
    filtering.add_argument("target", metavar="OUT")
    filtering.add_argument(
        "expression", metavar="EXPR", help="Python expression of topic, message m and time t"
    )
    filtering.add_argument(
        "-p",
        "--print",
        dest="shown",
        metavar="EXPR",
        help="expression to print for each copied message",
    )
    fixing = commands.add("fix", "copy a bag and convert it to the bundled message types", _fix)
    fixing.add_argument("source", metavar="IN")
    fixing.add_argument("target", metavar="OUT")
    fixing.add_argument("rules", nargs="*", metavar="RULES", help=argparse.SUPPRESS)
    fixing.add_argument(
        "--force", action="store_true", help="copy even if some types cannot be converted"
    )
    fixing.add_argument("-n", "--noplugins", action="store_true", help=argparse.SUPPRESS)
    mcap = commands.add(
        "to-mcap", "convert a bag to MCAP, for Foxglove", _to_mcap, "drive.bag drive.mcap"
    )
    mcap.add_argument("source", metavar="IN")
    mcap.add_argument(
        "target", metavar="OUT", nargs="?", help="output file (default: IN with suffix .mcap)"
    )
    for name, purpose, action in (
        ("reindex", "rebuild the index of truncated bags", _reindex),
        ("compress", "compress bags", _compress),
        ("decompress", "decompress bags", _compress),
    ):
        sub = commands.add(name, purpose, action, "drive.bag")
        sub.add_argument("bags", nargs="+", metavar="BAG")
        sub.add_argument("--output-dir", default="", metavar="DIR", help="output folder")
        sub.add_argument("-f", "--force", action="store_true", help="overwrite an existing backup")
        sub.add_argument("-q", "--quiet", action="store_true", help="print nothing")
        sub.set_defaults(compression="none" if name == "decompress" else "bz2")
        if name == "compress":
            add_compression(sub)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _record(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.commandline import record

    return record(args, _node_options(args, "record", "topics"))


def _play(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.commandline import play

    own = ("bags", "more_bags", "topics", "pause_topics")
    return play(args, _node_options(args, "play", *own))


def _node_options(args: argparse.Namespace, name: str, *lists: str) -> dict[str, Any]:
    """Remove the remappings from lists of arguments; return the node's options in them."""
    from gazelle_ros.builtin.arguments import parse_arguments

    words = [word for each in lists for word in getattr(args, each)]
    for each in lists:
        setattr(args, each, [word for word in getattr(args, each) if ":=" not in word])
    mappings = [word for word in words if ":=" in word]
    return parse_arguments(mappings, name, anonymous=True).options


def _info(args: argparse.Namespace) -> int:
    from gazelle_ros.bags import Bag
    from gazelle_ros.bags.info import as_dict, as_yaml, describe, value_of

    for number, path in enumerate(args.bags):
        with Bag(path) as bag:
            if args.key:
                text = value_of(as_dict(bag, rates=args.freq), args.key)
            elif args.yaml:
                text = as_yaml(as_dict(bag, rates=args.freq))
            else:
                text = describe(bag, rates=args.freq)
        separator = "---\n" if number else ""
        sys.stdout.write(f"{separator}{text}\n")
    return 0


def _check(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.operations import check

    problems = check(args.bag)
    if not problems:
        sys.stdout.write("Bag file does not need any migrations.\n")
        return 0
    sys.stdout.write("".join(f"{problem}\n" for problem in problems))
    return 1


def _fix(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.operations import fix_bag

    if args.rules:
        args.parser.error("rules of migration are not run; leave them out")
    problems = fix_bag(args.source, args.target, force=args.force)
    if not problems or args.force:
        sys.stdout.write("Bag migrated successfully.\n")
        return 0
    sys.stderr.write("Bag could not be migrated. These types differ:\n")
    sys.stderr.write("".join(f" * {problem}\n" for problem in problems))
    sys.stderr.write("Rules of migration are not run here; --force copies it as it is.\n")
    return 1


def _filter(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.operations import compile_filter, filter_bag

    show = None
    if args.shown:
        shown: Callable[..., Any] = compile_filter(args.shown)

        def show(good: bool, topic: str, message: Any, stamp: Any) -> None:  # noqa: FBT001
            sys.stdout.write(f"{'MATCH' if good else 'NO MATCH'} {shown(topic, message, stamp)}\n")

    kept, total = filter_bag(args.source, args.target, compile_filter(args.expression), show)
    sys.stdout.write(f"{args.target}: {kept} of {total} messages\n")
    return 0


def _bags(args: argparse.Namespace, *, allow_unindexed: bool = False) -> list[str]:
    """Return the bags that are to be replaced, each once, after a look at all.

    Raises:
        BagError: One is not a bag, so that none is replaced.
    """
    from gazelle_ros.bags.reader import BagReader

    bags = {os.path.realpath(path): path for path in args.bags}
    for path in bags.values():
        BagReader(path, allow_unindexed=allow_unindexed).close()
    return list(bags.values())


def _reindex(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.operations import reindex

    for path in _bags(args, allow_unindexed=True):
        old, found = reindex(path, folder=args.output_dir, force=args.force)
        count = sum(sum(chunk.counts.values()) for chunk in found.index.chunks)
        if not args.quiet:
            sys.stdout.write(f"{path}: {count} messages; the old bag is {old}\n")
            if found.damage:
                sys.stdout.write(f"{path}: what followed is lost: {found.damage}\n")
    return 0


def _to_mcap(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.mcap_files import write_mcap

    target = args.target or f"{args.source.removesuffix('.bag')}.mcap"
    count = write_mcap(args.source, target)
    sys.stdout.write(f"{target}: {count:,} messages\n")
    return 0


def _compress(args: argparse.Namespace) -> int:
    from gazelle_ros.bags.operations import recompress

    for path in _bags(args):
        old = recompress(path, args.compression, folder=args.output_dir, force=args.force)
        if not args.quiet:
            sys.stdout.write(f"{path}: {args.compression}; the old bag is {old}\n")
    return 0
