"""Pausing and slowing of runs from the shell by other programs."""

import argparse
import threading

import pytest

from gazelle.cli.run import go
from gazelle.simulation import Simulation
from tests.ros.graph import until


def test_a_run_is_paused_goes_on_and_changes_its_pace():
    with Simulation("empty", threads=1) as sim:
        args = argparse.Namespace(seconds=3.0, rate=1.0, paused=True)
        runner = threading.Thread(target=go, args=(sim, args))
        runner.start()
        until(lambda: sim.paused)
        sim.step(5)
        assert sim.time == pytest.approx(0.005)
        sim.unpause()
        until(lambda: sim.time > 0.1)
        sim.pause()
        stood = sim.time
        sim.step(3)
        assert sim.time == pytest.approx(stood + 0.003)
        sim.physics.update_rate = 0.0
        sim.unpause()
        until(lambda: not runner.is_alive())
        assert sim.time == pytest.approx(3.0)
