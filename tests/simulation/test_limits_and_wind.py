"""Limits of efforts, wind and integrators in runs that are saved, replayed and reset."""

from dataclasses import replace

import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.simulation import Replay, Simulation


def windmill():
    """Return a wheel with limits on a post, its rim in the wind, and a leaf that flies."""
    inertial = Inertial(1.0, Pose(x=0.3), Inertia(0.05, 0.05, 0.05))
    links = (Link("wheel", inertial=inertial, enable_wind=True),)
    axis = JointAxis((0.0, 0.0, 1.0), effort=2.0, velocity=1.5)
    joints = (Joint("axle", "continuous", "world", "wheel", axes=(axis,)),)
    return Model("mill", links=links, joints=joints)


def world():
    leaf = Model("leaf", enable_wind=True, links=(Link("link", inertial=Inertial()),))
    made = scenes.world(scenes.ground(), windmill(), replace(leaf, pose=Pose(z=50.0)))
    return replace(made, wind=(0.4, 0.1, 0.0))


def drive(sim):
    axle = sim.robots["mill"].joints["axle"]
    sim.run(seconds=0.1)
    axle.effort = 9.0
    sim.run(seconds=0.8)
    axle.apply_effort(-5.0, duration=0.1)
    sim.run(seconds=0.2)
    sim.physics.set(wind=(0.0, 3.0, 0.0), integrator="rk4")
    sim.run(seconds=0.3)


@pytest.mark.long
def test_a_run_replays_to_the_bit(tmp_path):
    path = tmp_path / "run.jsonl"
    with Simulation(world(), nworld=2) as sim:
        with sim.record(path):
            drive(sim)
        end = sim.state_hash()
    with Replay(path) as replay:
        replay.run()
        assert replay.simulation.state_hash() == end


def test_a_snapshot_goes_on_alike_and_a_reset_starts_over():
    with Simulation(world()) as sim, Simulation(world()) as other:
        first = sim.state_hash()
        drive(sim)
        other.restore(sim.snapshot())
        for each in (sim, other):
            each.run(seconds=0.2)
        assert sim.state_hash() == other.state_hash()
        sim.reset()
        assert sim.state_hash() == first


def test_timed_and_lasting_efforts_together_are_clamped_and_held_back():
    with Simulation(world()) as sim:
        sim.physics.wind = (0.0, 0.0, 0.0)
        axle = sim.robots["mill"].joints["axle"]
        axle.effort = 1.5
        axle.apply_effort(1.5, duration=5.0)
        sim.step()
        assert sim.engine.joints["mill::axle"].effort()[0, 0] == 2.0
        sim.run(seconds=1.0)
        assert axle.velocity == pytest.approx(1.5, abs=0.02)
