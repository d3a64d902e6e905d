"""Runs unit tests as rosunit does: results go to the file that ``--gtest_output`` names."""

from __future__ import annotations

import sys
import time
import unittest
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

_OUTPUT = XML_OUTPUT_FLAG = "--gtest_output=xml:"
_NO_NAMES = str.maketrans(dict.fromkeys(" \"'&$!`/\\", "_"))
"""Replacement of characters that are not written in names of files."""


def unitrun(
    package: str,
    test_name: str,
    test: Any,
    sysargs: Sequence[str] | None = None,
    coverage_packages: Any = None,
) -> None:
    """Run tests, write the results, and end the process with 1 if any failed.

    Args:
        package: Package of the tests.
        test_name: Their name.
        test: A class of tests, or ``module.Class``.
        sysargs: The command line, by default this process's.
        coverage_packages: Accepted, and not needed.
    """
    del coverage_packages
    if not _run(f"{package}.{test_name}", test, sys.argv if sysargs is None else sysargs):
        sys.exit(1)


rosrun = unitrun


def _run(name: str, test: Any, arguments: Sequence[str]) -> bool:
    loader = unittest.TestLoader()
    named = isinstance(test, str)
    suite = loader.loadTestsFromName(test) if named else loader.loadTestsFromTestCase(test)
    begin = time.monotonic()
    result = _Result(sys.stderr)
    suite.run(result)
    path = next((a[len(_OUTPUT) :] for a in arguments if a.startswith(_OUTPUT)), None)
    if path:
        _write(Path(path), name, result, time.monotonic() - begin)
    sys.stdout.write(
        f"\n-------------------------------------------------------------\nSUMMARY:\n"
        f" * RESULT: {'SUCCESS' if result.wasSuccessful() else 'FAIL'}\n"
        f" * TESTS: {result.testsRun}\n * ERRORS: {len(result.errors)} []\n"
        f" * FAILURES: {len(result.failures)} []\n\n"
    )
    return result.wasSuccessful()


class _Result(unittest.TestResult):
    """Remembers what went well, too, and says how each test went."""

    def __init__(self, stream: Any) -> None:
        super().__init__()
        self._stream = stream
        self.passed: list[unittest.TestCase] = []

    def addSuccess(self, test: unittest.TestCase) -> None:  # noqa: N802  # unittest's name
        super().addSuccess(test)
        self.passed.append(test)
        self._stream.write(f"{test} ... ok\n")

    def addError(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        super().addError(test, err)
        self._stream.write(f"{test} ... ERROR\n{self.errors[-1][1]}\n")

    def addFailure(self, test: unittest.TestCase, err: Any) -> None:  # noqa: N802
        super().addFailure(test, err)
        self._stream.write(f"{test} ... FAIL\n{self.failures[-1][1]}\n")


def _write(path: Path, name: str, result: _Result, seconds: float) -> None:
    """Write the results in JUnit's form."""
    root = ET.Element(
        "testsuite",
        name=name,
        tests=str(result.testsRun),
        errors=str(len(result.errors)),
        failures=str(len(result.failures)),
        time=f"{seconds:.3f}",
    )
    for test in result.passed:
        _case(root, test)
    for tag, group in (("error", result.errors), ("failure", result.failures)):
        for test, text in group:
            ET.SubElement(_case(root, test), tag, type="").text = text
    path.parent.mkdir(parents=True, exist_ok=True)
    ET.ElementTree(root).write(path, encoding="utf-8", xml_declaration=True)


def _case(root: ET.Element, test: unittest.TestCase) -> ET.Element:
    class_name, _, name = test.id().rpartition(".")
    return ET.SubElement(root, "testcase", classname=class_name, name=name, time="0")


def xml_results_file(
    test_pkg: str,
    test_name: str,
    is_rostest: bool = False,  # noqa: FBT001, FBT002  # rosunit's interface
    env: Mapping[str, str] | None = None,
) -> str:
    """Return the file for the results of a test; its folder is created if need be."""
    from gazelle_ros.compat.rospkg import get_test_results_dir

    folder = Path(get_test_results_dir(env)) / test_pkg
    folder.mkdir(parents=True, exist_ok=True)
    kind = "rostest" if is_rostest else "rosunit"
    return str(folder / f"{kind}-{test_name.translate(_NO_NAMES)}.xml")


def rostest_name_from_path(pkg_dir: str, test_file: str) -> str:
    """Return the name of a test file in results: its path in the package, joined with ``_``."""
    path = Path(test_file).absolute()
    inside = path.relative_to(pkg_dir) if path.is_relative_to(pkg_dir) else Path(test_file)
    return "_".join(part for part in inside.with_suffix("").parts if part != "/")
