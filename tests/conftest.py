"""Fixtures that every room's tests share.

What a test compares with may be missing: the corpus of public robot files, a Debian program.
Then the test is skipped with one line that says so. What was skipped, and why, is kept in pytest's
cache: `.ci/run` runs just that once the rest is installed, and fails where one is skipped again.
"""

import gc
import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import settings

# Shells start background jobs with Ctrl-C ignored, nohup with SIGHUP, and programs inherit that.
if signal.getsignal(signal.SIGINT) is signal.SIG_IGN:
    signal.signal(signal.SIGINT, signal.default_int_handler)
if hasattr(signal, "SIGHUP") and signal.getsignal(signal.SIGHUP) is signal.SIG_IGN:
    signal.signal(signal.SIGHUP, signal.SIG_DFL)

# ONNX Runtime reports its use to its makers, and leaves files, where this is not set before its import.
os.environ.setdefault("ORT_DISABLE_TELEMETRY", "1")

# Ten thousand tests and the libraries that they import are millions of objects, and none of them is
# garbage. Looking for some among them took a third of the time in which the tests are collected, in
# every process, and half a second in each full search after that.
gc.disable()


def pytest_collection_finish() -> None:
    """Freeze present objects, so that later garbage collections skip them."""
    gc.collect()
    gc.freeze()
    gc.enable()


# A machine busy with other things must not fail a test by its speed. The quick tests draw the same
# examples every time, so that what passed here passes there; "make test-slow" draws fresh ones.
settings.register_profile("repeatable", deadline=None, derandomize=True)
settings.register_profile("fresh", deadline=None, derandomize=False)  # also where CI is set
settings.load_profile(os.environ.get("GAZELLE_EXAMPLES", "repeatable"))


@pytest.fixture(scope="session", autouse=True)
def _folders_of_others(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Yield after setting the folders of Stable-Baselines3, PyTorch and ROS to temporary ones."""
    with pytest.MonkeyPatch.context() as patch:
        for name in ("SB3_LOGDIR", "TORCHINDUCTOR_CACHE_DIR", "ROS_HOME"):
            patch.setenv(name, str(tmp_path_factory.mktemp(name)))
        yield


_skipped: dict[str, str] = {}


def pytest_runtest_logreport(report: pytest.TestReport) -> None:
    """Record which tests were skipped."""
    if report.skipped and not hasattr(report, "wasxfail"):
        _note_skipped(report)


def pytest_collectreport(report: pytest.CollectReport) -> None:
    """Record which whole files were skipped."""
    if report.skipped:
        _note_skipped(report)


def _note_skipped(report: pytest.TestReport | pytest.CollectReport) -> None:
    """Record the reason, which pytest puts behind the place and the word `Skipped`."""
    _skipped[report.nodeid] = str(report.longrepr[-1]).removeprefix("Skipped: ")


def pytest_sessionfinish(session: pytest.Session) -> None:
    """Store the skipped tests in pytest's cache."""
    if hasattr(session.config, "workerinput"):
        return  # one of several processes: the first hears of all
    if session.config.getoption("lf", default=False):
        return  # what failed before, run again: the run before has skipped the others
    cache = getattr(session.config, "cache", None)  # with -p no:cacheprovider there is none
    if cache is not None:
        cache.set("gazelle/skipped", _skipped)


@pytest.fixture(scope="session")
def corpus() -> Path:
    """Return the folder of public robot files; skip the test without it."""
    beside = Path(__file__).parents[2] / "shared" / "corpus"
    folder = Path(os.environ.get("GAZELLE_CORPUS", beside))
    if not folder.is_dir():
        pytest.skip("the corpus of public robot files is not here (set GAZELLE_CORPUS)")
    return folder
