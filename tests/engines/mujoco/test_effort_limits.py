"""Effort and velocity limits against mechanics and Gazebo classic's rule."""

import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.engines import make_engine

INERTIA = 0.5
X = (1.0, 0.0, 0.0)


def spinner(nworld=1, joint="continuous", **limits):
    """Return a flywheel on a hinge of the world, or a cart of 1 kg on a rail."""
    moments = Inertia(INERTIA, INERTIA, INERTIA)
    links = (Link("wheel", inertial=Inertial(1.0, Pose(), moments)),)
    axis = JointAxis(X if joint == "prismatic" else (0.0, 0.0, 1.0), **limits)
    model = Model("m", links=links, joints=(Joint("j", joint, "world", "wheel", axes=(axis,)),))
    return make_engine("mujoco", scenes.world(model, gravity=(0, 0, 0)), nworld)


def velocity(engine):
    return engine.joints["m::j"].velocity()[:, 0]


def test_an_effort_is_clamped_to_the_limit_in_both_directions():
    engine = spinner(2, effort=2.0)
    engine.joints["m::j"].set_effort([[5.0], [-5.0]])
    np.testing.assert_array_equal(engine.joints["m::j"].effort()[:, 0], [2.0, -2.0])
    engine.step(100)
    np.testing.assert_allclose(velocity(engine), [0.4, -0.4], rtol=1e-9)


def test_without_limits_nothing_is_clamped():
    engine = spinner()
    engine.joints["m::j"].set_effort(1e6)
    assert engine.joints["m::j"].effort()[0, 0] == 1e6


def test_an_effort_limit_of_zero_lets_no_effort_through():
    engine = spinner(effort=0.0)
    engine.joints["m::j"].set_effort(3.0)
    engine.step(10)
    assert velocity(engine)[0] == 0.0


@pytest.mark.parametrize("count", [1, 50])
def test_efforts_do_not_speed_up_what_is_faster_than_the_velocity_limit(count):
    engine = spinner(2, velocity=1.0)
    engine.joints["m::j"].set_effort([[5.0], [-5.0]])  # 10 rad/s² each way
    for _ in range(300 // count):
        engine.step(count)
    # the last push ends within one step's gain above the limit
    np.testing.assert_allclose(np.abs(velocity(engine)), 1.0, atol=0.011)
    np.testing.assert_array_equal(engine.joints["m::j"].effort()[:, 0], [5.0, -5.0])


def test_efforts_that_brake_act_at_any_speed():
    engine = spinner(velocity=1.0)
    engine.joints["m::j"].set_velocity(4.0)
    engine.joints["m::j"].set_effort(-5.0)
    engine.step(100)
    assert velocity(engine)[0] == pytest.approx(3.0, rel=1e-9)


def test_what_is_thrown_may_be_faster_than_its_limit():
    engine = spinner(velocity=1.0)
    engine.joints["m::j"].set_velocity(4.0)
    engine.step(100)
    assert velocity(engine)[0] == pytest.approx(4.0, rel=1e-9)
    engine.joints["m::j"].set_effort(5.0)
    engine.step(100)
    assert velocity(engine)[0] == pytest.approx(4.0, rel=1e-9)


def test_a_wheel_slowed_below_its_limit_is_pushed_again():
    engine = spinner(velocity=1.0)
    engine.joints["m::j"].set_effort(5.0)
    engine.links["m::wheel"].set_wrench((0, 0, 0), (0, 0, -2.0))
    engine.step(1000)
    assert velocity(engine)[0] == pytest.approx(1.0, abs=0.011)


def test_steps_taken_at_once_and_one_by_one_agree_to_the_bit():
    def run(count):
        engine = spinner(3, velocity=1.0, effort=4.0)
        engine.joints["m::j"].set_effort([[3.0], [0.0], [-9.0]])
        for _ in range(60 // count):
            engine.step(count)
        return engine.snapshot()

    np.testing.assert_array_equal(run(60), run(1))


def test_a_snapshot_keeps_what_is_commanded_and_goes_on_alike():
    engine, other = spinner(velocity=0.5), spinner(velocity=0.5)
    engine.joints["m::j"].set_effort(5.0)
    engine.step(80)
    other.restore(engine.snapshot())
    assert other.joints["m::j"].effort()[0, 0] == 5.0
    engine.step(50)
    other.step(50)
    np.testing.assert_array_equal(engine.snapshot(), other.snapshot())


def test_limits_hold_for_sliding_and_survive_a_spawn():
    engine = spinner(joint="prismatic", velocity=0.2, effort=3.0)
    engine.joints["m::j"].set_effort(100.0)
    engine.spawn(scenes.ball(pose=Pose(x=9.0)))
    engine.step(500)
    assert velocity(engine)[0] == pytest.approx(0.2, abs=0.004)
    assert engine.joints["m::j"].effort()[0, 0] == 3.0


def test_the_acceleration_and_the_wrench_are_those_that_will_be():
    engine = spinner(velocity=1.0)
    engine.joints["m::j"].set_velocity(2.0)
    engine.joints["m::j"].set_effort(5.0)
    np.testing.assert_allclose(engine.links["m::wheel"].acceleration().angular, 0.0, atol=1e-9)
    np.testing.assert_allclose(engine.joints["m::j"].wrench().torque, 0.0, atol=1e-9)
    engine.joints["m::j"].set_velocity(0.5)
    assert engine.links["m::wheel"].acceleration().angular[0, 2] == pytest.approx(10.0)
    assert engine.joints["m::j"].wrench().torque[0, 2] == pytest.approx(-5.0)
