"""Properties of a whole run that change in the middle of it: ``Simulation.physics``."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Physics, Pose, World
from gazelle.errors import SimulationError, SimulationWarning
from gazelle.simulation import Replay, Simulation


def speed(sim, axis=0):
    return sim.robots["ball"].motion().linear[:, axis]


def test_physics_properties_change_in_the_middle_of_a_run_and_keep_time_exact():
    with Simulation(scenes.world(scenes.ball(pose=Pose(z=100.0)))) as sim:
        sim.run(0.5)
        sim.physics.set(time_step=0.002, gravity=(0.0, 0.0, 9.8), iterations=30, wind=(1, 2, 3))
        assert sim.engine.time_step == sim.physics.time_step == 0.002
        sim.run(0.5)
        assert sim.clock.now_ns == 1_000_000_000
        assert speed(sim, 2)[0] == pytest.approx(0.0, abs=1e-9)
        assert (sim.physics.iterations, sim.physics.wind) == (30, (1.0, 2.0, 3.0))


def test_every_physics_property_can_be_read_and_set():
    with Simulation(scenes.world(scenes.ball())) as sim:
        physics = sim.physics
        values = {
            "update_rate": 500.0,
            "real_time_factor": 2.0,
            "magnetic_field": (1e-5, 0.0, 0.0),
            "wind": (1.0, 2.0, 3.0),
            "auto_disable": True,
            "speculative_contacts": True,
            "friction_model": "cone_model",
            "contacts": "exact",
            "contact_surface_layer": 0.01,
            "contact_max_correcting_velocity": 0.1,
        }
        for name, value in values.items():
            setattr(physics, name, value)
            assert getattr(physics, name) == value
        sim.step(5)
        for name in ("sor", "precon_iterations", "max_contacts", "erp", "cfm"):
            with pytest.warns(SimulationWarning, match=f"'{name}' has no effect"):
                setattr(physics, name, 7)
            assert getattr(physics, name) == 7
            setattr(physics, name, 7)  # nothing new, nothing said


def test_another_pace_compiles_no_other_model():
    with Simulation(scenes.world(scenes.ball())) as sim:
        before = sim.engine.revision
        sim.physics.set(update_rate=0.0, real_time_factor=3.0)
        assert sim.engine.revision == before
        sim.physics.iterations = 30
        assert sim.engine.revision > before


def test_friction_is_the_same_in_all_directions_on_a_cone_and_on_a_pyramid():
    def slid(model, slope):
        pull = 9.8 * slope / math.sqrt(2.0)  # down it, between x and y; mu is 0.5
        block = scenes.box(size=(0.4, 0.4, 0.05), pose=Pose(z=0.025), mu=0.5)
        world = scenes.world(scenes.ground(), block, gravity=(pull, pull, -9.8))
        with Simulation(world) as sim:
            sim.physics.friction_model = model
            sim.run(1.0)
            return np.linalg.norm(sim.robots["box"].placement().position[0, :2])

    for model in ("pyramid_model", "cone_model"):
        assert slid(model, 0.47) < 0.002
        assert slid(model, 0.55) == pytest.approx(9.8 * 0.05 / 2.0, rel=0.01)


def test_wrong_physics_is_refused_and_nothing_changes():
    with Simulation(scenes.world(scenes.ball())) as sim:
        before = sim.world
        with pytest.raises(SimulationError, match="did you mean 'time_step'"):
            sim.physics.set(time_steps=0.1)
        with pytest.raises(SimulationError, match="positive"):
            sim.physics.time_step = 0.0
        with pytest.raises(SimulationError, match="3 numbers"):
            sim.physics.gravity = (0.0, 1.0)
        with pytest.raises(SimulationError, match="did you mean 'cone_model'"):
            sim.physics.friction_model = "cone_modell"
        assert sim.world is before


def test_the_physics_profiles_of_a_file_are_presets():
    fine, coarse = Physics("fine", max_step_size=0.001), Physics("coarse", max_step_size=0.01)
    with Simulation(World("w", models=(scenes.ball(),), physics=(fine, coarse))) as sim:
        assert sim.physics.presets == ("fine", "coarse")
        sim.physics.use("coarse")
        assert sim.physics.time_step == 0.01
        sim.physics.use("fine")
        assert sim.physics.time_step == 0.001
        with pytest.raises(SimulationError, match="did you mean 'coarse'"):
            sim.physics.use("course")


def test_contacts_are_chosen_by_name_before_and_during_a_run_and_survive(tmp_path):
    robot = scenes.burger()

    def cone(sim):
        return sim.engine.running.batch.model.opt.cone == 1

    with Simulation(scenes.world(scenes.ground(), robot)) as sim:
        assert sim.physics.contacts is None
        assert not cone(sim)
        with sim.record(tmp_path / "run.jsonl"):
            sim.run(0.1)
            x = sim.robots["burger"].position.copy()
            sim.physics.contacts = "exact"
            assert cone(sim)
            np.testing.assert_array_equal(sim.robots["burger"].position, x)
            sim.run(0.1)
        end = sim.state_hash()
        saved = sim.snapshot()
        sim.reset()
        assert sim.physics.contacts == "exact"
        with Simulation(scenes.world(scenes.ground(), robot)) as other:
            other.restore(saved)
            assert other.physics.contacts == "exact"
            assert cone(other)
        with pytest.raises(SimulationError, match=r"there are no contacts 'fsat'.*fast"):
            sim.physics.contacts = "fsat"
        sim.physics.contacts = "fast"
        assert not cone(sim)
    with Replay(tmp_path / "run.jsonl") as replay:
        replay.run()
        assert replay.simulation.physics.contacts == "exact"
        assert replay.simulation.state_hash() == end


@pytest.mark.parametrize(
    ("name", "hint"),
    [
        ("max_step_size", "it is called time_step here"),
        ("iters", "it is called iterations here"),
        ("gravty", "did you mean 'gravity'"),
    ],
)
def test_a_name_that_is_none_is_refused_and_not_kept(name, hint):
    with Simulation("empty") as sim:
        with pytest.raises(SimulationError, match=f"no '{name}'.*{hint}"):
            setattr(sim.physics, name, 3)
        assert not hasattr(sim.physics, name)
