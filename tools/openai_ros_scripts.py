"""Run the training scripts of others on Gazelle's openai_ros, unchanged, to the end of an episode.

    python tools/openai_ros_scripts.py FOLDER [PACKAGE[/LAUNCHFILE] ...] [--limit 120] [--markdown]

FOLDER holds ROS packages with training scripts and their launch files, such as a checkout of
openai_examples_projects. Each launch file that starts a script is launched on a graph of its own; the
episodes it ends are counted by the messages on /openai/reward. Beside each is how far it came, or
the last line of what it said.
"""

from __future__ import annotations

import argparse
import os
import re
import signal
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import gazelle_ros as ros
from gazelle_ros.errors import RosError

_SCRIPT = re.compile(r'<node[^>]*type="([^"]+\.py)"')
_NO_TRAINING = ("simulation", "spawn", "publisher", "tests", "controller", "setup")
_ERROR = re.compile(
    r"^(\w[\w.]*(?:Error|Exception|Interrupt)\b.*|.*is written for Python 2.*)$", re.MULTILINE
)
_END_S = 30.0


@dataclass(frozen=True)
class Outcome:
    """How far a script came: episodes ended, seconds of wall time, and what it said last."""

    script: str
    task: str
    episodes: int
    seconds: float
    said: str


def main() -> int:
    """Run them; returns how many ended no episode."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("folder", type=Path)
    parser.add_argument("only", nargs="*")
    parser.add_argument("--limit", type=float, default=120.0, help="for each script [s]")
    parser.add_argument("--episodes", type=int, default=1, help="enough of each")
    parser.add_argument(
        "--before",
        action="append",
        default=[],
        metavar="PACKAGE/LAUNCHFILE",
        help="launch that first, for scripts that want a world that runs",
    )
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()
    outcomes = []
    for launch in found(options.folder.resolve(), options.only):
        outcomes.append(run(launch, options))
        print(row(outcomes[-1], markdown=options.markdown), flush=True)
    return sum(not each.episodes for each in outcomes)


def found(folder: Path, only: list[str]) -> list[Path]:
    """Return the launch files that start training scripts."""
    files = sorted(folder.glob("*/launch/*.launch"))
    files = [each for each in files if not any(word in each.stem for word in _NO_TRAINING)]
    files = [each for each in files if _SCRIPT.search(each.read_text(encoding="utf-8"))]
    return [each for each in files if not only or is_among(each, only)]


def is_among(launch: Path, only: list[str]) -> bool:
    """Return whether a launch file is selected, by its package or its name."""
    package = launch.parents[1].name
    return package in only or f"{package}/{launch.name}" in only


def run(launch: Path, options: argparse.Namespace) -> Outcome:
    """Launch one on a master of its own, and count."""
    package, folder = launch.parents[1].name, options.folder.resolve()
    info = ros.load_message("openai_ros/RLExperimentInfo")
    heard: list[int] = []
    # The folder may hold an openai_ros of its own; the packages with scripts are what is wanted.
    packages = [each for each in folder.iterdir() if each.is_dir() and each.name != "openai_ros"]
    with (
        ros.Master(port=0) as master,
        ros.Node("counter", master_uri=master.uri) as node,
        tempfile.TemporaryFile("w+") as said,
    ):
        node.subscribe("/openai/reward", info, lambda message: heard.append(message.episode_number))
        begun = time.monotonic()
        environment = {
            **os.environ,
            "ROS_MASTER_URI": master.uri,
            "ROS_PACKAGE_PATH": os.pathsep.join(map(str, packages)),
        }
        worlds = [start(each.split("/"), environment, said) for each in options.before]
        process = start([package, launch.name], environment, said)
        # The first message comes with the first reset, so the first end of an episode is the second.
        while (
            process.poll() is None
            and time.monotonic() - begun < options.limit
            and len(heard) <= options.episodes
        ):
            time.sleep(0.1)
        seconds = time.monotonic() - begun
        for each in (process, *reversed(worlds)):
            end(each)
        said.seek(0)
        text = said.read()
        task = task_of(node, text)
    return Outcome(
        f"{package}/{script_of(launch)}", task, max(0, len(heard) - 1), seconds, last_words(text)
    )


def start(words: list[str], environment: dict[str, str], said: IO[str]) -> subprocess.Popen[bytes]:
    """Start a launch file of a package."""
    command = [sys.executable, "-m", "gazelle", "launch", *words]
    return subprocess.Popen(command, env=environment, stdout=said, stderr=said)


def end(process: subprocess.Popen[bytes]) -> None:
    """End a launch as Ctrl-C does."""
    if process.poll() is None:
        process.send_signal(signal.SIGINT)
    try:
        process.wait(_END_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def task_of(node: ros.Node, text: str) -> str:
    """Return the task, if a parameter names it."""
    try:
        names = [each for each in node.param_names() if "task_and_robot_environment" in each]
    except RosError:
        names = []
    if names:
        return str(node.get_param(names[0]))
    close = re.search(r"\b(\w+-v\d)\b", text)
    return close.group(1) if close else ""


def script_of(launch: Path) -> str:
    """Return the script that a launch file starts."""
    match = _SCRIPT.search(launch.read_text(encoding="utf-8"))
    return match.group(1) if match else launch.name


def last_words(text: str) -> str:
    """Return the last error in a text."""
    errors = [each for each in _ERROR.findall(text) if "Interrupt" not in each]
    return errors[-1].strip()[:200] if errors else ""


def row(outcome: Outcome, *, markdown: bool) -> str:
    """Return a line of the table."""
    result = f"{outcome.episodes} episodes" if outcome.episodes else outcome.said or "no episode"
    cells = (outcome.script, outcome.task, result, f"{outcome.seconds:.0f} s")
    return f"| {' | '.join(cells)} |" if markdown else "  ".join(cells)


if __name__ == "__main__":
    sys.exit(main())
