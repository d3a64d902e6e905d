from __future__ import annotations

import pytest

from gazelle.cli import showing
from gazelle.training import Evaluation, SuccessRate


def test_tables_wrap_their_last_column_and_break_no_path():
    path = "/a" * 60
    text = showing.table([("NAME", "WHAT"), ("x", "word " * 40), ("longer", path)])
    lines = text.splitlines()
    assert lines[0] == "NAME    WHAT"
    assert all(len(line) <= 80 for line in lines if path not in line)
    assert any(path in line for line in lines)


def test_the_text_of_a_long_name_is_below_it():
    text = showing.table([("NAME", "WHAT"), ("n" * 31, "word " * 15), ("short", "text")])
    assert text.splitlines() == [
        f"{'NAME':<32}WHAT",
        "n" * 31,
        " " * 32 + " ".join(["word"] * 9),
        " " * 32 + " ".join(["word"] * 6),
        f"{'short':<32}text",
    ]


@pytest.mark.parametrize(
    ("seconds", "text"), [(45, "45.0 s"), (750, "12.5 min"), (100_000, "27.8 h")]
)
def test_durations_are_in_a_fitting_unit(seconds, text):
    assert showing.duration(seconds) == text


def test_rates_come_with_their_interval():
    text = showing.rate(SuccessRate(97, 100))
    assert "97.0 %" in text
    assert "91.5 % to 99.0 %" in text
    assert "(97 of 100)" in text


def test_evaluation_fits_80_columns():
    result = Evaluation(
        "gazelle/T-v0", 10_000, 9_000, 1, SuccessRate(9_900, 10_000), None, SuccessRate(100, 10_000), SuccessRate(0, 10_000),
        -123456.789, 499.9, 1234.5, 1e7,
    )  # fmt: skip
    text = showing.evaluation(result)
    assert max(len(line) for line in text.splitlines()) <= 80
    assert "not reported by this task" in text
    assert f"RTF {1e7 / 1234.5:,.0f}" in text


def test_the_program_is_named_as_the_shell_would_find_it(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("sys.argv", [str(tmp_path / ".venv" / "bin" / "gazelle")])
    monkeypatch.setenv("PATH", "")
    assert showing.program() == ".venv/bin/gazelle"
    monkeypatch.setattr("sys.argv", ["pytest"])
    assert showing.program() == "gazelle"
