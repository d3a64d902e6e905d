"""Load files and judge them: every problem with its file and line, and what to do.
A file that can be read is also built with the engine and its plugins.

  gazelle check my.world my_robot.urdf.xacro

The exit code is 1 if there is any error; warnings alone leave it 0.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import sys
import warnings
from typing import TYPE_CHECKING

from gazelle.errors import Error, FormatWarning, GazelleWarning, describe

if TYPE_CHECKING:
    from gazelle.formats import Problem


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="a file, a model's folder, or a bundled name"
    )
    parser.add_argument("--engine", metavar="NAME", default="mujoco", help="default mujoco")
    parser.add_argument(
        "--files-only", action="store_true", help="do not build them with the engine"
    )


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    errors = sum(_judge(file, args) for file in args.files)
    return 1 if errors else 0


def _judge(file: str, args: argparse.Namespace) -> int:
    """Print the findings about one file; returns the number of errors."""
    from gazelle.formats import check

    problems = check(file)
    lines: list[tuple[str, str, str | None]]
    lines = [(problem.severity, _text(problem), problem.hint) for problem in problems]
    errors = sum(severity == "error" for severity, _, _ in lines)
    if not errors and not args.files_only:
        lines += _build(file, args.engine)
        errors = sum(severity == "error" for severity, _, _ in lines)
    for severity, text, hint in lines:
        sys.stdout.write(f"{severity}: {text}\n" + (f"  hint: {hint}\n" if hint else ""))
    counts = f"{_count(errors, 'error')}, {_count(len(lines) - errors, 'warning')}"
    sys.stdout.write(f"{file}: {counts if lines else 'ok'}\n")
    return errors


def _build(file: str, engine: str) -> list[tuple[str, str, str | None]]:
    """What the engine and the plugins have to say."""
    from gazelle.simulation import Simulation

    found: list[tuple[str, str, str | None]] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            Simulation(file, engine).close()
        except Error as error:
            found.append(("error", _text(error), error.hint))
    for warning in caught:
        # What the files hold was reported by `gazelle.formats.check` already.
        ours = issubclass(warning.category, GazelleWarning)
        if ours and not issubclass(warning.category, FormatWarning):
            found.append(("warning", str(warning.message), None))
    return found


def _text(problem: Problem | Error) -> str:
    return describe(problem.message, file=problem.file, line=problem.line, element=problem.element)


def _count(number: int, name: str) -> str:
    return f"{number} {name}" + ("" if number == 1 else "s")
