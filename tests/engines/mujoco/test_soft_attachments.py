"""Links that come together with a time constant."""

from __future__ import annotations

import numpy as np
import pytest
import scenes

import gazelle
from gazelle import formats
from gazelle.description import Pose
from gazelle.engines import make_engine
from gazelle.errors import EngineError

PAIR = "leader::link", "box::link"


def pair(step=0.001, nworld=2):
    """Return a box, and a kinematic one, without gravity."""
    models = scenes.box("leader"), scenes.box("box", pose=Pose(z=3.0))
    world = scenes.world(*models, step=step, gravity=(0.0, 0.0, 0.0))
    engine = make_engine("mujoco", world, nworld)
    engine.make_kinematic("leader")
    return engine


def gap_after(engine, seconds, away=(0.3, -0.2, 0.1)):
    """Return the rest of a gap, after the leader was placed elsewhere; shape (nworld,)."""
    there = np.add(away, [0.0, 0.0, 0.5])
    engine.models["leader"].set_placement(there, (0.0, 0.0, 0.0, 1.0))
    wanted = engine.links["box::link"].placement().position + away
    engine.step(round(seconds / engine.time_step))
    left = np.linalg.norm(wanted - engine.links["box::link"].placement().position, axis=1)
    return left / np.linalg.norm(away)


@pytest.mark.parametrize("settling", [0.02, 0.1, 0.4])
@pytest.mark.parametrize("times", [1.0, 2.0, 3.0])
def test_a_gap_closes_as_a_critically_damped_spring_closes_it(settling, times):
    engine = pair()
    engine.models["leader"].set_placement((0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0))
    engine.attach(*PAIR, None, settling)
    # MuJoCo's impedance of 0.95 makes it a little faster than the time constant says.
    wanted = (1.0 + times) * np.exp(-times)
    np.testing.assert_allclose(gap_after(engine, times * settling), wanted, atol=0.04)


def test_without_a_time_constant_it_is_as_stiff_as_can_be():
    engine = pair()
    engine.models["leader"].set_placement((0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0))
    engine.attach(*PAIR)
    assert gap_after(engine, 0.03).max() < 0.01


def test_another_time_constant_takes_the_place_of_the_first():
    engine = pair()
    engine.models["leader"].set_placement((0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0))
    engine.attach(*PAIR, np.array([0]), 0.5)
    engine.attach(*PAIR, np.array([0]), 0.02)
    left = gap_after(engine, 0.1)
    assert left[0] < 0.1
    assert left[1] == pytest.approx(1.0)  # never attached there
    assert len([call for call in engine.history() if call.method == "attach"]) == 1


def test_another_engine_becomes_the_same_and_goes_on_with_the_same_bits():
    engine, other = pair(), pair()
    engine.models["leader"].set_placement((0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 1.0))
    engine.attach(*PAIR, None, 0.1)
    gap_after(engine, 0.05)
    other.adopt(engine.history())
    other.restore(engine.snapshot())
    for each in (engine, other):
        each.step(40)
    np.testing.assert_array_equal(engine.snapshot(), other.snapshot())


@pytest.mark.parametrize("settling", [0.0, -0.1, np.nan, np.inf])
def test_what_cannot_be_is_refused(settling):
    with pytest.raises(EngineError, match="settling time must be positive"):
        pair().attach(*PAIR, None, settling)


def test_a_simulation_takes_it_and_saves_it():
    world = formats.load_string("<sdf version='1.7'><world name='w'/></sdf>")
    sim = gazelle.Simulation(world)
    leader = sim.spawn(scenes.box("leader", pose=Pose(z=3.0)))
    box = sim.spawn(scenes.box("box", pose=Pose(z=5.0)))
    sim.attach(box.links["link"], leader.links["link"], settling=0.2)
    sim.step(50)
    saved = sim.snapshot()
    sim.step(20)
    wanted = box.position.copy()
    sim.restore(saved)
    sim.step(20)
    np.testing.assert_array_equal(box.position, wanted)
