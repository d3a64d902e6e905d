"""Argument parsing that fits 80 columns and says what to do about a mistake."""

from __future__ import annotations

import argparse
import json
import shutil
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NoReturn

from gazelle_ros.base.argument_types import NumberParser, positive_int
from gazelle_ros.base.errors import did_you_mean
from gazelle_ros.base.program import program_name

_WIDTH = 80


class Parser(NumberParser):
    """A parser whose errors are one line and a hint, with exit code 2."""

    intermixed = False
    """True if options may stand between words, as those of nodes with remappings do."""

    def __init__(self, **keywords: Any) -> None:
        super().__init__(formatter_class=_formatter, allow_abbrev=False, **keywords)

    def parse_known_args(  # type: ignore[override]  # its overloads say the same
        self, args: Sequence[str] | None = None, namespace: argparse.Namespace | None = None
    ) -> tuple[argparse.Namespace, list[str]]:
        """Parse like the library, except for `intermixed`."""
        if not self.intermixed:
            return super().parse_known_args(args, namespace)
        self.intermixed = False  # the library's method calls this one
        try:
            return self.parse_known_intermixed_args(args, namespace)
        finally:
            self.intermixed = True

    def _get_value(self, action: argparse.Action, arg_string: str) -> Any:
        # A shell makes it of a variable that is not set; a default of "" says that it has a meaning.
        words = action.option_strings and action.type in (None, Path) and action.default != ""
        if words and not arg_string:
            raise argparse.ArgumentError(action, "expected a value, not an empty text")
        return super()._get_value(action, arg_string)

    def error(self, message: str) -> NoReturn:
        """Print what is wrong with the command line and exit with code 2."""
        hint = self._closest_option(message) or f"see {self.prog} --help"
        sys.stderr.write(f"{program_name()}: error: {message}\n  hint: {hint}\n")
        self.exit(2)

    def _closest_option(self, message: str) -> str | None:
        """Return the option similar to an unknown one."""
        prefix = "unrecognized arguments: "
        if not message.startswith(prefix):
            return None
        unknown = message.removeprefix(prefix).partition(" ")[0].partition("=")[0]
        known = [option for option in self._option_string_actions if option.startswith("--")]
        hint = did_you_mean(unknown, known)
        return hint if hint.startswith("did you mean") else None


def key_value(text: str) -> tuple[str, Any]:
    """Parse ``KEY=VALUE``; the value is read as JSON if it is JSON, else as text."""
    key, equals, value = text.partition("=")
    if not equals or not all(part.isidentifier() for part in key.split(".")):
        raise argparse.ArgumentTypeError(f"expected KEY=VALUE, not '{text}'")
    try:
        return key, json.loads(value)
    except ValueError:
        return key, value


def add_environment_options(parser: argparse.ArgumentParser) -> None:
    """Add the options of every command with an environment."""
    group = parser.add_argument_group("environment")
    group.add_argument(
        "--engine", metavar="NAME", help="physics engine: mujoco, planar or mujoco-warp"
    )
    group.add_argument(
        "--option",
        metavar="KEY=VALUE",
        action="append",
        type=key_value,
        default=[],
        help="an option of the task, such as lidar_samples=360 (repeatable)",
    )


def add_file_options(parser: argparse.ArgumentParser) -> None:
    """Add the options that replace the files of a task."""
    group = parser.add_argument_group("files (default: the bundled ones)")
    group.add_argument("--world", metavar="FILE", help="world: .world or .sdf, or a bundled name")
    group.add_argument(
        "--robot", metavar="FILE", help="robot: .urdf, .xacro or .sdf, or a bundled name"
    )


def add_scenario_options(parser: argparse.ArgumentParser) -> None:
    """Add the options for starts and ends of episodes of navigation tasks."""
    group = parser.add_argument_group("starts and goals (of navigation tasks)")
    kinds = "published, training or held-out"
    group.add_argument("--goals", metavar="KIND", help=f"goals: {kinds}")
    group.add_argument(
        "--starts", metavar="KIND", help=f"initial poses of robot and obstacles: {kinds}"
    )


def add_import_option(parser: argparse.ArgumentParser) -> None:
    """Add the options that find tasks of the user's own, and with which a run finds them."""
    parser.add_argument(
        "--import",
        dest="imports",
        metavar="MODULE",
        action="append",
        default=[],
        help="a module or file that registers your task (repeatable)",
    )
    parser.add_argument(
        "--trust",
        action="store_true",
        help="import the Python modules that a run names, which may be untrusted",
    )


def add_worker_options(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the options for work in other processes or machines.

    Args:
        parser: Parser of the declared arguments.
        what: Purpose of the worker processes.
    """
    parser.add_argument("--workers", metavar="N", type=positive_int, help=what)
    parser.add_argument(
        "--ray",
        metavar="ADDRESS",
        nargs="?",
        const="local",
        help="run the workers on a Ray cluster (default: one on this machine)",
    )


def environment_options(args: argparse.Namespace) -> dict[str, Any]:
    """Return the task options collected by the functions above, without those not given."""
    options = dict(args.option)
    for name in ("engine", "world", "robot", "goals", "starts"):
        value = getattr(args, name, None)
        if value is not None:
            # A run must find its files again, wherever it is evaluated from.
            file = name in {"world", "robot"} and Path(value).exists()
            options[name] = str(Path(value).resolve()) if file else value
    return options


def _formatter(prog: str) -> argparse.HelpFormatter:
    width = min(_WIDTH, shutil.get_terminal_size().columns) - 1
    return argparse.RawDescriptionHelpFormatter(prog, max_help_position=26, width=width)
