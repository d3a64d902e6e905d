"""The real-time factor on the page is the mean of what was reached, also where a simulation stands between."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

from gazelle.viewer.page import pace_meter, run_controls
from gazelle.viewer.page.pace_meter import PaceMeter
from gazelle.viewer.page.run_controls import ClockState, RunControls

PICTURE_S = 0.05


@pytest.fixture
def wall(monkeypatch):
    """Return a clock that a test advances."""
    clock = SimpleNamespace(now=1000.0)
    monkeypatch.setattr(pace_meter, "time", SimpleNamespace(monotonic=lambda: clock.now))
    return clock


def cycles(wall, meter, *, stepping, standing, speed, count, reset_every=None):
    """Yield the factor at each picture of cycles of stepping and standing."""
    simulated = 0.0
    for _ in range(count):
        for seconds, gain in ((stepping, speed), (standing, 0.0)):
            for _ in range(round(seconds / PICTURE_S)):
                wall.now += PICTURE_S
                simulated += gain * PICTURE_S
                if reset_every and simulated > reset_every:
                    simulated = 0.0
                yield meter.factor(simulated)


@pytest.mark.parametrize(
    ("stepping", "standing"), [(0.2, 1.5), (0.5, 3.0), (1.0, 10.0), (0.1, 0.1)]
)
def test_a_training_that_learns_between_shows_its_mean(wall, stepping, standing):
    found = list(
        cycles(wall, PaceMeter(), stepping=stepping, standing=standing, speed=200.0, count=40)
    )
    mean = 200.0 * stepping / (stepping + standing)
    second_half = found[len(found) // 2 :]
    assert min(second_half) > 0.5 * mean
    assert sum(second_half) / len(second_half) == pytest.approx(mean, rel=0.5)


@pytest.mark.parametrize("speed", [0.01, 1.0, 500.0])
def test_a_steady_run_shows_its_factor_at_once(wall, speed):
    found = list(cycles(wall, PaceMeter(), stepping=5.0, standing=0.0, speed=speed, count=1))
    assert found[0] is None
    assert found[1:] == pytest.approx([speed] * (len(found) - 1))


def test_a_change_is_seen_within_a_second(wall):
    meter = PaceMeter()
    list(cycles(wall, meter, stepping=5.0, standing=0.0, speed=1.0, count=1))
    meter.factor(0.0)
    found = list(cycles(wall, meter, stepping=1.1, standing=0.0, speed=4.0, count=1))
    assert found[-1] == pytest.approx(4.0)


def test_resets_do_not_count(wall):
    options = {"stepping": 1.0, "standing": 0.0, "speed": 10.0, "count": 10}
    found = list(cycles(wall, PaceMeter(), **options, reset_every=3.0))
    assert min(each for each in found if each is not None) > 8.0


def test_long_steps_of_a_slow_run_are_averaged(wall):
    meter, found = PaceMeter(), []
    for picture in range(2000):
        wall.now += PICTURE_S
        found.append(meter.factor(0.1 * (picture // 20)))  # 0.1 s once a second
    assert found[-1] == pytest.approx(0.1, rel=0.1)


def test_nothing_is_said_of_what_never_advanced(wall):
    meter = PaceMeter()
    for _ in range(100):
        wall.now += PICTURE_S
        assert meter.factor(7.0) is None


def page_text(states, wall):
    """Return what the page says after some states, a picture apart."""
    gui = SimpleNamespace(add_markdown=lambda _text: SimpleNamespace(content=""))
    simulation = SimpleNamespace(physics=SimpleNamespace(time_step=0.2))
    context = SimpleNamespace(gui=gui, guarded=None, read_only=True, simulation=simulation)
    controls = RunControls(context)
    for state in states:
        wall.now += PICTURE_S
        controls.show(state)
    return controls._status.content


def running(*times, paused=False):
    return [ClockState(each, paused, None) for each in times]


@pytest.mark.parametrize(
    ("states", "text"),
    [
        (running(1.0), "not stepping"),
        (running(1.0, 7.0), "factor 120"),
        (running(0.0, 7.0, *[7.0] * 50), "factor 2.75"),
        (running(1.0, 1.05), "factor 1.00"),
        (running(1.0, 1.000001), "factor 0.0000200"),
        (running(1.0, 7.0) + running(7.0, paused=True), "paused"),
        (running(1.0, 7.0) + running(7.0, paused=True) + running(7.05), "factor 1.00"),
    ],
)
def test_the_page_says_so(states, text, wall):
    assert page_text(states, wall).endswith(text)


def test_another_speed_begins_a_new_mean(wall):
    states = [ClockState(0.05 * step, False, 1.0) for step in range(10)]
    states += [ClockState(0.5 + 0.5 * step, False, 10.0) for step in range(3)]
    assert page_text(states, wall).endswith("factor 10.0")
    assert run_controls._name(None) == "max"
