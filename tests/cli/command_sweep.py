"""Every command line with a wrong word, each in a process of its own.

``PYTHONPATH=tests:tests/cli python tests/cli/command_sweep.py [COMMAND ...] [N]`` prints what ends
in anything but one line of error and a code of 0, 1 or 2, of all lines or of every N-th.
"""

from __future__ import annotations

import argparse
import collections
import contextlib
import itertools
import os
import re
import resource
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from ending_states import write_policy

from gazelle.cli.commands import COMMANDS
from gazelle.cli.main import main
from gazelle.cli.parsing import Parser

SECONDS = 10.0
WAITING_SECONDS = 2.0
BYTES = 3 * 2**30
"""More is too much for a call with a wrong word."""
NUMBERS = ["nan", "inf", "-inf", "-1", "0", "1e308", "1e400", "9" * 30, "1.5", "", "no such"]
WORDS = [
    *("", " ", "no such", "-1", "nan", "/", ".", "../..", "no/such/file", "/dev/null/a"),
    *("a" * 300, "a" * 10_000, "\udcff", "é\u2028", "a:b", "a=b", "a=nan", "::", "{", "[1, 2"),
]
WAITING = {
    *("bag-play", "bag-record", "bridge", "deploy", "exec", "launch", "master", "run", "shell"),
    *("topic-bw", "topic-delay", "topic-echo", "topic-hz", "topic-pub", "view"),
}
"""Commands that end when they are ended, or with what they wait for."""
_ERROR = re.compile(r"\berror\b", re.IGNORECASE)
LEFT_OUT = {"bench"}
"""Commands of a source checkout."""
GOOD = {
    "run": {"file": ["empty"]},
    "check": {"files": ["empty"]},
    "convert": {"source": ["turtlebot3_burger"], "target": ["a.sdf"]},
    "map": {"source": ["turtlebot3_world"], "target": ["map"]},
    "view": {"file": ["empty"]},
    "picture": {"source": ["empty"], "out": ["a.png"]},
    "film": {"source": ["empty"], "out": ["a.gif"]},
    "plot": {"sources": ["table.csv"], "out": ["a.png"]},
    "train": {"task": ["TurtleBot3Stage1"]},
    "eval": {"run": ["robot.npz"]},
    "new": {"kind": ["task"], "name": ["mine"]},
    "study": {"function": ["quick.py:run"]},
    "export": {"run": ["robot.npz"]},
    "deploy": {"policy": ["robot.npz"], "names": []},
    "launch": {"what": ["a.launch"]},
    "exec": {"script": ["quick.py"]},
    "completion": {"shell": ["bash"]},
    "tasks": {"task": ["TurtleBot3Stage1"]},
    "param-load": {"file": ["a.yaml"]},
    "param-dump": {"file": ["b.yaml"]},
    "bag-filter": {"source": ["a.bag"], "target": ["b.bag"], "expression": ["True"]},
    "bag-fix": {"source": ["a.bag"], "target": ["b.bag"]},
    "bag-to-mcap": {"source": ["a.bag"], "target": ["b.mcap"]},
}
BY_NAME = {
    "topic": ["/rosout"],
    "topics": ["/rosout"],
    "type": ["std_msgs/String"],
    "service": ["/rosout/get_loggers"],
    "node": ["/rosout"],
    "nodes": ["/rosout"],
    "name": ["/a"],
    "value": ["1"],
    "bag": ["a.bag"],
    "bags": ["a.bag"],
    "package": ["std_msgs"],
}
BASE = {
    "demo": "--steps 64 --num-envs 2 --episodes 1 --out runs",
    "train": "--steps 64 --num-envs 2 --out runs --option engine=planar",
    "eval": "--task TurtleBot3Stage1 --episodes 1 --num-envs 1 --engine planar",
    "film": "--for 0.1 --size 32x32 --fps 10",
    "picture": "--size 32x32",
    "run": "--for 0.1",
    "study": "--out study.csv",
    "topic-pub": "--once",
    "node-ping": "-c 1",
    "master": "--port 0",
    "bridge": "--port 0",
}
"""Options that keep work small."""


def leaves(
    path: list[str], parser: argparse.ArgumentParser
) -> Iterator[tuple[list[str], argparse.ArgumentParser]]:
    """Yield commands and sub-commands with their parsers."""
    inner = [each for each in parser._actions if isinstance(each, argparse._SubParsersAction)]
    if not inner:
        yield path, parser
    for action in inner:
        for name, each in action.choices.items():
            yield from leaves([*path, name], each)


def command_lines(names: list[str]) -> Iterator[tuple[str, str, list[str]]]:
    """Yield the command, what is wrong, and the words."""
    for command in COMMANDS.values():
        if command.name in LEFT_OUT or (names and command.name not in names):
            continue
        parser = Parser(prog=command.name)
        command.load().configure(parser)
        yield command.name, "no words", [command.name]
        for path, leaf in leaves([command.name], parser):
            name = "-".join(path)
            good = _positionals(name, leaf)
            base = [*path, *BASE.get(name, "").split()]
            yield name, "an unknown option", [*base, "--no-such", *_flat(good)]
            yield name, "too many words", [*base, *_flat(good), *["more"] * 5]
            for action in leaf._actions:
                for value in _wrong(action):
                    what = f"{action.metavar or action.dest}={value!r:.40}"
                    if not action.option_strings:
                        words = _flat({**good, action.dest: [value]})
                        dashes = ["--"] if value.startswith("-") else []
                        yield name, what, [*base, *dashes, *words]
                    else:
                        given = [action.option_strings[-1], value]
                        yield name, f"{given[0]} {what}", [*base, *given, *_flat(good)]


def _flat(words: dict[str, list[str]]) -> list[str]:
    return [word for each in words.values() for word in each]


def _wrong(action: argparse.Action) -> list[str]:
    if action.nargs == 0 or isinstance(action, argparse._HelpAction):
        return []
    return WORDS if action.type in (None, Path) else NUMBERS


def _positionals(name: str, parser: argparse.ArgumentParser) -> dict[str, list[str]]:
    """Return a good word or some for each positional argument."""
    good = {}
    for action in parser._actions:
        if action.option_strings or action.nargs == 0:
            continue
        optional = action.nargs in ("?", "*", argparse.REMAINDER)
        fallback = [] if optional else BY_NAME.get(action.dest, ["a"])
        good[action.dest] = GOOD.get(name, {}).get(action.dest, fallback)
    return good


class CommandFindings:
    """Counts of command lines, and those that ended badly."""

    def __init__(self) -> None:
        self.count = 0
        self.refused = 0
        self.bad: dict[str, list[str]] = collections.defaultdict(list)

    def attempt(self, name: str, what: str, words: list[str]) -> None:
        self.count += 1
        waiting = name in WAITING
        code, said, used = _run(words, WAITING_SECONDS if waiting else SECONDS)
        self.refused += code in (1, 2)
        for fault in _faults(code, said, used, waiting=waiting):
            line = next((each for each in said.splitlines()[::-1] if each.strip()), "")
            self.bad[f"{name}: {fault}"].append(f"{what}: {line[:160]}")
            print(f"{name}: {fault}: {what}".encode("utf-8", "replace").decode(), flush=True)

    def show(self, examples: int = 4) -> None:
        for fault, found in sorted(self.bad.items(), key=lambda pair: -len(pair[1])):
            shown = "\n          ".join(found[:examples])
            print(
                f"{len(found):>5}  {fault}\n          {shown}".encode("utf-8", "replace").decode()
            )
        bad = sum(map(len, self.bad.values()))
        print(f"{self.count} command lines: {self.refused} refused, {bad} ended badly")


def _faults(code: int | None, said: str, used: int, *, waiting: bool) -> Iterator[str]:
    if "Traceback" in said:
        yield "a traceback"
    found = re.search(r"this should not happen: (\w+)", said)
    if found:
        yield found[0]
    elif code in (1, 2):
        errors = [line for line in said.splitlines() if _ERROR.search(line)]
        listed = not errors and _ERROR.search(Path("stdout").read_text(errors="replace"))
        if len(errors) != 1 and not listed:  # `check` lists what it finds
            yield f"{len(errors)} lines of error"
    if code is None and not waiting:
        yield f"over {SECONDS:g} s"
    if code not in (None, 0, 1, 2):
        yield f"code {code}"
    if used > BYTES:
        yield f"over {BYTES >> 30} GiB"


def _run(words: list[str], seconds: float) -> tuple[int | None, str, int]:
    """Return the exit code (None for a process that had to be ended), the errors, and the memory [byte]."""
    child = os.fork()
    if child == 0:
        _be_command(words)
    end = time.monotonic() + seconds
    code: int | None = None
    while True:
        done, status, usage = os.wait4(child, os.WNOHANG)
        if done:
            code = os.waitstatus_to_exitcode(status)
            break
        if time.monotonic() > end:
            os.killpg(child, signal.SIGKILL)
            usage = os.wait4(child, 0)[2]
            break
        time.sleep(0.002)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    return code, Path("stderr").read_text(errors="replace"), usage.ru_maxrss * 1024


def _be_command(words: list[str]) -> None:
    code = 70
    try:
        os.setsid()
        resource.setrlimit(resource.RLIMIT_AS, (32 * 2**30, 32 * 2**30))
        for number, name, how in (
            (0, os.devnull, os.O_RDONLY),
            (1, "stdout", os.O_WRONLY | os.O_CREAT | os.O_TRUNC),
            (2, "stderr", os.O_WRONLY | os.O_CREAT | os.O_TRUNC),
        ):
            os.dup2(os.open(Path(os.environ["SWEEP"], name), how), number)
        code = main(words)
        sys.stdout.flush()
    except BaseException as error:  # noqa: BLE001  # as Python would show it
        sys.stderr.write(f"Traceback: {type(error).__name__}: {error!s:.200}\n")
    finally:
        with contextlib.suppress(Exception):
            sys.stderr.flush()
        os._exit(code)


@contextlib.contextmanager
def surroundings() -> Iterator[None]:
    """Run in a folder with good files, beside a ROS master."""
    here = Path.cwd()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        os.chdir(folder)
        os.environ["SWEEP"] = name
        write_policy(folder)
        write_files(folder)
        master = subprocess.Popen(
            [sys.executable, "-m", "gazelle", "master", "--port", "0"],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        try:
            found = None
            while found is None and master.stdout is not None:
                found = re.search(r"ROS_MASTER_URI\S*?(http://\S+?)/?\s", master.stdout.readline())
            os.environ["ROS_MASTER_URI"] = found[1] if found else ""
            yield
        finally:
            master.terminate()
            master.wait(20)
            os.chdir(here)


def write_files(folder: Path) -> None:
    """Write a good file of each kind that commands read."""
    from gazelle.ros import Time, load_message
    from gazelle.ros.bags import Bag

    (folder / "table.csv").write_text("a,b\n1,2\n2,3\n")
    (folder / "quick.py").write_text("def run(*, seed):\n    return {'seed': seed}\n")
    (folder / "a.yaml").write_text("a: 1\n")
    (folder / "a.launch").write_text('<launch><param name="a" value="1" /></launch>')
    with Bag(folder / "a.bag", "w") as bag:
        bag.write("/words", load_message("std_msgs/String")("hello"), Time(1))


def sweep(names: list[str], every: int = 1) -> CommandFindings:
    """Try the command lines of some commands, of all without a name; of many only every n-th."""
    findings = CommandFindings()
    with surroundings(), contextlib.suppress(KeyboardInterrupt):
        for name, what, words in itertools.islice(command_lines(names), 0, None, every):
            findings.attempt(name, what, words)
    return findings


if __name__ == "__main__":
    numbers = [int(word) for word in sys.argv[1:] if word.isdigit()]
    sweep([word for word in sys.argv[1:] if not word.isdigit()], *numbers).show(8)
