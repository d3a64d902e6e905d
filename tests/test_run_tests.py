"""The test runner reports files left behind, and skips where none are allowed."""

from __future__ import annotations

import importlib.util
import json
from pathlib import Path

import pytest
import run_tests


def skipped():
    """Return the program of CI that lists skipped tests."""
    path = Path(__file__).parents[1] / ".ci" / "skipped.py"
    spec = importlib.util.spec_from_file_location("skipped", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def ended(monkeypatch, names, status):
    """Run tests that leave files in their temporary folder; return the result and the folder."""
    folders = []

    def run(_, folder):
        folders.append(Path(folder))
        for name in names:
            (Path(folder) / name).mkdir()
        return status

    monkeypatch.setattr(run_tests, "run", run)
    return run_tests.main([]), *folders


@pytest.mark.parametrize("status", [0, 1, 2])
@pytest.mark.parametrize("names", [["SB3-2026"], ["pytest-of-me", "pymp-1", "r2"]])
def test_what_tests_leave_fails_the_run(monkeypatch, tmp_path, capsys, names, status):
    monkeypatch.setattr(run_tests.tempfile, "mkdtemp", lambda prefix: str(tmp_path))
    found, folder = ended(monkeypatch, names, status)
    assert found == (status or 1)
    assert folder.exists(), "to look into"
    said = capsys.readouterr().out
    assert all((name in said) == (name != "pytest-of-me") for name in names)


@pytest.mark.parametrize("names", [[], ["pytest-of-me"]])
def test_the_folder_goes_with_a_run_that_passed(monkeypatch, names):
    found, folder = ended(monkeypatch, names, 0)
    assert found == 0
    assert not folder.exists()


REASONS = {
    "t.py::a": "no checkout of navigation is at hand (set GAZELLE_ROBOTS)",
    "t.py::b": "the corpus of public robot files is not here (set GAZELLE_CORPUS)",
    "t.py::c[x y]": "there is no zsh",
}


@pytest.mark.parametrize(
    ("allowed", "left"),
    [
        ("", set(REASONS)),
        ("# there is no zsh\n", set(REASONS)),
        ("no checkout of\n\nthere is no zsh\n", {"t.py::b"}),
        ("no checkout of\nthe corpus\nthere\n", set()),
    ],
)
def test_a_test_that_is_skipped_again_fails(monkeypatch, tmp_path, capsys, allowed, left):
    program = skipped()
    (tmp_path / "last").write_text(json.dumps(REASONS))
    (tmp_path / "reasons").write_text(allowed)
    monkeypatch.setattr(program, "LAST", tmp_path / "last")
    assert program.main(["--but-for", str(tmp_path / "reasons")]) == bool(left)
    said = capsys.readouterr().out
    assert {name for name in REASONS if f"{name}: {REASONS[name]}" in said} == left


def test_the_names_of_what_was_skipped_are_printed_a_line_each(tmp_path, capsys):
    (tmp_path / "cache").write_text(json.dumps(REASONS))
    assert skipped().main([str(tmp_path / "cache")]) == 0
    assert capsys.readouterr().out.splitlines() == list(REASONS)
