"""What rosbag does: record, play and inspect bag files.

gazelle bag record -O drive /scan /odom
gazelle bag play drive.bag --clock -r 2
gazelle bag info drive.bag
gazelle bag filter drive.bag scans.bag "topic == '/scan'"
"""

from __future__ import annotations

import argparse
import contextlib
import select
import sys
import threading
from collections.abc import Callable, Iterator
from typing import Any

from gazelle.cli.parsing import positive_float, positive_int
from gazelle.cli.tools import SubCommands, stopping


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    configure_record(commands.add("record", "record topics", record))
    configure_play(commands.add("play", "publish what was recorded", play))
    info = commands.add("info", "what is in bags", _info)
    info.add_argument("bags", nargs="+", metavar="BAG")
    info.add_argument("-y", "--yaml", action="store_true", help="as YAML")
    info.add_argument("-k", "--key", help="one value of it")
    info.add_argument("--freq", action="store_true", help="rates of topics too")
    checking = commands.add("check", "whether its types are those known here", _check)
    checking.add_argument("bag", metavar="BAG")
    filtering = commands.add("filter", "copy the messages that an expression chooses", _filter)
    filtering.add_argument("source", metavar="IN")
    filtering.add_argument("target", metavar="OUT")
    filtering.add_argument("expression", metavar="EXPR", help="Python, with topic, m and t")
    filtering.add_argument("-p", "--print", dest="shown", metavar="EXPR", help="show of each")
    for name, purpose, action in (
        ("reindex", "make bags whole that were cut off", _reindex),
        ("compress", "compress bags", _compress),
        ("decompress", "undo compress", _compress),
    ):
        sub = commands.add(name, purpose, action)
        sub.add_argument("bags", nargs="+", metavar="BAG")
        sub.add_argument("--output-dir", default="", metavar="DIR", help="write there")
        sub.add_argument("-f", "--force", action="store_true", help="overwrite a backup")
        sub.add_argument("-q", "--quiet", action="store_true", help="say nothing")
        sub.set_defaults(compression="none" if name == "decompress" else "bz2")
        if name == "compress":
            _add_compression(sub)


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    code: int = args.action(args)
    return code


def configure_record(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of recording."""
    parser.add_argument("topics", nargs="*", metavar="/TOPIC")
    what = parser.add_argument_group("what")
    what.add_argument("-a", "--all", action="store_true", help="all topics, new ones too")
    what.add_argument("-e", "--regex", action="store_true", help="topics are regular expressions")
    what.add_argument("-x", "--exclude", default="", metavar="REGEX", help="not these topics")
    what.add_argument("--node", default="", help="what a node subscribes to")
    what.add_argument("-l", "--limit", type=int, default=0, metavar="N", help="messages a topic")
    where = parser.add_argument_group("where to")
    where.add_argument("-o", "--output-prefix", default="", metavar="PREFIX", dest="prefix")
    where.add_argument("-O", "--output-name", default="", metavar="NAME", dest="name")
    where.add_argument("--split", action="store_true", help="a new file at the limits")
    where.add_argument("--max-splits", type=int, default=0, metavar="N", help="keep N files")
    where.add_argument("--size", type=positive_int, metavar="MB", help="at most, of a file")
    where.add_argument("--duration", metavar="TIME", help="at most, of a file: 30, 5m, 2h")
    where.add_argument("--repeat-latched", action="store_true", help="in each split file")
    _add_compression(where)
    more = parser.add_argument_group("more")
    more.add_argument("-b", "--buffsize", help=argparse.SUPPRESS)
    more.add_argument("--chunksize", type=positive_int, default=768, metavar="KB")
    more.add_argument("--tcpnodelay", action="store_true", help="ask for it")
    more.add_argument("--udp", action="store_true", help=argparse.SUPPRESS)
    more.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    parser.set_defaults(compression="none", parser=parser)


def _add_compression(parser: Any) -> None:
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("-j", "--bz2", dest="compression", action="store_const", const="bz2")
    kinds.add_argument("--lz4", dest="compression", action="store_const", const="lz4")


def record(args: argparse.Namespace) -> int:
    """Record; returns the exit code."""
    from gazelle.ros import names
    from gazelle.ros.bags.recording import Recorder, RecordOptions, check, duration_of
    from gazelle.ros.node import Node

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
    )
    check(options)
    keywords = getattr(args, "node_options", None) or {"name": names.anonymous("record")}
    with stopping() as stop, Node(**keywords) as node:
        Recorder(node, options, _quiet if args.quiet else _say).run(stop)
    return 0


def configure_play(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments of playing."""
    parser.add_argument("bags", nargs="*", metavar="BAG")
    when = parser.add_argument_group("when")
    when.add_argument("-r", "--rate", type=positive_float, default=1.0, metavar="X", help="faster")
    when.add_argument("-s", "--start", type=float, default=0.0, metavar="S", help="seconds into it")
    when.add_argument("-u", "--duration", type=positive_float, metavar="S", help="seconds of it")
    when.add_argument("-l", "--loop", action="store_true", help="again and again")
    when.add_argument("-i", "--immediate", action="store_true", help="as fast as possible")
    when.add_argument("--pause", action="store_true", help="begin paused")
    when.add_argument("-d", "--delay", type=float, default=0.2, metavar="S", help="before it")
    when.add_argument("--skip-empty", type=positive_float, metavar="S", help="jump over gaps")
    when.add_argument("--wait-for-subscribers", action="store_true", help="of every topic")
    when.add_argument("-k", "--keep-alive", action="store_true", help="stay after the end")
    what = parser.add_argument_group("what")
    what.add_argument("--topics", nargs="+", default=[], metavar="/TOPIC", help="only these")
    what.add_argument("--pause-topics", nargs="+", default=[], metavar="/TOPIC")
    what.add_argument("--bags", nargs="+", default=[], dest="more_bags", metavar="BAG")
    what.add_argument("-p", "--prefix", default="", help="before the names of topics")
    what.add_argument("--clock", action="store_true", help="publish /clock")
    what.add_argument("--hz", type=positive_float, default=100.0, help="of /clock")
    what.add_argument("--queue", type=positive_int, default=100, metavar="N")
    what.add_argument("-q", "--quiet", action="store_true", help="say nothing")
    what.add_argument("--try-future-version", action="store_true", help=argparse.SUPPRESS)
    parser.set_defaults(parser=parser)


def play(args: argparse.Namespace) -> int:
    """Play; returns the exit code."""
    from gazelle.ros import names
    from gazelle.ros.bags.playing import Player, PlayOptions
    from gazelle.ros.clock import WallClock
    from gazelle.ros.node import Node

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
    keywords = getattr(args, "node_options", None) or {"name": names.anonymous("play")}
    with stopping() as stop, Node(**keywords, clock=WallClock()) as node:
        player = Player(node, bags, options, None if args.quiet else _Status().show)
        try:
            with _keys(player, stop):
                player.play(stop)
        finally:
            player.close()
            if not args.quiet and sys.stderr.isatty():
                sys.stderr.write("\n")
    return 0


class _Status:
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
    """On a terminal: space pauses and goes on, s steps."""
    if not sys.stdin.isatty():
        yield
        return
    import termios
    import tty

    sys.stdout.write("space: pause or go on, s: one message, Ctrl-C: end\n")
    sys.stdout.flush()
    actions: dict[str, Callable[[], None]] = {" ": player.toggle, "s": player.step}
    old = termios.tcgetattr(sys.stdin)
    ended = threading.Event()

    def watch() -> None:
        while not (ended.is_set() or stop.is_set()):
            if select.select([sys.stdin], [], [], 0.1)[0]:
                actions.get(sys.stdin.read(1), lambda: None)()

    watcher = threading.Thread(target=watch, daemon=True)
    tty.setcbreak(sys.stdin)
    watcher.start()
    try:
        yield
    finally:
        ended.set()
        watcher.join()
        termios.tcsetattr(sys.stdin, termios.TCSADRAIN, old)


def _info(args: argparse.Namespace) -> int:
    from gazelle.ros.bags import Bag
    from gazelle.ros.bags.info import as_dict, as_yaml, describe, value_of

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
    from gazelle.ros.bags.operations import check

    problems = check(args.bag)
    if not problems:
        sys.stdout.write("Bag file does not need any migrations.\n")
        return 0
    sys.stdout.write("".join(f"{problem}\n" for problem in problems))
    return 1


def _filter(args: argparse.Namespace) -> int:
    from gazelle.ros.bags.operations import filter_bag, keep_of

    show = None
    if args.shown:
        shown: Callable[..., Any] = keep_of(args.shown)

        def show(good: bool, topic: str, message: Any, stamp: Any) -> None:  # noqa: FBT001
            sys.stdout.write(f"{'MATCH' if good else 'NO MATCH'} {shown(topic, message, stamp)}\n")

    kept, total = filter_bag(args.source, args.target, keep_of(args.expression), show)
    sys.stdout.write(f"{args.target}: {kept} of {total} messages\n")
    return 0


def _reindex(args: argparse.Namespace) -> int:
    from gazelle.ros.bags.operations import reindex

    for path in args.bags:
        old, found = reindex(path, folder=args.output_dir, force=args.force)
        count = sum(sum(chunk.counts.values()) for chunk in found.index.chunks)
        if not args.quiet:
            sys.stdout.write(f"{path}: {count} messages; the old bag is {old}\n")
            if found.damage:
                sys.stdout.write(f"{path}: what followed is lost: {found.damage}\n")
    return 0


def _compress(args: argparse.Namespace) -> int:
    from gazelle.ros.bags.operations import recompress

    for path in args.bags:
        old = recompress(path, args.compression, folder=args.output_dir, force=args.force)
        if not args.quiet:
            sys.stdout.write(f"{path}: {args.compression}; the old bag is {old}\n")
    return 0


def _say(text: str) -> None:
    sys.stdout.write(f"{text}\n")
    sys.stdout.flush()


def _quiet(text: str) -> None:
    del text
