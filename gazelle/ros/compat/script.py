"""Runs a Python script written for ROS 1 in this process, as ``python script.py`` would."""

from __future__ import annotations

import contextlib
import sys
import sysconfig
import time
import traceback
import types
from collections.abc import Iterator, Sequence
from pathlib import Path

from gazelle.errors import RosError
from gazelle.ros.compat.finder import install

_PACKAGE = str(Path(__file__).parents[2])
_LIBRARY = sysconfig.get_paths()["stdlib"]


def run_script(path: str, arguments: Sequence[str] = (), *, sim_sleep: bool = False) -> int:
    """Run a script, with ROS 1's modules importable, as the main module of this process.

    What the script raises is printed with its traceback, as Python does.

    Args:
        path: The script.
        arguments: Its command line; remappings may be among them.
        sim_sleep: Let its ``time.sleep`` wait for simulated time, if its node goes by that.

    Returns:
        Its exit code.

    Raises:
        RosError: It cannot be read.
    """
    file = Path(path)
    try:
        source = file.read_bytes()
    except OSError as error:
        raise RosError(f"cannot read the script: {error.strerror}", file=path) from None
    main = types.ModuleType("__main__")
    main.__file__ = str(file)
    sys.modules["__main__"] = main
    sys.argv = [path, *arguments]
    sys.path.insert(0, str(file.resolve().parent))
    install()
    with _simulated_sleep() if sim_sleep else contextlib.nullcontext():
        return _execute(source, file, main)


def _execute(source: bytes, file: Path, main: types.ModuleType) -> int:
    try:
        code = compile(source, str(file), "exec", dont_inherit=True)
        exec(code, main.__dict__)  # noqa: S102  # to run it is what the user asked for
    except SystemExit as stop:
        if stop.code is None or isinstance(stop.code, int):
            return stop.code or 0
        sys.stderr.write(f"{stop.code}\n")
        return 1
    except BaseException as error:  # noqa: BLE001  # whatever it is, Python would print it
        trace = error.__traceback__
        # Our own frames in front tell the user nothing.
        inner = trace.tb_next if trace is not None else None
        traceback.print_exception(type(error), error, inner)
        return 1
    return 0


@contextlib.contextmanager
def _simulated_sleep() -> Iterator[None]:
    """Let ``time.sleep`` of the user's code wait for the node's clock."""
    real = time.sleep

    def sleep(seconds: float, /) -> None:
        from gazelle.ros.compat.rospy import timer
        from gazelle.ros.compat.rospy.state import process

        file = sys._getframe(1).f_code.co_filename  # noqa: SLF001  # who asks decides
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
