"""``PACKAGE.cfg.NAMEConfig``: modules made by running a package's ``.cfg`` files."""

from __future__ import annotations

import contextlib
import io
import sys
import types
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from gazelle_ros.base.errors import FormatError
from gazelle_ros.compat.cfg_modules import SUFFIX, cfg_files
from gazelle_ros.compat.dynamic_reconfigure.encoding import extract_params

_open: list[list[types.ModuleType]] = []
"""Stack of lists that collect generated modules; the innermost file last."""


def load_cfg(package: str, name: str) -> types.ModuleType:
    """Load the module ``PACKAGE.cfg.NAME``.

    Raises:
        ModuleNotFoundError: The package has no such ``.cfg`` file.
        FormatError: It fails; the file and the line are named.
    """
    files = cfg_files(package)
    if name not in files:
        known = ", ".join(sorted(files)) or "none"
        raise ModuleNotFoundError(
            f"No module named '{package}.cfg.{name}' (the package's .cfg files make: {known})",
            name=f"{package}.cfg.{name}",
        )
    made = _run(files[name])
    for each in made:
        if each.__name__.rpartition(".")[2] == name:
            return each
    raise FormatError(f"it generates no {name.removesuffix(SUFFIX)}", file=str(files[name]))


def _run(file: Path) -> list[types.ModuleType]:
    """Run a ``.cfg`` file, which is a Python script; gives the modules it generates."""
    from gazelle_ros.compat.finder import install

    made: list[types.ModuleType] = []
    main = {"__name__": "__main__", "__file__": str(file)}
    with install(), _pushed(made), _as_program([str(file), "", "", "", ""], str(file.parent)):
        try:
            code = compile(file.read_bytes(), str(file), "exec", dont_inherit=True)
            with contextlib.redirect_stdout(io.StringIO()):
                exec(code, main)  # noqa: S102  # .cfg files are programs; that is how they are read
        except SystemExit:
            pass  # they end so when they have generated
        except Exception as error:
            raise FormatError(
                f"{type(error).__name__}: {error}", file=str(file), line=_line_in(error, file)
            ) from error
    return made


@contextlib.contextmanager
def _pushed(made: list[types.ModuleType]) -> Iterator[None]:
    _open.append(made)
    try:
        yield
    finally:
        _open.pop()


@contextlib.contextmanager
def _as_program(arguments: list[str], folder: str) -> Iterator[None]:
    """Set the process's arguments and folder to those of a script while it lasts."""
    argv, path = sys.argv, list(sys.path)
    sys.argv = arguments
    sys.path.insert(0, folder)
    try:
        yield
    finally:
        sys.argv = argv
        sys.path[:] = path


def _line_in(error: BaseException, file: Path) -> int | None:
    if isinstance(error, SyntaxError):
        return error.lineno
    trace, line = error.__traceback__, None
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == str(file):
            line = trace.tb_lineno
        trace = trace.tb_next
    return line


def take(
    package: str, name: str, description: dict[str, Any], constants: Sequence[dict[str, Any]]
) -> None:
    """Store the description of a ``.cfg`` file; called by its generator."""
    if not _open:
        return
    module: Any = types.ModuleType(
        f"{package}.cfg.{name}{SUFFIX}", f"Parameters of {package} that can be changed."
    )
    module.inf = float("inf")
    module.config_description = description
    module.min, module.max, module.defaults = {}, {}, {}
    module.level, module.type, module.all_level = {}, {}, 0
    for each in extract_params(description):
        key = each["name"]
        module.min[key], module.max[key] = each["min"], each["max"]
        module.defaults[key], module.type[key] = each["default"], each["type"]
        module.level[key] = each["level"]
        module.all_level |= each["level"]
    for constant in constants:
        setattr(module, f"{name}_{constant['name']}", constant["value"])
    _open[-1].append(module)
