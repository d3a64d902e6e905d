"""Wind against the closed form of a linear drag."""

import math
from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Parameters,
    Plugin,
    Pose,
)
from gazelle.engines import make_engine


def windy(model, wind=(4.0, 0.0, 0.0), nworld=1, gravity=(0, 0, 0), **changes):
    world = replace(scenes.world(model, gravity=gravity), wind=wind, **changes)
    return make_engine("mujoco", world, nworld)


def floating(enable=True, whole=False, centre=(0.0, 0.0, 0.0)):
    inertial = Inertial(3.0, Pose(*centre), Inertia(0.1, 0.1, 0.1))
    link = Link("link", inertial=inertial, enable_wind=enable)
    return Model("leaf", links=(link,), enable_wind=whole)


def test_a_floating_body_takes_on_the_speed_of_the_wind_in_time():
    engine = windy(floating())
    engine.step(1500)
    expected = 4.0 * (1.0 - math.exp(-1.5))
    assert engine.links["leaf::link"].motion().linear[0, 0] == pytest.approx(expected, rel=1e-3)
    np.testing.assert_allclose(engine.links["leaf::link"].motion().angular, 0.0, atol=1e-12)


def test_the_strength_of_the_plugin_counts():
    settings = Parameters(
        "plugin", children=(Parameters("force_approximation_scaling_factor", "0.25"),)
    )
    engine = windy(floating(), plugins=(Plugin("wind", "libWindPlugin.so", settings),))
    engine.step(1000)
    expected = 4.0 * (1.0 - math.exp(-0.25))
    assert engine.links["leaf::link"].motion().linear[0, 0] == pytest.approx(expected, rel=1e-3)


def test_only_links_that_let_it_are_blown():
    for model, blown in (
        (floating(enable=False), False),
        (floating(enable=False, whole=True), True),
        (floating(), True),
    ):
        engine = windy(model)
        engine.step(10)
        assert (engine.links["leaf::link"].motion().linear[0, 0] > 0.0) == blown


def test_without_wind_the_air_does_not_brake_either():
    engine = windy(floating(), wind=(0.0, 0.0, 0.0))
    engine.models["leaf"].set_motion((2.0, 0, 0), (0, 0, 0))
    engine.step(500)
    assert engine.links["leaf::link"].motion().linear[0, 0] == pytest.approx(2.0, abs=1e-12)


def test_a_pendulum_leans_into_the_wind_by_the_ratio_of_the_forces():
    bob = Inertial(1.0, Pose(z=-1.0), Inertia(0.01, 0.01, 0.01))
    axis = JointAxis((0.0, 1.0, 0.0), damping=2.0)
    model = Model(
        "p",
        links=(Link("bob", inertial=bob, enable_wind=True),),
        joints=(Joint("j", "revolute", "world", "bob", axes=(axis,)),),
    )
    engine = windy(model, wind=(3.0, 0.0, 0.0), gravity=(0, 0, -9.8))
    engine.step(8000)
    # a wind along x lifts the bob towards x: a negative turn about y
    assert engine.joints["p::j"].position()[0, 0] == pytest.approx(-math.atan2(3.0, 9.8), rel=1e-3)


def test_the_wind_adds_to_pushes_and_leaves_no_trace_in_the_state():
    engine = windy(floating())
    engine.links["leaf::link"].set_wrench((-12.0, 0, 0), (0, 0, 0))  # as strong as the wind
    engine.step(100)
    assert engine.links["leaf::link"].motion().linear[0, 0] == pytest.approx(0.0, abs=1e-12)
    other = windy(floating())
    other.restore(engine.snapshot())
    engine.step(3)
    other.step(1)
    other.step(2)
    np.testing.assert_array_equal(engine.snapshot(), other.snapshot())


def test_wind_can_change_in_a_run_and_worlds_keep_their_own_masses():
    engine = windy(floating(), nworld=2)
    engine.set_parameter("link_mass", "leaf::link", [[1.0], [9.0]])
    engine.update_world(replace(engine.world, wind=(0.0, 2.0, 0.0)))
    engine.step(1000)
    speed = engine.links["leaf::link"].motion().linear
    np.testing.assert_allclose(speed[:, 1], 2.0 * (1.0 - math.exp(-1.0)), rtol=1e-3)
    np.testing.assert_allclose(speed[:, 0], 0.0, atol=1e-12)


def test_what_feels_the_wind_accelerates_at_once():
    engine = windy(floating(centre=(0.2, 0.0, 0.0)))
    assert engine.links["leaf::link"].acceleration().linear[0, 0] == pytest.approx(4.0, rel=1e-9)
