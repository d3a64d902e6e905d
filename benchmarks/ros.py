"""Topics, services and start-up of gazelle_ros beside the real rospy, in turns in one run.

Both run the same programs (`_ros_roles.py`, written for rospy) in the same interpreter, on a
Gazelle master; times are those of the best round. Debian packages the real one: python3-rospy,
python3-sensor-msgs, python3-std-srvs, and python3-rosmaster with roscore for the last lines.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import xmlrpc.client
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROLES = HERE / "_ros_roles.py"
PACKAGE = HERE.parent / "packages" / "gazelle-ros"
DEBIAN = "/usr/bin/python3"
OURS, THEIRS = "gazelle", "rospy"
Figures = dict[str, float]


@dataclass(frozen=True)
class Bench:
    """Where and how the programs run.

    Attributes:
        python: The interpreter of both.
        env: Their environment; it names the master.
        seconds: Length of a round of what is counted.
        trips: Messages of a round of what is timed one by one.
    """

    python: str
    env: dict[str, str]
    seconds: float
    trips: int

    def start(self, who: str, role: str, *arguments: object) -> subprocess.Popen[str]:
        """Start a role."""
        words = [self.python, str(ROLES), who, role, *map(str, arguments)]
        return subprocess.Popen(words, env=self.env, stdout=subprocess.PIPE, text=True)

    def figures(self, process: subprocess.Popen[str]) -> Figures:
        """Wait for what a role tells."""
        try:
            out, _ = process.communicate(timeout=60)
        except subprocess.TimeoutExpired:
            process.kill()
            raise
        if process.returncode or not out:
            raise SystemExit(f"a program failed: {' '.join(map(str, process.args))}")  # type: ignore[arg-type]
        figures: Figures = json.loads(out)
        return figures

    @contextlib.contextmanager
    def beside(self, who: str, role: str, *arguments: object) -> Iterator[subprocess.Popen[str]]:
        """Run a role in the background."""
        process = self.start(who, role, *arguments)
        try:
            yield process
        finally:
            process.terminate()
            process.communicate()


# What is measured ---------------------------------------------------------------------------


def ping_pong(bench: Bench, who: str, nodelay: int) -> Figures:
    """Measure two processes, a String there and back."""
    with bench.beside(who, "echo", nodelay):
        return bench.figures(bench.start(who, "ping", nodelay, bench.trips))


def paced(bench: Bench, who: str) -> Figures:
    """Measure one way at 100 Hz."""
    count = round(100 * bench.seconds)
    with bench.beside(who, "paced", 100, count):
        return bench.figures(bench.start(who, "clocked", count))


def flood(bench: Bench, who: str, kind: str) -> Figures:
    """Measure the highest rate of messages without losses."""
    with bench.beside(who, "source", kind, bench.seconds):
        return bench.figures(bench.start(who, "sink", kind))


def calls(bench: Bench, who: str, persistent: int) -> Figures:
    """Measure the highest rate of service calls."""
    with bench.beside(who, "server"):
        return bench.figures(bench.start(who, "caller", persistent, bench.seconds))


def crowd(bench: Bench, who: str) -> Figures:
    """Measure 72 publishers of one node at 10 Hz, with subscribers in another node."""
    seconds = max(3.0, bench.seconds)
    sink = bench.start(who, "crowd_in", 72, seconds)
    source = bench.figures(bench.start(who, "crowd_out", 72, 10, seconds))
    heard = bench.figures(sink)
    return {
        "source": source["share"],
        "sink": heard["share"],
        "threads": max(source["threads"], heard["threads"]),
    }


def start(bench: Bench, who: str) -> Figures:
    """Measure the start of a short program."""
    begin = time.perf_counter()
    figures = bench.figures(bench.start(who, "start"))
    return {**figures, "whole": 1e3 * (time.perf_counter() - begin)}


def within(bench: Bench, who: str, kind: str) -> Figures:
    """Measure topics inside one process."""
    return bench.figures(bench.start(who, "within", kind, bench.seconds))


def within_calls(bench: Bench, who: str, persistent: int) -> Figures:
    """Measure services inside one process."""
    return bench.figures(bench.start(who, "within_calls", persistent, bench.seconds))


def master(bench: Bench, who: str) -> Figures:
    """Measure the time until a master answers."""
    port = free_port()
    if who == OURS:
        words = [bench.python, "-m", "gazelle_ros", "master", "--port", str(port)]
    else:
        words = ["roscore", "-p", str(port)]
    env = {**bench.env, "ROS_MASTER_URI": f"http://127.0.0.1:{port}"}
    begin = time.perf_counter()
    quiet = subprocess.DEVNULL
    process = subprocess.Popen(words, env=env, stdout=quiet, stderr=quiet, cwd=PACKAGE)
    try:
        wait_for_master(port)
        return {"answers": 1e3 * (time.perf_counter() - begin)}
    finally:
        process.terminate()
        process.wait()


Measure = Callable[[Bench, str], Figures]
ROWS: tuple[tuple[str, Measure, tuple[tuple[str, str, str], ...]], ...] = (
    (
        "ping-pong",
        partial(ping_pong, nodelay=1),
        (
            ("String there and back, tcp_nodelay", "median", "us"),
            ("                       99th percentile", "p99", "us"),
        ),
    ),
    (
        "ping-pong-delay",
        partial(ping_pong, nodelay=0),
        (
            ("String there and back, without", "median", "us"),
            ("                       99th percentile", "p99", "us"),
        ),
    ),
    (
        "paced",
        paced,
        (
            ("String one way at 100 Hz", "median", "us"),
            ("                       99th percentile", "p99", "us"),
        ),
    ),
    ("string", partial(flood, kind="string"), (("String, flat out", "rate", "/s"),)),
    ("scan", partial(flood, kind="scan"), (("LaserScan of 720, flat out", "rate", "/s"),)),
    ("image", partial(flood, kind="image"), (("Image of 0.92 MB, flat out", "rate", "/s"),)),
    ("persistent", partial(calls, persistent=1), (("service, persistent", "rate", "/s"),)),
    ("calls", partial(calls, persistent=0), (("service, a connection a call", "rate", "/s"),)),
    (
        "crowd",
        crowd,
        (
            ("72 publishers at 10 Hz: their CPU", "source", "%"),
            ("                        subscriber's", "sink", "%"),
            ("                        threads", "threads", ""),
        ),
    ),
    (
        "start",
        start,
        (
            ("node: imports", "imports", "ms"),
            ("      init_node", "init", "ms"),
            ("      own latched message", "first", "ms"),
            ("      whole short program", "whole", "ms"),
        ),
    ),
    (
        "within",
        partial(within, kind="string"),
        (
            ("one process: String, flat out", "rate", "/s"),
            ("             String, latency", "median", "us"),
            ("             99th percentile", "p99", "us"),
        ),
    ),
    (
        "within-image",
        partial(within, kind="image"),
        (("             Image, flat out", "rate", "/s"),),
    ),
    (
        "within-calls",
        partial(within_calls, persistent=0),
        (("             service calls", "rate", "/s"),),
    ),
    (
        "within-persistent",
        partial(within_calls, persistent=1),
        (("             service, persistent", "rate", "/s"),),
    ),
    ("master", master, (("master answers (theirs: roscore)", "answers", "ms"),)),
)


# Running ------------------------------------------------------------------------------------


def main(argv: list[str] | None = None) -> None:
    """Measure and print a table."""
    parser = argparse.ArgumentParser(prog="gazelle bench ros", description=__doc__)
    parser.add_argument("rows", nargs="*", help=f"of {', '.join(name for name, *_ in ROWS)}")
    parser.add_argument("--rounds", type=int, default=3, help="of which the best (default 3)")
    parser.add_argument("--seconds", type=float, default=2.0, help="of a round (default 2)")
    parser.add_argument("--python", help=f"of both (default: {DEBIAN} if it has rospy)")
    args = parser.parse_args(argv)
    unknown = set(args.rows) - {name for name, *_ in ROWS}
    if unknown:
        parser.error(f"there is no row {', '.join(sorted(unknown))}")
    peers = [OURS, THEIRS]
    if not has_rospy(args.python or DEBIAN):
        print("the real rospy is not installed (Debian: ros-core python3-std-srvs); ours alone:")
        peers = [OURS]
    python = args.python or (DEBIAN if THEIRS in peers else sys.executable)
    version = subprocess.run([python, "--version"], capture_output=True, text=True, check=True)
    turns = "both, in turns," if THEIRS in peers else "alone,"
    print(f"{version.stdout.strip()}, {turns} best of {args.rounds} rounds")
    if THEIRS in peers:
        print("ratio: how many times better ours is, be that faster or less")
    print(f"{'':40}{'':>4}{'gazelle':>11}" + (f"{'rospy':>11}{'ratio':>8}" if peers[1:] else ""))
    with running(python, args) as bench:
        for name, measure, lines in ROWS:
            if not args.rows or name in args.rows:
                show(bench, measure, lines, peers, args.rounds)


def show(
    bench: Bench,
    measure: Measure,
    lines: tuple[tuple[str, str, str], ...],
    peers: list[str],
    rounds: int,
) -> None:
    """Print the lines of one measure."""
    if measure is master and shutil.which("roscore") is None:
        peers = [OURS]
    found: dict[str, list[Figures]] = {who: [] for who in peers}
    for _ in range(rounds):
        for who in peers:
            found[who].append(measure(bench, who))
    for text, key, unit in lines:
        pick = max if unit == "/s" else min
        best = {who: pick(figures[key] for figures in found[who]) for who in peers}
        cells = "".join(f"{best[who]:>11,.{digits(best[who])}f}" for who in peers)
        ratio = ""
        if THEIRS in best:
            better = best[OURS] / best[THEIRS] if unit == "/s" else best[THEIRS] / best[OURS]
            ratio = f"{better:>8.2f}"
        print(f"{text:40}{unit:>4}{cells}{ratio}", flush=True)


def digits(value: float) -> int:
    """Return the significant decimals."""
    return 0 if value >= 100 or value == int(value) else 1


@contextlib.contextmanager
def running(python: str, args: argparse.Namespace) -> Iterator[Bench]:
    """Run a bench with a master of its own."""
    port = free_port()
    with tempfile.TemporaryDirectory() as home:
        env = {
            **{key: os.environ[key] for key in ("HOME", "LANG") if key in os.environ},
            "PATH": "/usr/bin:/bin",
            "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
            "ROS_IP": "127.0.0.1",
            "ROS_HOME": home,
            "PYTHONWARNINGS": "ignore",
        }
        words = [python, "-m", "gazelle_ros", "master", "--port", str(port), "--no-rosout"]
        core = subprocess.Popen(words, env=env, stdout=subprocess.DEVNULL, cwd=PACKAGE)
        try:
            wait_for_master(port)
            yield Bench(python, env, args.seconds, round(1500 * args.seconds) + 200)
        finally:
            core.terminate()
            core.wait()


def has_rospy(python: str) -> bool:
    """Return whether an interpreter finds the real rospy, and the programs' modules."""
    if shutil.which(python) is None:
        return False
    code = "import rospy, sensor_msgs.msg, std_srvs.srv"
    return subprocess.run([python, "-c", code], capture_output=True, check=False).returncode == 0


def wait_for_master(port: int) -> None:
    """Ask until it answers."""
    proxy = xmlrpc.client.ServerProxy(f"http://127.0.0.1:{port}")
    deadline = time.monotonic() + 20
    while time.monotonic() < deadline:
        with contextlib.suppress(OSError):
            proxy.getPid("/bench")
            return
        time.sleep(0.002)
    raise SystemExit("the master does not answer")


def free_port() -> int:
    """Return a port nobody uses."""
    with socket.socket() as sock:
        sock.bind(("127.0.0.1", 0))
        number: int = sock.getsockname()[1]
        return number


if __name__ == "__main__":
    main()
