"""Rigid stops of joints: how far a joint passes its limit, and how fast it comes back."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, JointPhysics, Link, Model, Pose
from gazelle.engines import make_engine

Y = (0.0, 1.0, 0.0)
LIMIT = 0.5
FAST = np.linspace(2.5, 2.8, 16)  # [m/s or rad/s]
BACK = 0.055  # largest rebound, as a share of the speed of impact

STEPS = [0.0005, 0.001, 0.002, 0.005]
KINDS = ["revolute", "prismatic", "universal", "revolute2", "screw"]


def mover(kind, step, nworld=1, terms=None, **axis):
    """Return a link of 1 kg with a moment of 0.5 kg m² on a joint without gravity."""
    limits = {"lower": -LIMIT, "upper": LIMIT, **axis}
    axes = (JointAxis(Y, **limits), JointAxis((1.0, 0.0, 0.0)))
    count = 2 if kind in {"universal", "revolute2"} else 1
    physics = terms or JointPhysics()
    joint = Joint("j", kind, "world", "w", axes=axes[:count], physics=physics)
    link = Link("w", inertial=Inertial(1.0, Pose(), Inertia(0.5, 0.5, 0.5)))
    model = Model("m", links=(link,), joints=(joint,))
    return make_engine("mujoco", scenes.world(model, gravity=(0, 0, 0), step=step), nworld)


def passed_and_back(engine, duration):
    """Return how far each world passed its limit at most, and its largest speed back."""
    passed, back = (np.zeros(engine.nworld) for _ in range(2))
    for _ in range(round(duration / engine.time_step)):
        engine.step()
        passed = np.maximum(passed, np.abs(engine.joints["m::j"].position()[:, 0]) - LIMIT)
        back = np.maximum(back, -engine.joints["m::j"].velocity()[:, 0])
    return passed, back


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("kind", KINDS)
def test_a_thrown_joint_passes_its_limit_by_less_than_a_step_and_hardly_comes_back(kind, step):
    engine = mover(kind, step, len(FAST))
    count = engine.joints["m::j"].velocity().shape[1]
    engine.joints["m::j"].set_velocity(np.column_stack([FAST, *[0.0 * FAST] * (count - 1)]))
    passed, back = passed_and_back(engine, 0.3)
    assert (passed < FAST * step * 1.001).all()
    assert (back < BACK * FAST).all()


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_a_motor_that_pushes_against_a_stop_rests_at_it(kind, step):
    engine = mover(kind, step)
    engine.add_motor("m::j", [50.0])
    engine.joints["m::j"].set_motor_velocity(1.0)
    passed, _ = passed_and_back(engine, 1.5)
    assert passed[0] <= 1.001 * step
    assert engine.joints["m::j"].position()[0, 0] == pytest.approx(LIMIT, abs=1e-4)
    assert abs(engine.joints["m::j"].velocity()[0, 0]) < 1e-4
    engine.joints["m::j"].set_motor_velocity(-1.0)
    engine.step(round(0.5 / step))
    assert engine.joints["m::j"].position()[0, 0] == pytest.approx(0.0, abs=0.01)


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_an_effort_presses_a_joint_into_its_stop_by_no_more_than_rounding(kind, step):
    engine = mover(kind, step)
    engine.joints["m::j"].set_effort(20.0)
    engine.step(round(2.0 / step))
    assert engine.joints["m::j"].position()[0, 0] == pytest.approx(LIMIT, abs=20.0 * step**2)


@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
@pytest.mark.parametrize(
    ("given", "terms"),
    [  # springs too stiff for steps of 1 ms are rigid, softer ones give way by v √(m/k)
        ({"stiffness": 1e8, "dissipation": 1.0}, None),
        ({"stiffness": 1e7, "dissipation": 0.0}, None),
        ({"stiffness": 1e6, "dissipation": 100.0}, None),
        ({}, JointPhysics(stop_erp=0.2, stop_cfm=0.0)),
    ],
)
def test_stops_too_stiff_to_be_followed_are_rigid(given, terms, step):
    engine = mover("prismatic", step, len(FAST), terms, **given)
    engine.joints["m::j"].set_velocity(FAST[:, None])
    passed, back = passed_and_back(engine, 0.3)
    assert (passed < FAST * step * 1.001).all()
    assert (back < BACK * FAST).all()


@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
def test_springs_of_stops_that_can_be_followed_stay_springs(step):
    stiffness = 1000.0
    engine = mover("prismatic", step, stiffness=stiffness, dissipation=0.0)
    engine.joints["m::j"].set_velocity(2.8)
    passed, _ = passed_and_back(engine, 0.3)
    # The spring is implicit, and so loses energy: the more the longer the step.
    assert passed[0] == pytest.approx(2.8 * math.sqrt(1.0 / stiffness), rel=0.02 + 60.0 * step)
    assert passed[0] > 5.0 * 2.8 * 0.001


@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_limits_that_a_joint_gets_later_are_as_rigid(kind, step):
    engine = mover(kind, step, 3, lower=-math.inf, upper=math.inf)
    for side in ("lower", "upper"):
        way = -LIMIT if side == "lower" else LIMIT
        engine.set_parameter(f"joint_{side}", "m::j", [[way]] * 3)
    engine.joints["m::j"].set_velocity([[2.5], [2.65], [2.8]])
    passed, back = passed_and_back(engine, 0.3)
    assert (passed < 2.8 * step * 1.001).all()
    assert (back < BACK * 2.8).all()


@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
def test_worlds_with_masses_of_their_own_stop_alike(step):
    engine = mover("prismatic", step, 3)
    engine.set_parameter("link_mass", "m::w", [[0.1], [1.0], [40.0]])
    engine.joints["m::j"].set_velocity([[2.8]] * 3)
    passed, back = passed_and_back(engine, 0.3)
    np.testing.assert_allclose(passed, passed[0], rtol=1e-3)
    assert (passed < 2.8 * step * 1.001).all()
    assert (back < BACK * 2.8).all()


@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
@pytest.mark.parametrize("count", [2, 4, 6])
def test_a_chain_thrown_into_its_stops_loses_its_energy_there(count, step):
    """The frames of the links are at their centres, so that motions are those of the masses."""
    links, joints = [], []
    for i in range(count):
        inertial = Inertial(1.0, Pose(), Inertia(0.001, 0.008, 0.008))
        links.append(Link(f"l{i}", pose=Pose(x=0.3 * i + 0.15), inertial=inertial))
        axes = (JointAxis(Y, lower=-0.3, upper=0.3),)
        parent = f"l{i - 1}" if i else "world"
        joints.append(Joint(f"j{i}", "revolute", parent, f"l{i}", pose=Pose(x=-0.15), axes=axes))
    model = Model("m", links=tuple(links), joints=tuple(joints))
    engine = make_engine("mujoco", scenes.world(model, gravity=(0, 0, 0), step=step))
    names = [f"m::j{i}" for i in range(count)]
    for name in names:
        engine.joints[name].set_velocity(1.0)
    first, passed, fastest = _energy(engine, links), 0.0, 0.0
    for _ in range(round(1.0 / step)):
        engine.step()
        assert _energy(engine, links) < 1.001 * first
        moves = [engine.joints[name] for name in names]
        passed = max(passed, *(abs(joint.position()[0, 0]) - 0.3 for joint in moves))
        fastest = max(fastest, *(abs(joint.velocity()[0, 0]) for joint in moves))
    assert passed < fastest * step * 1.001
    assert _energy(engine, links) < 0.02 * first


def _energy(engine, links):
    motions = [engine.links[f"m::{link.name}"].motion() for link in links]
    return sum(
        0.5 * motion.linear[0] @ motion.linear[0] + 0.004 * motion.angular[0, 1] ** 2
        for motion in motions
    )
