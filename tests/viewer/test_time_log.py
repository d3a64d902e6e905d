"""A log of the page takes a simulation back and forth; the speed is plotted."""

import time

import numpy as np
import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from gazelle.simulation import Replay, Simulation
from gazelle.viewer import LiveView
from gazelle.viewer.page import time_log
from tests.ros.graph import until
from tests.viewer.browser import opened
from tests.viewer.lamp_world import LAMP_WORLD


@pytest.fixture
def falling(tmp_path):
    """Return a simulation in which a box falls."""
    file = tmp_path / "room.world"
    file.write_text(LAMP_WORLD)
    with Simulation(file, threads=1) as simulation:
        simulation.robots["box"].set_pose((0.0, 0.0, 3.0))
        yield simulation


def layer(view, name):
    return next(each for each in view._layers if type(each).__name__ == name)


def logged(simulation, view, count, monkeypatch):
    """Run and log so many states, 0.05 s apart; returns the log, and hashes by time."""
    monkeypatch.setattr(time_log, "_PERIOD", 0.0)
    monkeypatch.setattr(time_log, "_SHARE", np.inf)
    log, hashes = layer(view, "TimeLog"), {}
    log._on.value = True
    for _ in range(count):
        simulation.run(0.05)
        log.show(log.read())
        hashes[simulation.time] = simulation.state_hash()
    return log, hashes


def seek(log, moment):
    log._seek(moment)
    log.show(log.read())


def test_a_state_comes_back_to_the_bit_and_goes_on_the_same(falling, monkeypatch):
    with LiveView(falling) as view:
        log, hashes = logged(falling, view, 8, monkeypatch)
        times = list(hashes)
        for which in (3, 0, 7, 2):
            seek(log, times[which])
            assert falling.time == times[which]
            assert falling.paused
            assert falling.state_hash() == hashes[times[which]]
        falling.unpause()
        for moment in times[3:]:
            falling.run(0.05)
            assert falling.time == pytest.approx(moment)
            assert falling.state_hash() == hashes[times[times.index(moment)]]
        log.read()
        assert log._times[-1] == falling.time  # what came after the state is not to come


def test_the_present_is_kept_before_the_past_comes(falling, monkeypatch):
    with LiveView(falling) as view:
        log, hashes = logged(falling, view, 3, monkeypatch)
        falling.run(0.01)
        now = falling.time, falling.state_hash()
        seek(log, next(iter(hashes)))
        seek(log, now[0])
        assert (falling.time, falling.state_hash()) == now


def test_of_many_states_every_other_one_is_left_out(falling, monkeypatch):
    monkeypatch.setattr(time_log, "_MOST", 5)
    with LiveView(falling) as view:
        log, hashes = logged(falling, view, 12, monkeypatch)
        assert 2 < len(log._times) <= 5
        assert log._times[0] == min(hashes)
        assert set(log._times) <= set(hashes)


def test_other_models_and_a_reset_begin_a_new_log(falling, monkeypatch):
    with LiveView(falling) as view:
        log, _ = logged(falling, view, 3, monkeypatch)
        falling.reset()
        log.read()
        assert log._times == [falling.time]
        falling.delete("lamp")
        view._picture()
        assert len(log._times) <= 1


def test_a_recording_is_gone_through_by_the_slider(falling, tmp_path):
    file, hashes = tmp_path / "run.jsonl", {}
    with falling.record(file):
        for _ in range(6):
            falling.run(0.05)
            hashes[falling.time] = falling.state_hash()
    with Replay(file, threads=1) as replay, LiveView(replay.simulation) as view:
        view.show_recording(replay)
        log, again = layer(view, "TimeLog"), replay.simulation
        assert again.paused
        assert (again.time, again.state_hash()) == (falling.time, falling.state_hash())
        for moment in (0.1, 0.3, 0.05):
            seek(log, moment)
            assert again.time == pytest.approx(moment)
            assert again.state_hash() == hashes[again.time]


@pytest.mark.long
def test_a_user_goes_back_in_time_and_sees_the_speed(falling):
    with LiveView(falling) as view, opened(view.url, (1300, 700)) as page:
        page.get_by_role("tab", name="Log").click()
        page.get_by_label("Keep a log").click()
        log = layer(view, "TimeLog")

        def runs():
            falling.run(0.05)
            time.sleep(0.02)
            return len(log._times) >= 6

        until(runs)
        first, last = log._times[0], falling.time
        height = falling.robots["box"].pose.z
        slider = page.get_by_role("slider", name="Time").or_(page.get_by_role("slider")).first
        slider.focus()
        slider.press("Home")
        until(lambda: falling.paused and falling.time == pytest.approx(first, abs=2e-3))
        assert falling.robots["box"].pose.z > height
        page.get_by_role("button", name="Play the log").click()
        until(lambda: falling.time >= last and not log._playing)
        page.get_by_role("tab", name="Speed").click()
        falling.unpause()

        def plotted():
            falling.run(0.05)
            return page.locator(".u-over").count() == 2

        until(plotted)
        factor, cost = (layer(view, "SpeedPlots")._points[-1][k] for k in (1, 2))
        assert factor > 0.0
        assert 0.0 < cost < 1000.0
