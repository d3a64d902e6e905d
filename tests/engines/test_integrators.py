"""Integrators against each other and against energy, on a mechanism that is hard on them."""

from dataclasses import replace

import numpy as np
import pytest
import scenes
from second_engine import mechanisms

from gazelle.engines import make_engine
from gazelle.errors import EngineError
from gazelle.simulation import Simulation

ANGLES = ("drive", "knee", "foot")


def loop(integrator, step=0.001):
    world = scenes.world(mechanisms.four_bar(), step=step)
    profile = replace(world.physics[0], integrator=integrator)
    return replace(world, physics=(profile,))


def angles(integrator, step):
    engine = make_engine("mujoco", loop(integrator, step))
    engine.step(round(3.0 / step))
    return np.array([engine.joint_position(f"m::{name}")[0, 0] for name in ANGLES])


def test_a_four_bar_is_right_to_5_mrad_after_3_s_with_rk4_and_not_with_euler():
    exact = angles("rk4", 0.00025)
    assert np.abs(angles("rk4", 0.001) - exact).max() < 0.005
    assert np.abs(angles("euler", 0.001) - exact).max() > 0.05


def test_euler_is_the_default_and_an_integrator_can_be_chosen_in_a_run():
    np.testing.assert_array_equal(angles(None, 0.001), angles("euler", 0.001))
    with Simulation(loop(None)) as sim:
        sim.run(seconds=0.5)
        before = sim.robots["m"].joints["drive"].position
        sim.physics.integrator = "rk4"
        assert sim.robots["m"].joints["drive"].position == before
        assert sim.physics.integrator == "rk4"
        sim.run(seconds=0.1)


def test_an_integrator_that_is_not_there_is_an_error():
    with pytest.raises(EngineError, match="no integrator 'rk5'"):
        make_engine("mujoco", loop("rk5"))
