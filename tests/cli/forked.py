"""Commands in children forked from a process that has imported everything: Python starts slowly."""

from __future__ import annotations

import contextlib
import os
import pkgutil
import signal
import subprocess
import sys
import traceback
from collections.abc import Callable, Iterator
from pathlib import Path

import gazelle
from gazelle.cli.commands import COMMANDS
from gazelle.cli.main import main
from gazelle_ros.base.interrupts import end_process

TESTS = Path(__file__).parents[1]


def import_everything() -> None:
    """Import what commands do, without starting a thread."""
    os.environ |= dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1")
    for command in COMMANDS.values():
        command.load()
    for name in ("torch", "mujoco", "PIL.Image", *_modules()):
        with contextlib.suppress(ImportError):
            __import__(name)


def _modules() -> Iterator[str]:
    """Yield the names of Gazelle's modules, but for scripts and those under foreign names."""
    for _, name, _ in pkgutil.walk_packages(gazelle.__path__, "gazelle."):
        if not set(name.split(".")) & {
            "drop_in",
            "compat",
            "builtin",
            "assets",
            "warp",
            "__main__",
        }:
            yield name


def fork_command(
    words: list[str], folder: Path, out: Path, err: Path, prepare: Callable[[], object] = bool
) -> int:
    """Start a command in a session of its own, and return its process.

    Args:
        words: After ``gazelle``.
        folder: The working directory.
        out: File for the output.
        err: File for the errors.
        prepare: Called in the child first.
    """
    sys.stdout.flush()
    pid = os.fork()
    if not pid:
        _be_command(words, folder, out, err, prepare)
    return pid


def _be_command(
    words: list[str], folder: Path, out: Path, err: Path, prepare: Callable[[], object]
) -> None:
    code = 1
    try:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
        for file, number in ((out, 1), (err, 2)):
            os.dup2(os.open(file, os.O_WRONLY | os.O_CREAT | os.O_APPEND, 0o666), number)
        os.chdir(folder)
        prepare()
        sys.argv = ["gazelle", *words]
        os.setsid()
        code = main()
    except SystemExit as stop:
        code = stop.code if isinstance(stop.code, int) else 1
    except BaseException:  # noqa: BLE001  # as the interpreter does
        traceback.print_exc()
    end_process(code)


@contextlib.contextmanager
def a_master(folder: Path) -> Iterator[str]:
    """Run a master in a process of its own, and write the policy there: both start threads."""
    script = (
        "import sys, pathlib; sys.path.insert(0, sys.argv[1]); from cli.ending_states import *;"
        "from gazelle_ros import Master; write_policy(pathlib.Path(sys.argv[2]));"
        "print(Master(port=0).uri, flush=True); sys.stdin.read()"
    )
    command = [sys.executable, "-c", script, str(TESTS), str(folder)]
    with subprocess.Popen(
        command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        try:
            yield process.stdout.readline().strip()
        finally:
            process.kill()
