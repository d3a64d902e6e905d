"""Run the ``<test>`` elements of launch files, as rostest does.

Every test has a master of its own, and all nodes of the file again (http://wiki.ros.org/rostest).
"""

from __future__ import annotations

import contextlib
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path
from xml.etree import ElementTree as ET

from gazelle_ros import net
from gazelle_ros.base.errors import Error
from gazelle_ros.launch import folders
from gazelle_ros.launch.packages import Packages
from gazelle_ros.launch.plan import LaunchPlan, TestPlan
from gazelle_ros.launch.runner import Launch, Options, Say
from gazelle_ros.master.server import Master
from gazelle_ros.messages.search import find_packages

_LOOK_S = 0.05
_LARGEST = 16 << 20
"""No result file is longer [bytes]."""


@dataclass(slots=True)
class Case:
    """One case of a test: passed if there is no problem."""

    name: str
    seconds: float = 0.0
    problem: str = ""
    kind: str = ""
    """``failure`` or ``error`` if there is a problem."""


@dataclass(slots=True)
class TestReport:
    """Report of the tests of a launch file.

    Attributes:
        name: Name of the report.
        cases: All cases.
        seconds: Duration.
    """

    __test__ = False  # it is not a test of pytest's

    name: str
    cases: list[Case] = field(default_factory=list)
    seconds: float = 0.0

    @property
    def failures(self) -> int:
        """Number of cases that failed."""
        return sum(case.kind == "failure" for case in self.cases)

    @property
    def errors(self) -> int:
        """Number of cases that could not be run to their end."""
        return sum(case.kind == "error" for case in self.cases)

    @property
    def passed(self) -> bool:
        """True if there are cases and all passed."""
        return bool(self.cases) and not self.failures and not self.errors

    def write(self, path: Path) -> None:
        """Write it in JUnit's form."""
        root = ET.Element(
            "testsuite",
            name=self.name,
            tests=str(len(self.cases)),
            errors=str(self.errors),
            failures=str(self.failures),
            time=f"{self.seconds:.3f}",
        )
        for case in self.cases:
            group, _, name = case.name.rpartition("/")
            made = ET.SubElement(
                root, "testcase", classname=group, name=name, time=f"{case.seconds:.3f}"
            )
            if case.kind:
                ET.SubElement(
                    made, case.kind, type="", message=case.problem[:200]
                ).text = case.problem
        folders.made(path.parent)
        ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)

    def summary(self) -> str:
        """Return the report as text."""
        lines = ["", "[ROSTEST]" + "-" * 71, ""]
        for case in self.cases:
            lines.append(f"[{case.name}][{(case.kind + '!').upper() if case.kind else 'passed'}]")
            if case.kind:
                lines.append("\n".join(f"  {line}" for line in case.problem.splitlines()))
        lines += ["", "SUMMARY", f" * RESULT: {'SUCCESS' if self.passed else 'FAIL'}"]
        lines += [f" * TESTS: {len(self.cases)}", f" * ERRORS: {self.errors}"]
        return "\n".join([*lines, f" * FAILURES: {self.failures}", ""])


def results_folder() -> Path:
    """Return the folder of results: ROS_TEST_RESULTS_DIR, else ``test_results`` in ROS_HOME."""
    given = os.environ.get("ROS_TEST_RESULTS_DIR")
    return Path(given) if given else folders.ros_home() / "test_results"


def report_name(file: Path) -> tuple[str, str]:
    """Return the package of a test file, and the name of its report."""
    path = file.resolve()
    for name, folder in find_packages().items():
        if path.is_relative_to(folder.resolve()):
            inside = path.relative_to(folder.resolve()).with_suffix("")
            return name, "rostest-" + "_".join(inside.parts)
    return path.parent.name, f"rostest-{path.stem}"


def run_tests(
    plan: LaunchPlan,
    report: TestReport,
    folder: Path,
    *,
    say: Say,
    reuse_master: bool = False,
    text: bool = False,
    packages: Packages | None = None,
) -> None:
    """Run all tests of a plan, one after the other.

    Args:
        plan: The nodes and the tests.
        report: Gets the cases.
        folder: Folder of the tests' results.
        say: Gets lines for people.
        reuse_master: Use the master that runs instead of a new one for each test.
        text: Tests write to the screen.
        packages: Packages of the programs.
    """
    begin = time.monotonic()
    known = packages or Packages()
    for test in plan.tests:
        for attempt in range(test.retry + 1):
            with _options(reuse_master=reuse_master, text=text) as options:
                cases = _run_test(plan, test, folder, say, options, known)
            if attempt < test.retry and any(case.kind for case in cases):
                say(f"test [{test.test_name}] failed; it is tried again")
                continue
            report.cases += cases
            break
    report.seconds = time.monotonic() - begin


@contextlib.contextmanager
def _options(*, reuse_master: bool, text: bool) -> Iterator[Options]:
    """Yield the options for launching the nodes of one test, with the master they need."""
    if reuse_master:
        yield Options(screen=text)
        return
    with Master(net.default_host(), 0) as master:
        yield Options(master_uri=master.uri, screen=text)


def _run_test(
    plan: LaunchPlan,
    test: TestPlan,
    folder: Path,
    say: Say,
    options: Options,
    packages: Packages,
) -> list[Case]:
    """Run one test with all nodes; whatever goes wrong becomes a case."""
    name = f"{folder.name}.rosunit-{test.test_name}"
    results = folders.made(folder) / f"rosunit-{test.test_name}.xml"
    results.unlink(missing_ok=True)
    words = f"{test.arguments} --gtest_output=xml:{results}"
    node = replace(test, arguments=words, output="log")
    try:
        with Launch(replace(plan, tests=[]), options, say=say, packages=packages) as launch:
            launch.start()
            problem = _wait(launch, node, test)
    except Error as error:
        problem = str(error)
    if not problem and not results.is_file():
        problem = f"test [{test.test_name}] did not generate test results"
    if problem:
        return [Case(f"{name}/{test.test_name}", test.time_limit, problem, "error")]
    try:
        return read_results(results, name)
    except (ET.ParseError, OSError) as error:
        text = f"the results of test [{test.test_name}] cannot be read: {error}"
        return [Case(f"{name}/{test.test_name}", 0.0, text, "error")]


def _wait(launch: Launch, node: TestPlan, test: TestPlan) -> str:
    """Wait for the end of a test; what went wrong, or nothing."""
    process = launch.launch_node(node)
    end = time.monotonic() + test.time_limit
    while process.running:
        if time.monotonic() >= end:
            kind = f"{test.package}/{test.type}"
            return f"max time [{test.time_limit}s] allotted for test [{test.test_name}] of type [{kind}]"
        launch.poll()
        if launch.ended.is_set() and process.running:
            return f"the launch ended before test [{test.test_name}] did"
        time.sleep(_LOOK_S)
    return ""


def read_results(path: Path, name: str) -> list[Case]:
    """Read the cases in a result file of gtest's or JUnit's form.

    Raises:
        OSError: It cannot be read, or is too long.
        ParseError: It is not XML.
    """
    if path.stat().st_size > _LARGEST:
        raise OSError(f"the file is longer than {_LARGEST >> 20} MiB")
    # expat limits what entities may grow to, and tests are the user's own programs.
    root = ET.parse(path).getroot()  # noqa: S314
    cases = []
    for element in root.iter("testcase"):
        seconds = element.get("time", "0")
        case = Case(f"{name}/{element.get('name', '?')}", _number(seconds))
        for kind in ("failure", "error"):
            found = element.find(kind)
            if found is not None:
                case.kind = kind
                case.problem = (found.text or found.get("message") or "").strip() or kind
        cases.append(case)
    return cases


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        return 0.0
