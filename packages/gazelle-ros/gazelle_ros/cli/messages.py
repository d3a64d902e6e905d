"""List and show message types, as rosmsg does.

gazelle msg list
gazelle msg show geometry_msgs/Twist
gazelle msg show Twist
gazelle msg md5 std_msgs/Header
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING

from gazelle_ros.cli.tools import SubCommands

if TYPE_CHECKING:
    from gazelle_ros.tools.definitions import Kind


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    for name in ("show", "info"):
        show = commands.add(name, "show the fields of a type", _show)
        show.add_argument("type", metavar="[PKG/]TYPE")
        show.add_argument(
            "-r", "--raw", action="store_true", help="print the definition unchanged, with comments"
        )
    commands.add("md5", "print the MD5 sum of a type", _md5).add_argument(
        "type", metavar="[PKG/]TYPE"
    )
    commands.add("list", "list all types", _list)
    for name, purpose in (
        ("package", "list the types of a package"),
        ("packages", "list packages with types"),
    ):
        sub = commands.add(name, purpose, _package if name == "package" else _packages)
        if name == "package":
            sub.add_argument("package", metavar="PKG")
        sub.add_argument("-s", "--single-line", action="store_true", help="print one line")
    kind = "srv" if parser.prog.endswith("srv") else "msg"
    parser.set_defaults(kind=kind)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _matching_types(args: argparse.Namespace) -> list[str]:
    from gazelle_ros.tools.definitions import types_named
    from gazelle_ros.tools.errors import ToolError

    kind: Kind = args.kind
    found = types_named(args.type, kind)
    if not found:
        raise ToolError(f"Could not find {kind} '{args.type}'")
    return found


def _show(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.definitions import show_type

    for name in _matching_types(args):
        text = show_type(name, args.kind, raw=args.raw)
        sys.stdout.write(text + "\n" if "/" in args.type else f"[{name}]:\n{text}\n")
    return 0


def _md5(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.definitions import type_md5

    for name in _matching_types(args):
        md5 = type_md5(name, args.kind)
        sys.stdout.write(f"{md5}\n" if "/" in args.type else f"[{name}]: {md5}\n")
    return 0


def _list(args: argparse.Namespace) -> int:
    from gazelle_ros.messages import definitions

    sys.stdout.write("".join(f"{name}\n" for name in definitions(args.kind)))
    return 0


def _package(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.definitions import package_types

    return _write(package_types(args.package, args.kind), args)


def _packages(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.definitions import packages_with

    return _write(packages_with(args.kind), args)


def _write(names: list[str], args: argparse.Namespace) -> int:
    sys.stdout.write((" " if args.single_line else "\n").join(names) + "\n")
    return 0
