"""`gazelle eval --view`: the episodes of an evaluation on a page, failures first."""

import threading
from contextlib import suppress
from types import SimpleNamespace

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")
pytest.importorskip("torch", reason="the extra 'train' is not installed")

from gazelle.cli import episode_replay
from gazelle.cli.main import main
from gazelle.training import Actor, evaluate
from gazelle.viewer.episodes_page import EpisodesPage
from tests.ros.graph import until
from tests.viewer.browser import opened


@pytest.fixture
def seen(monkeypatch):
    """Return what is shown; somebody looks, and time does not pass."""
    shown = []
    wait = episode_replay._EpisodePace.wait

    def noted(pace, left):
        if left == 1:
            pace._page._view._picture()
            view, text = pace._page._view, pace._page.episodes._shown.content
            goals = view._optional["Task goals"]._marks.batched_positions
            shown.append((int(view._context.worlds[0]), text, goals[:, :2].copy()))
        wait(pace, left)

    monkeypatch.setattr(episode_replay._EpisodePace, "wait", noted)
    monkeypatch.setattr(EpisodesPage, "watched", True)
    monkeypatch.setattr(  # nobody is to be waited for after the last
        episode_replay._EpisodePace,
        "following",
        lambda _, number, count: number + 1 if number + 1 < count else None,
    )
    monkeypatch.setattr(episode_replay.time, "sleep", lambda _: None)
    return shown


def failing(episodes, copies):
    """Return the evaluation of a policy that drives straight on."""
    ahead = np.zeros(5, np.float32)
    ahead[2] = 1.0
    actor = Actor((np.zeros((26, 5), np.float32),), (ahead,), "tanh", "categorical")
    return evaluate(
        actor, task="TurtleBot3Stage1", episodes=episodes, num_envs=copies, engine="planar"
    )


def test_episodes_are_shown_one_by_one_failures_first(seen, capsys):
    found = failing(4, 2)
    episode_replay.show_episodes(found, 0)
    order = sorted(found.records, key=lambda record: not record.failed)
    for number, (record, (world, text, marks)) in enumerate(zip(order, seen, strict=True), 1):
        assert world == record.place.copy
        assert text.startswith(f"{number} of 4: **{record.outcome}** after {record.length} ")
        np.testing.assert_allclose(marks, [record.info["goal"]], atol=1e-5)
    assert capsys.readouterr().out.splitlines()[-1].startswith("view http://127.0.0.1:")


@pytest.mark.parametrize("other", [("--json",), ("--workers", "2")])
def test_a_view_is_of_this_process_and_not_for_programs(other, capsys):
    assert main(["eval", "RUN", "--view", *other]) == 2
    assert "cannot be used with --json, --workers or --ray" in capsys.readouterr().err


@pytest.mark.parametrize("chosen", [None, 2])
def test_a_reload_after_the_last_episode_ends_nothing(monkeypatch, chosen):
    monkeypatch.setattr(episode_replay, "_GONE", 0.3)
    moments = iter([(False, None), (chosen is not None, chosen)])  # watched, and what is chosen

    def take_choice():
        page.watched, chosen = next(moments, (False, None))
        return chosen

    page = SimpleNamespace(episodes=SimpleNamespace(take_choice=take_choice))
    assert episode_replay._EpisodePace(page, 0.1).following(2, 3) == chosen


@pytest.mark.long
def test_a_policy_is_watched_as_it_fails(capsys, monkeypatch):
    found = failing(3, 1)
    said = []

    def play():
        with suppress(InterruptedError):
            episode_replay.show_episodes(found, 0)

    thread = threading.Thread(target=play, daemon=True)
    thread.start()

    def told():
        said.append(capsys.readouterr().out)
        return "view http" in "".join(said)

    until(told)
    url = "".join(said).split()[-1]
    with opened(url, (900, 480)) as page:
        page.get_by_text("1 of 3: collision after").wait_for()
        page.get_by_role("button", name="next", exact=True).click()
        page.get_by_text("2 of 3: collision after").wait_for()
        page.get_by_role("combobox", name="Episode").click()
        page.get_by_role("option", name="3: collision").click()
        page.get_by_text("3 of 3: collision after").wait_for()
        page.get_by_role("button", name="previous", exact=True).click()
        page.get_by_text("2 of 3: collision after").wait_for()

    def interrupt(_page):
        raise InterruptedError

    monkeypatch.setattr(EpisodesPage, "watched", property(interrupt))
    thread.join()
