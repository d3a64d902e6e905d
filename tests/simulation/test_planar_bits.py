"""Bits of the planar engine: equal in any number of worlds, and whatever happens beside."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import Pose, Simulation

ROUNDS, STEPS = 12, 23
ROBOTS = {
    "noisy": (scenes.world(*scenes.square()), scenes.burger(stddev=0.01, samples=12)),
    "burger": ("turtlebot3_stage_4", "turtlebot3_burger"),
    "waffle": ("turtlebot3_world", "turtlebot3_waffle_pi"),
}
pytestmark = pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")


def run(name, *, nworld=1, events=(), seed=0):
    """Return the robot's actions and observations in world 0, to the bit, after each round.

    Each event is a round and what happens in it.
    """
    world, robot = ROBOTS[name]
    random, seen = np.random.default_rng(seed), []
    with Simulation(world, engine="planar", nworld=nworld, seed=seed) as sim:
        one = sim.spawn(robot, name="r1", pose=Pose(x=-0.7, yaw=0.3))
        for number in range(ROUNDS):
            linear, angular = random.uniform((-0.2, -2.0), (0.2, 2.0))
            one.inputs["cmd_vel"].send(linear=linear, angular=angular)
            for when, event in events:
                if when == number:
                    event(sim)
            sim.step(STEPS)
            seen.append(state_of(sim, one))
    return seen


def state_of(sim, one):
    """Place and motion of the robot's links, readings and odometry in world 0, as bytes."""
    first = np.array([0])
    arrays = []
    for link in (name for name in sim.engine.links.names if name.startswith("r1::")):
        place, motion = (
            sim.engine.links[link].placement(first),
            sim.engine.links[link].motion(first),
        )
        arrays += [place.position, place.quaternion, motion.linear, motion.angular]
    arrays += [sensor.latest()[0] for sensor in one.sensors.values()]
    odometry = one.outputs["odom"].last
    arrays += [np.atleast_2d(each)[0] for each in (odometry.position, odometry.linear)]
    return [np.asarray(array).tobytes() for array in arrays]


@cache
def alone(name):
    return run(name)


def restored(sim):
    sim.restore(sim.snapshot())


def joined(sim):
    sim.spawn(scenes.box(size=(0.1, 0.1, 0.1), name="box"), pose=Pose(x=30.0))


def left(sim):
    if "box" in sim.robots:
        sim.delete("box")


def passed_by(sim):
    sim.spawn(scenes.burger("guest"), pose=Pose(x=30.0, y=30.0))
    sim.robots["guest"].inputs["cmd_vel"].send(linear=0.1)
    sim.step(0)
    sim.delete("guest")


def others_reset(sim):
    if sim.nworld > 1:
        sim.reset(worlds=np.arange(1, sim.nworld))


EVENTS = (restored, joined, left, passed_by, others_reset)


@pytest.mark.long
@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("nworld", [2, 3, 8])
def test_a_world_has_the_same_bits_among_any_number(name, nworld):
    assert run(name, nworld=nworld) == alone(name)


@pytest.mark.long
@pytest.mark.parametrize("name", ROBOTS)
@pytest.mark.parametrize("event", EVENTS[:-1])
def test_what_happens_beside_changes_no_bit(name, event):
    events = [(5, event), (9, left if event is joined else event)]
    assert run(name, events=events) == alone(name)


@pytest.mark.long
@settings(max_examples=8)
@given(
    nworld=st.integers(1, 5),
    events=st.dictionaries(st.integers(1, ROUNDS - 1), st.sampled_from(EVENTS), max_size=5),
)
def test_no_order_of_events_changes_a_bit(nworld, events):
    kept, there = [], False
    for when, event in sorted(events.items(), key=lambda each: each[0]):
        if not (event is joined and there):
            kept.append((when, event))
        there = (there or event is joined) and event is not left
    assert run("noisy", nworld=nworld, events=kept) == alone("noisy")
