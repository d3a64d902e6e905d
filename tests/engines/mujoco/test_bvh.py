"""Optimisations of steps change no bit of the result."""

import mujoco
import numpy as np
import pytest
import scenes
from mujoco.batch import Batch

import gazelle
from gazelle.description import Box, Collision, Cylinder, Link, Model, Pose, Sphere
from gazelle.engines import make_engine
from gazelle.engines.mujoco.compiler import spec
from gazelle.engines.mujoco.compiler.options import PASSIVE_OFF
from gazelle.geometry.bounding_volumes import tighten_hierarchies


def heap():
    """Return free bodies of several shapes each that fall among static ones, on a floor."""
    rng = np.random.default_rng(3)
    shapes = (Box((0.3, 0.2, 0.1)), Sphere(0.1), Cylinder(0.1, 0.3))
    models = [scenes.ground()]
    for i in range(30):
        at = Pose(*rng.uniform(-1.5, 1.5, 2), rng.uniform(0.0, 0.3), yaw=rng.uniform(0, 3))
        link = Link("l", collisions=(Collision("c", shapes[i % 3]),))
        models.append(Model(f"static{i}", static=True, pose=at, links=(link,)))
    for i in range(6):
        at = Pose(*rng.uniform(-1.0, 1.0, 2), 1.0 + 0.5 * i, roll=rng.uniform(0, 3))
        parts = [
            Collision(f"c{k}", shapes[(i + k) % 3], pose=Pose(0.15 * k, 0.1 * k)) for k in range(4)
        ]
        link = Link("l", inertial=scenes.box("b").links[0].inertial, collisions=tuple(parts))
        models.append(Model(f"loose{i}", pose=at, links=(link,)))
    return scenes.world(*models)


def after(world, steps, drive=None):
    sim = gazelle.Simulation(world, time_step=0.001)
    if drive is not None:
        robot = sim.spawn(drive, name="robot", pose=Pose(x=-1.6, y=-0.5))
        robot.inputs["cmd_vel"].send(linear=0.3, angular=0.5)
    sim.step(steps)
    return sim.engine.peek().copy()


@pytest.mark.parametrize(
    ("world", "drive"), [(heap(), None), ("turtlebot3_world", "turtlebot3_burger")]
)
def test_contacts_are_those_that_mujocos_own_trees_find(world, drive, monkeypatch):
    ours = after(world, 1500, drive)
    monkeypatch.setattr(spec, "tighten_hierarchies", lambda model, seen: None)
    np.testing.assert_array_equal(ours, after(world, 1500, drive))


def test_the_trees_are_other_ones(monkeypatch):
    ours = make_engine("mujoco", heap()).running.batch.model
    monkeypatch.setattr(spec, "tighten_hierarchies", lambda model, seen: None)
    theirs = make_engine("mujoco", heap()).running.batch.model
    assert (ours.bvh_child != theirs.bvh_child).any()


def test_rays_meet_the_same_triangles_of_a_mesh():
    scene = mujoco.MjSpec()
    scene.add_mesh(name="mesh").make_supertorus(64, 0.4, 1.0, 1.0)
    scene.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, meshname="mesh")
    model = scene.compile()
    theirs = model.bvh_child.copy()
    chance = np.random.default_rng(1)
    origins, ways = chance.uniform(-2.0, 2.0, (2, 500, 3))
    ways /= np.linalg.norm(ways, axis=1)[:, None]
    before = Batch(model, 1).ray(origins, ways, normal=True)
    tighten_hierarchies(model, np.array([False]))
    assert (model.bvh_child == theirs).all()
    tighten_hierarchies(model, np.array([True]))
    assert (model.bvh_child != theirs).any()
    assert (before[0] >= 0.0).sum() > 50
    for old, new in zip(before, Batch(model, 1).ray(origins, ways, normal=True), strict=True):
        np.testing.assert_array_equal(old, new)


def test_idle_forces_are_left_out_and_nothing_is_different(monkeypatch):
    ours = after("turtlebot3_world", 500, "turtlebot3_burger")
    monkeypatch.setattr(spec, "skip_idle_forces", lambda model: None)
    np.testing.assert_array_equal(ours, after("turtlebot3_world", 500, "turtlebot3_burger"))


@pytest.mark.parametrize(
    "model", ["spring", "damper", "no gravity"], ids=lambda name: name.replace(" ", "_")
)
def test_forces_that_act_are_not_left_out(model):
    falling = mujoco.MjSpec()
    body = falling.worldbody.add_body()
    body.add_joint(
        type=mujoco.mjtJoint.mjJNT_SLIDE,
        stiffness=[float(model == "spring"), 0.0, 0.0],
        damping=[float(model == "damper"), 0.0, 0.0],
    )
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.1, 0.0, 0.0])
    body.gravcomp = float(model == "no gravity")
    made = falling.compile()
    spec.skip_idle_forces(made)
    assert not made.opt.disableflags & PASSIVE_OFF


def test_gravity_of_a_link_is_taken_away_while_it_falls():
    """Where no force was to act, one acts from now on, in one world of two."""
    engine = make_engine("mujoco", scenes.world(scenes.box(pose=Pose(z=9.0))), 2)
    assert engine.running.batch.model.opt.disableflags & PASSIVE_OFF
    engine.step(100)
    engine.set_parameter("link_gravity", engine.links.names[0], [[0.0], [1.0]])
    speed = engine.links[engine.links.names[0]].motion().linear[:, 2].copy()
    engine.step(100)
    gained = engine.links[engine.links.names[0]].motion().linear[:, 2] - speed
    np.testing.assert_allclose(gained, [0.0, -0.98], atol=1e-9)
