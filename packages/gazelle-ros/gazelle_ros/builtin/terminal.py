"""``xterm -e PROGRAM`` and its like where there is no display: the program runs all the same.

Scripts and launch prefixes open windows for what they start. Without a display, or without that
terminal, the program runs by itself; what it writes goes to a log.
"""

from __future__ import annotations

import os
import shlex
import shutil
import subprocess
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from gazelle_ros.base.path_texts import expanded

_REST = ("-e", "-x", "--", "--execute")
"""Options after which the rest of the command line is the program, or a text for a shell."""
_WORD = ("-e", "--command")
"""Options that take one word, a text for a shell, in the terminals of desktops."""
IN_PLACE = "--in-place"
_PACKAGE = b"gazelle_ros.builtin"
_DESKTOP = {"gnome-terminal", "mate-terminal", "xfce4-terminal", "lxterminal", "terminator"}
"""These take a text with each ``-e``, and return at once."""
TERMINALS = (
    "konsole",
    "rxvt",
    "urxvt",
    "uxterm",
    "x-terminal-emulator",
    "xterm",
    *sorted(_DESKTOP),
)


def main(words: Sequence[str]) -> int:
    """Run a terminal's command line; returns the exit code, if this process continues at all.

    Args:
        words: The terminal's name, and its command line; `IN_PLACE` before them lets terminals
            stay that would return at once.
    """
    in_place = words[0] == IN_PLACE
    name, *arguments = words[1:] if in_place else words
    real = real_terminal(name, os.environ)
    if real is not None:
        os.execv(real, [name, *arguments])  # noqa: S606  # the requested terminal
    why = "it is not installed" if has_display(os.environ) else "there is no display"
    commands = programs(name, arguments)
    if not commands:
        sys.stderr.write(f"{name}: {why}, and no program to run without\n")
        return 1
    *others, last = [_started(name, why, command) for command in commands]
    if name in _DESKTOP and not in_place:
        for command, log in (*others, last):
            _start(command, log)
        return 0
    for command, log in others:
        _start(command, log)
    return _become(*last)


def has_display(environment: Mapping[str, str]) -> bool:
    """Return whether windows can be shown."""
    return bool(environment.get("DISPLAY") or environment.get("WAYLAND_DISPLAY"))


def real_terminal(name: str, environment: Mapping[str, str]) -> str | None:
    """Return the terminal itself, if it is installed and can show its window."""
    if not has_display(environment):
        return None
    for folder in environment.get("PATH", os.defpath).split(os.pathsep):
        found = shutil.which(name, path=folder) if folder else None
        if found is not None and not _is_builtin_program(found):
            return found
    return None


def _is_builtin_program(program: str) -> bool:
    """Return whether it is one of the programs of `gazelle_ros.builtin.on_path`."""
    try:
        with Path(program).open("rb") as stream:
            return _PACKAGE in stream.read(2048)
    except OSError:
        return False


def programs(name: str, arguments: Sequence[str]) -> list[list[str]]:
    """Return the command lines inside a terminal's command line."""
    found: list[list[str]] = []
    rest = list(arguments)
    while rest:
        word = rest.pop(0)
        option, equals, value = word.partition("=")
        if name in _DESKTOP and option in _WORD and (equals or rest):
            found.append(_command([value if equals else rest.pop(0)]))
        elif word in _REST and rest:
            found.append(_command(rest))
            break
    return found


def _command(words: list[str]) -> list[str]:
    """Return a command line.

    One word that is no program is a text for a shell, as in terminals.
    """
    if len(words) == 1 and shutil.which(words[0]) is None:
        return ["/bin/sh", "-c", words[0]]
    return words


def _started(name: str, why: str, command: list[str]) -> tuple[list[str], Path]:
    """Return a command and its log; one line reports them."""
    folder = os.environ.get("ROS_LOG_DIR") or f"{os.environ.get('ROS_HOME') or '~/.ros'}/log"
    base = expanded(folder)
    base.mkdir(parents=True, exist_ok=True)
    shown = command[2] if command[:2] == ["/bin/sh", "-c"] else shlex.join(command)
    program = Path((shlex.split(shown, posix=False) or [name])[0]).name
    log = base / f"{name}-{program}-{os.getpid()}.log"
    log.touch()
    sys.stderr.write(f"{name}: {why}: '{shown}' runs without a window, and writes to {log}\n")
    sys.stderr.flush()
    return command, log


def _start(command: list[str], log: Path) -> None:
    with log.open("ab") as stream:
        subprocess.Popen(  # noqa: S603  # running it is the purpose
            command,
            stdin=subprocess.DEVNULL,
            stdout=stream,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )


def _become(command: list[str], log: Path) -> int:
    """Run a program in place of this process, so that signals reach it."""
    stream = os.open(log, os.O_WRONLY | os.O_APPEND | os.O_CREAT, 0o644)
    nothing = os.open(os.devnull, os.O_RDONLY)
    said = os.dup(2)
    os.set_inheritable(said, False)
    for source, target in ((nothing, 0), (stream, 1), (stream, 2)):
        os.dup2(source, target)
    try:
        os.execvp(command[0], command)  # noqa: S606  # running it is the purpose
    except OSError as error:
        os.write(said, f"'{command[0]}' cannot be run: {error.strerror}\n".encode())
        return 127


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
