"""Wide-angle cameras: where each projection puts things, cutoff, seams, and what is refused."""

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gazelle
from gazelle.errors import EngineError, SimulationWarning
from gazelle.formats import load_string
from gazelle.rendering import LensMapping, WideLens

# Of each projection where light of an angle falls, for a focal length of 1.
PROJECTIONS = {
    "gnomonical": math.tan,
    "stereographic": lambda angle: 2.0 * math.tan(angle / 2.0),
    "equidistant": lambda angle: angle,
    "equisolid_angle": lambda angle: 2.0 * math.sin(angle / 2.0),
    "orthographic": math.sin,
}
BALL = """<model name="b{n}"><static>1</static><pose>{x} {y} {z} 0 0 0</pose><link name="l">
<visual name="v"><geometry><sphere><radius>0.1</radius></sphere></geometry>
<material><emissive>{color} 1</emissive></material></visual></link></model>"""
WORLD = """<sdf version="1.6"><world name="w"><scene><ambient>0 0 0 1</ambient>
<background>0 0 0 1</background></scene>{balls}
<model name="robot"><static>1</static><link name="base">
<sensor type="wideanglecamera" name="eye"><update_rate>10</update_rate>
<camera><horizontal_fov>{fov}</horizontal_fov><image><width>200</width><height>150</height></image>
<clip><near>0.05</near><far>20</far></clip>{more}
<lens>{lens}<env_texture_size>{face}</env_texture_size></lens></camera>
<plugin name="p" filename="libgazebo_ros_camera.so"><cameraName>eye</cameraName></plugin>
</sensor></link></model></world></sdf>"""


def picture(directions, *, fov=2.0, lens="", face=256, more=""):
    """Return a camera's picture of white balls 2 m away in some directions."""
    balls = "".join(
        BALL.format(n=n, x=2.0 * x, y=2.0 * y, z=2.0 * z, color="1 1 1")
        for n, (x, y, z) in enumerate(directions)
    )
    text = WORLD.format(balls=balls, fov=fov, lens=lens, face=face, more=more)
    sim = gazelle.Simulation(load_string(text))
    return sim.robots["robot"].sensors["eye"].read().color


def middle_of(color):
    """Return column and row of the bright part, from the middle, in halves of the width."""
    rows, columns = np.nonzero(color[..., 0] > 100)
    assert rows.size, "nothing is seen"
    height, width = color.shape[:2]
    right = (columns.mean() + 0.5) / width * 2.0 - 1.0
    down = ((rows.mean() + 0.5) / height * 2.0 - 1.0) * height / width
    return right, down


def direction(angle, about):
    """Return a direction at an angle off the x axis, turned about it from the right downwards."""
    side = math.sin(angle)
    return (math.cos(angle), -side * math.cos(about), -side * math.sin(about))


@pytest.mark.parametrize("kind", PROJECTIONS)
@pytest.mark.parametrize("angle", [0.0, 0.5, 0.85])
def test_a_ball_is_where_the_projection_puts_it(kind, angle):
    about = 0.6
    seen = middle_of(picture([direction(angle, about)], lens=f"<type>{kind}</type>"))
    law = PROJECTIONS[kind]
    radius = law(angle) / law(1.0)  # half the field of view is at the picture's edge
    want = (radius * math.cos(about), radius * math.sin(about))
    assert seen == pytest.approx(want, abs=0.015)


@pytest.mark.parametrize("angle", [1.3, 2.2, 3.0])
def test_what_is_behind_is_seen_by_a_lens_of_the_whole_sphere(angle):
    lens = "<type>equidistant</type><cutoff_angle>3.15</cutoff_angle>"
    seen = middle_of(picture([direction(angle, 0.0)], fov=2.0 * math.pi, lens=lens))
    assert seen == pytest.approx((angle / math.pi, 0.0), abs=0.015)


def test_a_custom_function_and_a_focal_length_of_ones_own():
    lens = (
        "<type>custom</type><custom_function><c1>1.05</c1><c2>4</c2><c3>0.1</c3><f>0.8</f>"
        "<fun>tan</fun></custom_function><scale_to_hfov>0</scale_to_hfov>"
    )
    angle = 1.2
    seen = middle_of(picture([direction(angle, 0.3)], lens=lens))
    radius = 1.05 * 0.8 * math.tan(angle / 4.0 + 0.1)
    want = (radius * math.cos(0.3), radius * math.sin(0.3))
    assert seen == pytest.approx(want, abs=0.015)


def test_light_beyond_the_cutoff_is_dark():
    lens = "<type>equidistant</type><cutoff_angle>0.6</cutoff_angle>"
    near, far = (picture([direction(angle, 0.0)], lens=lens)[..., 0].max() for angle in (0.4, 0.8))
    assert near == 255
    assert far == 51


def test_faces_meet_without_a_seam():
    wall = """<model name="w{n}"><static>1</static><pose>{x} {y} {z} 0 0 0</pose><link name="l">
    <visual name="v"><geometry><box><size>3 3 3</size></box></geometry><material>
    <diffuse>0 0 0 1</diffuse><emissive>0.5 0.5 0.5 1</emissive></material></visual></link></model>"""
    around = [*np.eye(3), *-np.eye(3)]
    walls = "".join(
        wall.format(n=n, x=3.0 * x, y=3.0 * y, z=3.0 * z) for n, (x, y, z) in enumerate(around)
    )
    lens = "<type>equidistant</type><cutoff_angle>4</cutoff_angle>"
    text = WORLD.format(balls=walls, fov=5.0, face=32, more="", lens=lens)
    color = gazelle.Simulation(load_string(text)).robots["robot"].sensors["eye"].read().color
    assert color.min() == color.max() > 0


@given(
    kind=st.sampled_from(["sin", "tan", "id"]),
    c1=st.floats(0.1, 3.0),
    c2=st.floats(1.0, 5.0),
    f=st.floats(0.1, 3.0),
    angle=st.floats(0.0, 1.4),
)
def test_the_mapping_is_turned_around_exactly(kind, c1, c2, f, angle):
    mapping = LensMapping(c1, c2, 0.0, f, kind)
    assert mapping.angles(np.array([mapping.radius(angle)])) == pytest.approx([angle], abs=1e-6)


def test_a_pinhole_is_the_gnomonical_lens():
    lens = WideLens(64, 48, LensMapping(1.0, 1.0, 0.0, 1.0 / math.tan(0.5)))
    rays, _ = lens.rays()
    right = (np.arange(64) + 0.5) / 32.0 - 1.0
    assert -rays[0, :, 1] / rays[0, :, 0] == pytest.approx(right * math.tan(0.5))


def test_an_unknown_projection_is_named_and_gazebos_is_taken():
    with pytest.warns(SimulationWarning, match="'equidistance'; 'gnomonical' is taken"):
        picture([direction(0.0, 0.0)], lens="<type>equidistance</type>")


def test_a_field_of_view_that_the_projection_cannot_have_is_refused():
    world = load_string(
        WORLD.format(balls="", fov=4.0, face=64, more="", lens="<type>gnomonical</type>")
    )
    with pytest.warns(SimulationWarning, match="sees no light from half its field of view"):
        gazelle.Simulation(world)


def test_what_can_be_no_lens_is_refused():
    with pytest.raises(EngineError, match="env_texture_size"):
        WideLens(face=0)
    with pytest.raises(EngineError, match="above zero"):
        WideLens(mapping=LensMapping(c1=-1.0))


def test_the_plugin_publishes_its_pictures():
    text = WORLD.format(balls="", fov=2.0, face=64, more="", lens="")
    sim = gazelle.Simulation(load_string(text))
    told = []
    sim.robots["robot"].outputs["eye/image_raw"].subscribe(told.append)
    sim.run(0.15)
    assert [value.pixels.shape for value in told] == [(1, 150, 200, 3)]
