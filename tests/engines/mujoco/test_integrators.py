"""Integrators against each other and against energy, on a mechanism that is hard on them."""

from dataclasses import replace

import numpy as np
import pytest
import scenes
from second_engine import mechanisms

from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.errors import EngineError
from gazelle.simulation import Simulation

ANGLES = ("drive", "knee", "foot")
SWING = {"shoulder": 2.0, "elbow": -1.0}


def loop(integrator, step=0.001):
    world = scenes.world(mechanisms.four_bar(), step=step)
    profile = replace(world.physics[0], integrator=integrator)
    return replace(world, physics=(profile,))


def angles(integrator, step):
    engine = make_engine("mujoco", loop(integrator, step))
    engine.step(round(3.0 / step))
    return np.array([engine.joints[f"m::{name}"].position()[0, 0] for name in ANGLES])


def test_a_four_bar_is_right_to_5_mrad_after_3_s_with_rk4_and_not_with_euler():
    exact = angles("rk4", 0.00025)
    assert np.abs(angles("rk4", 0.001) - exact).max() < 0.005
    assert np.abs(angles("euler", 0.001) - exact).max() > 0.05


def test_of_a_double_pendulum_the_default_is_ten_times_nearer():
    def after(integrator, step):
        world = scenes.world(mechanisms.double_pendulum(), step=step)
        world = with_profile(world, replace(world.profile, integrator=integrator))
        engine = make_engine("mujoco", world)
        for name, angle in SWING.items():
            engine.joints[f"m::{name}"].set_position(angle)
        engine.step(round(2.0 / step))
        return np.array([engine.joints[f"m::{name}"].position()[0, 0] for name in SWING])

    exact = after("rk4", 0.0002)
    off, eulers = (np.abs(after(name, 0.001) - exact).max() for name in (None, "euler"))
    assert off < 0.15 * eulers


def test_the_default_is_nearer_to_the_limit_of_small_steps_than_euler():
    exact = angles("rk4", 0.00025)
    off, eulers = (np.abs(angles(name, 0.001) - exact).max() for name in (None, "euler"))
    assert off < 0.75 * eulers


def test_an_integrator_can_be_chosen_in_a_run():
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
