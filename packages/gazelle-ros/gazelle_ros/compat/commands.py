"""The main functions of ROS's command-line tools, which programs call with a command line."""

from __future__ import annotations

import io
import subprocess
import sys
from collections.abc import Sequence

from gazelle_ros.builtin.commands import run_command


def run(command: str, arguments: Sequence[str] | None = None) -> None:
    """Run a tool in a process of its own; its output goes to this one's ``sys.stdout``.

    Started by roslaunch as a node, this process becomes the tool, so that signals reach it.

    Args:
        command: Gazelle's command, such as ``param``.
        arguments: The command line, with the tool's name first; by default this process's.

    Raises:
        SystemExit: It failed.
    """
    words = list(sys.argv if arguments is None else arguments)[1:]
    if any(word.startswith("__name:=") for word in words):
        raise SystemExit(run_command(command, words))
    given = sys.stdin.read() if isinstance(sys.stdin, io.StringIO) else None
    process = subprocess.Popen(  # noqa: S603  # our own program
        [sys.executable, "-m", "gazelle_ros.cli.main", command, *words],
        stdin=None if given is None else subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    if process.stdin is not None:
        process.stdin.write(given or "")
        process.stdin.close()
    with process.stdout or io.StringIO() as output:
        try:
            for line in output:
                sys.stdout.write(line)
        except KeyboardInterrupt:
            process.terminate()  # the request to end goes to it, too
    if process.wait():
        raise SystemExit(process.returncode)
