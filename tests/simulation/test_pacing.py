"""Real time as a file asks for it."""

import time
from dataclasses import replace

import pytest
import scenes

from gazelle.simulation import Simulation


def world(step, rate):
    made = scenes.world(scenes.ball(), step=step)
    profile = replace(made.physics[0], real_time_update_rate=rate, real_time_factor=9.0)
    return replace(made, physics=(profile,))


@pytest.mark.parametrize(
    ("step", "rate", "target"),
    [(0.001, 1000.0, 1.0), (0.004, 250.0, 1.0), (0.001, 2000.0, 2.0), (0.001, 0.0, None)],
)
def test_the_target_rate_is_update_rate_times_step(step, rate, target):
    with Simulation(world(step, rate)) as sim:
        assert sim.physics.target_rate == (None if target is None else pytest.approx(target))


def test_it_follows_changes_in_a_run_and_paces_one():
    with Simulation(world(0.001, 1000.0)) as sim:
        sim.physics.set(update_rate=4000.0)
        assert sim.physics.target_rate == pytest.approx(4.0)
        start = time.monotonic()
        sim.run(seconds=0.8, rate=sim.physics.target_rate)
        assert time.monotonic() - start >= 0.19
