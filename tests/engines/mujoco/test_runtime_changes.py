"""Links, joints and parameters changed in the middle of a run, against mechanics."""

from dataclasses import replace
from typing import Protocol

import numpy as np
import pytest
import scenes

from gazelle.description import (
    Box,
    Collision,
    Contact,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
    Surface,
)
from gazelle.engines import CHANGES, PARAMETERS, Engine, make_engine
from gazelle.errors import EngineError

READS = {
    "nworld",
    "time_step",
    "world",
    "links",
    "joints",
    "models",
    "range_kind",
    "range_table",
    "revision",
    "close",
    "contacts",
    "history",
    "parameter",
    "prepare",
    "peek",
    "snapshot",
    "update",
}
UP = (0.0, 0.0, 0.0, 1.0)


def make(*models, nworld=1, step=0.001, gravity=(0.0, 0.0, -9.8)):
    return make_engine("mujoco", scenes.world(*models, step=step, gravity=gravity), nworld)


def arm(**axis):
    """Return a rod of 1 kg on a vertical hinge that is held by the world."""
    rod = Inertial(1.0, Pose(x=0.5), Inertia(0.02, 0.03, 0.04))
    return Model(
        "arm",
        links=(Link("base", inertial=Inertial()), Link("rod", inertial=rod)),
        joints=(
            Joint("fix", "fixed", "world", "base"),
            Joint("hinge", "revolute", "base", "rod", axes=(JointAxis(**axis),)),
        ),
    )


def test_every_method_of_the_protocol_either_changes_something_or_reads():
    own = {name for name in vars(Engine) if not name.startswith("_")}
    own -= set(vars(Protocol))
    assert own == READS | set(CHANGES)


# -- laws --------------------------------------------------------------------------------


def test_a_new_time_step_keeps_every_state():
    engine = make(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(2.0, 0.0, 1.0)), nworld=2)
    engine.add_motor("burger::wheel_left_joint", 5.0)
    engine.joints["burger::wheel_left_joint"].set_motor_velocity(np.array([1.0, 3.0]))
    engine.step(100)
    before = engine.snapshot()
    profile = replace(engine.world.profile, max_step_size=0.004)
    engine.update_world(replace(engine.world, physics=(profile,)))
    assert engine.time_step == 0.004
    np.testing.assert_array_equal(engine.snapshot(), before)
    engine.step(10)


def test_gravity_can_change_in_flight():
    engine = make(scenes.ball(pose=Pose(z=10.0)))
    engine.step(500)
    engine.update_world(replace(engine.world, gravity=(0.0, 0.0, 1.0)))
    engine.step(1000)
    speed = engine.links["ball::link"].motion().linear[0, 2]
    assert speed == pytest.approx(-9.8 * 0.5 + 1.0 * 1.0, abs=1e-9)


def test_impossible_laws_change_nothing():
    engine = make(scenes.ball())
    with pytest.raises(EngineError, match="finite"):
        engine.update_world(replace(engine.world, gravity=(0.0, np.inf, 0.0)))
    profile = replace(engine.world.profile, max_step_size=0.0)
    with pytest.raises(EngineError, match="positive"):
        engine.update_world(replace(engine.world, physics=(profile,)))
    assert engine.world.gravity == (0.0, 0.0, -9.8)
    assert engine.time_step == 0.001


# -- fast and sleeping bodies --------------------------------------------------------------


@pytest.mark.parametrize("radius", [0.01, 0.02])
def test_a_small_ball_at_20_m_per_s_does_not_pass_a_wall_of_a_centimetre(radius):
    wall = scenes.box("wall", size=(0.01, 2.0, 2.0), static=True)
    starts = np.linspace(-0.30, -0.28, 11)
    engine = make(wall, scenes.ball(radius=radius), nworld=11, gravity=(0.0, 0.0, 0.0))
    places = np.zeros((11, 3))
    places[:, 0] = starts
    engine.models["ball"].set_placement(places, UP)
    engine.models["ball"].set_motion((20.0, 0.0, 0.0), np.zeros(3))
    farthest = np.full(11, -1.0)
    for _ in range(60):
        engine.step()
        farthest = np.maximum(farthest, engine.models["ball"].placement().position[:, 0])
    assert (farthest < 0.0).all()
    assert (engine.links["ball::link"].motion().linear[:, 0] <= 0.5).all()


def test_boxes_at_rest_fall_asleep_and_wake_when_hit():
    boxes = [scenes.box(f"box_{i}", pose=Pose(i * 0.5, 0.0, 0.1)) for i in range(20)]
    engine = make(scenes.ground(), *boxes)
    engine.step(1000)
    asleep = engine.running.batch.bind("tree_asleep")
    assert (asleep >= 0).all()
    engine.models["box_0"].set_motion((3.0, 0.0, 0.0), np.zeros(3))
    engine.step(300)
    assert engine.models["box_1"].placement().position[0, 0] > 0.51


def test_a_snapshot_of_sleepers_restores_the_exact_future():
    boxes = [scenes.box(f"box_{i}", pose=Pose(i * 0.5, 0.0, 0.1)) for i in range(20)]
    engine = make(scenes.ground(), *boxes, nworld=2)
    engine.step(400)
    saved = engine.snapshot()
    engine.step(100)
    future = engine.peek().copy()
    engine.restore(saved)
    engine.step(100)
    np.testing.assert_array_equal(engine.peek(), future)


# -- placing and pushing -----------------------------------------------------------------


def test_a_wrench_accelerates_the_centre_of_mass_and_turns_about_it():
    inertial = Inertial(2.0, Pose(x=0.3), Inertia(0.1, 0.2, 0.4))
    body = Model("b", links=(Link("l", inertial=inertial),))
    engine = make(body, nworld=3, gravity=(0.0, 0.0, 0.0))
    engine.links["b::l"].set_wrench(
        np.array([[0, 4.0, 0], [0, 0, 0]]), (0, 0, 0.8), np.array([0, 2])
    )
    engine.step(10)
    centre = engine.links["b::l"].centre()
    t = 0.010 * 0.011 / 2  # sum of semi-implicit steps
    np.testing.assert_allclose(centre[0], [0.3, 2.0 * t, 0.0], atol=1e-9)
    np.testing.assert_allclose(centre[1:], [[0.3, 0, 0]] * 2, atol=1e-8)
    spin = engine.links["b::l"].motion().angular
    np.testing.assert_allclose(spin[:, 2], [2.0 * 0.01, 0.0, 2.0 * 0.01], atol=1e-9)


def test_nothing_can_push_a_static_link():
    with pytest.raises(EngineError, match="no force can act on it"):
        make(scenes.ground()).links["ground_plane::link"].set_wrench((1, 0, 0), (0, 0, 0))


# -- holding -----------------------------------------------------------------------------


def test_attached_links_move_as_one_and_let_go_in_one_world_at_a_time():
    engine = make(
        scenes.box("a", pose=Pose(z=1.0)),
        scenes.box("b", pose=Pose(x=0.5, z=1.2, yaw=0.3)),
        nworld=2,
        gravity=(0.0, 0.0, 0.0),
    )
    engine.attach("a::link", "b::link")
    engine.links["a::link"].set_wrench((2.0, 0.0, 0.0), (0.0, 0.3, 0.0))
    engine.step(500)
    a, b = engine.links["a::link"].placement(), engine.links["b::link"].placement()
    gap = np.linalg.norm(b.position - a.position, axis=1)
    np.testing.assert_allclose(gap, np.hypot(0.5, 0.2), atol=1e-3)
    # Two bodies of 1 kg: the common centre of mass moves with F / 2.
    centre = (a.position + b.position)[:, 0] / 2 - 0.25
    np.testing.assert_allclose(centre, 0.5 * 1.0 * 0.5**2, rtol=0.01)
    engine.detach("a::link", "b::link", np.array([1]))
    engine.step(500)
    gap = np.linalg.norm(
        engine.links["b::link"].placement().position - engine.links["a::link"].placement().position,
        axis=1,
    )
    assert gap[0] == pytest.approx(np.hypot(0.5, 0.2), abs=1e-3)
    assert abs(gap[1] - gap[0]) > 0.05


def test_what_is_attached_to_a_static_link_hangs_there():
    engine = make(scenes.wall("wall", 0.0, 0.0, 0.0), scenes.box(pose=Pose(y=0.5, z=1.0)))
    engine.attach("wall::link", "box::link")
    engine.step(1000)
    np.testing.assert_allclose(
        engine.links["box::link"].placement().position[0], [0.0, 0.5, 1.0], atol=2e-3
    )
    engine.reset()
    engine.step(1000)
    assert engine.links["box::link"].placement().position[0, 2] < -3.0


def test_an_attachment_survives_a_spawn_to_the_bit():
    engine = make(scenes.box("a"), scenes.box("b", pose=Pose(x=1.0)), nworld=2)
    engine.attach("a::link", "b::link", np.array([0]))
    engine.step(50)
    before = engine.snapshot()
    engine.spawn(scenes.ball(pose=Pose(y=3.0)))
    engine.delete("ball")
    np.testing.assert_array_equal(engine.snapshot(), before)
    engine.step(50)
    gap = (
        engine.links["b::link"].placement().position - engine.links["a::link"].placement().position
    )
    assert gap[0, 0] == pytest.approx(1.0, abs=1e-3)


def test_detaching_what_was_never_attached_is_an_error():
    with pytest.raises(EngineError, match="never attached"):
        make(scenes.box("a"), scenes.box("b", pose=Pose(x=1.0))).detach("a::link", "b::link")


# -- parameters: world i behaves like a world with those values -----------------------------


def swing(engine, steps=700):
    engine.joints["arm::hinge"].set_velocity(1.0)
    engine.joints["arm::hinge"].set_effort(0.2)
    engine.step(steps)
    return engine.joints["arm::hinge"].position()[:, 0]


@pytest.mark.parametrize(
    ("kind", "field", "values"),
    [
        ("joint_damping", "damping", [0.0, 0.1, 0.7]),
        ("joint_friction", "friction", [0.0, 0.05, 0.3]),
        ("joint_upper", "upper", [np.inf, 0.3, 0.1]),
    ],
)
def test_joint_parameters_do_what_the_description_would(kind, field, values):
    engine = make(arm(), nworld=3)
    engine.set_parameter(kind, "arm::hinge", np.array(values)[:, None])
    found = swing(engine)
    single = [swing(make(arm(**{field: value})))[0] for value in values]
    np.testing.assert_allclose(found, single, rtol=1e-6, atol=1e-9)


def push(engine):
    engine.links["b::l"].set_wrench((3.0, 1.0, 0.0), (0.1, 0.2, 0.3))
    engine.step(400)
    place, motion = engine.links["b::l"].placement(), engine.links["b::l"].motion()
    return np.concatenate((place.position, motion.linear, motion.angular), axis=1)


def body(mass=1.0, centre=(0.0, 0.0, 0.0), inertia=(0.1, 0.2, 0.25, 0, 0, 0), gravity=True):
    inertial = Inertial(mass, Pose(*centre), Inertia(*inertia))
    return Model("b", links=(Link("l", inertial=inertial, gravity=gravity),))


@pytest.mark.parametrize(
    ("kind", "argument", "values"),
    [
        ("link_mass", "mass", [1.0, 0.5, 4.0]),
        ("link_centre", "centre", [(0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, -0.2, 0.3)]),
        (
            "link_inertia",
            "inertia",
            [(0.1, 0.2, 0.25, 0, 0, 0), (0.3, 0.3, 0.3, 0, 0, 0), (0.2, 0.2, 0.3, 0.05, 0.01, 0)],
        ),
        ("link_gravity", "gravity", [True, False, True]),
    ],
)
def test_link_parameters_do_what_the_description_would(kind, argument, values):
    engine = make(body(), nworld=3)
    engine.step(10)
    engine.reset()
    engine.set_parameter(kind, "b::l", np.array(values, float).reshape(3, -1))
    single = [push(make(body(**{argument: value})))[0] for value in values]
    np.testing.assert_allclose(push(engine), single, rtol=1e-7, atol=1e-9)


def test_friction_of_each_world_decides_how_far_a_block_slides():
    mu = np.array([0.1, 0.2, 0.4])
    block = scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=0.05), mu=1.0)
    engine = make(scenes.ground(), block, nworld=3)
    engine.set_parameter("collision_friction", "box::link::c", mu[:, None])
    engine.step(300)
    start = engine.models["box"].placement().position[:, 0]
    engine.models["box"].set_motion((1.0, 0.0, 0.0), np.zeros(3))
    engine.step(1500)
    slid = engine.models["box"].placement().position[:, 0] - start
    np.testing.assert_allclose(slid, 1.0 / (2 * mu * 9.8), rtol=0.03)


def test_friction_of_each_world_holds_for_springy_contacts_too():
    surface = Surface(Friction(1.0, 1.0), Contact(kp=1e5, kd=300.0))
    collision = Collision("c", Box((0.4, 0.4, 0.1)), surface=surface)
    link = Link("link", inertial=Inertial(), collisions=(collision,))
    block = Model("box", pose=Pose(z=0.05), links=(link,))
    engine = make(scenes.ground(), block, nworld=2)
    mu = np.array([0.1, 0.3])
    engine.set_parameter("collision_friction", "box::link::c", mu[:, None])
    engine.step(500)
    start = engine.models["box"].placement().position[:, 0]
    engine.models["box"].set_motion((1.0, 0.0, 0.0), np.zeros(3))
    engine.step(1500)
    slid = engine.models["box"].placement().position[:, 0] - start
    np.testing.assert_allclose(slid, 1.0 / (2 * mu * 9.8), rtol=0.05)


def test_each_world_has_its_gravity():
    engine = make(scenes.ball(), nworld=3)
    gravity = np.array([[0.0, 0.0, -9.8], [0.0, 0.0, -1.6], [1.0, 0.0, 0.0]])
    engine.set_parameter("gravity", "", gravity)
    engine.step(100)
    np.testing.assert_allclose(engine.links["ball::link"].motion().linear, 0.1 * gravity, atol=1e-9)


def test_parameters_survive_spawn_delete_and_a_new_time_step():
    engine = make(arm(), scenes.box("gone", pose=Pose(x=3.0)), nworld=2)
    engine.set_parameter("link_mass", "arm::rod", np.array([[2.0], [3.0]]))
    engine.set_parameter("link_mass", "gone::link", 7.0)
    engine.spawn(scenes.ball(pose=Pose(y=3.0)))
    engine.delete("gone")
    profile = replace(engine.world.profile, max_step_size=0.002)
    engine.update_world(replace(engine.world, physics=(profile,)))
    np.testing.assert_array_equal(engine.parameter("link_mass", "arm::rod")[:, 0], [2.0, 3.0])
    engine.spawn(scenes.box("gone", pose=Pose(x=3.0)))
    np.testing.assert_array_equal(engine.parameter("link_mass", "gone::link")[:, 0], [1.0, 1.0])
    engine.step(5)


def test_every_parameter_reads_what_was_compiled():
    engine = make(scenes.ground(), body(2.0, (0.1, 0.2, 0.3)), arm(damping=0.5, upper=1.0))
    engine.add_motor("arm::hinge", 4.0)
    engine.attach("arm::rod", "b::l")
    names = {"link": "b::l", "joint": "arm::hinge", "motor": "arm::hinge", "world": ""}
    names |= {"collision": "ground_plane::link::c", "attachment": "arm::rod>b::l"}
    for kind, (owner, width, _) in PARAMETERS.items():
        assert engine.parameter(kind, names[owner]).shape == (1, width), kind
    assert engine.parameter("link_mass", "b::l")[0, 0] == 2.0
    np.testing.assert_allclose(engine.parameter("link_centre", "b::l")[0], (0.1, 0.2, 0.3))
    np.testing.assert_allclose(
        engine.parameter("link_inertia", "b::l")[0], (0.1, 0.2, 0.25, 0, 0, 0), atol=1e-12
    )
    assert engine.parameter("joint_damping", "arm::hinge")[0, 0] == 0.5
    assert engine.parameter("joint_lower", "arm::hinge")[0, 0] == -np.inf
    assert engine.parameter("joint_upper", "arm::hinge")[0, 0] == 1.0


@pytest.mark.parametrize(
    ("kind", "name", "value", "message"),
    [
        ("link_mass", "arm::rod", 0.0, "positive"),
        ("link_mass", "arm::rodd", 1.0, "did you mean 'arm::rod'"),
        ("link_mass", "ground_plane::link", 1.0, "does not move"),
        ("link_mas", "arm::rod", 1.0, "did you mean 'link_mass'"),
        ("joint_damping", "arm::hinge", -1.0, "negative"),
        ("joint_damping", "arm::hinge", np.nan, "finite"),
        ("link_inertia", "arm::rod", (1, 1, -1, 0, 0, 0), "positive definite"),
    ],
)
def test_impossible_parameters_are_errors_that_change_nothing(kind, name, value, message):
    engine = make(scenes.ground(), arm())
    with pytest.raises(EngineError, match=message):
        engine.set_parameter(kind, name, value)
    assert engine.history() == []


def test_a_new_engine_becomes_the_same_by_its_history():
    def fresh():
        return make(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(2.0)), nworld=2)

    engine = fresh()
    engine.add_motor("burger::wheel_left_joint", 5.0)
    engine.joints["burger::wheel_left_joint"].set_motor_velocity(np.array([1.0, 3.0]))
    engine.models["ground_plane"].set_placement((0.0, 0.0, -0.1), UP)
    engine.attach("burger::base_footprint", "box::link", np.array([1]))
    engine.set_parameter("link_mass", "box::link", np.array([[1.0], [2.0]]))
    engine.step(50)
    other = fresh()
    other.adopt(engine.history())
    other.restore(engine.snapshot())
    for each in (engine, other):
        each.step(100)
    np.testing.assert_array_equal(engine.snapshot(), other.snapshot())


def _hinged(upper):
    return Model(
        "arm",
        links=(
            Link("base"),
            Link("rod", inertial=Inertial(mass=1.0, inertia=Inertia(0.1, 0.1, 0.1))),
        ),
        joints=(
            Joint("fix", "fixed", "world", "base"),
            Joint("hinge", "revolute", "base", "rod", axes=(JointAxis(upper=upper),)),
        ),
    )


def test_limits_are_those_of_the_model_that_runs():
    """What is read once a layout must not outlive it, nor what was set since."""
    engine = make_engine("mujoco", scenes.world(), nworld=2)
    for upper in (1.0, 2.0):
        engine.spawn(_hinged(upper))
        for _ in range(2):
            assert engine.parameter("joint_upper", "arm::hinge").tolist() == [[upper]] * 2
        engine.parameter("joint_upper", "arm::hinge")[:] = 9.0  # the caller's own
        engine.joints["arm::hinge"].set_position([5.0])
        assert engine.joints["arm::hinge"].position().tolist() == [[upper]] * 2
        engine.set_parameter("joint_upper", "arm::hinge", [0.5], np.array([1]))
        assert engine.parameter("joint_upper", "arm::hinge").tolist() == [[upper], [0.5]]
        engine.delete("arm")
