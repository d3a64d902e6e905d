"""Forces in joints and contacts against statics and dynamics."""

import math
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes

from gazelle.description import Inertia, Inertial, Joint, JointAxis, Link, Model, Pose
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.errors import EngineError

G = 9.8
Y = (0.0, 1.0, 0.0)


def part(name, mass=2.0, centre=(0.0, 0.0, 0.0), gravity=True, **pose):
    inertial = Inertial(mass, Pose(*centre), Inertia(0.02, 0.02, 0.02))
    return Link(name, pose=Pose(**pose), inertial=inertial, gravity=gravity)


def chain(*links, joints, gravity=(0.0, 0.0, -G), nworld=1):
    return make_engine(
        "mujoco", scenes.world(Model("m", links=links, joints=joints), gravity=gravity), nworld
    )


def fixed(name, parent, child, **pose):
    return Joint(name, "fixed", parent, child, pose=Pose(**pose))


def hinge(name, parent, child, axis=Y, **options):
    pose = options.pop("pose", Pose())
    return Joint(name, "revolute", parent, child, pose=pose, axes=(JointAxis(axis, **options),))


def test_a_fixed_joint_carries_the_weight_and_the_lever():
    arm = part("b", mass=3.0, centre=(0.5, 0.0, 0.0), x=1.0)
    engine = chain(part("a"), arm, joints=(fixed("hold", "world", "a"), fixed("j", "a", "b")))
    wrench = engine.joints["m::j"].wrench()
    np.testing.assert_allclose(wrench.force, [[0.0, 0.0, -3.0 * G]], rtol=1e-9, atol=1e-9)
    # the weight half a metre ahead along x turns the parent about +y: r x F
    np.testing.assert_allclose(wrench.torque, [[0.0, 1.5 * G, 0.0]], rtol=1e-9, atol=1e-9)
    root = engine.joints["m::hold"].wrench()
    np.testing.assert_allclose(root.force, [[0.0, 0.0, -5.0 * G]], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(root.torque, [[0.0, 4.5 * G, 0.0]], rtol=1e-9, atol=1e-9)


def test_the_torque_is_about_the_joint_not_the_link():
    arm = part("b", mass=3.0, x=1.0)
    joints = (fixed("hold", "world", "a"), fixed("j", "a", "b", x=-0.4))
    engine = chain(part("a"), arm, joints=joints)
    np.testing.assert_allclose(
        engine.joints["m::j"].wrench().torque, [[0.0, 0.4 * 3.0 * G, 0.0]], rtol=1e-9, atol=1e-9
    )


def test_a_hinge_at_rest_by_its_effort_carries_the_effort_too():
    engine = chain(part("a", mass=2.0, centre=(0.5, 0, 0)), joints=(hinge("j", "world", "a"),))
    effort = -2.0 * G * 0.5  # holds the weight ahead: a positive turn about y lowers it
    engine.joints["m::j"].set_effort(effort)
    engine.step(200)
    assert abs(engine.joints["m::j"].position()[0, 0]) < 1e-6
    wrench = engine.joints["m::j"].wrench()
    np.testing.assert_allclose(wrench.force, [[0.0, 0.0, -2.0 * G]], rtol=1e-4, atol=1e-4)
    np.testing.assert_allclose(wrench.torque, [[0.0, -effort, 0.0]], rtol=1e-4, atol=1e-4)


def test_a_free_hinge_carries_no_torque_about_its_axis_and_what_a_falling_bar_needs():
    engine = chain(part("a", mass=2.0, centre=(0.5, 0, 0)), joints=(hinge("j", "world", "a"),))
    moment = 0.02 + 2.0 * 0.25
    sinking = (2.0 * G * 0.5 / moment) * 0.5
    wrench = engine.joints["m::j"].wrench()
    np.testing.assert_allclose(wrench.force[0], [0.0, 0.0, -2.0 * (G - sinking)], rtol=1e-6)
    np.testing.assert_allclose(wrench.torque, 0.0, atol=1e-9)


def test_a_pendulum_pulls_with_its_centripetal_force():
    engine = chain(part("a", mass=2.0, centre=(0, 0, -0.5)), joints=(hinge("j", "world", "a"),))
    engine.joints["m::j"].set_velocity(3.0)
    expected = -(2.0 * G + 2.0 * 9.0 * 0.5)
    assert engine.joints["m::j"].wrench().force[0, 2] == pytest.approx(expected, rel=1e-6)


def test_a_slider_pushed_from_behind_hands_the_push_on_less_its_inertia():
    slide = Joint("j", "prismatic", "world", "a", axes=(JointAxis((1.0, 0.0, 0.0)),))
    joints = (slide, fixed("bolt", "a", "b"))
    engine = chain(part("a", mass=3.0), part("b", mass=1.0, x=0.2), joints=joints)
    engine.joints["m::j"].set_effort(8.0)
    np.testing.assert_allclose(
        engine.joints["m::bolt"].wrench().force[0], [-2.0, 0.0, -G], rtol=1e-6, atol=1e-9
    )


def test_what_gravity_does_not_pull_weighs_nothing_in_any_world():
    arm = part("b", mass=3.0, centre=(0.5, 0.0, 0.0), gravity=False)
    joints = (fixed("hold", "world", "a"), hinge("j", "a", "b"))
    engine = chain(part("a"), arm, joints=joints, nworld=2)
    np.testing.assert_allclose(engine.joints["m::j"].wrench().force, 0.0, atol=1e-9)
    np.testing.assert_allclose(engine.joints["m::j"].wrench().torque, 0.0, atol=1e-9)
    np.testing.assert_allclose(engine.joints["m::hold"].wrench().force[:, 2], -2.0 * G, rtol=1e-9)
    engine.set_parameter("link_gravity", "m::b", [[0.0], [1.0]])
    engine.set_parameter("link_mass", "m::b", [[3.0], [4.0]])
    lifted = engine.joints["m::hold"].wrench().force[:, 2]
    assert lifted[0] == pytest.approx(-2.0 * G, rel=1e-9)
    assert -6.0 * G < lifted[1] < -2.0 * G - 0.1


def test_worlds_have_their_own_and_subsets_agree():
    engine = chain(part("a", mass=2.0), joints=(fixed("j", "world", "a"),), nworld=3)
    engine.set_parameter("link_mass", "m::a", [[1.0], [2.0], [3.0]])
    all_of_them = engine.joints["m::j"].wrench().force
    np.testing.assert_allclose(all_of_them[:, 2], [-G, -2 * G, -3 * G], rtol=1e-9)
    chosen = engine.joints["m::j"].wrench(np.array([2])).force
    np.testing.assert_array_equal(chosen, all_of_them[2:])


def test_a_push_on_a_link_is_felt_at_once_and_measuring_changes_nothing():
    engine = chain(part("a"), joints=(fixed("j", "world", "a"),))
    other = chain(part("a"), joints=(fixed("j", "world", "a"),))
    engine.joints["m::j"].wrench()
    for each in (engine, other):
        each.links["m::a"].set_wrench((7.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    wrench = engine.joints["m::j"].wrench()
    np.testing.assert_allclose(wrench.force[0], [7.0, 0.0, -2.0 * G], rtol=1e-9)
    np.testing.assert_allclose(wrench.torque[0], [0.0, 0.0, 2.0], atol=1e-9)
    engine.step(10)
    other.step(10)
    np.testing.assert_array_equal(engine.snapshot(), other.snapshot())


def test_measuring_in_a_run_of_contacts_changes_no_bit():
    def run(measure):
        world = scenes.world(scenes.ground(), scenes.burger(pose=Pose(z=0.01)))
        engine = make_engine("mujoco", world)
        for _ in range(30):
            engine.step(5)
            if measure:
                engine.joints["burger::wheel_left_joint"].wrench()
                engine.contacts([["burger::base_footprint::caster"]]).named()
        return engine.snapshot()

    np.testing.assert_array_equal(run(measure=True), run(measure=False))


def test_wheels_and_caster_carry_the_robot():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.burger()))
    engine.step(2000)
    wheels = [f"burger::wheel_{side}_link::c" for side in ("left", "right")]
    caster = "burger::base_footprint::caster"
    touching = engine.contacts([[*wheels, caster]]).named()
    weight = (0.944735 + 2 * 0.02849894) * G
    assert touching.force[:, 2].sum() == pytest.approx(weight, rel=0.01)
    assert set(touching.collisions) == {*wheels, caster}
    assert set(touching.others) == {"ground_plane::link::c"}
    np.testing.assert_allclose(touching.normal[:, 2], 1.0, atol=1e-6)
    # the joints carry what the wheels do, less the wheels' own weight
    for side, wheel in zip(("left", "right"), wheels, strict=True):
        own = [i for i, name in enumerate(touching.collisions) if name == wheel]
        carried = touching.force[own, 2].sum() - 0.02849894 * G
        up = engine.joints[f"burger::wheel_{side}_joint"].wrench().force[0, 2]
        assert up == pytest.approx(carried, rel=0.01)


def test_contacts_are_seen_from_the_collision_that_is_asked_for():
    engine = make_engine(
        "mujoco",
        scenes.world(scenes.ground(), scenes.ball(pose=Pose(z=0.1)), gravity=(0, 0, -G)),
        2,
    )
    engine.models["ball"].set_placement((0, 0, 30.0), (0, 0, 0, 1), np.array([1]))
    engine.step(1000)
    ball, plane = "ball::link::c", "ground_plane::link::c"
    on_ball, on_plane = engine.contacts([[ball]]).named(), engine.contacts([[plane]]).named()
    assert (on_ball.collisions, on_ball.others) == ((ball,), (plane,))
    assert (on_plane.collisions, on_plane.others) == ((plane,), (ball,))
    np.testing.assert_allclose(on_ball.force, [[0, 0, G]], rtol=1e-2, atol=1e-6)
    np.testing.assert_allclose(on_plane.force, -on_ball.force)
    np.testing.assert_allclose(on_plane.normal, -on_ball.normal)
    np.testing.assert_allclose(on_ball.position, [[0, 0, 0]], atol=1e-3)
    assert 0.0 <= on_ball.depth[0] < 1e-3
    assert len(engine.contacts([[ball, plane]]).named()) == 1
    assert len(engine.contacts([[ball]], np.array([1])).named()) == 0


def test_a_flying_ball_touches_nothing():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.ball(pose=Pose(z=3.0))))
    empty = engine.contacts([["ball::link::c"]]).named()
    assert len(empty) == 0
    assert empty.force.shape == empty.position.shape == (0, 3)


def test_names_that_are_not_there_are_errors():
    engine = make_engine("mujoco", scenes.world(scenes.box(static=True)))
    with pytest.raises(EngineError, match="no joint between moving links 'box::j'"):
        engine.joints["box::j"].wrench()
    with pytest.raises(EngineError, match="no collision 'box::link::x'"):
        engine.contacts([["box::link::x"]]).named()


def test_a_resting_stack_presses_with_all_that_is_above():
    boxes = [scenes.box(f"b{i}", pose=Pose(z=0.1 + 0.2 * i), mass=1.0 + i) for i in range(2)]
    engine = make_engine("mujoco", scenes.world(scenes.ground(), *boxes))
    engine.step(1500)
    between = engine.contacts([["b1::link::c"]]).named()
    assert between.force[:, 2].sum() == pytest.approx(2.0 * G, rel=0.01)
    lower = engine.contacts([["b0::link::c"]]).named()
    below = [i for i, name in enumerate(lower.others) if name.startswith("ground")]
    assert lower.force[below, 2].sum() == pytest.approx(3.0 * G, rel=0.01)
    assert math.isclose(lower.force[:, 2].sum(), 1.0 * G, rel_tol=0.01)


# -- loops -------------------------------------------------------------------------------


def table(kind, nworld=1):
    """Return a beam of 4 kg on two posts, one in the tree, the other closing the loop."""
    posts = (part("left", x=-0.6), part("right", x=0.9))
    beam = part("beam", mass=4.0, z=1.0)
    far = Joint("far", kind, "right", "beam", pose=Pose(x=0.9), axes=(JointAxis(Y),))
    joints = (
        fixed("feet", "world", "left"),
        fixed("foot", "world", "right"),
        hinge("near", "left", "beam", pose=Pose(x=-0.6)),
        far,
    )
    engine = chain(*posts, beam, joints=joints, nworld=nworld)
    engine.step(500)
    return engine


@pytest.mark.parametrize("kind", ["revolute", "ball"])
def test_a_joint_that_closes_a_loop_carries_its_share(kind):
    engine = table(kind, nworld=2)
    near, far = engine.joints["m::near"].wrench(), engine.joints["m::far"].wrench()
    # the lever law; how the beam presses its ends apart is not determined
    np.testing.assert_allclose(near.force[:, 2], -4.0 * G * 0.9 / 1.5, rtol=1e-3)
    np.testing.assert_allclose(far.force[:, 2], -4.0 * G * 0.6 / 1.5, rtol=1e-3)
    np.testing.assert_allclose((near.force + far.force)[:, :2], 0.0, atol=1e-3)
    np.testing.assert_allclose(far.torque[:, 1], 0.0, atol=1e-3)
    one = engine.joints["m::far"].wrench(np.array([1]))
    np.testing.assert_allclose(one.force, far.force[1:], atol=1e-9)


def test_a_ring_welded_shut_hands_on_force_and_torque():
    """A load on an arm that swings freely in the tree, held only by the joint that closes it."""
    arm = part("arm", mass=3.0, centre=(0.5, 0.0, 0.0), x=0.2)
    joints = (
        fixed("hold", "world", "base"),
        Joint("free", "ball", "base", "arm", pose=Pose(x=-0.2)),
        Joint("weld", "fixed", "base", "arm", pose=Pose(x=0.1, z=0.2, yaw=0.3)),
    )
    engine = chain(part("base"), arm, joints=joints)
    engine.step(500)
    ball, weld = engine.joints["m::free"].wrench(), engine.joints["m::weld"].wrench()
    weight = np.array([0.0, 0.0, -3.0 * G])
    np.testing.assert_allclose(ball.force + weld.force, [weight], rtol=1e-3, atol=1e-2)
    # moments about the base: the weight's is that of both joints together
    assert np.abs(weld.torque).max() > 1.0
    ball_at, weld_at, load_at = np.zeros(3), np.array([0.3, 0.0, 0.2]), np.array([0.7, 0.0, 0.0])
    moment = np.cross(ball_at, ball.force[0]) + np.cross(weld_at, weld.force[0]) + weld.torque[0]
    np.testing.assert_allclose(moment, np.cross(load_at, weight), rtol=1e-3, atol=1e-2)


def test_contacts_of_many_worlds_are_those_of_each():
    models = scenes.ground(), scenes.burger(), scenes.box(pose=Pose(2.0, z=0.1))
    engine = make_engine("mujoco", scenes.world(*models), nworld=4)
    engine.models["burger"].set_placement((0.0, 0.0, 5.0), (0.0, 0.0, 0.0, 1.0), np.array([2]))
    engine.step(50)
    names = [n for n in engine.running.layout.collisions if n.startswith(("burger", "box"))]
    worlds = np.array([3, 2, 0])
    table = engine.contacts([names], worlds)
    where, every = table.worlds, table.named()
    assert len(set(where.tolist())) == 3
    for world in worlds.tolist():
        rows, alone = (
            np.flatnonzero(where == world),
            engine.contacts([names], np.array([world])).named(),
        )
        assert [every.others[i] for i in rows] == list(alone.others)
        assert [every.collisions[i] for i in rows] == list(alone.collisions)
        for field in ("position", "normal", "depth", "force", "torque"):
            np.testing.assert_array_equal(getattr(every, field)[rows], getattr(alone, field))
    assert (where == 2).sum() < (where == 0).sum()
    assert len(engine.contacts([names], np.array([], np.intp)).named()) == 0


@pytest.mark.parametrize("model", ["pyramid_model", "cone_model"])
def test_contact_forces_are_those_that_mujoco_tells(model):
    slab = scenes.box("slab", size=(0.3, 0.2, 0.1), pose=Pose(2.0, z=0.05, yaw=0.4), mu=0.7)
    world = scenes.world(scenes.ground(), slab, scenes.burger(), gravity=(2.0, 1.0, -9.8))
    ode = replace(world.profile.ode, friction_model=model)
    engine = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)))
    engine.step(100)
    found = engine.contacts([list(engine.running.layout.collisions)]).named()
    known, data = engine.reactions.probe(0)
    forces = np.zeros((data.ncon, 6))
    for index, row in enumerate(forces):
        mujoco.mj_contactForce(known, data, index, row)
    turned = np.einsum("kij,ki->kj", data.contact.frame.reshape(-1, 3, 3), forces[:, :3])
    assert len(found) == data.ncon > 4
    np.testing.assert_allclose(np.abs(found.force), np.abs(turned), atol=1e-9)
