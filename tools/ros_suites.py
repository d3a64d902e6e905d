"""Run ROS 1's own test suites with parts of Gazelle in the real ones' place, and count.

  python tools/ros_suites.py --fetch
  python tools/ros_suites.py --sources ~/ros --stack both --only actionlib

Needs the real ROS 1 of Debian 12 (.ci/packages.txt) and the suites' sources: those of Debian's
source packages (--fetch), or checkouts of ros/ros_comm at 1.15.15, ros/actionlib, ros/geometry and
ros/geometry2 below one folder. Debian packages neither ros_control nor ros_controllers, so theirs are run
from checkouts of ros-controls/ros_control, ros_controllers and realtime_tools only, whose C++ clients are
compiled with libroscpp-dev, libtf-dev, libactionlib-dev, libnav-msgs-dev, libtrajectory-msgs-dev,
libangles-dev, libgtest-dev and python3-gencpp. MoveIt's Python suites
are run from checkouts of ros-planning/moveit and moveit_resources (rossuites/moveit.py). Nothing of them is kept. The stacks are: real, the installed ROS
alone; master, Gazelle's master under real clients; clients, Gazelle's modules and tools on the real
master; both; alone, nothing real. Exits with 1 if a stack passes fewer tests than the real one is known to.
"""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT / "tools"))

from rossuites import compiling, generating, sources, stacks  # noqa: E402  # the path must come first
from rossuites.catalogue import SUITES, Suite  # noqa: E402
from rossuites.control import CONTROL  # noqa: E402
from rossuites.moveit import MOVEIT  # noqa: E402
from rossuites.running import Outcome, run  # noqa: E402

ALL = (*SUITES, *CONTROL, *MOVEIT)
SOURCES = "GAZELLE_ROS_SOURCES"


def main() -> int:
    """Run what is asked for and print the table."""
    options = _parse()
    if not Path("/usr/bin/rostest").exists() and options.stack != ["alone"]:
        print("the real ROS 1 is not installed (Debian: see .ci/packages.txt); nothing is run")
        return 1 if options.strict else 0
    with tempfile.TemporaryDirectory(prefix="ros-suites-") as scratch:
        return _run(options, Path(scratch))


def _parse() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "--sources",
        type=Path,
        default=os.environ.get(SOURCES) and Path(os.environ[SOURCES]),
        help=f"folder with the suites' sources (default: {SOURCES}, where that is set)",
    )
    parser.add_argument("--build", type=Path, help="folder that keeps compiled clients")
    parser.add_argument("--fetch", action="store_true", help="fetch them from Debian")
    parser.add_argument("--stack", nargs="+", choices=stacks.STACKS, help="default: all but real")
    parser.add_argument("--only", nargs="+", metavar="SUITE", help="suites by name")
    parser.add_argument("--quick", action="store_true", help="what CI runs: two minutes")
    parser.add_argument("--log", type=Path, help="folder for the output of what failed")
    parser.add_argument("--tries", type=int, default=1, help="of a suite that falls short")
    parser.add_argument("--strict", action="store_true", help="what cannot be run has failed")
    return parser.parse_args()


def _run(options: argparse.Namespace, scratch: Path) -> int:
    folder = options.sources or scratch / "sources"
    if options.fetch:
        folder.mkdir(parents=True, exist_ok=True)
        for package in sources.fetch(folder):
            print(f"Debian's source package {package} cannot be had")
    found = sources.packages(folder) if folder.is_dir() else {}
    print("| suite | stack | passed | run | real ROS passes | s | differs |")
    print("|---|---|---|---|---|---|---|")
    good = True
    for name in options.stack or [name for name in stacks.STACKS if name != "real"]:
        stack = stacks.STACKS[name]
        environment = _prepare(stack, found, scratch / name)
        for suite in _chosen(options, stack):
            if suite.package in found:
                build = options.build or scratch / "build"
                _compile(suite, found, scratch / name / "packages" / suite.package, build)
                # Their waits of a second or two do not fit a busy machine: a second try is shown, too.
                good &= any(
                    _suite(suite, stack, environment, scratch / name, options.log)
                    for _ in range(options.tries)
                )
            else:
                print(f"| {suite.name} | {name} | - | - | {suite.reference} | | no sources |")
                good &= not options.strict
    return 0 if good else 1


def _compile(suite: Suite, found: dict[str, Path], package: Path, folder: Path) -> None:
    """Build the programs of a suite, and put the stand-ins of its robots beside them."""
    for program in suite.programs:
        sources.build(package / program)
    stacks.put_robots(suite.robots, package)
    clients = [
        *suite.clients,
        *(compiling.clients_of(package, suite.files) if suite.compiled else ()),
    ]
    wanted = [client for client in clients if client.name not in suite.robots]
    for name, words in compiling.build(package, wanted, found, folder).items() if clients else ():
        print(f"{name} cannot be compiled: {words[:500]}")


def _prepare(stack: stacks.Stack, found: dict[str, Path], folder: Path) -> dict[str, str]:
    environment = stacks.lay_out(stack, folder)
    names = {name for suite in ALL for name in (suite.package, *suite.beside)} | {"test_rosmaster"}
    sources.overlay(found, names, folder / "packages", folder / "bin" / "python")
    if not stack.launcher:  # real programs have no use of ours
        generating.generate(folder / "packages", folder / "generated")
    return environment


def _chosen(options: argparse.Namespace, stack: stacks.Stack) -> list[Suite]:
    return [
        suite
        for suite in ALL
        if (options.only is None or suite.name in options.only)
        and (stack.name in suite.quick or not options.quick)
        and (not stack.replaces or suite.uses & stack.replaces)
        and (not suite.only or stack.name in suite.only)
    ]


def _suite(
    suite: Suite, stack: stacks.Stack, environment: dict[str, str], folder: Path, log: Path | None
) -> bool:
    outcomes = []
    for name in suite.files:
        # Roslaunch wants no blanks.
        home = folder / f"{suite.name}-{Path(name).name}".replace(" ", "_").replace(",", "")
        file = folder / "packages" / suite.package / name
        with sources.hiding(folder / "packages", suite.hidden):
            outcome = run(file, environment | {"ROS_HOME": str(home)})
        if stack.clients and not stack.launcher and not (home / stacks.USED).exists():
            raise SystemExit(f"{name}: Gazelle's modules were not used")
        outcomes.append(outcome)
        if log is not None and outcome.passed < suite.files[name]:
            log.mkdir(parents=True, exist_ok=True)
            (log / f"{stack.name}-{Path(name).name}.log").write_text(outcome.log)
    passed = sum(outcome.passed for outcome in outcomes)
    fewer, reason = suite.less.get(stack.name, (0, ""))
    print(_row(suite, stack, outcomes, reason), flush=True)
    return passed >= suite.reference - fewer


def _row(suite: Suite, stack: stacks.Stack, outcomes: list[Outcome], reason: str) -> str:
    failed = ", ".join(name for outcome in outcomes for name in outcome.failed)
    cells = (
        suite.name,
        stack.name,
        sum(outcome.passed for outcome in outcomes),
        sum(outcome.total for outcome in outcomes),
        suite.reference,
        f"{sum(outcome.seconds for outcome in outcomes):.0f}",
        "; ".join(each for each in (reason, failed) if each),
    )
    return f"| {' | '.join(map(str, cells))} |"


if __name__ == "__main__":
    sys.exit(main())
