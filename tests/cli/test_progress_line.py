"""Progress of long work on standard error."""

import io
import time

import pytest

from gazelle.cli import progress_line
from gazelle.cli.progress_line import ProgressLine


class Screen(io.StringIO):
    def isatty(self):
        return True


@pytest.fixture
def clock(monkeypatch):
    """Return a list whose number is the time [s]."""
    now = [100.0]
    monkeypatch.setattr(progress_line.time, "monotonic", lambda: now[0])
    return now


def work(clock, seconds, items=5):
    for item in ProgressLine("filming", items, "pictures").count(range(items)):
        clock[0] += seconds
        yield item


@pytest.mark.parametrize("live", [True, False])
def test_short_work_shows_nothing(monkeypatch, clock, live):
    shown = Screen() if live else io.StringIO()
    monkeypatch.setattr("sys.stderr", shown)
    assert list(work(clock, 0.3)) == [0, 1, 2, 3, 4]
    assert shown.getvalue() == ""


def test_long_work_is_counted_in_one_line_of_a_terminal_that_goes_at_the_end(monkeypatch, clock):
    shown = Screen()
    monkeypatch.setattr("sys.stderr", shown)
    list(work(clock, 1.0))
    lines = [line.strip() for line in shown.getvalue().split("\r")]
    assert lines == ["", *(f"filming: {n} of 5 pictures" for n in (2, 3, 4, 5)), "", ""]


def test_a_log_gets_a_line_now_and_then(monkeypatch, clock):
    shown = io.StringIO()
    monkeypatch.setattr("sys.stderr", shown)
    list(work(clock, 4.0, 6))
    assert shown.getvalue() == "filming: 1 of 6 pictures\nfilming: 4 of 6 pictures\n"


def test_only_long_work_is_announced(monkeypatch, capsys):
    with progress_line.announced("loading a.urdf"):
        pass
    assert capsys.readouterr().err == ""
    monkeypatch.setattr(progress_line, "_ANNOUNCED", 0.0)
    with progress_line.announced("loading b.urdf"):
        time.sleep(0.5)
    assert capsys.readouterr().err == "gazelle: loading b.urdf\n"
