"""Check files: report each problem with its file, line and a suggested fix.
Files that can be read are also loaded into the engine, with their plugins.

  gazelle check my.world my_robot.urdf.xacro
  gazelle check --urdf my_robot.urdf my_robot.srdf my_controllers.yaml
  gazelle check my_robot.launch model:=burger    # its nodes, world and robots
  gazelle check --json my.world > findings.json

The exit code is 1 if there is any error; warnings alone leave it 0.
"""  # noqa: D205  # this is the text of --help

from __future__ import annotations

import argparse
import json
import shutil
import sys
import textwrap
from collections import Counter
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING

from gazelle.cli.progress_line import ProgressLine
from gazelle.errors import Error, describe

if TYPE_CHECKING:
    from gazelle.formats import Problem


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "files",
        nargs="+",
        metavar="FILE",
        help="file, model folder or bundled name; arg:=value for launch files",
    )
    parser.add_argument("--json", action="store_true", help="print the findings as a JSON list")
    parser.add_argument(
        "--urdf", metavar="FILE", help="robot that an SRDF or controller file belongs to"
    )
    parser.add_argument(
        "--engine",
        metavar="NAME",
        default="",
        help="physics engine: mujoco or planar (default mujoco; planar for Stage files)",
    )
    parser.add_argument(
        "--files-only", action="store_true", help="do not load the files into the engine"
    )


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle.cli.check_launch import check_launch, is_launch
    from gazelle.cli.file_checks import check_file
    from gazelle_ros.names import split_arguments

    words, arguments = split_arguments(args.files)
    if not words:
        raise Error("there is no file to check", hint="arg:=value goes with a launch file")
    engine = None if args.files_only else args.engine
    lists: dict[str, list[str]] = {}
    judged: dict[str, list[Problem]] = {}
    for file in ProgressLine("checking", len(words), "files").count(words):
        if is_launch(file):
            lists[file], judged[file] = check_launch(file, arguments, engine)
        else:
            judged[file] = check_file(file, engine, urdf=args.urdf)
    if args.json:
        rows = [{"path": file, **asdict(each)} for file, found in judged.items() for each in found]
        sys.stdout.write(json.dumps(rows, indent=2) + "\n")
    else:
        for file, found in judged.items():
            sys.stdout.writelines(f"{line}\n" for line in lists.get(file, ()))
            _show(file, found)
    return 1 if any(each.severity == "error" for found in judged.values() for each in found) else 0


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
    """Return a finding without its reasons; the line names its element, if any."""
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


def _count(number: int, name: str) -> str:
    return f"{number} {name}" + ("" if number == 1 else "s")
