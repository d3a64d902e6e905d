"""The engine against closed-form mechanics."""

import math

import numpy as np
import pytest
import scenes

from gazelle.description import Box, Cylinder, Pose
from gazelle.engines import make_engine

G = 9.8
STILL = np.zeros(3)


def engine_of(*models, step=0.001, nworld=1, gravity=(0.0, 0.0, -G)):
    return make_engine("mujoco", scenes.world(*models, step=step, gravity=gravity), nworld)


@pytest.mark.parametrize("step", [0.001, 0.01])
def test_a_thrown_body_flies_a_parabola_with_the_error_of_semi_implicit_euler(step):
    engine = engine_of(scenes.ball(pose=Pose(z=10.0)), step=step)
    engine.models["ball"].set_motion((2.0, 0.0, 3.0), STILL)
    steps = round(0.8 / step)
    engine.step(steps)
    t = steps * step
    x, _, z = engine.models["ball"].placement().position[0]
    assert x == pytest.approx(2.0 * t, abs=1e-9)
    exact_sum = 10.0 + 3.0 * t - G * step * step * steps * (steps + 1) / 2
    assert z == pytest.approx(exact_sum, abs=1e-9)
    assert z == pytest.approx(10.0 + 3.0 * t - G * t * t / 2, abs=G * t * step)


def test_a_sliding_block_stops_after_v_squared_over_2_mu_g():
    mu, speed = 0.3, 1.5
    engine = engine_of(scenes.ground(), scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=0.05), mu=mu))
    engine.step(300)
    start = engine.models["box"].placement().position[0, 0]
    engine.models["box"].set_motion((speed, 0.0, 0.0), STILL)
    engine.step(1500)
    place, motion = engine.models["box"].placement(), engine.links["box::link"].motion()
    assert place.position[0, 0] - start == pytest.approx(speed**2 / (2 * mu * G), rel=0.03)
    assert np.abs(motion.linear).max() < 1e-3


@pytest.mark.parametrize(("degrees", "slides"), [(24.0, False), (29.0, True)])
def test_a_block_slips_on_a_slope_steeper_than_the_friction_angle(degrees, slides):
    mu = 0.5  # slips at 26.57 degrees
    tilt = math.radians(degrees)
    gravity = (G * math.sin(tilt), 0.0, -G * math.cos(tilt))
    block = scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=0.05), mu=mu)
    engine = engine_of(scenes.ground(), block, gravity=gravity)
    engine.step(1000)
    speed = engine.links["box::link"].motion().linear[0, 0]
    expected = G * (math.sin(tilt) - mu * math.cos(tilt)) if slides else 0.0
    assert speed == pytest.approx(expected, abs=0.03)


def test_the_slipperier_of_two_surfaces_decides_as_in_ode():
    icy = scenes.ground(mu=0.1)
    engine = engine_of(icy, scenes.box(size=(0.4, 0.4, 0.1), pose=Pose(z=0.05), mu=1.0))
    engine.step(300)
    engine.models["box"].set_motion((1.0, 0.0, 0.0), STILL)
    engine.step(500)
    speed = engine.links["box::link"].motion().linear[0, 0]
    assert speed == pytest.approx(1.0 - 0.1 * G * 0.5, rel=0.05)


def test_a_ball_rolls_down_a_slope_with_five_sevenths_of_the_sliding_acceleration():
    tilt = math.radians(10.0)
    gravity = (G * math.sin(tilt), 0.0, -G * math.cos(tilt))
    engine = engine_of(scenes.ground(), scenes.ball(pose=Pose(z=0.1)), gravity=gravity)
    engine.step(1000)
    motion = engine.links["ball::link"].motion()
    expected = 5.0 / 7.0 * G * math.sin(tilt)
    assert motion.linear[0, 0] == pytest.approx(expected, rel=0.02)
    assert motion.angular[0, 1] * 0.1 == pytest.approx(motion.linear[0, 0], rel=0.02)


def test_colliding_balls_keep_their_momentum_and_hardly_bounce_without_restitution():
    left = scenes.ball("left", mass=2.0, pose=Pose(x=-0.5))
    right = scenes.ball("right", mass=1.0, pose=Pose(x=0.5))
    engine = engine_of(left, right, gravity=(0.0, 0.0, 0.0))
    engine.models["left"].set_motion((1.5, 0.0, 0.0), STILL)
    engine.step(2000)
    v_left = engine.links["left::link"].motion().linear[0, 0]
    v_right = engine.links["right::link"].motion().linear[0, 0]
    assert 2.0 * v_left + v_right == pytest.approx(3.0, abs=1e-9)
    assert 0.0 <= v_right - v_left < 0.1 * 1.5


def test_a_body_rests_on_the_ground_within_a_tenth_of_a_millimetre():
    engine = engine_of(scenes.ground(), scenes.box(pose=Pose(z=0.3)))
    engine.step(3000)
    assert engine.models["box"].placement().position[0, 2] == pytest.approx(0.1, abs=1e-4)


@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("mu", [0.5, 1.0, 2.0, 100.0])
@pytest.mark.parametrize(
    "shape", [Cylinder(0.4, 1.0), Box((0.4, 0.3, 1.0))], ids=["cylinder", "box"]
)
def test_what_stands_on_the_ground_stands_still(shape, mu, step):
    for yaw in (0.0, 0.3, 0.6, 2.0, 2.5):
        moments = (2.5, 2.5, 1.6)
        post = scenes.solid(
            "post", shape, mass=20.0, moments=moments, mu=mu, pose=Pose(z=0.5, yaw=yaw)
        )
        engine = engine_of(scenes.ground(), post, step=step)
        for _ in range(20):
            engine.step(round(0.1 / step))
            place = engine.models["post"].placement().position[0]
            assert place == pytest.approx((0.0, 0.0, 0.5), abs=5e-4)


def test_a_free_rigid_body_keeps_its_angular_momentum_and_energy():
    moments = np.array([0.01, 0.02, 0.03])
    body = scenes.solid("top", Cylinder(0.1, 0.1), moments=tuple(moments))
    engine = engine_of(body, step=0.0005, gravity=(0.0, 0.0, 0.0))
    spin = np.array([0.1, 5.0, 0.1])
    engine.models["top"].set_motion(STILL, spin)

    def momentum():
        place, motion = engine.links["top::link"].placement(), engine.links["top::link"].motion()
        pose = Pose.from_quaternion((0, 0, 0), place.quaternion[0])
        rotation = pose.matrix()[:3, :3]
        return rotation @ (moments * (rotation.T @ motion.angular[0]))

    before = momentum()
    engine.step(2000)
    assert momentum() == pytest.approx(before, abs=0.02 * np.linalg.norm(before))


@pytest.mark.parametrize(("ratio", "deepest"), [(10.0, 2e-4), (100.0, 2e-3), (1e5, 4e-3)])
def test_what_is_heavy_stands_still_on_what_is_light(ratio, deepest):
    """Two light boxes with one on them that is many times heavier."""
    heavy = scenes.box("heavy", mass=ratio, pose=Pose(z=0.5))
    light = [scenes.box(f"light{i}", pose=Pose(z=0.1 + 0.2 * i)) for i in range(2)]
    engine = make_engine("mujoco", scenes.world(scenes.ground(), *light, heavy))
    engine.step(2000)
    heights = []
    for _ in range(200):
        engine.step(10)
        heights.append(engine.models["heavy"].placement().position[0, 2])
    assert 0.5 - min(heights) < deepest
    assert np.ptp(heights) < 2e-4
