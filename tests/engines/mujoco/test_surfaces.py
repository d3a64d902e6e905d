"""Terms of a surface: friction by direction and about the normal, softness, thresholds."""

import math
import warnings
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes

from gazelle.description import (
    Bounce,
    Contact,
    Friction,
    Ode,
    Pose,
    Surface,
    TorsionalFriction,
)
from gazelle.engines import make_engine
from gazelle.engines.laws import with_profile
from gazelle.errors import EngineWarning

G = 9.8


def with_surface(model, surface, **changes):
    link = model.links[0]
    collisions = tuple(replace(c, surface=surface) for c in link.collisions)
    return replace(model, links=(replace(link, collisions=collisions),), **changes)


def tilted(angle, heading=0.0):
    """Return gravity on a plane that falls by an angle towards a heading."""
    down = math.sin(angle)
    return (G * down * math.cos(heading), G * down * math.sin(heading), -G * math.cos(angle))


def slid(surface, angle, heading=0.0, *, ground=None, model=None, yaw=0.0):
    """Return the distance of a flat block down a slope in a second, after a tenth [m]."""
    block = scenes.box(size=(0.4, 0.4, 0.05), pose=Pose(z=0.025, yaw=yaw))
    block = with_surface(block, surface)
    world = scenes.world(ground or scenes.ground(), block, gravity=tilted(angle, heading))
    profile = replace(world.profile, ode=replace(world.profile.ode, friction_model=model))
    engine = make_engine("mujoco", with_profile(world, profile))
    engine.step(100)
    start = engine.models["box"].placement().position[0]
    engine.step(1000)
    return float(np.linalg.norm((engine.models["box"].placement().position[0] - start)[:2]))


@pytest.mark.parametrize("yaw", [0.0, 0.4])
@pytest.mark.parametrize("heading", [0.0, 0.6, math.pi / 4.0, 4.0])
@pytest.mark.parametrize("mu", [0.05, 0.1, 0.2, 0.5, 1.0, 1.5, 2.0])
def test_a_block_slips_at_the_friction_angle(mu, heading, yaw):
    """Within 2 %: at 98 % of it the block holds, at 102 % it goes about as far as mechanics says."""
    surface = scenes.rubber(mu)
    assert slid(surface, 0.98 * math.atan(mu), heading, yaw=yaw) < 0.002
    steep = 1.02 * math.atan(mu)
    pull = G * (math.sin(steep) - mu * math.cos(steep))
    far = pull * (1.1**2 - 0.1**2) / 2.0
    assert slid(surface, steep, heading, yaw=yaw) > 0.8 * far


def test_a_cone_is_used_where_things_lie_loose_or_where_it_is_asked_for():
    def cone(*models, step=0.001, **profile):
        world = scenes.world(scenes.ground(), *models, step=step)
        world = with_profile(world, replace(world.profile, **profile))
        engine = make_engine("mujoco", world)
        return engine.running.batch.model.opt.cone == mujoco.mjtCone.mjCONE_ELLIPTIC

    assert cone(scenes.box())
    assert cone(scenes.box(), step=0.01)
    assert cone(scenes.box(), scenes.burger())
    assert cone(scenes.box(), scenes.burger(), step=0.02)
    assert not cone(scenes.burger())
    assert cone(scenes.burger(), contacts="exact")
    assert not cone(scenes.box(), contacts="fast")
    pyramid = Ode(friction_model="pyramid_model")
    assert not cone(scenes.box(), ode=pyramid)
    assert cone(scenes.box(), ode=pyramid, contacts="exact")


def test_what_moves_only_when_told_to_asks_for_no_cone():
    engine = make_engine("mujoco", scenes.world(scenes.ground(), scenes.box(), scenes.burger()))
    engine.make_kinematic("box")
    engine.step()
    assert engine.running.batch.model.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL


@pytest.mark.parametrize("mu", [0.1, 0.5, 1.0])
@pytest.mark.parametrize("heading", [0.0, 0.3, math.pi / 4.0])
def test_a_pyramid_holds_and_slides_alike_in_every_direction(mu, heading):
    """Its sides are turned to the slip; else it would give way at 0.71 mu at 45 degrees."""
    model = "pyramid_model"
    assert slid(scenes.rubber(mu), math.atan(0.9 * mu), heading, model=model) < 0.002
    steep = math.atan(1.1 * mu)
    pull = G * (math.sin(steep) - mu * math.cos(steep))
    far = slid(scenes.rubber(mu), steep, heading, model=model)
    assert far == pytest.approx(pull * (1.1**2 - 0.1**2) / 2.0, rel=0.01)


@pytest.mark.parametrize(("mu", "mu2"), [(0.5, 0.1), (0.1, 0.5)])
def test_without_fdir1_friction_differs_along_y_and_x_on_level_ground_as_in_ode(mu, mu2):
    surface = Surface(Friction(mu, mu2))
    angle = math.atan(0.3)
    along_x, along_y = slid(surface, angle), slid(surface, angle, math.pi / 2.0)
    slippery, rough = (along_x, along_y) if mu2 < mu else (along_y, along_x)
    assert rough < 0.002
    pull = G * (math.sin(angle) - 0.1 * math.cos(angle))
    assert slippery == pytest.approx(pull * (1.1**2 - 0.1**2) / 2.0, rel=0.02)


def test_fdir1_of_the_ground_turns_the_directions():
    surface = Surface(Friction(0.5, 0.1, fdir1=(1.0, 0.0, 0.0)))
    floor = with_surface(scenes.ground(), surface)
    angle = math.atan(0.3)
    assert slid(scenes.rubber(5.0), angle, ground=floor) < 0.002
    assert slid(scenes.rubber(5.0), angle, math.pi / 2.0, ground=floor) > 0.5


def test_directions_do_not_matter_where_nothing_slips():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert (
            slid(Surface(Friction(100.0, 50.0, fdir1=(1.0, 0.0, 0.0))), math.radians(60.0)) < 0.01
        )


def test_the_friction_of_one_world_stays_in_it_and_off_other_pairs():
    first = with_surface(scenes.box("first", pose=Pose(z=0.1)), Surface(Friction(0.5, 0.1)))
    second = with_surface(scenes.box("second", pose=Pose(2.0, z=0.1)), Surface(Friction(0.5, 0.1)))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), first, second), nworld=2)
    engine.set_parameter("collision_friction", "first::link::c", [0.02], np.array([1]))
    pairs = engine.running.batch.expand("pair_friction")
    assert np.allclose(pairs[0, :, :2], (0.5, 0.1))
    assert sorted(pairs[1, :, :2].tolist()) == [[0.02, 0.02], [0.02, 0.02], [0.5, 0.1]]


def test_torsional_friction_stops_a_spinning_ball_as_hertz_says():
    torsional = TorsionalFriction(coefficient=0.5, patch_radius=0.02)
    surface = Surface(Friction(1.0, 1.0, torsional=torsional))
    ball = with_surface(scenes.ball(mass=2.0, pose=Pose(z=0.1)), surface)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), ball))
    engine.step(200)
    engine.models["ball"].set_motion((0.0, 0.0, 0.0), (0.0, 0.0, 20.0))
    engine.step(500)
    rate = 3.0 * math.pi / 16.0 * 0.5 * 0.02 * 2.0 * G / (0.4 * 2.0 * 0.1**2)
    assert engine.links["ball::link"].motion().angular[0, 2] == pytest.approx(
        20.0 - 0.5 * rate, rel=0.02
    )


def test_without_a_patch_radius_a_ball_spins_on():
    surface = Surface(Friction(1.0, 1.0, torsional=TorsionalFriction(patch_radius=0.0)))
    ball = with_surface(scenes.ball(pose=Pose(z=0.1)), surface)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), ball))
    engine.models["ball"].set_motion((0.0, 0.0, 0.0), (0.0, 0.0, 20.0))
    engine.step(1000)
    assert engine.links["ball::link"].motion().angular[0, 2] == pytest.approx(20.0, rel=1e-3)


@pytest.mark.parametrize(
    "torsional",
    [
        TorsionalFriction(use_patch_radius=False, surface_radius=0.1),
        TorsionalFriction(patch_radius=0.01, slip=0.2),
    ],
)
def test_torsional_friction_that_is_lost_is_warned_about(torsional):
    ball = with_surface(scenes.ball(pose=Pose(z=0.1)), Surface(Friction(torsional=torsional)))
    with pytest.warns(EngineWarning, match="<torsional> of collision 'ball::link::.*patch_radius"):
        make_engine("mujoco", scenes.world(scenes.ground(), ball))


@pytest.mark.parametrize(
    ("cfm", "erp", "mass"), [(0.01, 0.2, 1.0), (0.05, 0.5, 2.0), (1e-3, 0.1, 5.0)]
)
def test_a_soft_surface_gives_way_as_its_cfm_and_erp_say(cfm, erp, mass):
    """ODE at rest: erp / h * depth = cfm * force."""
    soft = Surface(Friction(0.5, 0.5), Contact(soft_cfm=cfm, soft_erp=erp))
    ball = with_surface(scenes.ball(radius=0.3, mass=mass, pose=Pose(z=0.3)), soft)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), ball))
    engine.step(4000)
    depth = 0.3 - engine.models["ball"].placement().position[0, 2]
    assert depth == pytest.approx(0.001 * cfm / erp * mass * G, rel=0.05)


def test_a_threshold_that_nothing_reaches_means_no_bounce():
    bouncy = Surface(bounce=Bounce(0.9, 200.0))
    ball = with_surface(scenes.ball(pose=Pose(z=0.6)), bouncy)
    floor = with_surface(scenes.ground(), bouncy)
    engine = make_engine("mujoco", scenes.world(floor, ball))
    engine.step(700)
    assert engine.models["ball"].placement().position[0, 2] == pytest.approx(0.1, abs=5e-3)


def test_slip_of_what_is_no_wheel_is_warned_about_once():
    slippery = Surface(Friction(1.0, 1.0, slip1=0.1))
    blocks = [
        with_surface(scenes.box(n, pose=Pose(x, z=0.1)), slippery) for n, x in (("a", 0), ("b", 1))
    ]
    with pytest.warns(
        EngineWarning, match=r"slip1 and slip2 of collision 'a::link::c' and 1 others"
    ) as caught:
        make_engine("mujoco", scenes.world(scenes.ground(), *blocks))
    assert len(caught) == 1
