"""Pictures by ray tracing, against geometry and light."""

import dataclasses
import math

import numpy as np
import pytest
import scenes

from gazelle.description import Light, Material, Plane, Pose, Scene, Sphere, Visual
from gazelle.engines.tracer import make_tracer
from gazelle.errors import SimulationError
from gazelle.sensors import View, look_at, render

RED = Material(diffuse=(1.0, 0.0, 0.0, 1.0))
WHITE = Material(diffuse=(1.0, 1.0, 1.0, 1.0))
SUN = Light("sun", "directional", cast_shadows=True, diffuse=(0.5, 0.5, 0.5, 1.0))
PLAIN = Scene(ambient=(0.2, 0.2, 0.2, 1.0), background=(0.0, 0.0, 1.0, 1.0), grid=False)


def seen(model, shape, material):
    link = model.links[0]
    visual = Visual("v", shape, material=material)
    return dataclasses.replace(model, links=(dataclasses.replace(link, visuals=(visual,)),))


def ball_over_floor():
    floor = seen(scenes.ground(), Plane(size=(20.0, 20.0)), WHITE)
    ball = seen(scenes.ball(pose=Pose(z=1.0)), Sphere(0.5), RED)
    return dataclasses.replace(scenes.world(floor, ball), scene=PLAIN, lights=(SUN,))


def picture(world, eye, target, **options):
    view = View(look_at(eye, target), **{"width": 60, "height": 60, **options})
    return render(make_tracer(world), world, view).astype(int)


def test_a_ball_covers_the_angle_that_geometry_says():
    world = dataclasses.replace(ball_over_floor(), models=ball_over_floor().models[1:])
    image = picture(world, (-4.0, 0.0, 1.0), (0.0, 0.0, 1.0), horizontal_fov=0.6)
    red = (image[..., 0] > 40) & (image[..., 2] < 40)
    pixel = 2 * math.tan(0.3) / 60
    expected = math.pi * math.tan(math.asin(0.5 / 4.0)) ** 2 / pixel**2
    assert red.sum() == pytest.approx(expected, rel=0.05)
    assert (image[0, 0] == [0, 0, 255]).all()


def test_the_floor_is_dark_under_the_ball_and_light_beside_it():
    image = picture(ball_over_floor(), (-3.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    shadow, lit = image[30, 30].sum(), image[30, 5].sum()
    assert shadow < 0.7 * lit


def test_without_shadows_the_floor_is_even():
    world = ball_over_floor()
    bright = dataclasses.replace(world, scene=dataclasses.replace(PLAIN, shadows=False))
    image = picture(bright, (-3.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    assert image[45, 30].tolist() == image[45, 5].tolist()


def test_left_is_left_and_up_is_up():
    world = ball_over_floor()
    moved = dataclasses.replace(world.models[1], pose=Pose(y=1.0, z=1.5))
    world = dataclasses.replace(world, models=(moved,))
    image = picture(world, (-5.0, 0.0, 1.0), (0.0, 0.0, 1.0))
    rows, columns = np.nonzero(image[..., 0] > 40)
    assert columns.mean() < 25
    assert rows.mean() < 30


def test_a_link_that_moved_is_seen_where_it_is():
    world = ball_over_floor()
    tracer = make_tracer(world)
    origin, down = np.array([[3.0, 0.0, 5.0]]), np.array([[0.0, 0.0, -1.0]])
    assert tracer.trace(origin, down).distance[0] == pytest.approx(5.0)
    tracer.place({"ball::link": Pose(3.0, 0.0, 1.0)})
    sight = tracer.trace(origin, down)
    assert sight.distance[0] == pytest.approx(3.5)
    np.testing.assert_allclose(sight.normal[0], [0.0, 0.0, 1.0], atol=1e-9)


def test_a_world_without_visuals_is_all_background():
    world = dataclasses.replace(scenes.world(scenes.ball()), scene=PLAIN)
    image = picture(world, (-3.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    assert (image == [0, 0, 255]).all()


@pytest.mark.parametrize("field", ["width", "height", "samples", "horizontal_fov", "pose"])
@pytest.mark.parametrize(
    "value", [np.zeros(3), np.array([]), np.array(["a"]), [1, 2], "x", None, True, 10**30, 0, -1]
)
def test_a_view_of_wrong_values_is_refused(field, value):
    whole = {"pose": Pose(), "width": 8, "height": 8}
    if field == "horizontal_fov" and value is True:
        value = math.pi
    world = ball_over_floor()
    with pytest.raises(SimulationError):
        render(make_tracer(world), world, View(**whole | {field: value}))
