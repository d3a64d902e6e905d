"""Write template files into this folder.

  gazelle new task Balance
  gazelle new control my_arm.urdf

task:    a task with a robot and a test; its cart-pole trains in a minute.
control: files for ros_control: the robot's URDF with transmissions, a
         controller configuration and a launch file.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import contextlib
import re
import sys
from importlib import resources
from importlib.resources.abc import Traversable
from pathlib import Path

from gazelle.cli import showing
from gazelle.errors import TaskError
from gazelle_ros.base.text_files import read_text
from gazelle_ros.base.writing import write_text

_FILES = {"task.py": "{}.py", "robot.urdf": "{}.urdf", "test.py": "test_{}.py"}


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "kind", choices=["task", "control"], metavar="task|control", help="kind of template"
    )
    parser.add_argument(
        "name", metavar="NAME", help="name of the task, or the robot's URDF or xacro file"
    )
    parser.add_argument(
        "--out", metavar="DIR", type=Path, default=Path(), help="output folder (default: this one)"
    )
    parser.add_argument(
        "--interface", choices=["effort", "position", "velocity"], default="effort",
        help="hardware interface of the joints (default effort)",
    )  # fmt: skip
    parser.add_argument(
        "--controller", choices=["trajectory", "group", "joint"], default="trajectory",
        help="one trajectory controller, one group controller, or one controller per joint (default trajectory)",
    )  # fmt: skip


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    if args.kind == "control":
        return _control(args)
    files = write_task(args.name, args.out)
    sys.stdout.write("".join(f"wrote {file}\n" for file in files))
    program, task = showing.program(), f"{files[0]}:my/{args.name}-v0"
    sys.stdout.write(
        f"train it:   {program} train {task}\n"
        f"test it:    python -m pytest {files[-1]}\n"
        "change it:  what is seen, done and rewarded is in the first file\n"
    )
    return 0


def _control(args: argparse.Namespace) -> int:
    """Write what a robot needs to be controlled."""
    from gazelle import builders
    from gazelle.formats import Resolver, loader, xacro, xml
    from gazelle.formats.reading import Reading
    from gazelle.formats.write.xml import fragment

    reading = Reading(Resolver(()))
    path = loader.find_file(args.name, reading)
    text = read_text(path)
    if xacro.is_xacro(xml.read_file(path)):
        text = fragment(xacro.expand(path, reading), "")
    files = builders.control_files(text, interface=args.interface, kind=args.controller)
    written = files.write(args.out)
    sys.stdout.write("".join(f"wrote {file}\n" for file in written))
    program = showing.program()
    sys.stdout.write(
        f"check it:   {program} check --urdf {written[0]} {written[1]}\n"
        f"start it:   {program} launch {written[2]}\n"
        "tune it:    gains are a first guess from inertias\n"
    )
    return 0


def write_task(name: str, folder: Path) -> list[Path]:
    """Write a task, its robot and its test; all or nothing.

    Raises:
        TaskError: The name cannot be a class's, or a file is there already.
    """
    if not re.fullmatch(r"[A-Za-z][A-Za-z0-9]*", name):
        hint = "letters and digits, such as Balance"
        raise TaskError(f"'{name}' is not a valid name of a task", hint=hint)
    stem = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()
    sources = {folder / pattern.format(stem): source for source, pattern in _FILES.items()}
    for file in sources:
        if file.exists():
            hint = "give another name, or another folder with --out"
            raise TaskError(f"{file} is there already", hint=hint)
    folder.mkdir(parents=True, exist_ok=True)
    home = resources.files("gazelle.cli") / "templates"
    with contextlib.ExitStack() as undo:
        _write_all(sources, home, name, stem, undo)
        undo.pop_all()
    return list(sources)


def _write_all(
    sources: dict[Path, str], home: Traversable, name: str, stem: str, undo: contextlib.ExitStack
) -> None:
    for file, source in sources.items():
        undo.callback(file.unlink, missing_ok=True)
        text = (home / f"{source}.txt").read_text(encoding="utf-8")
        text = text.replace("TESTFILE", f"test_{stem}").replace("TASKFILE", stem)
        write_text(file, text.replace("NAME", name))
