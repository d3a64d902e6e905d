"""Read and set parameters, as rosparam does, on any ROS 1 graph.

gazelle param list
gazelle param set /use_sim_time true
gazelle param load gains.yaml /arm
gazelle param dump
"""  # this is the text of --help

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from gazelle_ros.base.text_files import read_text
from gazelle_ros.base.writing import write_text
from gazelle_ros.cli.tools import SubCommands


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    commands = SubCommands(parser)
    commands.add("list", "list parameter names", _list, "", "/move_base").add_argument(
        "space", nargs="?", metavar="/NAMESPACE"
    )
    get = commands.add("get", "print a value as YAML", _get, "/use_sim_time")
    get.add_argument("name", metavar="/NAME")
    get.add_argument("-p", dest="pretty", action="store_true", help="print in a readable layout")
    setting = commands.add(
        "set", "set a parameter to a YAML value; mappings are merged", _set, "/use_sim_time true"
    )
    setting.add_argument("name", metavar="/NAME")
    setting.add_argument("value", nargs="?", metavar="YAML")
    source = setting.add_mutually_exclusive_group()
    source.add_argument("-t", "--textfile", metavar="FILE", help="set to the text of a file")
    source.add_argument("-b", "--binfile", metavar="FILE", help="set to the bytes of a file")
    load = commands.add("load", "load parameters from a YAML file", _load, "gains.yaml /arm")
    load.add_argument("file", metavar="FILE", help="YAML file; '-' for standard input")
    load.add_argument("space", nargs="?", metavar="/NAMESPACE")
    dump = commands.add(
        "dump", "write parameters to a YAML file", _dump, "", "params.yaml /move_base"
    )
    dump.add_argument(
        "file", nargs="?", metavar="FILE", help="output file (default: standard output)"
    )
    dump.add_argument("space", nargs="?", metavar="/NAMESPACE")
    delete = commands.add("delete", "delete a parameter", _delete, "/move_base")
    delete.add_argument("name", metavar="/NAME")
    for each in (get, setting, load, dump, delete):
        each.add_argument("-v", "--verbose", action="store_true", help="print what is done")


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    code: int = args.action(args)
    return code


def _graph() -> Any:
    from gazelle_ros.tools.graph import GraphInspector

    return GraphInspector("rosparam")


def _list(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import list_parameters

    with _graph() as graph:
        sys.stdout.write("\n".join(list_parameters(graph, args.space)) + "\n")
    return 0


def _get(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import as_yaml, get_parameter, pretty

    with _graph() as graph:
        value = get_parameter(graph, args.name)
        if args.verbose:
            sys.stdout.write(f"getting parameter [{graph.resolve(args.name)}]\n")
    sys.stdout.write(pretty(value) if args.pretty else as_yaml(value))
    return 0


def _set(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import set_from_text, set_parameter

    given = [each for each in (args.value, args.textfile, args.binfile) if each is not None]
    if len(given) != 1:
        args.parser.error("give a value, --textfile or --binfile")
    with _graph() as graph:
        if args.textfile is not None:
            text = read_text(Path(args.textfile))
            done = set_parameter(graph, args.name, text)
        elif args.binfile is not None:
            done = set_parameter(graph, args.name, Path(args.binfile).read_bytes())
        else:
            done = set_from_text(graph, args.name, args.value)
    _report(args, done)
    return 0


def _load(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import load_parameters

    with _graph() as graph:
        done = load_parameters(graph, args.file, args.space)
    if args.verbose:
        sys.stdout.write(f"reading parameters from [{args.file}]\n")
        sys.stdout.write("".join(f"{name}={value}\n" for name, value in done))
    return 0


def _report(args: argparse.Namespace, done: list[tuple[str, Any]]) -> None:
    if args.verbose:
        for name, value in done:
            sys.stdout.write(f"set parameter [{name}] to [{value}]\n")


def _dump(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import dump_parameters, get_parameter, leaves

    with _graph() as graph:
        text = dump_parameters(graph, args.space)
        if args.verbose:
            space = graph.resolve(args.space or "/")
            sys.stdout.write(f"dumping namespace [{space}] to file [{args.file or ''}]\n")
            for name, value in leaves(get_parameter(graph, space), space):
                sys.stdout.write(f"{name}={value}\n")
    if args.file:
        write_text(args.file, text)
    else:
        sys.stdout.write(text)
    return 0


def _delete(args: argparse.Namespace) -> int:
    from gazelle_ros.tools.params import delete_parameter

    with _graph() as graph:
        delete_parameter(graph, args.name)
        if args.verbose:
            sys.stdout.write(f"deleted parameter [{graph.resolve(args.name)}]\n")
    return 0
