"""In MuJoCo Warp meshes, ground by a picture, wind and attachments are what they are in MuJoCo."""

import importlib.util
from dataclasses import replace

import numpy as np
import pytest
import scenes
import trimesh
from PIL import Image as Picture

from gazelle.description import Heightmap, Inertia, Inertial, Link, Mesh, Model, Pose
from gazelle.engines import make_engine

if importlib.util.find_spec("mujoco_warp") is None:
    pytest.skip(
        "MuJoCo Warp is not here (docs/how-to/scale.md has the two commands)",
        allow_module_level=True,
    )

pytestmark = [
    pytest.mark.filterwarnings("ignore:the engine 'mujoco-warp' finds no graphics card"),
    pytest.mark.long,
]

STILL = (0.0, 0.0, 0.0)
NAMES = ("mujoco", "mujoco-warp")


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    importlib.import_module("warp").init()  # its kernels stay in the user's cache
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def saved(folder, mesh):
    mesh.export(folder / "m.stl")
    return Mesh("m.stl", folder / "m.stl")


def places(engine, name="ball::link"):
    return engine.links[name].placement().position


@pytest.mark.parametrize("static", [True, False], ids=["static", "loose"])
def test_a_ball_falls_through_a_ring_and_lies_on_its_rim(tmp_path, static):
    ring = saved(tmp_path, trimesh.creation.annulus(0.3, 0.4, 0.2))
    hoop = scenes.solid("hoop", ring, pose=Pose(z=0.1), static=static, mass=50.0)
    world = scenes.world(scenes.ground(), hoop, scenes.ball(), step=0.002)
    ends = []
    for name in NAMES:
        engine = make_engine(name, world, 2)
        engine.models["ball"].set_placement([(0.0, 0.0, 0.12), (0.35, 0.0, 0.31)], (0, 0, 0, 1))
        engine.step(50)
        ends.append(places(engine))
    assert ends[1][0] == pytest.approx((0.0, 0.0, 0.1), abs=2e-3)
    assert ends[1][1, 2] == pytest.approx(0.3, abs=5e-3)
    assert ends[1] == pytest.approx(ends[0], abs=1e-3)


def test_rays_see_a_mesh_as_it_is(tmp_path):
    hoop = scenes.solid(
        "hoop", saved(tmp_path, trimesh.creation.annulus(0.3, 0.4, 0.2)), static=True
    )
    world = scenes.world(hoop, scenes.box("eye", pose=Pose(z=2.0)), gravity=STILL)
    starts = np.column_stack([np.linspace(-0.5, 0.5, 41), np.zeros(41), np.zeros(41)])
    down = np.tile((0.0, 0.0, -1.0), (41, 1))
    one, other = (
        make_engine(name, world)
        .links["eye::link"]
        .cast_rays(starts, down, ignore_own=True)
        .distance
        for name in NAMES
    )
    assert 5 < np.isfinite(one).sum() < 20
    assert (np.isfinite(one) == np.isfinite(other)).all()
    assert other[np.isfinite(one)] == pytest.approx(one[np.isfinite(one)], abs=1e-5)


def test_ground_follows_its_picture(tmp_path):
    slope = np.tile(np.linspace(0, 255, 33).astype(np.uint8), (33, 1))
    Picture.fromarray(slope).save(tmp_path / "slope.png")
    shape = Heightmap("slope.png", tmp_path / "slope.png", size=(4.0, 4.0, 1.0))
    world = scenes.world(
        scenes.solid("hills", shape, static=True, mu=1.0), scenes.ball(mu=1.0), step=0.002
    )
    ends = []
    for name in NAMES:
        engine = make_engine(name, world, 2)
        engine.models["ball"].set_placement([(1.0, 0.0, 1.0), (0.0, 0.3, 0.7)], (0, 0, 0, 1))
        engine.step(200)
        ends.append(places(engine))
    assert (ends[1][:, 0] < (0.95, -0.05)).all()  # rolled down
    assert ends[1] == pytest.approx(ends[0], abs=5e-3)


def test_the_wind_carries_as_far():
    inertial = Inertial(1.0, inertia=Inertia(0.01, 0.01, 0.01))
    leaf = Model("leaf", links=(Link("link", inertial=inertial, enable_wind=True),))
    stone = Model("stone", links=(Link("link", inertial=inertial, pose=Pose(y=3.0)),))
    world = replace(scenes.world(leaf, stone, gravity=STILL), wind=(4.0, 1.0, 0.0))
    speeds = []
    for name in NAMES:
        engine = make_engine(name, world, 2)
        engine.models["leaf"].set_motion([(0.0, 0.0, 0.0), (-1.0, 0.0, 0.0)], STILL)
        engine.step(300)
        speeds.append(engine.links["leaf::link"].motion().linear)
        assert np.array_equal(engine.links["stone::link"].motion().linear, np.zeros((2, 3)))
    assert speeds[1][0, 0] > 0.5
    assert speeds[1] == pytest.approx(speeds[0], abs=1e-5)


def test_what_is_attached_hangs_and_falls_when_let_go():
    wall = scenes.box("wall", pose=Pose(z=1.0))
    world = scenes.world(replace(wall, static=True), scenes.box("load", pose=Pose(x=0.4, z=1.0)))
    ends = []
    for name in NAMES:
        engine = make_engine(name, world, 3)
        engine.attach("wall::link", "load::link", np.array([0, 2]))
        engine.step(100)
        held = places(engine, "load::link").copy()
        engine.detach("wall::link", "load::link", np.array([2]))
        engine.step(100)
        ends.append(np.stack([held, places(engine, "load::link")]))
    assert ends[1][:, 0, 2] == pytest.approx(1.0, abs=1e-3)  # held all the time
    assert ends[1][:, 2, 2] == pytest.approx((1.0, 1.0 - 9.8 * 0.1**2 / 2), abs=2e-3)
    assert ends[1] == pytest.approx(ends[0], abs=1e-4)
