"""Engines of other packages: found by name, and run by a simulation that knows nothing of them."""

from importlib.metadata import EntryPoint

import numpy as np
import pytest
import scenes

from gazelle.description import Pose
from gazelle.engines import Engine, engine_names, make_engine, register_engine, registry
from gazelle.engines.mujoco import MujocoEngine
from gazelle.errors import EngineError
from gazelle.simulation import Simulation


class Relay:
    """An engine that is none of Gazelle's: it hands the protocol, and only that, to another."""

    def __init__(self, world, nworld=1, *, time_step=None, threads=None):
        self._inner = MujocoEngine(world, nworld, time_step=time_step, threads=threads)

    def __getattr__(self, name):
        if name not in vars(Engine):
            raise AttributeError(name)
        return getattr(self._inner, name)


@pytest.fixture
def relay(monkeypatch):
    monkeypatch.setattr(registry, "_registered", {})
    register_engine("relay", Relay)
    return "relay"


def test_a_registered_engine_is_found_beside_those_that_are_there(relay):
    assert {"mujoco", relay} <= set(engine_names())
    assert isinstance(make_engine(relay, scenes.world(scenes.ball())), Relay)


def test_a_simulation_needs_nothing_but_the_protocol(relay):
    def run(engine):
        world = scenes.world(scenes.ground(), *scenes.square(), scenes.burger(pose=Pose(z=0.01)))
        with Simulation(world, engine=engine, nworld=2, seed=3) as sim:
            robot = sim.robots["burger"]
            sim.run(seconds=0.2)
            robot.inputs["cmd_vel"].send(linear=0.2, angular=0.3)
            sim.run(seconds=0.3)
            sim.spawn(scenes.box("crate", pose=Pose(1.0, 1.0, 0.1)))
            saved = sim.snapshot()
            scan = robot.sensors["lds"].read(world=1).ranges
            acceleration = robot.sensors["imu"].read().linear_acceleration
            sim.run(seconds=0.2)
            sim.restore(saved)
            sim.physics.set(gravity=(0.0, 0.0, -1.6))
            sim.run(seconds=0.1)
            sim.delete("crate")
            sim.run(seconds=0.1)
            return np.concatenate((scan, acceleration, robot.position.ravel()))

    np.testing.assert_array_equal(run(relay), run("mujoco"))


def test_an_engine_of_an_installed_package_is_its_entry_point(monkeypatch):
    point = EntryPoint("other", "gazelle.engines.mujoco:MujocoEngine", "gazelle.engines")
    monkeypatch.setattr(registry, "entry_points_of_others", lambda _: {"other": point})
    assert "other" in engine_names()
    assert make_engine("other", scenes.world(scenes.ball())).nworld == 1


def test_a_package_that_is_broken_and_a_name_that_is_not_there_are_errors(monkeypatch):
    point = EntryPoint("other", "gazelle_no_such_package:Engine", "gazelle.engines")
    monkeypatch.setattr(registry, "entry_points_of_others", lambda _: {"other": point})
    with pytest.raises(EngineError, match=r"'other' \(gazelle_no_such_package:Engine\) cannot"):
        make_engine("other", scenes.world())
    with pytest.raises(EngineError, match=r"no engine 'mujico'.*did you mean 'mujoco'"):
        make_engine("mujico", scenes.world())
