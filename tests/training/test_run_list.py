"""Lists of training runs."""

import pytest

from gazelle.cli.main import main
from gazelle.errors import FormatError
from gazelle.training import Recipe, Run, RunConfig, list_runs, run_list

HEAD = "time/steps,time/seconds,episodes/return,episodes/success_rate\n"


def make_run(out, *rows, task="x/Corridor-v0", steps=3000):
    run = Run.create(RunConfig(task=task, recipe=Recipe(steps=steps), seed=3), out)
    if rows:
        (run.folder / "progress.csv").write_text(HEAD + "".join(f"{row}\n" for row in rows))
    return run


def test_the_last_row_counts(tmp_path):
    run = make_run(tmp_path, "1000,1.5,2.5,0.25", "3000,4.5,-7,0.75")
    (found,) = list_runs(tmp_path)
    assert found.run == run
    assert (found.steps, found.seconds, found.success, found.mean_return) == (3000, 4.5, 0.75, -7.0)
    assert found.finished
    assert not found.resumable


def test_a_link_to_what_is_gone_is_no_run(tmp_path):
    run = make_run(tmp_path)
    (tmp_path / "config.json").symlink_to(tmp_path / "gone")
    assert [each.run for each in list_runs(tmp_path)] == [run]


def test_a_run_that_just_began_and_one_without_successes(tmp_path):
    make_run(tmp_path)
    make_run(tmp_path, "1000,1.5,2.5,")
    began, other = list_runs(tmp_path)
    assert (began.steps, began.success, began.mean_return) == (0, None, None)
    assert not began.finished
    assert (other.steps, other.success) == (1000, None)


def test_a_checkpoint_can_be_resumed(tmp_path):
    run = make_run(tmp_path, "1000,1.5,2.5,0.25")
    run.add_checkpoint(1000, lambda folder: (folder / "policy.npz").write_bytes(b"x"))
    assert list_runs(tmp_path)[0].resumable


def test_runs_below_are_found_and_others_left_out(tmp_path):
    run = make_run(tmp_path / "study" / "runs", "3000,4.5,7,0.75")
    for name, text in (("other", "{}"), ("damaged", '{"format": "gazelle-run-1"'), ("list", "[]")):
        (tmp_path / name).mkdir()
        (tmp_path / name / "config.json").write_text(text)
    damaged = make_run(tmp_path, "no number,1,1,1")
    assert damaged.folder.exists()
    assert [each.run for each in list_runs(tmp_path)] == [run]


def test_a_folder_with_too_many_files_is_an_error(tmp_path, monkeypatch):
    run = make_run(tmp_path, "1000,1.5,2.5,0.25")
    for steps in range(1000, 9000, 1000):  # what is in a run does not count
        run.add_checkpoint(steps, lambda folder: (folder / "policy.npz").write_bytes(b"x"))
    monkeypatch.setattr(run_list, "MAX_ENTRIES", 8)
    assert [each.run for each in list_runs(tmp_path)] == [run]
    for number in range(8):
        (tmp_path / str(number)).mkdir()
    with pytest.raises(FormatError, match="more than 8 files and folders"):
        list_runs(tmp_path)


def test_a_missing_folder(tmp_path):
    with pytest.raises(FormatError, match="no such folder"):
        list_runs(tmp_path / "runs")


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["runs"]) == 1
    assert "gazelle train TASK" in capsys.readouterr().err
    (tmp_path / "runs").mkdir()
    assert main(["runs"]) == 0
    assert "there are no runs" in capsys.readouterr().out
    run = make_run(tmp_path / "runs", "1500000,75.4,-7,0.754", steps=2_000_000)
    assert main(["runs"]) == 0
    line = capsys.readouterr().out.splitlines()[1]
    assert line.split("  ")[0] == run.folder.name
    assert line.split() == [
        run.folder.name,
        *("3", "1.5M", "of", "2.0M", "75.4", "%", "-7", "75", "s"),
    ]
    assert main(["runs", "runs"]) == 0
    assert run.folder.name in capsys.readouterr().out
    run.folder.rename(tmp_path / "runs" / "mine")
    assert main(["runs"]) == 0
    assert "\nmine (Corridor, ppo)  3 " in capsys.readouterr().out
