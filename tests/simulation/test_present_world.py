"""A world is described, and saved, as it is in the middle of a run."""

import numpy as np
import pytest

from gazelle import formats
from gazelle.builders import lamp
from gazelle.errors import SimulationError
from gazelle.simulation import Simulation
from gazelle.simulation.lights import add_light, delete_light
from gazelle.simulation.present_world import present_world
from tests.viewer.lamp_world import LAMP_WORLD


@pytest.fixture
def running(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(LAMP_WORLD)
    with Simulation(file, threads=1) as simulation:
        yield simulation


def test_a_world_in_which_nothing_changed_is_described_as_before(running):
    assert present_world(running) == running.world


def test_a_saved_world_begins_where_the_other_was(running, tmp_path):
    running.robots["box"].set_pose((0.4, 1.5, 0.5), yaw=0.3)
    running.robots["box"].links["l"].set_properties(mass=7.0, inertia=[1, 2, 2.5, 0.1, 0.0, 0.2])
    running.parameters.friction["box::l::c"] = 0.25
    running.robots["lamp"].joints["hinge"].set_properties(damping=0.75, upper=0.5)
    running.parameters.gravity = (0.0, 0.0, -1.6)
    formats.save(present_world(running), tmp_path / "saved.world")
    with Simulation(tmp_path / "saved.world", threads=1) as again:
        assert again.robots["box"].pose.is_close(
            running.robots["box"].pose, position=1e-6, angle=1e-6
        )
        for kind, name in (
            ("link_mass", "box::l"),
            ("link_inertia", "box::l"),
            ("friction", "box::l::c"),
            ("joint_damping", "lamp::hinge"),
            ("joint_upper", "lamp::hinge"),
        ):
            now, before = (getattr(sim.parameters, kind)[name] for sim in (again, running))
            np.testing.assert_allclose(now, before, rtol=1e-6, atol=1e-9)
        np.testing.assert_allclose(again.parameters.gravity, running.parameters.gravity)


def test_worlds_of_a_batch_are_described_each_for_itself(tmp_path):
    file = tmp_path / "room.world"
    file.write_text(LAMP_WORLD)
    with Simulation(file, nworld=2, threads=1) as simulation:
        simulation.robots["box"].set_pose((0.0, 1.0, 0.5), worlds=np.array([1]))
        places = [
            next(each for each in present_world(simulation, k).models if each.name == "box").pose.y
            for k in range(2)
        ]
        assert places == [0.0, 1.0]
        with pytest.raises(SimulationError, match="there is no world 2"):
            present_world(simulation, 2)


def test_lights_are_added_under_free_names_and_deleted(running):
    names = [add_light(running, lamp()).name for _ in range(2)]
    assert names == ["lamp", "lamp_2"]
    assert [each.name for each in running.world.lights] == ["sun", "bulb", "lamp", "lamp_2"]
    delete_light(running, "lamp")
    assert "lamp" not in [each.name for each in running.world.lights]
    with pytest.raises(SimulationError, match="there is no light 'lamp'"):
        delete_light(running, "lamp")
