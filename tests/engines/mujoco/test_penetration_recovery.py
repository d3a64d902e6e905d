"""Overlaps in a file are resolved slowly, and nothing else is disturbed."""

from dataclasses import replace

import numpy as np
import pytest
import scenes

import gazelle
from gazelle.description import Bounce, Contact, Friction, Joint, JointAxis, Model, Pose, Surface
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile

UP = (0.0, 0.0, 0.0, 1.0)


def sunk(model, depth, bounce=None, **contact):
    link = model.links[0]
    surface = Surface(Friction(1.0, 1.0), Contact(**contact), bounce or Bounce())
    collisions = tuple(replace(c, surface=surface) for c in link.collisions)
    pose = Pose(z=-depth) * model.pose
    return replace(model, pose=pose, links=(replace(link, collisions=collisions),))


def ground(max_vel=100.0):
    return sunk(scenes.ground(), 0.0, max_vel=max_vel)


def heights(engine, name, seconds, every=0.1):
    track = []
    for _ in range(round(seconds / every)):
        engine.step(round(every / engine.time_step))
        track.append(engine.models[name].placement().position[0, 2])
    return np.array(track)


@pytest.mark.parametrize("make", [scenes.box, scenes.ball])
def test_a_body_in_the_ground_rises_at_max_vel_and_then_stands(make):
    body = sunk(make(pose=Pose(z=0.1)), 0.05, max_vel=0.1)
    name = body.name
    engine = make_engine("mujoco", scenes.world(ground(), body))
    track = heights(engine, name, 1.0)
    assert np.allclose(track[:4], 0.05 + 0.1 * np.arange(1, 5) / 10.0, atol=3e-3)
    assert np.allclose(track[6:], 0.1, atol=5e-4)


def test_the_slower_of_two_surfaces_and_of_the_world_decides():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.05, max_vel=100.0)
    slow = make_engine("mujoco", scenes.world(ground(0.02), body))
    assert heights(slow, "box", 1.0)[-1] == pytest.approx(0.07, abs=2e-3)
    world = scenes.world(ground(), body)
    ode = replace(world.profile.ode, contact_max_correcting_vel=0.02)
    slow = make_engine("mujoco", with_profile(world, replace(world.profile, ode=ode)))
    assert heights(slow, "box", 1.0)[-1] == pytest.approx(0.07, abs=2e-3)


def test_by_default_nothing_is_thrown():
    body = scenes.box(pose=Pose(z=-0.5))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), body))
    for _ in range(100):
        engine.step(10)
        assert np.abs(engine.links["box::link"].motion().linear).max() < 0.05


def test_a_robot_drives_while_it_rises_out_of_the_ground():
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn("courier", pose=Pose(z=-0.02))
        robot.inputs["cmd_vel"].send(linear=0.2)
        sim.run(1.0)
        assert robot.pose.z == pytest.approx(-0.01, abs=1e-3)
        # Sunk wheels touch the ground nearer to their axles.
        assert 0.12 < robot.pose.x < 0.2


def test_what_bounces_is_let_out_too():
    bouncy = Bounce(0.8, 0.01)
    body = sunk(scenes.ball(pose=Pose(z=0.1)), 0.05, bounce=bouncy, max_vel=0.1)
    engine = make_engine("mujoco", scenes.world(sunk(scenes.ground(), 0.0, bounce=bouncy), body))
    track = heights(engine, "ball", 6.0)
    assert np.diff(track).min() > -1e-3
    assert np.diff(track).max() < 0.02
    assert track[-1] > 0.09


def test_a_spring_that_a_file_compresses_is_let_go():
    body = sunk(scenes.ball(radius=0.3, pose=Pose(z=0.3)), 0.05, kp=3000.0, kd=1.0, max_vel=0.1)
    engine = make_engine("mujoco", scenes.world(ground(), body))
    assert heights(engine, "ball", 0.1, 0.01).max() > 0.3


@pytest.mark.long
def test_a_change_of_the_world_leaves_what_strikes_alone():
    """An impact may be deep for a moment; spawning just then is not a reason to let it in."""
    box = scenes.box(pose=Pose(z=0.5))
    worlds = scenes.world(ground(), box, step=0.005), scenes.world(ground(), box, step=0.005)
    tracks = []
    for spawns, world in zip((False, True), worlds, strict=True):
        engine = make_engine("mujoco", world)
        track = []
        for i in range(80):
            engine.step()
            track.append(engine.models["box"].placement().position[0, 2])
            if spawns and i % 2:
                engine.spawn(scenes.box(f"extra_{i}", pose=Pose(100.0 + i, z=0.1)))
        tracks.append(track)
    assert min(tracks[0]) < 0.1 - 1e-3
    np.testing.assert_allclose(tracks[0], tracks[1], atol=1e-9)


def test_shallow_overlaps_are_left_to_the_contact():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.0009, max_vel=0.001)
    engine = make_engine("mujoco", scenes.world(ground(), body))
    assert heights(engine, "box", 0.5)[-1] == pytest.approx(0.1, abs=1e-4)


def test_a_surface_layer_or_least_depth_of_the_file_says_what_is_shallow():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.004, max_vel=0.001, min_depth=0.005)
    engine = make_engine("mujoco", scenes.world(ground(), body))
    assert heights(engine, "box", 0.5)[-1] == pytest.approx(0.1, abs=1e-4)


def test_a_reset_starts_again_and_a_restored_state_goes_on():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.05, max_vel=0.1)
    engine = make_engine("mujoco", scenes.world(ground(), body), nworld=2)
    engine.step(300)
    saved = engine.snapshot()
    engine.step(1000)
    engine.reset(np.array([1]))
    engine.step(100)
    z = engine.models["box"].placement().position[:, 2]
    assert z == pytest.approx([0.1, 0.06], abs=2e-3)
    engine.restore(saved)
    engine.step(100)
    assert engine.models["box"].placement().position[:, 2] == pytest.approx(0.09, abs=3e-3)
    after = engine.snapshot()
    engine.restore(saved)
    engine.step(100)
    np.testing.assert_array_equal(engine.snapshot(), after)


def test_spawning_leaves_what_has_come_out_as_it_is():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.05, max_vel=1.0)
    engine = make_engine("mujoco", scenes.world(ground(), body))
    engine.step(500)
    engine.spawn(sunk(scenes.box("other", pose=Pose(1.0, z=0.1)), 0.03, max_vel=0.1))
    engine.step(200)
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(0.1, abs=5e-4)
    assert engine.models["other"].placement().position[0, 2] == pytest.approx(0.09, abs=2e-3)


def test_what_is_placed_elsewhere_overlaps_no_more():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.05, max_vel=0.001)
    engine = make_engine("mujoco", scenes.world(ground(), body))
    engine.step(10)
    engine.models["box"].set_placement((0.0, 0.0, 0.1), UP)
    engine.step(500)
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(0.1, abs=5e-4)


def test_a_nested_model_that_is_static_holds_what_hangs_on_it():
    floor = replace(scenes.ground(), name="floor")
    post = scenes.box("post", pose=Pose(3.0, z=1.0), static=True)
    arm = scenes.box("arm", pose=Pose(3.5, z=1.0))
    axes = (JointAxis(xyz=(0.0, 1.0, 0.0)),)
    hinge = Joint("hinge", "revolute", "post::link", "arm::link", Pose(x=-0.5), axes=axes)
    place = Model("place", models=(floor, post, arm), joints=(hinge,))
    box = scenes.box(pose=Pose(z=0.1))
    engine = make_engine("mujoco", scenes.world(place, box))
    engine.step(300)
    assert engine.links["place::post::link"].placement().position[0, 2] == 1.0
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(0.1, abs=5e-4)
    assert engine.links["place::arm::link"].placement().position[0, 2] < 0.99
    arm_at = engine.links["place::arm::link"].placement().position[0]
    assert np.linalg.norm(arm_at - (3.0, 0.0, 1.0)) == pytest.approx(0.5, abs=1e-9)


def test_what_is_placed_into_the_ground_comes_out_at_max_vel_in_its_world():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.0, max_vel=0.1)
    engine = make_engine("mujoco", scenes.world(ground(), body), nworld=3)
    engine.step(50)
    engine.models["box"].set_placement((0.0, 0.0, 0.05), UP, np.array([1]))
    engine.models["box"].set_placement((0.0, 0.0, 0.07), UP, np.array([2]))
    engine.step(200)
    rising = engine.models["box"].placement().position[:, 2]
    assert rising == pytest.approx([0.1, 0.07, 0.09], abs=2e-3)
    assert engine.links["box::link"].motion().linear[:, 2] == pytest.approx(
        [0.0, 0.1, 0.1], abs=0.06
    )
    engine.step(500)
    assert engine.models["box"].placement().position[:, 2] == pytest.approx(0.1, abs=5e-4)


@pytest.mark.long
def test_what_is_placed_into_another_body_is_not_thrown():
    boxes = [scenes.box(name, pose=Pose(x, z=0.1)) for name, x in (("a", 0.0), ("b", 1.0))]
    engine = make_engine("mujoco", scenes.world(scenes.ground(), *boxes))
    engine.step(50)
    engine.models["b"].set_placement((0.1, 0.02, 0.1), UP)
    for _ in range(100):
        engine.step(10)
        for name in "ab":
            # Meanwhile it sinks as deep into the ground, too.
            motion = engine.links[f"{name}::link"].motion().linear[0]
            assert max(np.abs(motion[:2]).max(), motion[2]) < 0.15
    engine.step(9000)
    a, b = (engine.models[name].placement().position[0] for name in "ab")
    assert b[0] - a[0] > 0.19
    assert (a[2], b[2]) == pytest.approx((0.1, 0.1), abs=1e-3)


def test_what_a_placed_body_strikes_at_speed_is_no_overlap():
    box = scenes.box(pose=Pose(z=0.5))
    tracks = []
    for places in (False, True):
        other = scenes.box("other", pose=Pose(5.0, z=0.1))
        engine = make_engine("mujoco", scenes.world(ground(), box, other, step=0.005))
        track = []
        for _ in range(80):
            engine.step()
            track.append(engine.models["box"].placement().position[0, 2])
            if places:
                engine.models["other"].set_placement((6.0, 0.0, 0.05), UP)
        tracks.append(track)
    assert min(tracks[0]) < 0.1 - 1e-3
    np.testing.assert_allclose(tracks[0], tracks[1], atol=1e-6)


def test_a_state_saved_after_placing_goes_on_alike():
    body = sunk(scenes.box(pose=Pose(z=0.1)), 0.0, max_vel=0.1)
    engine = make_engine("mujoco", scenes.world(ground(), body), nworld=2)
    engine.models["box"].set_placement((0.0, 0.0, 0.05), UP)
    saved = engine.snapshot()
    engine.step(100)
    after = engine.snapshot()
    engine.restore(saved)
    engine.step(100)
    np.testing.assert_array_equal(engine.snapshot(), after)


def test_what_is_moved_on_purpose_still_pushes():
    wall = replace(scenes.box("wall", size=(0.1, 1.0, 1.0), pose=Pose(-0.2, z=0.5)))
    engine = make_engine(
        "mujoco", scenes.world(scenes.ground(), wall, scenes.box(pose=Pose(z=0.1)))
    )
    engine.make_kinematic("wall")
    for i in range(500):
        engine.models["wall"].set_placement((-0.2 + 0.001 * i, 0.0, 0.5), UP)
        engine.step()
    assert engine.models["box"].placement().position[0, 0] > 0.4


@pytest.mark.parametrize("angle", [0.03, 0.1, 0.3])
@pytest.mark.parametrize("mu", [0.0, 0.02])
def test_what_is_wedged_does_not_shoot_out(angle, mu):
    """For both sides to part at max_vel it would have to leave at max_vel / sin(angle), 3.3 m/s.

    What is less deep than the surface layer is a contact's.
    """
    surface = Surface(Friction(mu, mu), Contact(max_vel=0.1))
    walls = [
        scenes.box(
            f"wall{side}",
            (1.0, 1.0, 1.0),
            static=True,
            pose=Pose(0.625 * side, 0.0, 0.5, 0.0, side * angle, 0.0),
        )
        for side in (-1, 1)
    ]
    ball = scenes.ball(radius=0.15, pose=Pose(z=0.5))
    models = [scenes.with_surface(each, surface) for each in (*walls, ball)]
    engine = make_engine("mujoco", scenes.world(*models, gravity=(0.0, 0.0, 0.0)))
    fastest = 0.0
    for _ in range(200):
        engine.step(5)
        if engine.running.overlaps.any:
            fastest = max(
                fastest, float(np.linalg.norm(engine.links["ball::link"].motion().linear))
            )
    assert 0.05 < fastest < 0.21
