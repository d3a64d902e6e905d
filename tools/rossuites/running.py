"""Runs one test file and counts what passed."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import time
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree as ET

TIME_LIMIT = 240.0
_BAD = {"failure", "error"}


@dataclass(frozen=True)
class Outcome:
    """What became of a test file.

    Attributes:
        passed: How many of its tests passed.
        total: How many were run.
        seconds: How long it took.
        failed: The names of those that failed.
        log: What it printed.
    """

    passed: int
    total: int
    seconds: float
    failed: tuple[str, ...]
    log: str


def run(file: Path, environment: dict[str, str]) -> Outcome:
    """Run a test file in an environment; one that does not end in time has failed."""
    home = Path(environment["ROS_HOME"])
    results = home / "results"
    shutil.rmtree(results, ignore_errors=True)  # of a run before, which is tried again
    results.mkdir(parents=True)
    environment = environment | {"ROS_LOG_DIR": str(home / "log")}
    begin = time.monotonic()
    if file.suffix == ".py":
        log = _output(["python3", str(file)], environment)
        passed, total, failed = _summed(log)
    else:
        log = _output(["rostest", "--results-base-dir", str(results), str(file)], environment)
        passed, total, failed = _count(results)
    return Outcome(passed, total, time.monotonic() - begin, tuple(failed), log)


def _output(command: list[str], environment: dict[str, str]) -> str:
    process = subprocess.Popen(
        command,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=TIME_LIMIT)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        output, _ = process.communicate()
        output += b"\n(took too long)"
    return re.sub(r"\x1b\[[0-9;]*m", "", output.decode(errors="replace"))


def _summed(log: str) -> tuple[int, int, list[str]]:
    """Return the sums of the summaries; a script may have several, and only one report."""

    def figure(word: str) -> int:
        return sum(map(int, re.findall(rf"^ \* {word}: (\d+)", log, re.MULTILINE)))

    total = figure("TESTS")
    failed = re.findall(r"^(?:FAIL|ERROR): (\w+)|^(\w+) .*\.\.\. (?:FAIL|ERROR)", log, re.MULTILINE)
    return total - figure("ERRORS") - figure("FAILURES"), total, [a or b for a, b in failed]


def _count(results: Path) -> tuple[int, int, list[str]]:
    passed = total = 0
    failed = []
    for file in sorted(results.rglob("*.xml")):
        # rostest leaves the tests' own reports and one that repeats them all.
        if file.name.startswith("rostest-"):
            continue
        for case in _cases(file):
            total += 1
            if _BAD.isdisjoint(child.tag for child in case):
                passed += 1
            else:
                failed.append(case.get("name", "?"))
        file.unlink()
    return passed, total, failed


def _cases(file: Path) -> list[ET.Element]:
    try:
        return list(ET.parse(file).iter("testcase"))
    except ET.ParseError:
        return []
