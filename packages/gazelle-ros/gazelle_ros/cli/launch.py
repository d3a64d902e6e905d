"""Run a roslaunch file: start its nodes, and stop them at Ctrl-C.

  gazelle launch turtlebot3_gazebo turtlebot3_world.launch model:=waffle
  gazelle launch ./my.launch gui:=false
  gazelle launch my.launch --ros-args
  gazelle launch --test my_package my.test

Packages are looked up on ROS_PACKAGE_PATH. Python nodes run as 'gazelle exec'
runs them, so that 'import rospy' works with no ROS installed. A master is
started if there is none.
"""  # this is the text of --help

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gazelle_ros.base.argument_types import peer_port, positive_float
from gazelle_ros.base.errors import Error
from gazelle_ros.base.output import say_line
from gazelle_ros.base.program import program_name
from gazelle_ros.base.terminal import kept_terminal
from gazelle_ros.base.writing import write_text

if TYPE_CHECKING:
    from gazelle_ros.launch import LaunchPlan, Packages

_NO_EFFECT = ("--local", "--skip-log-check", "--disable-title")
_NO_EFFECT_VALUES = (("-w", "--numworkers"), ("-t", "--timeout"), ("--master-logger-level",))
_CHILD = (("-c", "--child"), ("-u", "--server_uri"))


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "what",
        nargs="*",
        metavar="[PKG] FILE | arg:=value",
        help="a launch file, '-' for standard input, or a package and a file in it",
    )
    shows = parser.add_argument_group("print information instead of running")
    shows.add_argument("--ros-args", action="store_true", help="print the arguments of the file")
    shows.add_argument("--files", action="store_true", help="print the included launch files")
    shows.add_argument("--nodes", action="store_true", help="print the names of the nodes")
    shows.add_argument(
        "--find-node", "--find", metavar="NODE", help="print the launch file that defines a node"
    )
    shows.add_argument("--args", metavar="NODE", help="print the command line of a node")
    shows.add_argument("--dump-params", action="store_true", help="print the parameters as YAML")
    runs = parser.add_argument_group("run")
    runs.add_argument("--screen", action="store_true", help="print the output of all nodes")
    runs.add_argument(
        "--log", action="store_true", help="write the output of all nodes to log files"
    )
    runs.add_argument("--required", action="store_true", help="stop when any node ends")
    runs.add_argument("--core", action="store_true", help="start master and rosout, as roscore")
    runs.add_argument(
        "--wait", action="store_true", help="wait for a master instead of starting one"
    )
    runs.add_argument("-p", "--port", type=peer_port, help="port of the master")
    runs.add_argument(
        "--nodes-survive",
        action="store_true",
        help="leave the nodes running if this process is killed (kill -9), as roslaunch does",
    )
    runs.add_argument("--run_id", default="", metavar="ID", help="run_id of the session")
    runs.add_argument("--pid", metavar="FILE", help="write the process id to a file")
    runs.add_argument(
        "-v",
        "--verbose",
        action="store_true",
        help="print parameters and nodes first, as roslaunch does",
    )
    runs.add_argument(
        "--no-summary", action="store_true", help="do not print a summary of parameters and nodes"
    )
    runs.add_argument(
        "--sigint-timeout",
        type=positive_float,
        default=15.0,
        metavar="S",
        help="seconds from SIGINT to SIGTERM (default 15)",
    )
    runs.add_argument(
        "--sigterm-timeout",
        type=positive_float,
        default=2.0,
        metavar="S",
        help="seconds from SIGTERM to SIGKILL (default 2)",
    )
    tests = parser.add_argument_group("test, as rostest does")
    tests.add_argument("--test", action="store_true", help="run the tests of the files")
    tests.add_argument("--text", action="store_true", help="print the output of tests")
    tests.add_argument("--results", metavar="DIR", help="write JUnit results below this folder")
    tests.add_argument(
        "--reuse-master", action="store_true", help="use the running master instead of a new one"
    )
    for option in _NO_EFFECT:
        runs.add_argument(option, action="store_true", help=argparse.SUPPRESS)
    for options in (*_NO_EFFECT_VALUES, *_CHILD):
        dest = "child" if options in _CHILD else None
        runs.add_argument(*options, dest=dest, help=argparse.SUPPRESS)
    parser.set_defaults(parser=parser)


def run(args: argparse.Namespace) -> int:
    """Run the command; returns the exit code."""
    from gazelle_ros.launch import Packages

    if args.child is not None:
        args.parser.error("nodes run on this machine only: there are no child launchers")
    packages = Packages()
    plan = _load(args, packages)
    for notice in plan.notices:
        sys.stderr.write(f"{program_name()}: warning: {notice}\n")
    shown = _show(args, plan, packages)
    if shown is not None:
        sys.stdout.write(shown)
        return 0
    if args.pid:
        write_text(args.pid, f"{os.getpid()}\n")
    if args.test:
        return _test(args, plan, packages)
    return _launch(args, plan, packages)


def _test(args: argparse.Namespace, plan: LaunchPlan, packages: Packages) -> int:
    from gazelle_ros.launch import testing

    package, name = testing.report_name(Path(plan.files[0]))
    folder = Path(args.results) if args.results else testing.results_folder()
    report = testing.TestReport(f"{package}.{name}")
    testing.run_tests(
        plan,
        report,
        (folder / package).resolve(),
        say=say_line,
        reuse_master=args.reuse_master,
        text=args.text,
        packages=packages,
    )
    report.write(folder / package / f"{name}.xml")
    say_line(report.summary())
    say_line(f"results are in {folder / package / name}.xml")
    return 0 if report.passed else 1


def _load(args: argparse.Namespace, packages: Packages) -> LaunchPlan:
    from gazelle_ros.launch import LaunchPlan, load_launch, load_launch_text
    from gazelle_ros.names import split_arguments

    words, given = split_arguments(args.what)
    if args.ros_args:
        return _arguments_only(words, given, packages, args.parser)
    if args.core and not words:
        return LaunchPlan()
    if words == ["-"]:
        text = sys.stdin.buffer.read()
        return load_launch_text(text, given, name="stdin", packages=packages)
    return load_launch(_files(words, packages, args.parser), given, packages=packages)


def _arguments_only(
    words: list[str], arguments: dict[str, str], packages: Packages, parser: Any
) -> LaunchPlan:
    from gazelle_ros.launch.loader import declared_arguments

    plan: LaunchPlan = declared_arguments(
        _files(words, packages, parser), arguments, packages=packages
    )
    return plan


def _files(words: list[str], packages: Packages, parser: Any) -> list[str]:
    """Return the launch files: files, or a package and the name of a file in it."""
    from gazelle_ros.launch.finding import find_launch_file, require_name

    if not words:
        parser.error("give a launch file, or a package and a launch file")
    if len(words) == 2 and not Path(words[0]).is_file():
        return [str(find_launch_file(words[0], words[1], packages))]
    if len(words) == 1 and not Path(words[0]).is_file():
        require_name(words[0], packages)
    return words


def _show(args: argparse.Namespace, plan: LaunchPlan, packages: Packages) -> str | None:
    """Return the text that is requested instead of a run; None if none is."""
    from gazelle_ros import net
    from gazelle_ros.launch import describing

    if args.ros_args:
        return describing.arguments(plan)
    if args.files:
        return "".join(f"{file}\n" for file in plan.files)
    if args.nodes:
        return "".join(f"{node.full_name}\n" for node in [*plan.nodes, *plan.tests])
    if args.find_node:
        return f"{describing.find_node(plan, args.find_node).place.file}\n"
    if args.args:
        node = describing.find_node(plan, args.args)
        return " ".join(describing.command(node, packages, net.default_master_uri())) + "\n"
    if args.dump_params:
        return describing.parameters(plan, packages)
    return None


def _launch(args: argparse.Namespace, plan: LaunchPlan, packages: Packages) -> int:
    from dataclasses import replace

    from gazelle_ros import net
    from gazelle_ros.base.interrupts import stopping
    from gazelle_ros.launch import describing
    from gazelle_ros.launch.process import StopTimeouts
    from gazelle_ros.launch.runner import Launch, Options

    options = Options(
        core=args.core,
        core_survives=True,
        nodes_survive=args.nodes_survive,
        wait=args.wait,
        screen=args.screen,
        log=args.log,
        run_id=args.run_id,
        patience=StopTimeouts(args.sigint_timeout, args.sigterm_timeout),
    )
    if args.port is not None:
        options.master_uri = net.uri_of(options.host, args.port)
    if args.required:
        plan.nodes = [replace(each, required=True, respawn=False) for each in plan.nodes]
    if plan.tests:
        say_line(f"{len(plan.tests)} tests are not run; --test runs them")
    launch = Launch(plan, options, say=say_line, packages=packages)
    if not args.no_summary:
        describe = describing.summary if args.verbose else describing.outline
        sys.stdout.write(f"{describe(plan)}\nROS_MASTER_URI={launch.master_uri}\n\n")
    # A node that read keys may be killed.
    with kept_terminal(sys.stdin), launch, stopping(launch.end) as request:
        try:
            launch.start()
        except Error:
            if not request.is_set():
                raise
        code = launch.spin()
        say_line("shutting down")
    say_line("done")
    return code
