"""Promises of the Engine protocol, kept by the MuJoCo engine."""

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.description import (
    Box,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
    Source,
)
from gazelle.engines import make_engine
from gazelle.errors import EngineError, EngineWarning
from gazelle.rotations import from_yaw

SOURCE = Source("robot.sdf", 12, "joint[@name='hinge']")


def pendulum(**axis):
    rod = Inertial(1.0, Pose(z=-0.5), Inertia(0.01, 0.01, 0.01))
    links = (Link("base", inertial=Inertial()), Link("rod", inertial=rod))
    joints = (
        Joint("fix", "fixed", "world", "base"),
        Joint("hinge", "revolute", "base", "rod", axes=(JointAxis((0.0, 1.0, 0.0), **axis),)),
    )
    return Model("pendulum", pose=Pose(z=2.0), links=links, joints=joints)


def make(*models, nworld=1, threads=None, step=0.001):
    return make_engine("mujoco", scenes.world(*models, step=step), nworld, threads=threads)


def test_names_are_scoped_and_near_misses_are_named():
    engine = make(scenes.ground(), pendulum())
    assert engine.links.names == ("ground_plane::link", "pendulum::base", "pendulum::rod")
    assert engine.joints.names == ("pendulum::hinge",)
    with pytest.raises(EngineError, match="did you mean 'pendulum::rod'"):
        engine.links["pendulum::rodd"].placement()


def test_an_unknown_engine_is_named():
    with pytest.raises(EngineError, match="did you mean 'mujoco'"):
        make_engine("mujocco", scenes.world())


def test_a_small_swing_has_the_period_of_a_physical_pendulum():
    engine = make(pendulum())
    engine.joints["pendulum::hinge"].set_position(0.05)
    angles = []
    for _ in range(6000):
        engine.step()
        angles.append(engine.joints["pendulum::hinge"].position()[0, 0])
    ups = [i for i in range(1, 6000) if angles[i - 1] < 0.0 <= angles[i]]
    period = (ups[-1] - ups[0]) / (len(ups) - 1) * 0.001
    inertia = 0.01 + 1.0 * 0.5**2
    assert period == pytest.approx(2 * np.pi * np.sqrt(inertia / (1.0 * 9.8 * 0.5)), rel=2e-3)


def test_a_joint_stops_at_its_limit():
    engine = make(pendulum(lower=-0.2, upper=0.2))
    engine.joints["pendulum::hinge"].set_effort(8.0)
    engine.step(3000)
    assert engine.joints["pendulum::hinge"].position()[0, 0] == pytest.approx(0.2, abs=0.01)


@given(
    position=st.tuples(*[st.floats(-3, 3)] * 3),
    yaw=st.floats(-3, 3),
    linear=st.tuples(*[st.floats(-2, 2)] * 3),
    angular=st.tuples(*[st.floats(-2, 2)] * 3),
)
@settings(max_examples=20, deadline=None)
def test_what_is_set_is_what_is_read(position, yaw, linear, angular):
    engine = make(scenes.burger(), nworld=3)
    chosen = np.array([0, 2])
    engine.models["burger"].set_placement(position, from_yaw(np.array(yaw)), chosen)
    engine.models["burger"].set_motion(linear, angular, chosen)
    place, motion = (
        engine.models["burger"].placement(),
        engine.links["burger::base_footprint"].motion(),
    )
    np.testing.assert_allclose(place.position[chosen], [position] * 2, atol=1e-12)
    np.testing.assert_allclose(np.abs(place.quaternion[0] @ from_yaw(np.array(yaw))), 1.0)
    np.testing.assert_allclose(motion.linear[chosen], [linear] * 2, atol=1e-9)
    np.testing.assert_allclose(motion.angular[chosen], [angular] * 2, atol=1e-9)
    np.testing.assert_array_equal(place.position[1], 0.0)
    np.testing.assert_array_equal(motion.linear[1], 0.0)


def test_links_that_are_not_roots_move_rigidly_with_the_model():
    engine = make(scenes.burger(pose=Pose(1.0, 2.0, 0.5, yaw=0.7)))
    wheel = engine.links["burger::wheel_left_link"].placement()
    expected = Pose(1.0, 2.0, 0.5, yaw=0.7) * Pose(y=0.08, z=0.033)
    np.testing.assert_allclose(wheel.position[0], expected.position, atol=1e-12)
    engine.models["burger"].set_motion((0.0, 0.0, 0.0), (0.0, 0.0, 2.0))
    motion = engine.links["burger::wheel_left_link"].motion()
    arm = np.subtract(expected.position, (1.0, 2.0, 0.5))
    np.testing.assert_allclose(motion.linear[0], np.cross((0, 0, 2.0), arm), atol=1e-9)


def test_spawn_and_delete_leave_every_other_state_as_it_is():
    engine = make(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(2.0, 0.0, 1.0)), nworld=2)
    engine.add_motor("burger::wheel_left_joint", 5.0)
    engine.joints["burger::wheel_left_joint"].set_motor_velocity(np.array([1.0, 3.0]))
    engine.step(200)
    before = engine.snapshot()
    engine.spawn(scenes.ball(pose=Pose(y=3.0, z=1.0)))
    assert "ball::link" in engine.links.names
    engine.delete("ball")
    np.testing.assert_array_equal(engine.snapshot(), before)
    engine.step(50)


def test_a_failed_spawn_changes_nothing():
    engine = make(scenes.ground(), scenes.box())
    loop = Model(
        "loop",
        links=(Link("a", inertial=Inertial()), Link("b", inertial=Inertial())),
        joints=(
            Joint("ab", "prismatic", "a", "b", axes=(JointAxis(),)),
            Joint("slide", "screw", "b", "a", axes=(JointAxis(),), thread_pitch=0.0, source=SOURCE),
        ),
    )
    with pytest.raises(EngineError, match=r"robot.sdf:12: .*thread pitch of 0"):
        engine.spawn(loop)
    assert engine.links.names == ("ground_plane::link", "box::link")
    engine.step(5)


@pytest.mark.parametrize(
    ("link", "message"),
    [
        (Link("l", inertial=Inertial(0.0, source=SOURCE)), "mass 0 kg"),
        (Link("l", inertial=Inertial(1.0, inertia=Inertia(1, -1, 1), source=SOURCE)), "positive"),
    ],
)
def test_impossible_masses_are_errors_with_their_place(link, message):
    with pytest.raises(EngineError, match=message) as caught:
        make(Model("m", links=(link,)))
    assert (caught.value.file, caught.value.line) == ("robot.sdf", 12)


def test_reset_restores_some_worlds_and_leaves_the_others():
    engine = make(scenes.ground(), scenes.box(pose=Pose(z=1.0)), nworld=3)
    engine.step(200)
    fallen = engine.models["box"].placement().position[0, 2]
    engine.reset(np.array([1]))
    heights = engine.models["box"].placement().position[:, 2]
    np.testing.assert_array_equal(heights, [fallen, 1.0, fallen])


def test_a_snapshot_restores_the_exact_future():
    engine = make(scenes.ground(), scenes.burger(), scenes.box(pose=Pose(1.0, 0.0, 0.5)))
    engine.step(100)
    saved = engine.snapshot()
    engine.step(300)
    future = engine.snapshot()
    engine.restore(saved)
    engine.step(300)
    np.testing.assert_array_equal(engine.snapshot(), future)


def test_a_snapshot_of_other_models_is_refused():
    saved = make(scenes.box()).snapshot()
    with pytest.raises(EngineError, match="shape"):
        make(scenes.box(), scenes.ball()).restore(saved)


@pytest.mark.long
@pytest.mark.parametrize(("nworld", "threads"), [(1, 1), (64, 1), (64, 2)])
def test_world_0_is_the_same_bits_at_any_number_of_worlds_and_threads(nworld, threads):
    def run(nworld, threads):
        models = (
            scenes.ground(),
            *scenes.square(),
            scenes.burger(),
            scenes.box(pose=Pose(x=0.4, z=0.2)),
        )
        engine = make(*models, nworld=nworld, threads=threads, step=0.005)
        for side, speed in (("left", 6.0), ("right", 5.0)):
            engine.add_motor(f"burger::wheel_{side}_joint", 10.0)
            engine.joints[f"burger::wheel_{side}_joint"].set_motor_velocity(
                speed + np.arange(nworld)
            )
        engine.step(400)
        return engine.snapshot()[0]

    np.testing.assert_array_equal(run(nworld, threads), run(1, 2))


def test_rays_measure_the_distance_to_a_wall_and_know_the_inside():
    engine = make(scenes.wall("wall", 2.0, 0.0, 0.0, length=0.2), scenes.box(pose=Pose(z=0.2)))
    origins = np.array([[0.15, 0.0, 0.0], [0.0, 0.0, 0.0], [0.15, 0.0, 0.0]])
    directions = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]])
    hits = engine.links["box::link"].cast_rays(origins, directions)
    np.testing.assert_allclose(hits.distance[0], [1.75, 0.1, np.inf], atol=1e-12)
    np.testing.assert_array_equal(hits.from_inside[0], [False, True, False])


def test_a_static_model_moves_when_told_to_and_pushes():
    slab = scenes.box("slab", size=(1.0, 1.0, 0.1), static=True, pose=Pose(z=-0.05))
    engine = make(slab, scenes.box(pose=Pose(z=0.1)))
    engine.step(100)
    engine.models["slab"].set_placement((0.0, 0.0, -1.05), (0.0, 0.0, 0.0, 1.0))
    engine.step(2000)
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(-0.9, abs=1e-3)


def test_a_motor_holds_its_speed_and_its_largest_effort():
    wheel = Inertial(1.0, inertia=Inertia(0.02, 0.02, 0.02))
    model = Model(
        "m",
        links=(Link("base", inertial=Inertial()), Link("wheel", inertial=wheel)),
        joints=(
            Joint("fix", "fixed", "world", "base"),
            Joint("axle", "continuous", "base", "wheel", axes=(JointAxis(),)),
        ),
    )
    engine = make(model)
    engine.add_motor("m::axle", 1.0)
    engine.joints["m::axle"].set_motor_velocity(3.0)
    engine.step(1000)
    assert engine.joints["m::axle"].velocity()[0, 0] == pytest.approx(3.0, rel=1e-3)
    engine.joints["m::axle"].set_effort(-1.5)
    engine.step(1000)
    assert engine.joints["m::axle"].velocity()[0, 0] < 2.9


def test_an_infinite_state_is_an_error_that_names_the_world():
    engine = make(scenes.ball(), nworld=2)
    state = engine.snapshot()
    state[1, 8:] = np.nan
    engine.restore(state)
    with pytest.raises(EngineError, match=r"1 of 2 worlds became infinite \(first: world 1, where"):
        engine.step(3)


@pytest.mark.long
def test_links_of_one_model_do_not_collide_unless_asked():
    def pair(collide):
        links = tuple(
            Link(
                n, pose=Pose(x=x), inertial=Inertial(), collisions=scenes.box().links[0].collisions
            )
            for n, x in (("a", 0.0), ("b", 0.1))
        )
        return Model("pair", links=links, self_collide=collide)

    for collide, apart in ((False, False), (True, True)):
        engine = make_engine("mujoco", scenes.world(pair(collide), gravity=(0, 0, 0)))
        engine.step(12_000)
        gap = (
            engine.links["pair::b"].placement().position
            - engine.links["pair::a"].placement().position
        )
        assert (np.linalg.norm(gap) > 0.15) == apart


def test_shapes_without_volume_are_nothing_to_hit():
    from gazelle.description import Collision, Empty, Mesh

    link = Link("l", collisions=(Collision("e", Empty()), Collision("m", Mesh("x.stl", None))))
    engine = make(Model("m", links=(link,), static=True), scenes.solid("b", Box((0.1, 0.1, 0.1))))
    start = engine.links["b::link"].placement().position[0, 2]
    engine.step(100)
    fallen = start - engine.links["b::link"].placement().position[0, 2]
    assert fallen == pytest.approx(0.5 * 9.8 * 0.1**2, rel=0.02)


def test_a_kinematic_link_is_not_dropped_in_silence():
    link = Link("link", inertial=Inertial(), kinematic=True)
    with pytest.warns(EngineWarning, match="link 'm::link' has <kinematic>, which has no effect"):
        make(Model("m", links=(link,)))


def test_velocity_decay_is_not_dropped_in_silence():
    link = Link("link", inertial=Inertial(), velocity_decay_linear=0.01)
    with pytest.warns(
        EngineWarning, match="link 'm::link' has a <velocity_decay>, which has no effect"
    ):
        make(Model("m", links=(link,)))
