"""Runs a Python script written for ROS 1 in this process, as ``python script.py`` would."""

from __future__ import annotations

import contextlib
import os
import sys
import sysconfig
import time
import traceback
import types
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle_ros.base.child_processes import become
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.text_files import read_bytes
from gazelle_ros.builtin.on_path import offer
from gazelle_ros.compat.finder import install
from gazelle_ros.compat.import_errors import import_fault
from gazelle_ros.compat.python2 import advice_text, explain

_PACKAGE = str(Path(__file__).parents[1])
_LIBRARY = sysconfig.get_paths()["stdlib"]
INTERRUPTED = 130
"""The exit code of a script that Ctrl-C ended, as shells have it."""


def run_script(
    path: str, arguments: Sequence[str] = (), *, sim_sleep: bool = False, debug: bool = False
) -> int:
    """Run a script, with ROS 1's modules importable, as the main module of this process.

    What the script raises is printed with its traceback, as Python does; for what is written for
    Python 2, and for what cannot be imported, there is one line that says what to do.

    Args:
        path: The script.
        arguments: Its command line; remappings may be among them.
        sim_sleep: Make its ``time.sleep`` wait for simulated time, if its node goes by that.
        debug: Print whole tracebacks, always.

    Returns:
        Its exit code.

    Raises:
        FormatError: It is larger than the limit.
        RosError: It cannot be read, is written for Python 2, or imports what is not there.
    """
    file = Path(path)
    try:
        source = read_bytes(file)
    except OSError as error:
        raise RosError(
            f"cannot read the script: {error.strerror}", file=path, hint=_closest(file)
        ) from None
    main = types.ModuleType("__main__")
    main.__file__ = str(file)
    sys.modules["__main__"] = main
    sys.argv = [path, *arguments]
    sys.path.insert(0, str(file.resolve().parent))
    install()
    offer()
    with _simulated_sleep() if sim_sleep else contextlib.nullcontext():
        return _execute(source, file, main, debug=debug)


def run_named(
    word: str, arguments: Sequence[str] = (), *, sim_sleep: bool = False, debug: bool = False
) -> int:
    """Run a script, or a program of a package as ``rosrun PACKAGE PROGRAM`` does.

    Args:
        word: A script's path, or a package. ``python3`` before a script is passed over.
        arguments: Arguments on the command line; after a package, the program first.
        sim_sleep: See `run_script`.
        debug: See `run_script`.

    Returns:
        Its exit code. A program that is no Python script takes the place of this process.

    Raises:
        RosError: As `run_script`, or the package has no such program.
    """
    from gazelle_ros.builtin import registry
    from gazelle_ros.launch.packages import Packages, is_python
    from gazelle_ros.launch.programs import PYTHON, Skipped, program_of, window_command

    if PYTHON.fullmatch(word) and arguments and Path(arguments[0]).is_file():
        word, *arguments = arguments
    packages = Packages()
    known = packages.find(word) or registry.package(word)
    if Path(word).is_file() or (known is None and (not arguments or _is_path(word))):
        return run_script(word, arguments, sim_sleep=sim_sleep, debug=debug)
    if known is None:
        raise packages.missing(word)
    if not arguments:
        raise packages.unnamed_program(word)
    program = program_of(word, arguments[0], packages)
    if isinstance(program, Skipped):
        window = window_command(word, arguments[0])
        if window is not None:
            return become([*window, *arguments[1:]])
        raise RosError(f"'{program.package}' is left out: {program.reason}")
    path = program.command[-1]
    if program.folder is not None and is_python(Path(path)):
        return run_script(path, arguments[1:], sim_sleep=sim_sleep, debug=debug)
    return become([*program.command, *arguments[1:]])


def _is_path(word: str) -> bool:
    """Return whether a word can only mean a file."""
    return os.sep in word or bool(Path(word).suffix)


def runs_tool(word: str, arguments: Sequence[str]) -> bool:
    """Return whether a command line names a ROS tool, such as ``rostopic``, and no script or program.

    Some tools are packages, too: ``rosbag record`` is a program of one.
    """
    from gazelle_ros import tool_names
    from gazelle_ros.builtin import registry

    if word not in {**tool_names.COMMANDS, **tool_names.NODES} or Path(word).is_file():
        return False
    known = registry.package(word)
    return known is None or not arguments or arguments[0] not in known.nodes


def _closest(file: Path) -> str | None:
    try:
        known = [each.name for each in file.parent.iterdir() if each.suffix == ".py"]
    except OSError:
        return None
    hint = did_you_mean(file.name, known)
    return hint if hint.startswith("did you mean") else None


def _execute(source: bytes, file: Path, main: types.ModuleType, *, debug: bool) -> int:
    try:
        code = compile(source, str(file), "exec", dont_inherit=True)
        exec(code, main.__dict__)  # noqa: S102  # running it is the purpose
    except SystemExit as stop:
        if stop.code is None or isinstance(stop.code, int):
            return stop.code or 0
        sys.stderr.write(f"{stop.code}\n")
        return 1
    except BaseException as error:  # noqa: BLE001  # whatever it is, Python would print it
        if not debug:
            _explain(error, source, file)
        trace = error.__traceback__
        # Our own frames in front do not help the user.
        inner = trace.tb_next if trace is not None and not debug else trace
        traceback.print_exception(type(error), error, inner)
        return INTERRUPTED if isinstance(error, KeyboardInterrupt) else 1
    return 0


def _explain(error: BaseException, source: bytes, file: Path) -> None:
    """Raise one line instead of a traceback for what is Python 2, or an import that fails."""
    findings = explain(error, source.decode("utf-8", "replace"))
    if findings:
        said = error.msg if isinstance(error, SyntaxError) else str(error)
        raise RosError(
            f"this is written for Python 2 ({type(error).__name__}: {said})",
            file=findings[0].file or str(file),
            line=findings[0].line,
            hint=advice_text(findings),
        ) from None
    fault = import_fault(error)
    if fault is not None:
        raise fault from None


@contextlib.contextmanager
def _simulated_sleep() -> Iterator[None]:
    """Make ``time.sleep`` of the user's code wait for the node's clock while it lasts."""
    real = time.sleep

    def sleep(seconds: float, /) -> None:
        from gazelle_ros.compat.rospy import timer
        from gazelle_ros.compat.rospy.state import process

        file = sys._getframe(1).f_code.co_filename  # noqa: SLF001  # the caller decides
        ours = file.startswith((_PACKAGE, _LIBRARY)) and "site-packages" not in file
        if ours or process.node is None or not process.node.clock.simulated:
            real(seconds)
        else:
            timer.sleep(seconds)

    time.sleep = sleep  # type: ignore[assignment]  # integers of any kind come as floats
    try:
        yield
    finally:
        time.sleep = real
