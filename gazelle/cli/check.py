"""Load files and check them: every problem with its file and line, and what to do.
A file that can be read is also built with the engine and its plugins.

  gazelle check my.world my_robot.urdf.xacro
  gazelle check --urdf my_robot.urdf my_robot.srdf my_controllers.yaml
  gazelle check my_robot.launch model:=burger    # is every node there?
  gazelle check --json my.world > findings.json

The exit code is 1 if there is any error; warnings alone leave it 0.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import json
import shutil
import sys
import textwrap
import warnings
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cli.progress_line import ProgressLine
from gazelle.errors import (
    ControlError,
    Error,
    FormatWarning,
    GazelleWarning,
    PluginWarning,
    describe,
)

if TYPE_CHECKING:
    from gazelle.formats import Problem


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "files",
        nargs="+",
        metavar="FILE",
        help="a file, a model's folder, or a bundled name; arg:=value for launch files",
    )
    parser.add_argument("--json", action="store_true", help="for tools: one JSON list")
    parser.add_argument("--urdf", metavar="FILE", help="the robot of an SRDF, or of controllers")
    parser.add_argument("--engine", metavar="NAME", default="mujoco", help="default mujoco")
    parser.add_argument(
        "--files-only", action="store_true", help="do not build them with the engine"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.cli.check_launch import check_launch, is_launch
    from gazelle_ros.names import split_arguments

    words, arguments = split_arguments(args.files)
    if not words:
        raise Error("there is no file to check", hint="arg:=value goes with a launch file")
    lists: dict[str, list[str]] = {}
    judged: dict[str, list[Problem]] = {}
    for file in ProgressLine("checking", len(words), "files").count(words):
        if is_launch(file):
            lists[file], judged[file] = check_launch(file, arguments)
        else:
            judged[file] = _judge(file, args)
    if args.json:
        rows = [{"path": file, **asdict(each)} for file, found in judged.items() for each in found]
        sys.stdout.write(json.dumps(rows, indent=2) + "\n")
    else:
        for file, found in judged.items():
            sys.stdout.writelines(f"{line}\n" for line in lists.get(file, ()))
            _show(file, found)
    return 1 if any(each.severity == "error" for found in judged.values() for each in found) else 0


def _judge(file: str, args: argparse.Namespace) -> list[Problem]:
    """Return the findings about one file."""
    from gazelle.control.checking import check_controllers, is_controllers
    from gazelle.formats import check
    from gazelle.formats.check import TOLERATED, is_semantic

    if is_controllers(Path(file)):
        if args.urdf is None:
            raise ControlError(f"{file} holds controllers", hint="name their robot: --urdf FILE")
        return check_controllers(file, args.urdf)
    found = check(file, urdf=args.urdf)
    if is_semantic(Path(file)):
        return found
    stopped = any(each.severity == "error" and each.rule != TOLERATED for each in found)
    if not args.files_only and not stopped:
        found += _build(file, args.engine)
    return found


def _show(file: str, found: list[Problem]) -> None:
    """Print the findings about one file: those with one advice together, by their lines.

    What a macro or an include repeats is one line.
    """
    for key in dict.fromkeys(map(_advice, found)):
        alike = [each for each in found if _advice(each) == key]
        alike.sort(key=lambda each: (each.file or "", each.line or 0))
        for line, times in Counter(map(_line, alike)).items():
            _write(line if times == 1 else f"{line} ({times} times)", "  ")
        for name, more in (("why", alike[0].why), ("hint", alike[0].hint)):
            if more:
                _write(f"  {name}: {more}", "    ")
    errors = sum(each.severity == "error" for each in found)
    counts = f"{_count(errors, 'error')}, {_count(len(found) - errors, 'warning')}"
    sys.stdout.write(f"{file}: {counts if found else 'ok'}\n")


def _advice(each: Problem) -> tuple[str | None, ...]:
    """Return the key of findings that are printed together."""
    return (each.severity, each.rule, each.why, each.hint)


def _line(each: Problem) -> str:
    """Return a finding without its reasons; the line says which element it is about, if any."""
    file = None if each.file is None else _near(each.file)
    element = each.element if each.line is None else None
    text = describe(each.message, file=file, line=each.line, element=element)
    return f"{each.severity}: {text}" + (f" [{each.rule}]" if each.rule else "")


def _near(file: str) -> str:
    """Return the name of a file relative to this folder, if it lies below."""
    path = Path(file)
    return str(path.relative_to(Path.cwd())) if path.is_relative_to(Path.cwd()) else file


def _write(text: str, indent: str) -> None:
    """Print text, on a screen in lines that fit; in a file or pipe it stays one line."""
    lines = [text]
    if sys.stdout.isatty():
        width = max(40, shutil.get_terminal_size((80, 24)).columns)
        lines = textwrap.wrap(
            text, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
        )
    sys.stdout.write("\n".join(lines) + "\n")


def _build(file: str, engine: str) -> list[Problem]:
    """Return the problems that the engine and the plugins report."""
    from gazelle.formats import Problem
    from gazelle.simulation import Simulation

    found: list[Problem] = []
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            Simulation(file, engine).close()
        except Error as error:
            found.append(Problem.of(error))
    for warning in caught:
        # What the files hold was reported by `gazelle.formats.check` already.
        ours = issubclass(warning.category, GazelleWarning)
        failed = issubclass(warning.category, PluginWarning)
        if ours and not issubclass(warning.category, FormatWarning):
            found.append(Problem("error" if failed else "warning", str(warning.message)))
    return found


def _count(number: int, name: str) -> str:
    return f"{number} {name}" + ("" if number == 1 else "s")
