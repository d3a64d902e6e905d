"""Links on joints in the plane, against MuJoCo's kinematics."""

from dataclasses import replace

import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.engines import make_engine
from gazelle.rotations import turns

SKEW, ACROSS = (0.48, 0.6, 0.64), (0.8, 0.0, -0.6)
MASS = Inertial(1.0, inertia=Inertia(0.1, 0.1, 0.1))
FRAME = Pose(0.05, -0.1, 0.15, 0.2, 0.3, 0.4)
AXES = {
    "revolute": (SKEW,),
    "continuous": (SKEW,),
    "prismatic": (SKEW,),
    "universal": ((0.0, 0.0, 1.0), ACROSS),
    "revolute2": (SKEW, ACROSS),
}


def chain(kind, other, **model):
    """Return two joints, one on the other, and a link that is fixed to the last."""
    joints = (
        Joint("first", kind, "world", "lower", FRAME, axes=tuple(map(JointAxis, AXES[kind]))),
        Joint("second", other, "lower", "upper", FRAME, axes=tuple(map(JointAxis, AXES[other]))),
        Joint("weld", "fixed", "upper", "tip"),
    )
    poses = {"lower": Pose(0.1, 0.2, 0.3, 0.4, -0.3, 0.2), "upper": Pose(0.4, -0.1, 0.5, yaw=2.0)}
    poses["tip"] = poses["upper"] * Pose(0.2, 0.1, 0.3, 0.5, 0.6, 0.7)
    links = tuple(Link(name, pose, inertial=MASS) for name, pose in poses.items())
    return Model("robot", links=links, joints=joints, **model)


@pytest.mark.parametrize("other", ["revolute", "prismatic", "universal"])
@pytest.mark.parametrize("kind", AXES)
def test_links_are_placed_and_move_as_in_mujoco(kind, other):
    model = chain(kind, other, pose=Pose(1.0, 2.0, 0.5, yaw=0.7))
    world = scenes.world(model, gravity=(0.0, 0.0, 0.0))
    space, plane = (make_engine(name, world, 3) for name in ("mujoco", "planar"))
    random = np.random.default_rng(7)
    for joint, axes in (("first", AXES[kind]), ("second", AXES[other])):
        position, velocity = random.uniform(-2.0, 2.0, (2, 3, len(axes)))
        for engine in (space, plane):
            engine.joints[f"robot::{joint}"].set_position(position)
            engine.joints[f"robot::{joint}"].set_velocity(velocity)
    names = tuple(f"robot::{link}" for link in ("lower", "upper", "tip"))
    for number, name in enumerate(names):
        expected, found = (engine.links[name].placement() for engine in (space, plane))
        np.testing.assert_allclose(found.position, expected.position, atol=1e-12)
        np.testing.assert_allclose(turns(found.quaternion), turns(expected.quaternion), atol=1e-12)
        rates, wanted = plane.links[name].motion(), space.links[name].motion()
        np.testing.assert_allclose(rates.linear, wanted.linear, atol=1e-11)
        np.testing.assert_allclose(rates.angular, wanted.angular, atol=1e-11)
        several = plane.links[names]
        assert (several.placement().position[:, number] == found.position).all()
        assert (several.motion().linear[:, number] == rates.linear).all()


def test_joints_of_a_model_that_stands_do_not_move_its_links():
    model = replace(chain("revolute", "prismatic"), static=True)
    engine = make_engine("planar", scenes.world(model), 1)
    assert not list(engine.joints)
    found = engine.links["robot::tip"].placement()
    np.testing.assert_allclose(found.position[0], model.links[-1].pose.position, atol=1e-12)
