"""A link that hangs on a joint takes the part of a pose or velocity that its joint allows."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes

import gazelle
from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.engines import make_engine
from gazelle.errors import EngineError, SimulationWarning

SKEW = (0.48, 0.6, 0.64)
ACROSS = (0.8, 0.0, -0.6)
MASS = Inertial(1.0, inertia=Inertia(0.1, 0.1, 0.1))
BASE = Pose(1.0, 2.0, 3.0, 0.3, -0.2, 0.5)
ARM = Pose(1.3, 2.1, 3.4, -0.4, 0.1, 0.9)
TIP = ARM * Pose(0.2, 0.1, 0.3, 0.5, 0.6, 0.7)
HAND = TIP * Pose(0.1, 0.0, 0.2, 0.2, 0.0, 0.0)
FRAME = Pose(0.05, -0.1, 0.15, 0.2, 0.3, 0.4)
KINDS = {
    "revolute": ([0.7], (SKEW,)),
    "continuous": ([-2.9], (SKEW,)),
    "prismatic": ([0.3], (SKEW,)),
    "universal": ([0.7, -0.4], ((0.0, 0.0, 1.0), ACROSS)),
    "revolute2": ([-1.2, 2.1], (SKEW, ACROSS)),
    "ball": ([0.1, 0.2, 0.3, math.sqrt(0.86)], ()),
    "planar": ([0.2, -0.3, 0.6], (SKEW,)),
    "screw": ([0.5, -0.1], (SKEW,)),
}
WORLDS = np.array([0, 2])


def arm(kind, axes, parent="base", **limits):
    """Return a base, an arm on the joint, a tip fixed to it, and a hand on a hinge at the tip."""
    drawn = tuple(JointAxis(axis, **limits) for axis in axes)
    joints = (
        Joint("joint", kind, parent, "arm", FRAME, axes=drawn, thread_pitch=5.0),
        Joint("weld", "fixed", "arm", "tip"),
        Joint("wrist", "revolute", "tip", "hand", axes=(JointAxis(),)),
    )
    links = [
        Link(name, pose, inertial=MASS)
        for name, pose in (("arm", ARM), ("tip", TIP), ("hand", HAND))
    ]
    if parent != "world":
        links.insert(0, Link("base", BASE, inertial=MASS))
    return Model("robot", links=tuple(links), joints=joints)


def engine_of(model, name="mujoco"):
    return make_engine(name, scenes.world(model, gravity=(0.0, 0.0, 0.0)), 3)


@pytest.mark.parametrize("parent", ["base", "world"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("link", ["arm", "tip"])
def test_a_pose_that_the_joint_allows_is_reached_by_the_joint_alone(kind, parent, link):
    position, axes = KINDS[kind]
    engine = engine_of(arm(kind, axes, parent))
    name = f"robot::{link}"
    if parent == "base":
        there = Pose(4.0, 5.0, 6.0, 1.0, 0.3, 0.2)
        engine.models["robot"].set_placement(there.position, there.quaternion)
    rest = engine.snapshot()
    engine.joints["robot::wrist"].set_position(0.4)
    engine.joints["robot::joint"].set_position(position)
    goal, hand = engine.links[name].placement(WORLDS), engine.links["robot::hand"].placement(WORLDS)
    engine.restore(rest)
    engine.joints["robot::wrist"].set_position(0.4)
    engine.links[name].set_placement(goal.position, goal.quaternion, WORLDS)
    found = engine.joints["robot::joint"].position()
    np.testing.assert_allclose(found[WORLDS], [position] * 2, atol=1e-9)
    assert not np.allclose(found[1], position)
    np.testing.assert_allclose(
        engine.links[name].placement(WORLDS).position, goal.position, atol=1e-9
    )
    rides = engine.links["robot::hand"].placement(WORLDS)
    np.testing.assert_allclose(rides.position, hand.position, atol=1e-9)


@pytest.mark.parametrize("parent", ["base", "world"])
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("link", ["arm", "tip"])
def test_a_velocity_that_the_joint_allows_is_given_to_the_joint_alone(kind, parent, link):
    position, axes = KINDS[kind]
    engine = engine_of(arm(kind, axes, parent))
    engine.joints["robot::joint"].set_position(position)
    if parent == "base":
        engine.models["robot"].set_motion((0.1, 0.2, 0.3), (0.4, 0.5, 0.6))
    rates = np.zeros(engine.joints["robot::joint"].velocity().shape[1])
    rates[:] = np.linspace(0.5, 0.9, len(rates))
    if kind == "screw":
        rates[1] = -rates[0] / 5.0
    engine.joints["robot::joint"].set_velocity(rates)
    name = f"robot::{link}"
    goal = engine.links[name].motion(WORLDS)
    if kind in ("universal", "revolute2", "ball", "revolute", "continuous"):
        goal = replace(goal, linear=goal.linear * 0.0)  # hinges do not look at it
    engine.joints["robot::joint"].set_velocity(rates * 0.0)
    engine.joints["robot::wrist"].set_velocity(0.3)
    engine.links[name].set_motion(goal.linear, goal.angular, WORLDS)
    found = engine.joints["robot::joint"].velocity(WORLDS)
    np.testing.assert_allclose(found, [rates] * 2, atol=1e-9)
    assert engine.joints["robot::wrist"].velocity(WORLDS)[0, 0] == 0.3


def test_the_part_that_the_joint_does_not_allow_is_left_out_with_one_warning():
    with gazelle.Simulation(scenes.world(arm("revolute", (SKEW,), "world")), threads=1) as sim:
        robot = sim.robots["robot"]
        link, pose = robot.links["arm"], robot.links["arm"].pose
        robot.joints["joint"].set_position(0.5)
        with pytest.warns(SimulationWarning, match=r"'robot::arm'.*'robot::joint' allows"):
            link.set_pose((9.0, 9.0, 9.0), pose.quaternion)
        assert robot.joints["joint"].position == pytest.approx(0.0, abs=1e-9)
        link.set_pose(pose.position, pose.quaternion)


def test_a_joint_goes_to_its_limits_at_most_and_takes_the_turn_within_them():
    engine = engine_of(arm("revolute", (SKEW,), lower=3.0, upper=4.0))
    engine.joints["robot::joint"].set_position(3.5)
    goal = engine.links["robot::arm"].placement()
    engine.joints["robot::joint"].set_position(3.0)
    engine.links["robot::arm"].set_placement(goal.position, goal.quaternion)
    np.testing.assert_allclose(engine.joints["robot::joint"].position(), 3.5)
    engine = engine_of(arm("prismatic", (SKEW,), lower=-0.1, upper=0.2))
    far = engine.links["robot::arm"].placement().position + 10.0
    engine.links["robot::arm"].set_placement(far, goal.quaternion)
    np.testing.assert_allclose(engine.joints["robot::joint"].position(), 0.2)


def test_what_is_fixed_to_the_world_stays_and_says_so():
    engine = engine_of(arm("fixed", (), "world"))
    for link in ("arm", "tip"):
        with pytest.raises(EngineError, match="is fixed to the world"):
            engine.links[f"robot::{link}"].set_placement((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    goal = engine.links["robot::hand"].placement()
    engine.joints["robot::wrist"].set_position(1.0)
    engine.links["robot::hand"].set_placement(goal.position, goal.quaternion)
    np.testing.assert_allclose(engine.joints["robot::wrist"].position(), 0.0, atol=1e-9)


def test_the_root_of_a_free_model_takes_the_model_along():
    engine = engine_of(arm("revolute", (SKEW,)))
    engine.joints["robot::joint"].set_position(0.5)
    assert engine.links["robot::base"].set_placement((5.0, 6.0, 7.0), (0.0, 0.0, 0.0, 1.0)) == ""
    np.testing.assert_allclose(
        engine.links["robot::base"].placement().position, [[5.0, 6.0, 7.0]] * 3
    )
    np.testing.assert_allclose(engine.joints["robot::joint"].position(), 0.5)


def test_it_is_the_same_in_the_plane():
    engine = engine_of(scenes.burger(pose=Pose(1.0, 2.0, yaw=0.7)), "planar")
    name = "burger::wheel_left_link"
    before = engine.models["burger"].placement().position
    engine.joints["burger::wheel_left_joint"].set_position(0.8)
    goal = engine.links[name].placement()
    engine.joints["burger::wheel_left_joint"].set_position(0.0)
    engine.links[name].set_placement(goal.position, goal.quaternion)
    np.testing.assert_allclose(engine.joints["burger::wheel_left_joint"].position(), 0.8)
    np.testing.assert_array_equal(engine.models["burger"].placement().position, before)
