"""Damped joints: Euler's method takes their forces anew, so the solver has to find forces well."""

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Box,
    Collision,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
)
from gazelle.engines import make_engine


def door(damping, mass, friction):
    """A door in a frame that stands on the ground, and that a joint without play holds, too."""

    def post(name, y):
        shape = Box((0.05, 0.07, 2.0))
        return Collision(name, shape, pose=Pose(y=y, z=1.0), surface=scenes.rubber(1.0))

    frame = Link(
        "frame",
        inertial=Inertial(1.0, inertia=Inertia(1.0, 1.0, 1.0)),
        collisions=(post("left", -0.48), post("right", 0.48)),
    )
    moments = Inertia(0.34 * mass, 0.42 * mass, 0.07 * mass)
    wing = Link("wing", pose=Pose(0.03, -0.4, 1.0), inertial=Inertial(mass, Pose(y=0.45), moments))
    handle = Link("handle", pose=Pose(0.05, 0.3, 1.0), inertial=Inertial(1.0))
    fixed = JointAxis((0.0, 1.0, 0.0), lower=0.0, upper=0.0, damping=damping)
    hinge = JointAxis((0.0, 0.0, 1.0), 0.0, 1.58, damping=damping, friction=friction)
    knob = JointAxis((1.0, 0.0, 0.0), 0.0, 1.58, damping=damping, friction=10.0 * friction)
    joints = (
        Joint("ground_joint", "revolute", "world", "frame", axes=(fixed,)),
        Joint("hinge", "revolute", "frame", "wing", axes=(hinge,)),
        Joint("knob", "revolute", "wing", "handle", axes=(knob,)),
    )
    return Model("door", links=(frame, wing, handle), joints=joints)


def fastest(engine, seconds):
    """The fastest that any joint turns at any step [rad/s]."""
    engine.step(round(2.0 / engine.time_step))
    most = 0.0
    for _ in range(round(seconds / engine.time_step)):
        engine.step()
        most = max(most, *(float(abs(engine.joint_velocity(j)).max()) for j in engine.joint_names))
    return most


@pytest.mark.parametrize("mass", [1.0, 40.0, 400.0])
@pytest.mark.parametrize("damping", [0.1, 1.0, 10.0])
def test_what_stands_on_damped_joints_stands_still(damping, mass):
    engine = make_engine("mujoco", scenes.world(scenes.ground(), door(damping, mass, 1.0)))
    assert fastest(engine, 5.0) < 0.01


def test_so_it_does_if_joints_are_damped_at_run_time():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), door(0.0, 40.0, 1.0)), nworld=2)
    engine.step(100)
    before = engine.snapshot()
    for joint in engine.joint_names:
        engine.set_parameter("joint_damping", joint, [[0.0], [1.0]])
    np.testing.assert_array_equal(engine.snapshot()[:, : before.shape[1]], before)
    assert fastest(engine, 5.0) < 0.01
