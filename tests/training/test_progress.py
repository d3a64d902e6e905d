from __future__ import annotations

import io

import pytest

from gazelle.training import progress
from gazelle.training.progress import Bar, Lines, choose_progress, describe


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_terminal_gets_a_bar_and_a_pipe_gets_lines():
    assert isinstance(choose_progress(Terminal()), Bar)
    assert isinstance(choose_progress(io.StringIO()), Lines)


def test_the_bar_fits_80_columns_and_shows_success(monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    stream = Terminal()
    bar = Bar(stream)
    bar.start(0, 2_000_000)
    bar.update(1_000_000, {"success_rate": 0.97, "return": 12345.678})
    bar.update(2_100_000, {"success_rate": 0.98})
    bar.close()
    lines = stream.getvalue().replace("\r", "\n").splitlines()
    assert max(len(line) for line in lines) <= 80
    assert "success 98%" in lines[-1]
    assert lines[-1].startswith("100%")


def test_lines_come_now_and_then(monkeypatch):
    now = [100.0]
    monkeypatch.setattr(progress.time, "monotonic", lambda: now[0])
    stream = io.StringIO()
    lines = Lines(stream, seconds=10.0)
    lines.start(500, 10_000)
    for step in range(1, 31):
        now[0] += 1.0
        lines.update(500 + 100 * step, {"return": 3.0})
    assert stream.getvalue().splitlines() == [
        f"{done:,}/10,000 steps, 100 steps/s, return 3" for done in (1500, 2500, 3500)
    ]


@pytest.mark.parametrize(
    ("summary", "text"),
    [({}, ""), ({"return": 1.5}, ", return 1.5"), ({"success_rate": 0.5}, ", success 50%")],
)
def test_the_most_telling_figure_is_shown(summary, text):
    assert describe(summary) == text
