"""Shadows in the pictures of cameras."""

from __future__ import annotations

import numpy as np
import pytest

from gazelle import Simulation
from gazelle.description import (
    Box,
    Light,
    Link,
    Material,
    Model,
    Plane,
    Pose,
    Scene,
    Sphere,
    Visual,
    World,
)
from gazelle.rendering import PinholeLens, Renderer
from gazelle.rendering.shadow_maps import FARTHEST, casting_lamp
from gazelle.sensors import look_at

WHITE = Material(ambient=(1.0, 1.0, 1.0, 1.0), diffuse=(1.0, 1.0, 1.0, 1.0))
AMBIENT = Scene(ambient=(0.2, 0.2, 0.2, 1.0), background=(0.0, 0.0, 0.0, 1.0))
LENS = PinholeLens(120, 120, 0.8)
ABOVE = look_at((0.0, 0.001, 12.0), (0.0, 0.0, 0.0))


def sun(direction, *, casts=True):
    return Light(
        "sun", "directional", direction=direction, diffuse=(0.7, 0.7, 0.7, 1.0), cast_shadows=casts
    )


def model(name, shape, pose=None, **look):
    visual = Visual("v", geometry=shape, material=WHITE, **look)
    return Model(name, pose=pose or Pose(), links=(Link("link", visuals=(visual,)),))


FLOOR = model("floor", Plane((0.0, 0.0, 1.0), (100.0, 100.0)))


def picture(models, light, *, shadows=True, eye=ABOVE, threads=1, count=1):
    renderer = Renderer(
        World("w", models=tuple(models), lights=(light,), scene=AMBIENT),
        nworld=count,
        threads=threads,
        shadows=shadows,
    )
    at, way = np.array([eye.position] * count), np.array([eye.quaternion] * count)
    return renderer.render(LENS, at, way)


@pytest.mark.parametrize("direction", [(0.0, 0.0, -1.0), (0.6, 0.0, -0.8), (-0.3, 0.5, -0.7)])
def test_a_hovering_box_throws_its_shadow_where_the_light_goes(direction):
    """Against the closed form: the box moved along the light onto the floor."""
    height = 2.0
    box = model("box", Box((1.0, 1.0, 0.01)), Pose(z=height))
    shifted = -height * np.array(direction[:2]) / direction[2]
    frames = picture([FLOOR, box], sun(direction))
    focal = 60.0 / np.tan(0.4)
    rows, columns = np.mgrid[:120, :120] + 0.5
    # Down the picture and to its right, in the camera's axes.
    seen = frames.labels[0] == 0
    down = np.array(ABOVE.rotate((0.0, 0.0, -1.0)))
    right = np.array(ABOVE.rotate((0.0, -1.0, 0.0)))
    ahead = np.array(ABOVE.rotate((1.0, 0.0, 0.0)))
    ways = (
        ahead
        + ((rows - 60) / focal)[..., None] * down
        + ((columns - 60) / focal)[..., None] * right
    )
    spot = np.array(ABOVE.position) + ways * (-ABOVE.position[2] / ways[..., 2:])
    edge = np.abs(spot[..., :2] - shifted).max(axis=-1) - 0.5
    dark = frames.color[0, ..., 0] < 100
    assert dark[seen & (edge < -0.06)].all()
    assert not dark[seen & (edge > 0.06)].any()
    if direction[0]:
        assert (seen & (edge < -0.06)).sum() > 50
    shade = frames.color[0, ..., 0][seen & (edge < -0.06)]
    assert np.all(np.abs(shade.astype(int) - 51) <= 1)  # the ambient light alone


@pytest.mark.parametrize("direction", [(0.0, 0.0, -1.0), (0.9, 0.0, -0.45)])
def test_nothing_is_in_the_shadow_of_itself(direction):
    """What the light falls on is as bright as without shadows."""
    ball = model("ball", Sphere(1.0), Pose(z=1.0))
    eye = look_at((-3.0 * direction[0], -2.0, 5.0), (0.0, 0.0, 1.0))
    with_, without = (
        picture([FLOOR, ball], sun(direction), shadows=on, eye=eye) for on in (True, False)
    )
    np.testing.assert_array_equal(with_.depth, without.depth)
    np.testing.assert_array_equal(with_.labels, without.labels)
    difference = without.color[0].astype(int) - with_.color[0]
    assert difference.min() >= -2
    on_ball = with_.labels[0] == 1
    facing = without.color[0, ..., 0] > 130  # well in the light
    assert (difference[on_ball & facing].max(axis=-1) > 4).mean() < 0.01


def test_what_is_transparent_or_no_caster_throws_none():
    box = model("box", Box((1.0, 1.0, 0.01)), Pose(z=2.0), transparency=0.5)
    slanted = (0.6, 0.0, -0.8)
    frames = picture([FLOOR, box], sun(slanted))
    assert not (frames.color[0, ..., 0] < 100).any()
    solid = model("box", Box((1.0, 1.0, 0.01)), Pose(z=2.0))
    frames = picture([FLOOR, solid], sun(slanted, casts=False))
    assert not (frames.color[0, ..., 0] < 100).any()


def test_the_first_directional_lamp_that_may_casts():
    lamps = (
        Light("p", "point", cast_shadows=True),
        sun((0, 0, -1), casts=False),
        sun((0, 0, -1)),
    )
    assert casting_lamp(lamps) == 2
    assert casting_lamp(lamps[:2]) is None


def test_pictures_do_not_depend_on_threads_or_other_cameras():
    box = model("box", Box((1.0, 1.0, 1.0)), Pose(z=2.0))
    alone = picture([FLOOR, box], sun((0.6, 0.1, -0.8)))
    many = picture([FLOOR, box], sun((0.6, 0.1, -0.8)), threads=3, count=5)
    for each in many.color:
        np.testing.assert_array_equal(each, alone.color[0])


def test_a_large_world_has_shadows_before_each_camera():
    far = 4.0 * FARTHEST
    boxes = [model(f"b{x}", Box((1.0, 1.0, 0.01)), Pose(x, z=2.0)) for x in (0.0, far)]
    for x in (0.0, far):
        eye = look_at((x, 0.001, 12.0), (x, 0.0, 0.0))
        frames = picture([FLOOR, *boxes], sun((0.6, 0.0, -0.8)), eye=eye)
        dark = (frames.color[0, ..., 0] < 100) & (frames.labels[0] == 0)
        assert 100 < dark.sum() < 1000


def test_a_robots_camera_sees_them_when_asked():
    """In a simulation, and where things are now."""
    with Simulation("turtlebot3_world", "planar") as simulation:
        eye = look_at((-3.0, -3.0, 2.5), (0.0, 0.0, 0.2))
        at, way = np.array([eye.position]), np.array([eye.quaternion])
        scene = simulation.live_scene
        plain = scene.render(LENS, at, way, want=("color",)).color
        scene.shadows = True
        shaded = scene.render(LENS, at, way, want=("color",)).color
        scene.shadows = False
        np.testing.assert_array_equal(scene.render(LENS, at, way, want=("color",)).color, plain)
    darker = (plain.astype(int) - shaded).max(axis=-1) > 20
    assert 0.01 < darker.mean() < 0.5
