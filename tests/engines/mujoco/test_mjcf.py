"""A world exported as MJCF is what the engine runs: to the last bit, without Gazelle."""

import mujoco
import numpy as np
import pytest

from gazelle import formats
from gazelle.description import (
    Bounce,
    Box,
    Collision,
    Inertial,
    Link,
    Material,
    Model,
    Pose,
    Surface,
    Visual,
    World,
)
from gazelle.engines.mujoco import MujocoEngine, to_mjcf
from gazelle.errors import EngineError, EngineWarning

RED = Material(diffuse=(1.0, 0.0, 0.0, 1.0))
pytestmark = pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")

# What decides how a world moves.
FIELDS = (
    "body_pos", "body_quat", "body_ipos", "body_iquat", "body_mass", "body_inertia",
    "body_gravcomp", "jnt_type", "jnt_pos", "jnt_axis", "jnt_range", "jnt_stiffness",
    "jnt_solref", "jnt_solimp", "dof_damping", "dof_frictionloss", "dof_armature",
    "pair_solref", "pair_solimp", "pair_friction", "exclude_signature", "eq_data", "qpos0",
)  # fmt: skip


def box_world(**visual):
    shown = (Visual("look", Box((0.5, 0.5, 0.5)), **visual),)
    box = Link("l", Pose(), Inertial(), (Collision("c", Box((1.0, 1.0, 1.0))),), shown)
    floor = Link("f", collisions=(Collision("c", Box((9.0, 9.0, 0.2))),))
    return World(
        models=(
            Model("floor", static=True, links=(floor,)),
            Model("box", Pose(z=2.0, roll=0.3, yaw=1 / 3), links=(box,)),
        )
    )


@pytest.mark.parametrize("name", ["turtlebot3_burger", "turtlebot3_stage_4", "turtlebot3_waffle"])
def test_it_steps_as_the_engine_does(name):
    world = formats.load(name)
    engine = MujocoEngine(world)
    model = mujoco.MjModel.from_xml_string(to_mjcf(world))
    data = mujoco.MjData(model)
    engine.step(200)
    for _ in range(200):
        mujoco.mj_step(model, data)
    mujoco.mj_kinematics(model, data)
    moving = 0
    for link in engine.links.names:
        body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, link)
        if body >= 0:  # links of static models are part of MuJoCo's world
            moving += 1
            np.testing.assert_array_equal(
                engine.links[link].placement().position[0], data.xpos[body], link
            )
    assert moving


def test_every_number_is_the_one_compiled():
    from gazelle.engines.mujoco.compiler.spec import CompilerInput, compile_world

    world = box_world()
    ours = compile_world(CompilerInput(world, 0.001)).model
    theirs = mujoco.MjModel.from_xml_string(to_mjcf(world, visuals=False))
    for field in FIELDS:
        np.testing.assert_array_equal(getattr(theirs, field), getattr(ours, field), field)
    assert theirs.opt.timestep == ours.opt.timestep
    assert theirs.opt.iterations == ours.opt.iterations
    assert theirs.ngeom == ours.ngeom


def test_visuals_show_and_never_collide():
    world = box_world(material=RED, transparency=0.25)
    model = mujoco.MjModel.from_xml_string(to_mjcf(world))
    shown = np.flatnonzero(model.geom_group == 1)
    assert len(shown) == 1
    assert not model.geom_contype[shown].any()
    assert not model.geom_conaffinity[shown].any()
    np.testing.assert_allclose(model.geom_rgba[shown[0]], (1.0, 0.0, 0.0, 0.75))


def test_the_time_step_can_be_chosen():
    model = mujoco.MjModel.from_xml_string(to_mjcf(box_world(), time_step=0.004))
    assert model.opt.timestep == 0.004


def test_digits_are_back_to_usual_afterwards():
    to_mjcf(box_world())
    spec = mujoco.MjSpec()
    spec.worldbody.add_body(pos=[1 / 3, 0, 0])
    spec.compile()
    assert '"0.333333 0 0"' in spec.to_xml()


def test_what_cannot_be_simulated_is_an_error():
    heavy = Link("l", inertial=Inertial(-1.0))
    with pytest.raises(EngineError, match="mass"):
        to_mjcf(World(models=(Model("m", links=(heavy,)),)))


def test_what_mujoco_alone_does_not_know_is_said():
    surface = Surface(bounce=Bounce(0.5, 0.01))
    box = Link("l", collisions=(Collision("c", Box((1.0, 1.0, 1.0)), surface=surface),))
    floor = Model("floor", static=True, links=(box,))
    world = World(models=(floor, Model("box", Pose(z=2.0), links=(box,))))
    with pytest.warns(EngineWarning, match="without Gazelle bounces are less exact"):
        to_mjcf(world)
