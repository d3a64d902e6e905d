"""Recording and playing from a command line, also as nodes of a launch file."""

from __future__ import annotations

import argparse
import contextlib
import select
import sys
import threading
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from gazelle_ros import names
from gazelle_ros.base.argument_types import positive_float, positive_int, seconds
from gazelle_ros.base.interrupts import stopping
from gazelle_ros.base.output import say, say_line
from gazelle_ros.base.terminal import kept_terminal


def configure_record(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of recording."""
    parser.add_argument("topics", nargs="*", metavar="/TOPIC")
    what = parser.add_argument_group("topics")
    what.add_argument(
        "-a", "--all", action="store_true", help="record all topics, including new ones"
    )
    what.add_argument(
        "-e", "--regex", action="store_true", help="treat topics as regular expressions"
    )
    what.add_argument(
        "-x", "--exclude", default="", metavar="REGEX", help="exclude topics that match"
    )
    what.add_argument("--node", default="", help="record all topics that a node subscribes to")
    what.add_argument(
        "-p",
        "--publish",
        action="store_true",
        help="publish the name of each new file on /begin_write",
    )
    what.add_argument(
        "-l",
        "--limit",
        type=int,
        default=0,
        metavar="N",
        help="maximum number of messages per topic",
    )
    where = parser.add_argument_group("output")
    where.add_argument(
        "-o",
        "--output-prefix",
        default="",
        metavar="PREFIX",
        dest="prefix",
        help="prefix of the file name",
    )
    where.add_argument(
        "-O", "--output-name", default="", metavar="NAME", dest="name", help="name of the bag"
    )
    where.add_argument(
        "--split", action="store_true", help="start a new file at --size or --duration"
    )
    where.add_argument(
        "--max-splits", type=int, default=0, metavar="N", help="keep only the last N files"
    )
    where.add_argument("--size", type=positive_int, metavar="MB", help="maximum size of a file")
    where.add_argument("--duration", metavar="TIME", help="maximum duration of a file: 30, 5m, 2h")
    where.add_argument(
        "--repeat-latched", action="store_true", help="repeat latched messages in each file"
    )
    add_compression(where)
    more = parser.add_argument_group("other")
    more.add_argument(
        "-b", "--buffsize", metavar="MB", help="ignored; messages are written at once"
    )
    more.add_argument(
        "--chunksize",
        type=positive_int,
        default=768,
        metavar="KB",
        help="size of chunks (default 768)",
    )
    more.add_argument("--tcpnodelay", action="store_true", help="request TCP_NODELAY")
    more.add_argument("--udp", action="store_true", help=argparse.SUPPRESS)
    more.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    parser.set_defaults(compression="none", parser=parser)


def add_compression(parser: Any) -> None:
    """Declare the kinds of compression."""
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument(
        "-j",
        "--bz2",
        dest="compression",
        action="store_const",
        const="bz2",
        help="compress with bz2",
    )
    kinds.add_argument(
        "--lz4", dest="compression", action="store_const", const="lz4", help="compress with lz4"
    )


def record(args: argparse.Namespace, node_options: Mapping[str, Any] | None = None) -> int:
    """Record; returns the exit code.

    Args:
        args: Arguments of `configure_record`.
        node_options: Of the node; by default it has a name of its own.
    """
    from gazelle_ros.bags.recording import BagRecorder, RecordOptions, check, duration_of
    from gazelle_ros.node import Node

    options = RecordOptions(
        topics=args.topics,
        all_topics=args.all or (bool(args.exclude) and not args.topics),
        regex=args.regex,
        exclude=args.exclude,
        node=args.node,
        prefix=args.prefix,
        name=args.name,
        split=args.split,
        most_files=args.max_splits,
        size=(args.size or 0) * 1_000_000,
        duration=duration_of(args.duration) if args.duration else 0.0,
        limit=args.limit,
        compression=args.compression or "none",
        chunk_bytes=args.chunksize * 1024,
        tcp_nodelay=args.tcpnodelay,
        repeat_latched=args.repeat_latched,
        publish=args.publish,
    )
    check(options)
    keywords = node_options or {"name": names.anonymous("record")}
    with Node(**keywords) as node, stopping() as stop:
        BagRecorder(node, options, _quiet if args.quiet else say_line).run(stop)
    return 0


def configure_play(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of playing."""
    parser.add_argument("bags", nargs="*", metavar="BAG")
    when = parser.add_argument_group("time")
    when.add_argument(
        "-r",
        "--rate",
        type=positive_float,
        default=1.0,
        metavar="X",
        help="speed factor (default 1)",
    )
    when.add_argument(
        "-s",
        "--start",
        type=seconds,
        default=0.0,
        metavar="S",
        help="start this many seconds into the bag",
    )
    when.add_argument(
        "-u", "--duration", type=positive_float, metavar="S", help="play only this many seconds"
    )
    when.add_argument("-l", "--loop", action="store_true", help="repeat until interrupted")
    when.add_argument("-i", "--immediate", action="store_true", help="publish without waiting")
    when.add_argument("--pause", action="store_true", help="start paused")
    when.add_argument(
        "-d",
        "--delay",
        type=seconds,
        default=0.2,
        metavar="S",
        help="wait after advertising the topics [s] (default 0.2)",
    )
    when.add_argument(
        "--skip-empty", type=positive_float, metavar="S", help="skip gaps longer than this [s]"
    )
    when.add_argument(
        "--wait-for-subscribers", action="store_true", help="wait for a subscriber of every topic"
    )
    when.add_argument(
        "-k", "--keep-alive", action="store_true", help="keep the topics advertised after the end"
    )
    what = parser.add_argument_group("topics")
    what.add_argument(
        "--topics", nargs="+", default=[], metavar="/TOPIC", help="play only these topics"
    )
    what.add_argument(
        "--pause-topics",
        nargs="+",
        default=[],
        metavar="/TOPIC",
        help="pause before messages of these topics",
    )
    what.add_argument(
        "--bags",
        nargs="+",
        default=[],
        dest="more_bags",
        metavar="BAG",
        help="further bags to play",
    )
    what.add_argument("-p", "--prefix", default="", help="prefix for the names of all topics")
    what.add_argument("--clock", action="store_true", help="publish /clock")
    what.add_argument(
        "--hz", type=positive_float, default=100.0, help="rate of /clock (default 100)"
    )
    what.add_argument(
        "--queue",
        type=positive_int,
        default=100,
        metavar="N",
        help="queue size of publishers (default 100)",
    )
    what.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    what.add_argument("--try-future-version", action="store_true", help=argparse.SUPPRESS)
    parser.set_defaults(parser=parser)


def play(args: argparse.Namespace, node_options: Mapping[str, Any] | None = None) -> int:
    """Play bags; returns the exit code.

    Args:
        args: Arguments of `configure_play`.
        node_options: Of the node; by default it has a name of its own.
    """
    from gazelle_ros.bags.playing import Player, PlayOptions
    from gazelle_ros.clock import WallClock
    from gazelle_ros.node import Node

    bags = [*args.bags, *args.more_bags]
    if not bags:
        args.parser.error("give a bag")
    options = PlayOptions(
        rate=args.rate,
        start=args.start,
        duration=args.duration,
        loop=args.loop,
        immediate=args.immediate,
        paused=args.pause,
        delay=args.delay,
        clock=args.clock,
        clock_hertz=args.hz,
        queue_size=args.queue,
        topics=args.topics,
        pause_topics=args.pause_topics,
        prefix=args.prefix,
        skip_empty=args.skip_empty,
        wait_for_subscribers=args.wait_for_subscribers,
        keep_alive=args.keep_alive,
    )
    keywords = node_options or {"name": names.anonymous("play")}
    with Node(**keywords, clock=WallClock()) as node, stopping() as stop:
        player = Player(node, bags, options, None if args.quiet else _PlayStatus().show)
        try:
            with _keys(player, stop):
                player.play(stop)
        finally:
            player.close()
            if not args.quiet and sys.stderr.isatty():
                sys.stderr.write("\n")
    return 0


class _PlayStatus:
    """A line with the time of the bag, rewritten in place on a terminal."""

    def __init__(self) -> None:
        self._live = sys.stderr.isatty()
        self._last = ""

    def show(self, state: str, now: float, passed: float) -> None:
        """Show the state, if it changed enough to see."""
        text = f"[{state}]  Bag Time: {now:13.6f}   Duration: {passed:.1f}"
        if self._live and text != self._last:
            sys.stderr.write(f"\r{text:<70}")
            sys.stderr.flush()
        self._last = text


@contextlib.contextmanager
def _keys(player: Any, stop: threading.Event) -> Iterator[None]:
    """Handle keys of a terminal while it lasts: space pauses and continues, s steps."""
    with kept_terminal(sys.stdin) as there:
        if not there:
            yield
            return
        import tty

        say("space: pause or go on, s: one message, Ctrl-C: end\n")
        ended = threading.Event()
        watcher = threading.Thread(target=_watch, args=(player, ended, stop), daemon=True)
        tty.setcbreak(sys.stdin)
        watcher.start()
        try:
            yield
        finally:
            ended.set()
            watcher.join()


def _watch(player: Any, ended: threading.Event, stop: threading.Event) -> None:
    """Act on keys until the end, also of the terminal."""
    actions: dict[str, Callable[[], None]] = {" ": player.toggle, "s": player.step}
    while not (ended.is_set() or stop.is_set()):
        if select.select([sys.stdin], [], [], 0.1)[0]:
            try:
                key = sys.stdin.read(1)
            except OSError:
                return
            if not key:
                return
            actions.get(key, lambda: None)()


def _quiet(text: str) -> None:
    del text
