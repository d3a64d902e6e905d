"""Stops, springs, damping and friction of joints against closed forms."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Collision,
    Contact,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    JointPhysics,
    Link,
    Model,
    Pose,
    Sphere,
    Surface,
)
from gazelle.engines import make_engine

Y = (0.0, 1.0, 0.0)


def wheel(moment=0.02, mass=1.0, kind="revolute", nworld=1, step=0.001, terms=None, **axis):
    links = (Link("w", inertial=Inertial(mass, Pose(), Inertia(moment, moment, moment))),)
    joint = Joint(
        "j", kind, "world", "w", axes=(JointAxis(Y, **axis),), physics=terms or JointPhysics()
    )
    world = scenes.world(Model("m", links=links, joints=(joint,)), gravity=(0, 0, 0), step=step)
    return make_engine("mujoco", world, nworld)


def angle(engine):
    return engine.joints["m::j"].position()[:, 0]


@pytest.mark.parametrize(
    ("stiffness", "dissipation", "step"),
    [  # 200 is too stiff for steps of 0.004: it is rigid then
        (20.0, 1.0, 0.001), (20.0, 1.0, 0.004), (200.0, 0.5, 0.001), (5.0, 0.1, 0.001), (5.0, 0.1, 0.004),
    ],
)  # fmt: skip
def test_a_soft_stop_gives_way_by_torque_over_stiffness(stiffness, dissipation, step):
    engine = wheel(lower=-0.5, upper=0.5, stiffness=stiffness, dissipation=dissipation, step=step)
    engine.joints["m::j"].set_effort(2.0)
    engine.step(round(8.0 / step))
    assert angle(engine)[0] - 0.5 == pytest.approx(2.0 / stiffness, rel=0.05)
    engine.joints["m::j"].set_effort(-2.0)
    engine.step(round(8.0 / step))
    assert -0.5 - angle(engine)[0] == pytest.approx(2.0 / stiffness, rel=0.05)


def test_a_soft_stop_of_an_arm_gives_way_the_same_wherever_the_load_is():
    """Two links: the inertia at the shoulder changes by a factor of ten with the elbow."""
    upper = Link("u", inertial=Inertial(0.5, Pose(), Inertia(0.01, 0.01, 0.01)))
    fore = Link("f", pose=Pose(x=0.5), inertial=Inertial(1.0, Pose(0.4), Inertia(0.01, 0.01, 0.01)))
    joints = (
        Joint(
            "j",
            "revolute",
            "world",
            "u",
            axes=(JointAxis(Y, lower=-1.0, upper=0.2, stiffness=50.0, dissipation=3.0),),
        ),
        Joint("e", "revolute", "u", "f", axes=(JointAxis(Y, friction=50.0),)),
    )
    model = Model("m", links=(upper, fore), joints=joints)
    for bend in (0.0, 2.6):
        engine = make_engine("mujoco", scenes.world(model, gravity=(0, 0, 0)))
        engine.joints["m::e"].set_position(bend)
        engine.joints["m::j"].set_effort(4.0)
        engine.step(8000)
        assert angle(engine)[0] - 0.2 == pytest.approx(4.0 / 50.0, rel=0.05)


@pytest.mark.parametrize(("erp", "cfm"), [(0.2, 0.5), (0.8, 2.0), (0.2, 0.1)])
def test_a_stop_gives_way_by_h_cfm_torque_over_erp_as_odes_terms_say(erp, cfm):
    terms = JointPhysics(stop_erp=erp, stop_cfm=cfm)
    engine = wheel(lower=-0.5, upper=0.5, terms=terms)
    engine.joints["m::j"].set_effort(1.0)
    engine.step(10_000)
    assert angle(engine)[0] - 0.5 == pytest.approx(0.001 * cfm / erp, rel=0.05)
    own = wheel(lower=-0.5, upper=0.5, terms=terms, stiffness=50.0, dissipation=1.0)
    own.joints["m::j"].set_effort(1.0)
    own.step(10_000)
    assert angle(own)[0] - 0.5 == pytest.approx(1.0 / 50.0, rel=0.05)


def test_sdf_default_stops_do_not_give():
    engine = wheel(lower=-0.5, upper=0.5)
    engine.joints["m::j"].set_effort(2.0)
    engine.step(2000)
    assert angle(engine)[0] == pytest.approx(0.5, abs=2e-3)


def test_a_soft_stop_swings_at_its_own_frequency_and_loses_what_it_dissipates():
    moment, stiffness = 0.02, 20.0
    engine = wheel(moment, lower=-3.0, upper=0.0, stiffness=stiffness, dissipation=0.0)
    engine.joints["m::j"].set_velocity(1.0)
    half = math.pi * math.sqrt(moment / stiffness)
    steps = 0
    while angle(engine)[0] >= 0.0 and steps < 1000:
        engine.step()
        steps += 1
    assert steps * 0.001 == pytest.approx(half, rel=0.05)


def test_a_spring_holds_against_an_effort_at_reference_plus_effort_over_stiffness():
    engine = wheel(spring_stiffness=8.0, spring_reference=0.3, damping=0.4)
    engine.joints["m::j"].set_effort(1.6)
    engine.step(4000)
    assert angle(engine)[0] == pytest.approx(0.3 + 1.6 / 8.0, rel=1e-4)


def test_a_spring_swings_with_its_period():
    engine = wheel(0.02, kind="continuous", spring_stiffness=2.0)
    engine.joints["m::j"].set_position(0.5)
    period = 2.0 * math.pi * math.sqrt(0.02 / 2.0)
    engine.step(round(period / 2 / 0.001))
    assert angle(engine)[0] == pytest.approx(-0.5, rel=1e-3)


def test_damping_slows_exponentially():
    engine = wheel(0.02, kind="continuous", damping=0.05)
    engine.joints["m::j"].set_velocity(3.0)
    engine.step(400)
    expected = 3.0 * math.exp(-0.05 / 0.02 * 0.4)
    assert engine.joints["m::j"].velocity()[0, 0] == pytest.approx(expected, rel=2e-3)


def test_friction_holds_below_and_slows_evenly_above():
    engine = wheel(0.02, kind="continuous", nworld=2, friction=0.1)
    engine.joints["m::j"].set_effort([[0.09], [0.14]])
    engine.step(1000)
    speed = engine.joints["m::j"].velocity()[:, 0]
    assert abs(speed[0]) < 1e-6
    assert speed[1] == pytest.approx(0.04 / 0.02, rel=1e-6)
    engine.joints["m::j"].set_effort(np.zeros((2, 1)))
    engine.step(200)
    assert engine.joints["m::j"].velocity()[1, 0] == pytest.approx(speed[1] - 5.0 * 0.2, rel=0.02)


@pytest.mark.parametrize("step", [0.0005, 0.002, 0.005])
@pytest.mark.parametrize("kind", ["revolute", "prismatic"])
def test_what_friction_holds_does_not_creep_in_a_minute(step, kind):
    friction = 5.0 * 9.8 * 1.001
    along = (0.0, 0.0, 1.0) if kind == "prismatic" else Y
    inertial = Inertial(5.0, Pose(x=1.0), Inertia(0.01, 0.01, 0.01))
    joint = Joint("j", kind, "world", "arm", axes=(JointAxis(along, friction=friction),))
    model = Model("m", links=(Link("arm", inertial=inertial),), joints=(joint,))
    engine = make_engine("mujoco", scenes.world(model, step=step))
    engine.step(round(5.0 / step))
    assert abs(engine.joints["m::j"].position()[0, 0]) * 12.0 < 1e-3


def test_worlds_with_inertias_of_their_own_have_the_same_stops():
    engine = wheel(0.02, nworld=3, lower=-0.5, upper=0.5, stiffness=20.0)
    tensors = [[m, m, m, 0.0, 0.0, 0.0] for m in (0.02, 0.04, 0.3)]
    engine.set_parameter("link_inertia", "m::w", tensors)
    engine.spawn(scenes.ball(pose=Pose(x=5.0)))  # compiled anew, the inertias still their own
    engine.joints["m::j"].set_effort(2.0)
    engine.step(12000)
    np.testing.assert_allclose(angle(engine) - 0.5, 0.1, rtol=0.02)


def test_worlds_with_masses_of_their_own_sink_by_their_own_weight_over_kp():
    soft = Surface(Friction(1.0, 1.0), Contact(kp=2000.0, kd=40.0))
    link = Link(
        "link",
        inertial=Inertial(2.0, inertia=Inertia(0.02, 0.02, 0.02)),
        collisions=(Collision("c", Sphere(0.1), surface=soft),),
    )
    model = Model("ball", pose=Pose(z=0.1), links=(link,))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), model), 2)
    engine.set_parameter("link_mass", "ball::link", [[2.0], [5.0]])
    engine.step(4000)
    depth = 0.1 - engine.links["ball::link"].placement().position[:, 2]
    np.testing.assert_allclose(depth, np.array([2.0, 5.0]) * 9.8 / 2000.0, rtol=0.05)


def test_a_joint_that_is_locked_by_equal_limits_does_not_move():
    engine = wheel(lower=0.2, upper=0.2)
    engine.joints["m::j"].set_effort(0.5)
    engine.step(1000)
    assert angle(engine)[0] == pytest.approx(0.2, abs=2e-3)
