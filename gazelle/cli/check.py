"""Load files and judge them: every problem with its file and line, and what to do.
A file that can be read is also built with the engine and its plugins.

  gazelle check my.world my_robot.urdf.xacro
  gazelle check --json my.world > findings.json

The exit code is 1 if there is any error; warnings alone leave it 0.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import json
import sys
import warnings
from dataclasses import asdict
from typing import TYPE_CHECKING

from gazelle.errors import Error, FormatWarning, GazelleWarning, describe

if TYPE_CHECKING:
    from gazelle.formats import Problem


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "files", nargs="+", metavar="FILE", help="a file, a model's folder, or a bundled name"
    )
    parser.add_argument("--json", action="store_true", help="for tools: one JSON list")
    parser.add_argument("--engine", metavar="NAME", default="mujoco", help="default mujoco")
    parser.add_argument(
        "--files-only", action="store_true", help="do not build them with the engine"
    )


def run(args: argparse.Namespace) -> int:
    """Do it; returns the exit code."""
    judged = {file: _judge(file, args) for file in args.files}
    if args.json:
        rows = [{"path": file, **asdict(each)} for file, found in judged.items() for each in found]
        sys.stdout.write(json.dumps(rows, indent=2) + "\n")
    else:
        for file, found in judged.items():
            _show(file, found)
    return 1 if any(each.severity == "error" for found in judged.values() for each in found) else 0


def _judge(file: str, args: argparse.Namespace) -> list[Problem]:
    """The findings about one file."""
    from gazelle.formats import check

    found = check(file)
    if not args.files_only and not any(each.severity == "error" for each in found):
        found += _build(file, args.engine)
    return found


def _show(file: str, found: list[Problem]) -> None:
    """Print the findings about one file."""
    for each in found:
        text = describe(each.message, file=each.file, line=each.line, element=each.element)
        rule = f" [{each.rule}]" if each.rule else ""
        sys.stdout.write(f"{each.severity}: {text}{rule}\n")
        for name, more in (("why", each.why), ("hint", each.hint)):
            if more:
                sys.stdout.write(f"  {name}: {more}\n")
    errors = sum(each.severity == "error" for each in found)
    counts = f"{_count(errors, 'error')}, {_count(len(found) - errors, 'warning')}"
    sys.stdout.write(f"{file}: {counts if found else 'ok'}\n")


def _build(file: str, engine: str) -> list[Problem]:
    """What the engine and the plugins have to say."""
    from gazelle.formats import Problem
    from gazelle.simulation import Simulation

    found: list[Problem] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            Simulation(file, engine).close()
        except Error as error:
            found.append(
                Problem("error", error.message, error.file, error.line, error.element, error.hint)
            )
    for warning in caught:
        # What the files hold was reported by `gazelle.formats.check` already.
        ours = issubclass(warning.category, GazelleWarning)
        if ours and not issubclass(warning.category, FormatWarning):
            found.append(Problem("warning", str(warning.message)))
    return found


def _count(number: int, name: str) -> str:
    return f"{number} {name}" + ("" if number == 1 else "s")
