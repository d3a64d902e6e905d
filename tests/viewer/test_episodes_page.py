"""`gazelle eval --view`: the episodes of an evaluation on a page, failures first."""

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")
pytest.importorskip("torch", reason="the extra 'train' is not installed")

from gazelle.cli import episodes_beside
from gazelle.cli.main import main
from gazelle.training import Actor, evaluate
from gazelle.viewer.episodes_page import EpisodesPage


@pytest.fixture
def seen(monkeypatch):
    """Return what is shown; somebody looks, and time does not pass."""
    shown = []
    wait = episodes_beside._EpisodePace.wait

    def noted(pace, left):
        if left == 1:
            pace._page._view._picture()
            view, text = pace._page._view, pace._page._panel._shown.content
            goals = view._optional["Task goals"]._marks.batched_positions
            shown.append((int(view._context.worlds[0]), text, goals[:, :2].copy()))
        wait(pace, left)

    monkeypatch.setattr(episodes_beside._EpisodePace, "wait", noted)
    monkeypatch.setattr(EpisodesPage, "watched", True)
    monkeypatch.setattr(episodes_beside.time, "sleep", lambda _: None)
    return shown


def test_episodes_are_shown_one_by_one_failures_first(seen, capsys):
    task = "TurtleBot3Stage1"
    size = 26
    ahead = np.zeros(5, np.float32)
    ahead[2] = 1.0
    actor = Actor((np.zeros((size, 5), np.float32),), (ahead,), "tanh", "categorical")
    found = evaluate(actor, task=task, episodes=4, num_envs=2, engine="planar")
    episodes_beside.show_episodes(found, 0)
    order = sorted(found.records, key=lambda record: not record.failed)
    for number, (record, (world, text, marks)) in enumerate(zip(order, seen, strict=True), 1):
        assert world == record.place.copy
        assert text.startswith(f"{number} of 4: **{record.outcome}** after {record.length} ")
        np.testing.assert_allclose(marks, [record.info["goal"]], atol=1e-5)
    assert capsys.readouterr().out.splitlines()[-1].startswith("view http://127.0.0.1:")


@pytest.mark.parametrize("other", [("--json",), ("--workers", "2")])
def test_a_view_is_of_this_process_and_not_for_programs(other, capsys):
    assert main(["eval", "RUN", "--view", *other]) == 2
    assert "leave out --json, --workers and --ray" in capsys.readouterr().err
