"""Shapes collide as they look: hollows stay hollow, ground follows its picture."""

from dataclasses import replace

import numpy as np
import pytest
import scenes
import trimesh
from PIL import Image as Picture

from gazelle import formats
from gazelle.description import Heightmap, Image, Joint, JointAxis, Mesh, Plane, Polyline, Pose
from gazelle.engines import make_engine
from gazelle.errors import EngineWarning, FormatError


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def rest(*models, seconds=1.5, name="ball", step=0.002):
    """Return the pose of a model after a while."""
    engine = make_engine("mujoco", scenes.world(scenes.ground(), *models, step=step))
    for _ in range(round(seconds / step)):
        engine.step()
    return engine.models[name].placement().position[0]


@pytest.mark.parametrize("spin", [0.0, 2.0])
def test_the_plane_of_a_body_that_moves_stays_where_it_begins(spin):
    lying = Joint("j", "revolute", "world", "link", axes=(JointAxis((0.0, 0.0, 1.0)),))
    plane = scenes.solid("tilted", Plane(), pose=Pose(z=0.5, roll=0.2))
    plane = replace(plane, joints=(lying,))
    with pytest.warns(EngineWarning, match="'c' of the link 'tilted::link' stays where it is"):
        engine = make_engine("mujoco", scenes.world(plane, scenes.ball(pose=Pose(z=0.7))))
    engine.joints["tilted::j"].set_velocity(spin)
    engine.step(300)
    _, y, z = engine.models["ball"].placement().position[0]
    across = (z - 0.5) * np.cos(0.2) - y * np.sin(0.2)  # of the plane
    assert across == pytest.approx(0.1, abs=1e-3)
    assert y < -0.04  # rolls down
    assert engine.contacts([("tilted::link::c",)]).named().others[0].startswith("ball")


def saved_mesh(folder, mesh):
    mesh.export(folder / "m.stl")
    return Mesh("m.stl", folder / "m.stl")


@pytest.mark.parametrize("static", [True, False])
def test_a_ball_drops_through_a_ring(tmp_path, static):
    ring = saved_mesh(tmp_path, trimesh.creation.annulus(0.3, 0.4, 0.2))
    hoop = scenes.solid("hoop", ring, pose=Pose(z=0.15), static=static, mass=5.0)
    assert rest(hoop, scenes.ball(pose=Pose(z=0.6)))[2] == pytest.approx(0.1, abs=0.01)
    on_rim = rest(hoop, scenes.ball(pose=Pose(x=0.35, z=0.6)), seconds=0.45)
    assert on_rim[2] > 0.25


def test_a_ball_stays_in_a_bowl(tmp_path):
    outer = trimesh.creation.box((1, 1, 0.5))
    outer.update_faces(outer.face_normals[:, 2] < 0.5)  # a box of sheets, open above
    tray = scenes.solid("tray", saved_mesh(tmp_path, outer), pose=Pose(z=0.5), static=True)
    x, y, z = rest(tray, scenes.ball(pose=Pose(x=0.2, z=1.0)))
    assert z == pytest.approx(0.25 + 0.1, abs=0.03)
    assert max(abs(x), abs(y)) < 0.45


def test_an_outline_with_a_hole_is_a_frame():
    square = ((-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0))
    hole = tuple((x / 2, y / 2) for x, y in square)
    frame = scenes.solid("frame", Polyline((square, hole), 0.3), static=True)
    assert rest(frame, scenes.ball(pose=Pose(z=0.6)))[2] == pytest.approx(0.1, abs=0.01)
    on_frame = rest(frame, scenes.ball(pose=Pose(x=0.75, z=0.6)))
    assert on_frame[2] == pytest.approx(0.4, abs=0.01)


def test_ground_follows_the_heightmap(tmp_path):
    step = np.zeros((33, 33), np.uint8)
    step[:, 20:] = 200
    step[:4, :12] = 100
    Picture.fromarray(step).save(tmp_path / "h.png")
    land = Heightmap("h.png", tmp_path / "h.png", size=(8.0, 8.0, 1.0), position=(0, 0, 0.5))
    ground = scenes.solid("land", land, static=True)
    for x, y, height in ((-2, 0, 0.0), (3, 0, 1.0), (-3, 3.7, 0.5), (-3, -3.7, 0.0)):
        z = rest(ground, scenes.ball(pose=Pose(x=x, y=y, z=0.8 + height)))[2]
        assert z == pytest.approx(0.5 + height + 0.1, abs=0.02)


def test_dark_pixels_are_walls(tmp_path):
    Picture.fromarray(np.array([[255, 0], [255, 255]], np.uint8)).save(tmp_path / "i.png")
    walls = scenes.solid("walls", Image("i.png", tmp_path / "i.png", height=0.4), static=True)
    assert rest(walls, scenes.ball(pose=Pose(x=0.5, y=0.5, z=0.8)))[2] == pytest.approx(
        0.5, abs=0.01
    )
    assert rest(walls, scenes.ball(pose=Pose(x=0.5, y=-0.5, z=0.4)))[2] == pytest.approx(
        0.1, abs=0.01
    )


def test_pictures_that_cannot_be_read(tmp_path):
    (tmp_path / "h.png").write_text("?")
    (tmp_path / "h.dem").write_text("?")
    bad = scenes.solid("bad", Heightmap("h.png", tmp_path / "h.png"), static=True)
    with pytest.raises(FormatError, match="cannot be used"):
        make_engine("mujoco", scenes.world(bad))
    other = scenes.solid("dem", Heightmap("h.dem", tmp_path / "h.dem"), static=True)
    with pytest.raises(FormatError, match=r"not an elevation model of the USGS.*gdal_translate"):
        make_engine("mujoco", scenes.world(other))
    missing = scenes.solid("gone", Heightmap("h.png", None), static=True)
    make_engine("mujoco", scenes.world(missing, scenes.ground()))


@pytest.mark.corpus
@pytest.mark.filterwarnings("ignore::gazelle.errors.GazelleWarning")
def test_a_ball_is_free_inside_the_walls_of_turtlebot3_world(corpus):
    simulations = corpus / "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo"
    world = formats.load(simulations / "worlds/turtlebot3_world.world")
    ball = scenes.ball(pose=Pose(-2.0, -0.5, 0.1))
    x, y, z = rest(*world.models, ball)
    assert (x, y) == pytest.approx((-2.0, -0.5), abs=0.01)
    assert z == pytest.approx(0.1, abs=0.01)
