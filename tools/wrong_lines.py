"""Run command lines with a wrong word, and see that each ends well.

    python tools/wrong_lines.py                        # every line of every command
    python tools/wrong_lines.py train eval --every 10  # every tenth line of two commands

Lines are made from the parsers, see tests/cli/wrong_words.py. Good is an exit code of 0, or of 1 or 2 with
one line of error and no file left. What waits is ended by SIGTERM, and what works for too long. Each line
runs in a child forked from this process, in a folder of its own with a few good files, beside a master.
"""

from __future__ import annotations

import argparse
import contextlib
import itertools
import os
import re
import shutil
import signal
import sys
import tempfile
import time
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "tests"))

from cli.ending_states import spent  # noqa: E402
from cli.forked import a_master, fork_command, import_everything  # noqa: E402
from cli.line_folders import contents, limit, write_bag, write_files  # noqa: E402
from cli.whole_files import broken_files  # noqa: E402
from cli.wrong_words import Line, command_lines  # noqa: E402

SECONDS, CLOCK_S = 20.0, 300.0
"""Most processor time of a line, and most time by the clock while others use the processors."""
IDLE_S = 0.4
END_S, END_CLOCK_S = 2.0, 60.0
BYTES = 2 * 2**30
POLL_S = 0.01
WAITING = {
    *(
        "bag-play",
        "bag-record",
        "bridge",
        "demo",
        "deploy",
        "eval",
        "exec",
        "launch",
        "master",
        "run",
        "shell",
    ),
    *(
        "topic-bw",
        "topic-delay",
        "topic-echo",
        "topic-hz",
        "topic-pub",
        "view",
        "train",
        "node-ping",
    ),
}
"""Commands that end when they are ended, or with what they wait for."""
_ERROR = re.compile(r"\berror\b", re.IGNORECASE)


@dataclass
class End:
    """The end of a command line.

    Attributes:
        code: Of the exit.
        stopped: Reason for a signal; empty where none was sent.
        late: Whether it had to be killed.
        size: Memory at most [bytes].
        left: Files that are new, and those that are half-written.
        processes: Whether a process was left.
    """

    code: int = 0
    stopped: str = ""
    late: bool = False
    size: int = 0
    new: list[str] = field(default_factory=list)
    left: list[str] = field(default_factory=list)
    processes: bool = False
    said: str = ""
    printed: str = ""

    def faults(self, *, waiting: bool) -> Iterator[str]:
        """Yield what is wrong with the end."""
        yield from self._wrongly_said()
        if self.stopped and not waiting:
            yield f"it {self.stopped}"
        if self.late:
            yield "SIGTERM did not end it"
        # 127: a shell that knows no such program
        elif self.code not in (0, 1, 2, 127, *((143, -15) if self.stopped else ())):
            yield f"exit code {self.code}"
        if self.size > BYTES:
            yield f"{self.size / 2**30:.1f} GiB"
        yield from self.left
        if self.processes:
            yield "a process is left"

    def _wrongly_said(self) -> Iterator[str]:
        if "Traceback" in self.said:
            yield "a traceback"
        found = re.search(r"this should not happen: (\w+)", self.said)
        if found:
            yield found[0]
        elif self.code in (1, 2) and not self.stopped:
            errors = [line for line in self.said.splitlines() if _ERROR.search(line)]
            if len(errors) > 1 or not (self.said or self.printed):
                yield f"{len(errors)} lines of error"  # `check` lists what it finds
            yield from (f"it left {name}" for name in self.new)


class Sweep:
    """Counts of command lines, and those that ended badly.

    Args:
        home: A folder of its own.
    """

    def __init__(self, home: Path) -> None:
        self.home = home
        self.count = self.refused = self.stopped = 0
        self.bad: dict[str, list[str]] = defaultdict(list)
        self.slowest = 0.0

    def attempt(self, line: Line) -> None:
        """Run a line."""
        begin = time.monotonic()
        folder = self.home / "beneath" / "folder"
        write_files(folder, self.home / "robot.npz")
        before = contents(folder)
        end = run(line.words, folder, self.home, waiting=line.command in WAITING)
        end.new = sorted(str(n) for n, data in contents(folder).items() if before.get(n) != data)
        end.left = broken_files(folder)
        shutil.rmtree(folder)
        for each in (self.home / "beneath").iterdir():
            end.left.append(f"{each.name} is left outside")
        shutil.rmtree(self.home / "beneath")
        self.count += 1
        self.refused += end.code in (1, 2)
        self.stopped += bool(end.stopped)
        self.slowest = max(self.slowest, time.monotonic() - begin)
        for fault in end.faults(waiting=line.command in WAITING):
            said = next((each for each in end.said.splitlines()[::-1] if each.strip()), "")
            self.bad[f"{line.command}: {fault}"].append(f"{line.wrong}: {said[:160]}")
            _print(f"{line.command}: {fault}: {line.wrong}: {said[:160]}")

    def show(self, examples: int = 4) -> None:
        """Print the counts."""
        for fault, found in sorted(self.bad.items(), key=lambda pair: -len(pair[1])):
            _print(f"{len(found):>5}  {fault}\n          " + "\n          ".join(found[:examples]))
        bad = sum(map(len, self.bad.values()))
        _print(
            f"{self.count} command lines: {self.refused} refused, {self.stopped} ended by a signal, "
            f"{bad} ended badly; the slowest took {self.slowest:.1f} s"
        )


def _print(text: str) -> None:
    sys.stdout.write(text.encode("utf-8", "replace").decode() + "\n")
    sys.stdout.flush()


def run(words: list[str], folder: Path, home: Path, *, waiting: bool) -> End:
    """Run a command in a folder to its end."""
    out, err = home / "stdout", home / "stderr"
    for each in (out, err):
        each.write_text("")
    pid = fork_command(words, folder, out, err, limit)
    end, begin, used, changed, asked = End(), time.monotonic(), 0.0, time.monotonic(), 0.0
    while True:
        done, status, usage = os.wait4(pid, os.WNOHANG)
        if done:
            end.code, end.size = os.waitstatus_to_exitcode(status), usage.ru_maxrss * 1024
            break
        time.sleep(POLL_S)
        now, spent_now = time.monotonic(), spent(Path(f"/proc/{pid}"))[1]
        if spent_now != used or _state(pid) != "S":
            used, changed = spent_now, now
        if end.stopped:
            if used - asked > END_S or now - begin > END_CLOCK_S:
                end.late = True
                os.kill(pid, signal.SIGKILL)
        elif reason := _reason(used, now - begin, now - changed, waiting=waiting):
            end.stopped, asked, begin = reason, used, now
            os.kill(pid, signal.SIGTERM)
    end.processes = _left(pid)
    end.said, end.printed = (each.read_text(errors="replace") for each in (err, out))
    return end


def _reason(used: float, clock: float, idle: float, *, waiting: bool) -> str:
    if used > SECONDS or (waiting and used > SECONDS / 4):
        return f"took over {SECONDS:g} s"
    if clock > CLOCK_S or idle > (IDLE_S if waiting else SECONDS):
        return "waited"
    return ""


def _state(pid: int) -> str:
    with contextlib.suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]
    return ""


def _left(pid: int) -> bool:
    """End what a session left; return whether there was anything."""
    end = time.monotonic() + 2.0
    with contextlib.suppress(ProcessLookupError):
        while time.monotonic() < end:
            os.killpg(pid, 0)
            time.sleep(POLL_S)
        os.killpg(pid, signal.SIGKILL)
        return True
    return False


def sweep(names: list[str], every: int = 1, first: int = 0) -> Sweep:
    """Try the lines of some commands, of all without a name; of many only every n-th."""
    home = Path(tempfile.mkdtemp(prefix="wrong-lines-"))  # no object: a child would delete it
    with a_master(home) as uri:
        os.environ |= {"HOME": str(home), "XDG_CACHE_HOME": f"{home}/cache", "ROS_MASTER_URI": uri}
        write_bag(home / "a.bag")
        found = Sweep(home)
        with contextlib.suppress(KeyboardInterrupt):
            for line in itertools.islice(command_lines(names), first, None, every):
                found.attempt(line)
    shutil.rmtree(home)
    return found


def main() -> int:
    """Run the tool."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("commands", nargs="*")
    parser.add_argument("--every", type=int, default=1, metavar="N", help="only every n-th line")
    parser.add_argument("--first", type=int, default=0, metavar="N", help="lines left out before")
    args = parser.parse_args()
    import_everything()
    found = sweep(args.commands, args.every, args.first)
    found.show()
    return 1 if found.bad else 0


if __name__ == "__main__":
    sys.exit(main())
