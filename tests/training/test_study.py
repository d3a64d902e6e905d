"""Many calls of one function in one table."""

from __future__ import annotations

import csv

import pytest

from gazelle.cli.main import main
from gazelle.errors import FormatError, TaskError
from gazelle.training import Study, conduct

FUNCTION = """
import os, pathlib, signal

def square(*, seed, factor=1.0, fatal=-1):
    if seed == fatal:
        mark = pathlib.Path(__file__).with_name(f"died{seed}")
        if not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    if factor == 0:
        raise ValueError("nothing to do")
    return {"result": factor * seed**2} | ({"even": True} if seed % 2 == 0 else {})

def listed(*, seed):
    return {"result": [1, 2]}
"""


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "experiment.py"
    path.write_text(FUNCTION)
    return path


def table(path):
    with path.open(newline="") as lines:
        return list(csv.DictReader(lines))


def results(rows):
    return {(float(row["factor"]), int(row["seed"])): float(row["result"]) for row in rows}


@pytest.mark.long
def test_all_combinations_are_in_the_table(file, tmp_path):
    study = Study(function=f"{file}:square", vary={"factor": [1.0, 2.5]}, seeds=3)
    told = []
    done = conduct(study, tmp_path / "t.csv", workers=2, on_row=lambda *said: told.append(said))
    wanted = {(f, s): f * s**2 for f in (1.0, 2.5) for s in range(3)}
    assert results(table(tmp_path / "t.csv")) == wanted == results(done.rows)
    assert (done.new, done.failed) == (6, 0)
    assert told[-1] == (6, 6)


@pytest.mark.long
def test_a_study_that_was_cut_short_goes_on(file, tmp_path):
    out = tmp_path / "t.csv"
    study = Study(function=f"{file}:square", vary={"factor": [1.0]}, seeds=4)
    conduct(study, out, workers=1)
    lines = out.read_text().splitlines()
    out.write_text("\n".join(lines[:3]) + "\n" + lines[3][:3])
    again = conduct(study, out, workers=1)
    assert again.new == 2
    assert results(table(out)) == {(1.0, seed): seed**2 for seed in range(4)}
    assert conduct(study, out, workers=1).new == 0


@pytest.mark.long
def test_a_worker_that_is_killed_is_replaced(file, tmp_path):
    study = Study(function=f"{file}:square", vary={"factor": [1.0], "fatal": [1]}, seeds=3)
    done = conduct(study, tmp_path / "t.csv", workers=1)
    assert results(done.rows) == {(1.0, seed): seed**2 for seed in range(3)}


def test_errors_are_rows_and_the_exit_code_says_so(file, tmp_path, capfd, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ["study", "experiment.py:square", "--vary", "factor=0,1", "--seeds", "2"]
    assert main([*words, "--workers", "1"]) == 1
    rows = table(tmp_path / "study.csv")
    assert [row["error"] for row in rows] == ["ValueError: nothing to do"] * 2 + [""] * 2
    told = capfd.readouterr()
    assert "study.csv: 4 rows, 4 of them new" in told.out
    assert "2 calls failed" in told.err


def test_what_no_table_takes_is_an_error_of_the_row(file, tmp_path):
    done = conduct(Study(function=f"{file}:listed"), tmp_path / "t.csv", workers=1)
    assert "a table takes numbers and text" in done.rows[0]["error"]


@pytest.mark.parametrize(
    ("function", "said"),
    [("{}:sqare", "has no function 'sqare'"), ("{}", "does not name a function")],
)
def test_functions_that_are_not_there(file, tmp_path, function, said):
    with pytest.raises(TaskError, match=said) as caught:
        conduct(Study(function=function.format(file)), tmp_path / "t.csv")
    assert "square" in caught.value.hint or "FUNCTION" in caught.value.hint


def test_a_table_of_another_study_is_refused(file, tmp_path):
    (tmp_path / "t.csv").write_text("a,b\n1,2\n")
    with pytest.raises(FormatError, match="no column 'seed'"):
        conduct(Study(function=f"{file}:square"), tmp_path / "t.csv")


@pytest.mark.parametrize("values", [{"seed": [1]}, {"factor": []}])
def test_what_cannot_be_varied(values):
    with pytest.raises(TaskError, match="cannot vary"):
        Study(function="a:b", vary=values)
