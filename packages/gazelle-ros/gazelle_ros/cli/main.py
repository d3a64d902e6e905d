"""The entry point: find the sub-command, run it, report what goes wrong in one line."""

from __future__ import annotations

import codecs
import contextlib
import errno
import io
import os
import re
import signal
import sys
import traceback
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from typing import TextIO

from gazelle_ros import __version__
from gazelle_ros.base.errors import Error, GazelleWarning, describe, did_you_mean
from gazelle_ros.base.interrupts import (
    Interrupted,
    end_process,
    exit_code,
    interruptible,
    requested,
)
from gazelle_ros.base.program import program_name, running
from gazelle_ros.base.writing import naming
from gazelle_ros.cli.commands import COMMANDS, Command
from gazelle_ros.cli.parsing import Parser
from gazelle_ros.process_name import call_process
from gazelle_ros.tool_names import process_name, translated

DONE, FAILED, WRONG_USAGE = 0, 1, 2
_ANY_TEXT = "gazelle.any_text"
_FULL = {errno.ENOSPC, errno.EFBIG, getattr(errno, "EDQUOT", errno.ENOSPC)}
_NO_ROOM = "free some space, or name a place with more"
_NO_MEMORY = (
    "cannot allocate memory",
    "can't allocate memory",
    "can't start new thread",
    "failed to map segment",
    "std::bad_alloc",
)


@dataclass(frozen=True)
class CommandLine:
    """A program with sub-commands."""

    name: str
    version: str
    purpose: str
    """One line for ``--help``."""
    commands: Mapping[str, Command]
    prepared: Callable[[], AbstractContextManager[None]] = nullcontext
    """Made before a command is imported, and closed when it has ended."""


_VARIABLES = {
    "PYTHONPATH": "",
    "ROS_DISTRO": "noetic",
    "ROS_PACKAGE_PATH": "",
    "ROS_PYTHON_VERSION": "3",
    "ROS_VERSION": "1",
}
"""Environment variables that launch files and scripts read, as ROS's setup files set them."""

ROS = CommandLine(
    "gazelle-ros",
    __version__,
    "ROS 1 without ROS: a master, nodes, launch files, bags and tools.",
    COMMANDS,
)


def main(argv: Sequence[str] | None = None, program: CommandLine = ROS) -> int:
    """Run the command line.

    Args:
        argv: The arguments after the program's name; by default those of this process.
        program: Its name and sub-commands.

    Returns:
        0 done, 1 the work failed, 2 the command line was wrong, 130 Ctrl-C, 143 SIGTERM.
    """
    with running(program.name):
        return _main(argv, program)


def inherited() -> CommandLine:
    """Return the commands of ``gazelle-ros`` under the name of the program that the user started."""
    return replace(ROS, name=program_name())


def _main(argv: Sequence[str] | None, program: CommandLine) -> int:
    if argv is None:
        if not _open_streams():
            _complain("the standard output is closed", "'>/dev/null' throws it away")
            return FAILED
        for name, value in _VARIABLES.items():
            os.environ.setdefault(name, value)
    arguments = translated(sys.argv[1:] if argv is None else argv)
    arguments, debug = _without_debug(arguments)
    if not arguments or arguments[0] in {"-h", "--help", "help"}:
        return _run(program, lambda: _show(overview(program)), debug=debug)
    if arguments[0] in {"-V", "--version"}:
        return _run(program, lambda: _show(f"{program.name} {program.version}\n"), debug=debug)
    command = program.commands.get(arguments[0])
    if command is None:
        _complain(
            f"there is no command '{arguments[0]}'", did_you_mean(arguments[0], program.commands)
        )
        return WRONG_USAGE
    if argv is None:
        call_process(process_name(arguments))
    # A script is given the signals of a fresh process, as Python has them.
    alone = arguments[0] == "exec"
    signals = nullcontext() if alone else interruptible(ends_process=argv is None)
    with _one_line_warnings(show_all=debug), program.prepared():
        code = _run(
            program,
            lambda: _call(program, command, arguments[1:], debug=debug),
            signals,
            debug=debug,
        )
    if requested():
        end_process(code)
    return code


def _open_streams() -> bool:
    """Open all standard streams, so that no file becomes one.

    Returns whether there is an output.
    """
    there = sys.stdout is not None
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)  # the least free number
    sys.stdin = sys.stdin or open(0, encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stdout = sys.stdout or open(1, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    sys.stderr = sys.stderr or open(2, "w", encoding="utf-8", closefd=False)  # noqa: SIM115
    if isinstance(sys.stdout, io.TextIOWrapper):
        codecs.register_error(_ANY_TEXT, _encoded)
        sys.stdout.reconfigure(errors=_ANY_TEXT)
    return there


def _encoded(error: UnicodeError) -> tuple[str | bytes, int]:
    """Encode names of files, which may be any bytes, and what the terminal's encoding lacks."""
    try:
        return codecs.lookup_error("surrogateescape")(error)
    except UnicodeError:
        return codecs.backslashreplace_errors(error)


def _without_debug(arguments: list[str]) -> tuple[list[str], bool]:
    """Return the arguments without ``--debug``, and whether it was there.

    A script keeps its own.
    """
    end = len(arguments)
    if "exec" in arguments[:2]:
        begin = arguments.index("exec") + 1
        rest = enumerate(arguments[begin:], begin)
        end = next((place for place, word in rest if not word.startswith("-")), end)
    kept = [word for word in arguments[:end] if word != "--debug"]
    return [*kept, *arguments[end:]], len(kept) < end


def overview(program: CommandLine) -> str:
    """Return the text of ``--help``."""
    lines = [
        f"usage: {program.name} COMMAND ...",
        "",
        program.purpose,
    ]
    group, width = "", max(map(len, program.commands))
    for command in program.commands.values():
        if command.group != group:
            group = command.group
            lines += ["", f"{group}:"]
        lines.append(f"  {command.name:<{width}} {command.purpose}")
    lines += [
        "",
        "options:",
        f"  -h, --help     show this help; '{program.name} COMMAND --help' shows a command's",
        "  -V, --version  print the version",
        "  --debug        show tracebacks and all warnings",
        "",
    ]
    return "\n".join(lines)


def _run(
    program: CommandLine,
    call: Callable[[], int],
    signals: AbstractContextManager[None] | None = None,
    *,
    debug: bool,
) -> int:
    """Make a call; any error becomes a message and an exit code."""
    try:
        with signals or nullcontext():
            return call()
    except SystemExit as stop:
        return stop.code if isinstance(stop.code, int) else FAILED
    except KeyboardInterrupt as request:
        sys.stderr.write(f"\n{program.name}: interrupted\n")
        return exit_code(request)
    except BrokenPipeError:
        # The reader of our output is gone, as in `gazelle tasks | head`.
        _discard_output()
        return DONE
    except Exception as error:  # noqa: BLE001  # the last resort: a user sees no traceback
        if getattr(error, "errno", None) == errno.EIO and requested():
            _discard_output()  # its terminal was closed
            return exit_code(Interrupted(signal.SIGHUP))
        if debug:
            traceback.print_exc()
        _report(error)
        return FAILED


def _call(program: CommandLine, command: Command, arguments: list[str], *, debug: bool) -> int:
    try:
        parsed = command_parser(program, command).parse_args(arguments)
    except SystemExit:  # after `--help`
        _flush()
        raise
    parsed.debug = debug
    code = command.load().run(parsed)
    _flush()
    return code


def _show(text: str) -> int:
    with naming("the standard output"):
        sys.stdout.write(text)
    _flush()
    return DONE


def _flush() -> None:
    try:
        with naming("the standard output"):
            sys.stdout.flush()
    except OSError:
        _discard_output()  # else the interpreter tries once more at its end
        raise


def _discard_output() -> None:
    with contextlib.suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def command_parser(program: CommandLine, command: Command) -> Parser:
    """Return the parser of a sub-command's arguments."""
    module = command.load()
    parser = Parser(
        prog=f"{program.name} {command.name}",
        description=_usage(program, command.text or module.__doc__),
    )
    module.configure(parser)
    return parser


def _usage(program: CommandLine, text: str | None) -> str:
    """Return the head of a command's help, whose examples name the program."""
    return re.sub(r"(?m)(^  |')gazelle (?=[a-z])", rf"\g<1>{program.name} ", text or "")


def _report(error: Exception) -> None:
    if isinstance(error, Error):
        place = describe(error.message, file=error.file, line=error.line, element=error.element)
        _complain(place, error.hint)
    elif isinstance(error, OSError):
        name = f"{error.filename}: " if error.filename else ""
        _complain(f"{name}{error.strerror or error}", _NO_ROOM if error.errno in _FULL else None)
    elif _is_out_of_memory(error):
        text = str(error).partition("\n")[0]
        _complain(
            f"there is not enough memory{': ' if text else ''}{text}",
            "free some, raise the limit ('ulimit -v'), or ask for less (--num-envs, --size)",
        )
    else:
        text = str(error).splitlines()[0] if str(error) else ""
        _complain(
            f"this should not happen: {type(error).__name__}: {text}",
            "run it again with --debug for the traceback, and report it",
        )


def _is_out_of_memory(error: BaseException | None) -> bool:
    """Return True if an error or one of its causes says that memory ran out, in the words of any library."""
    while error is not None:
        text = str(error).lower()
        if isinstance(error, MemoryError) or any(sign in text for sign in _NO_MEMORY):
            return True
        error = error.__cause__ or error.__context__
    return False


def _complain(message: str, hint: str | None) -> None:
    sys.stderr.write(f"{program_name()}: error: {message}\n")
    if hint:
        sys.stderr.write(f"  hint: {hint}\n")


@contextlib.contextmanager
def _one_line_warnings(*, show_all: bool) -> Iterator[None]:
    """Show Gazelle's warnings as one line each, others only on request."""
    with warnings.catch_warnings():
        warnings.simplefilter("default" if show_all else "ignore")
        warnings.simplefilter("default", GazelleWarning)
        warnings.showwarning = _show_warning
        yield


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    del line
    stream = file or sys.stderr
    if issubclass(category, GazelleWarning):
        stream.write(f"{program_name()}: warning: {message}\n")
    else:
        stream.write(f"{filename}:{lineno}: {category.__name__}: {message}\n")


if __name__ == "__main__":
    sys.exit(main(program=inherited()))
