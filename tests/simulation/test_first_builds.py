"""Requests of plugins at a world's start are compiled with it, once."""

from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle import EngineError, Pose, Simulation
from gazelle.engines import make_engine
from gazelle.engines.mujoco import worlds
from gazelle.formats import load_string

DRIVE = (scenes.drive_plugin(),)


@pytest.fixture
def compiled(monkeypatch):
    """Return the count of compilations of a world."""
    calls = []
    compile_world = worlds.compile_world

    def counting(recipe):
        calls.append(recipe)
        return compile_world(recipe)

    monkeypatch.setattr(worlds, "compile_world", counting)
    return calls


def walker(name, y):
    way = (
        "<waypoint><time>0</time><pose>0 {0} 0.1 0 0 0</pose></waypoint>"
        "<waypoint><time>1</time><pose>1 {0} 0.1 0 0 0</pose></waypoint>"
    )
    return (
        f"<model name='{name}'><pose>0 {y} 0.1 0 0 0</pose><link name='l'><collision name='c'>"
        "<geometry><box><size>0.2 0.2 0.2</size></box></geometry></collision></link>"
        f"<plugin name='p' filename='libgazelle_scripted_motion.so'>{way.format(y)}</plugin></model>"
    )


def world_of(*models):
    return load_string(f"<sdf version='1.7'><world name='w'>{''.join(models)}</world></sdf>")


@pytest.mark.parametrize("count", [1, 6])
def test_many_models_that_plugins_move_are_compiled_with_the_world(compiled, count):
    with Simulation(world_of(*(walker(f"w{i}", float(i)) for i in range(count)))) as sim:
        sim.run(0.5)
        for i in range(count):
            assert sim.robots[f"w{i}"].pose.is_close(Pose(0.5, i, 0.1), position=0.11)
    assert len(compiled) == 1


def test_many_robots_that_drive_are_compiled_with_the_world(compiled):
    robots = [replace(scenes.burger(f"r{i}", Pose(y=float(i))), plugins=DRIVE) for i in range(5)]
    with Simulation(scenes.world(scenes.ground(), *robots)) as sim:
        for robot in robots:
            sim.robots[robot.name].inputs["cmd_vel"].send(linear=0.2)
        sim.run(0.5)
        assert all(sim.robots[robot.name].pose.x > 0.05 for robot in robots)
    assert len(compiled) == 1


def test_robots_and_walkers_start_as_they_did_one_by_one():
    together = Simulation(world_of(walker("a", 0.0), walker("b", 1.0)))
    one_by_one = Simulation(world_of())
    for name, y in (("a", 0.0), ("b", 1.0)):
        model = world_of(walker(name, y)).models[0]
        one_by_one.spawn(model)
    for sim in (together, one_by_one):
        sim.run(0.3)
    for name in "ab":
        np.testing.assert_array_equal(
            together.robots[name].pose.position, one_by_one.robots[name].pose.position
        )
    together.close()
    one_by_one.close()


def test_a_model_that_is_to_be_placed_has_no_motors_from_then_on():
    engine = make_engine("mujoco", scenes.world(scenes.burger("r")))
    engine.make_kinematic("r")
    with pytest.raises(EngineError, match="wheel_left_joint"):
        engine.add_motor("r::wheel_left_joint", 1.0)
    assert not any(name.startswith("r::") for name in engine.joints.names)
    other = make_engine("mujoco", scenes.world(scenes.burger("r")))
    other.add_motor("r::wheel_left_joint", 1.0)
    with pytest.raises(EngineError, match="has motors"):
        other.make_kinematic("r")


def test_the_first_step_of_a_simulation_compiles_nothing(compiled):
    with Simulation(world_of(walker("w", 0.0))) as sim:
        assert len(compiled) == 1
        sim.step()
    assert len(compiled) == 1


def test_names_are_known_before_a_world_is_compiled(compiled):
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.burger("r")), late=True)
    names = engine.links.names, engine.joints.names
    with pytest.raises(EngineError, match="there is no model 's'"):
        engine.make_kinematic("s")
    with pytest.raises(EngineError, match="there is no joint 'r::wheel'"):
        engine.add_motor("r::wheel", 1.0)
    engine.add_motor("r::wheel_left_joint", 1.0)
    assert not compiled
    engine.prepare()
    assert names == (engine.links.names, engine.joints.names)
    assert len(compiled) == 1
    assert list(compiled[0].motors) == ["r::wheel_left_joint"]


def test_a_late_engine_that_is_closed_compiles_nothing(compiled):
    make_engine("mujoco", scenes.world(scenes.burger("r")), late=True).close()
    assert not compiled


def test_a_world_that_cannot_be_simulated_is_refused_when_it_is_made():
    massless = "<model name='m'><link name='l'><inertial><mass>{}</mass></inertial></link></model>"
    good, bad = world_of(massless.format(1.0)), replace_mass(world_of(massless.format(1.0)))
    make_engine("mujoco", good)
    for make in (Simulation, lambda world: make_engine("mujoco", world)):
        with pytest.raises(EngineError, match="mass"):
            make(bad)


def replace_mass(world):
    """Return the world with a link that weighs nothing."""
    model = world.models[0]
    link = replace(model.links[0], inertial=replace(model.links[0].inertial, mass=0.0))
    return replace(world, models=(replace(model, links=(link,)),))
