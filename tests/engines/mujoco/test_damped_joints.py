"""Damped joints: implicit Euler, constraints included; what stands and grips on them is still."""

from dataclasses import replace

import grips
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
    """Return a door in a frame on the ground, also held by a joint without play."""

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
    """Return the fastest rate of any joint at any step [rad/s]."""
    engine.step(round(2.0 / engine.time_step))
    most = 0.0
    for _ in range(round(seconds / engine.time_step)):
        engine.step()
        most = max(
            most, *(float(abs(engine.joints[j].velocity()).max()) for j in engine.joints.names)
        )
    return most


@pytest.mark.parametrize("mass", [1.0, 40.0, 400.0])
@pytest.mark.parametrize("damping", [0.1, 1.0, 10.0])
def test_what_stands_on_damped_joints_stands_still(damping, mass):
    engine = make_engine("mujoco", scenes.world(scenes.ground(), door(damping, mass, 1.0)))
    assert fastest(engine, 5.0) < 0.01


@pytest.mark.long
def test_so_it_does_if_joints_are_damped_at_run_time():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), door(0.0, 40.0, 1.0)), nworld=2)
    engine.step(100)
    before = engine.snapshot()
    for joint in engine.joints.names:
        engine.set_parameter("joint_damping", joint, [[0.0], [1.0]])
    np.testing.assert_array_equal(engine.snapshot()[:, : before.shape[1]], before)
    assert fastest(engine, 5.0) < 0.01


def slider(damping, mass):
    """Return a body on a slide."""
    inertial = Inertial(mass, inertia=Inertia(0.01, 0.01, 0.01))
    axis = JointAxis((1.0, 0.0, 0.0), damping=damping)
    base = Link("base", inertial=Inertial(1.0, inertia=Inertia(0.1, 0.1, 0.1)))
    links = (base, Link("body", inertial=inertial))
    joints = (
        Joint("hold", "fixed", "world", "base"),
        Joint("slide", "prismatic", "base", "body", axes=(axis,)),
    )
    return Model("slider", links=links, joints=joints)


@pytest.mark.parametrize("changed", [False, True])
@pytest.mark.parametrize("damping", [0.5, 100.0, 1e5])
def test_damping_is_implicit_euler(damping, changed):
    mass = 0.08
    engine = make_engine("mujoco", scenes.world(slider(0.0 if changed else damping, mass)))
    if changed:
        engine.set_parameter("joint_damping", "slider::slide", [damping])
    engine.joints["slider::slide"].set_velocity([1.0])
    engine.step(5)
    left = (mass / (mass + engine.time_step * damping)) ** 5
    assert engine.joints["slider::slide"].velocity()[0, 0] == pytest.approx(
        left, rel=1e-6, abs=1e-12
    )


def test_light_fingers_with_strong_dampers_hold_what_they_close_on():
    """Fetch's: 80 g, 100 N s/m; they push with 60 N each on a cube that stands on the ground."""
    model = grips.gripper()
    axes = [replace(joint.axes[0], damping=100.0) for joint in model.joints[1:]]
    joints = [replace(j, axes=(a,)) for j, a in zip(model.joints[1:], axes, strict=True)]
    low = [replace(link, pose=Pose(y=link.pose.y, z=0.03)) for link in model.links[1:]]
    hand = replace(model, links=(model.links[0], *low), joints=(model.joints[0], *joints))
    cube = scenes.solid("cube", Box((0.05, 0.05, 0.05)), mass=0.25, moments=(1e-4, 1e-4, 1e-4),
                        pose=Pose(z=0.025, yaw=0.02))  # fmt: skip
    engine = make_engine("mujoco", scenes.world(scenes.ground(), hand, cube))
    for name in ("left", "right"):
        engine.joints[f"g::{name}_joint"].set_effort([-60.0])
    where, fastest_m_s = engine.models["cube"].placement().position[0].copy(), 0.0
    for _ in range(1000):
        engine.step()
        now = engine.models["cube"].placement().position[0].copy()
        fastest_m_s = max(fastest_m_s, float(np.linalg.norm(now - where)) / engine.time_step)
        where = now
    assert fastest_m_s < 1.0
    assert where == pytest.approx((0.0, 0.0, 0.025), abs=0.01)
