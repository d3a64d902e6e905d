"""Rays meet the triangles of a mesh, whatever pieces collide in its stead."""

import numpy as np
import pytest
import scenes
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_rays import first_hits, rays_at

from gazelle.description import Mesh, Pose
from gazelle.engines import make_engine


@pytest.fixture(autouse=True, scope="module")
def _own_cache(tmp_path_factory):
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_CACHE_HOME", str(tmp_path_factory.mktemp("cache")))
        yield


def seen(folder, mesh, origins, directions, *, static=True, pose=Pose()):  # noqa: B008
    """Return an engine's ray hits from the world's frame on a mesh at a pose."""
    mesh.export(folder / "m.stl")
    thing = scenes.solid("thing", Mesh("m.stl", folder / "m.stl"), pose=pose, static=static)
    eye = scenes.solid("eye", scenes.Sphere(1e-3), pose=Pose(z=50.0))
    engine = make_engine("mujoco", scenes.world(thing, eye))
    local = origins - np.array([0.0, 0.0, 50.0])
    return engine.links["eye::link"].cast_rays(local, directions, ignore_own=True)


def bowl(sections=48):
    angles = np.linspace(0.0, np.pi / 2.0, 24)
    outer = np.stack([1.05 * np.sin(angles), -1.05 * np.cos(angles)], axis=1)
    inner = np.stack([np.sin(angles), -np.cos(angles)], axis=1)[::-1]
    return trimesh.creation.revolve(np.concatenate([outer, inner]), sections=sections)


def gear(teeth=12, radius=0.5, depth=0.08, height=0.1):
    turn = np.arange(4 * teeth) * (np.pi / 2.0 / teeth)
    length = np.where(np.arange(4 * teeth) % 4 < 2, radius, radius - depth)
    rim = np.stack([length * np.cos(turn), length * np.sin(turn)], axis=1)
    count = len(rim)
    points = [(*p, z) for z in (0.0, height) for p in rim] + [(0, 0, 0.0), (0, 0, height)]
    faces = []
    for i in range(count):
        j = (i + 1) % count
        faces += [(i, j, count + j), (i, count + j, count + i)]
        faces += [(2 * count, j, i), (2 * count + 1, count + i, count + j)]
    return trimesh.Trimesh(points, faces)


def sheet(seed):
    chance = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(-2, 2, 20), np.linspace(-2, 2, 20))
    z = chance.uniform(-0.3, 0.3, x.shape)
    corner = (np.arange(19)[:, None] * 20 + np.arange(19)).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + 21], 1),
            np.stack([corner, corner + 21, corner + 20], 1),
        ]
    )
    return trimesh.Trimesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), faces)


SHAPES = {
    "torus": lambda _: trimesh.creation.torus(1.0, 0.25),
    "thin torus": lambda _: trimesh.creation.torus(1.0, 0.03),
    "bowl": lambda _: bowl(),
    "gear": lambda _: gear(),
    "rough sheet": sheet,
    "ring": lambda _: trimesh.creation.annulus(0.6, 1.0, 0.4),
    "ball": lambda _: trimesh.creation.icosphere(subdivisions=3),
}


@pytest.mark.long
@pytest.mark.parametrize("static", [True, False])
@pytest.mark.parametrize("name", SHAPES)
def test_beams_meet_the_triangles(tmp_path, name, static):
    mesh = SHAPES[name](7)
    start, along = rays_at(mesh, 600, 1)
    hits = seen(tmp_path, mesh, start, along, static=static)
    expected = first_hits(mesh, start, along)
    same = np.isclose(hits.distance[0], expected, atol=5e-4) | (
        np.isinf(hits.distance[0]) & np.isinf(expected)
    )
    assert same.mean() > 0.997  # the rest graze an edge
    assert not hits.from_inside.any()


@pytest.mark.long
@settings(max_examples=25, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.floats(0.02, 0.6),
    st.integers(5, 40),
    st.floats(-3.0, 3.0),
    st.sampled_from(["torus", "gear", "star"]),
)
def test_beams_meet_any_ring_or_gear_anywhere(tmp_path_factory, seed, thick, count, turn, kind):
    if kind == "torus":
        mesh = trimesh.creation.torus(1.0, thick, major_sections=count, minor_sections=8)
    elif kind == "gear":
        mesh = gear(count, 1.0, thick, 0.3)
    else:
        mesh = gear(3, 1.0, 0.3 + thick, thick)
    pose = Pose(0.3, -0.2, 0.1, turn, 0.5 * turn, -turn)
    start, along = rays_at(mesh, 200, seed)
    matrix = pose.matrix()
    placed = mesh.copy().apply_transform(matrix)
    folder = tmp_path_factory.mktemp("any")
    hits = seen(folder, mesh, start, along, pose=pose)
    expected = first_hits(placed, start, along)
    off = np.abs(np.nan_to_num(hits.distance[0], posinf=99.0) - np.minimum(expected, 99.0))
    assert (off > 5e-3).sum() <= 2  # beams that graze an edge


def test_a_sheet_is_seen_from_both_sides_and_a_closed_mesh_has_an_inside(tmp_path):
    box = trimesh.creation.box((2, 2, 2))
    box.update_faces(box.face_normals[:, 2] < 0.5)  # no lid
    along = np.array([[1.0, 0.1, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    along /= np.linalg.norm(along, axis=1)[:, None]
    hits = seen(tmp_path, box, np.zeros((3, 3)), along)
    np.testing.assert_allclose(hits.distance[0], [np.hypot(1.0, 0.1), np.inf, 1.0], atol=1e-5)
    assert not hits.from_inside.any()
    ring = trimesh.creation.annulus(0.5, 1.0, 1.0)
    within = seen(tmp_path, ring, np.array([[0.75, 0.0, 0.0]]), np.array([[1.0, 0.0, 0.0]]))
    assert within.from_inside.all()


def test_what_rays_meet_collides_with_nothing(tmp_path):
    ring = trimesh.creation.annulus(0.3, 0.4, 0.2)
    ring.export(tmp_path / "m.stl")
    hoop = scenes.solid("hoop", Mesh("m.stl", tmp_path / "m.stl"), pose=Pose(z=0.1), static=True)
    ball = scenes.ball(pose=Pose(z=0.15))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), hoop, ball))
    for _ in range(300):
        engine.step()
    assert not len(engine.contacts([["hoop::link::c"]]).named().depth)


def test_rays_pass_through_the_shapes_of_their_own_link(tmp_path):
    ring = trimesh.creation.annulus(0.3, 0.4, 0.2)
    ring.export(tmp_path / "m.stl")
    for static in (True, False):
        hoop = scenes.solid("hoop", Mesh("m.stl", tmp_path / "m.stl"), static=static)
        wall = scenes.solid("wall", scenes.Box((0.1, 2, 2)), pose=Pose(x=1.0), static=True)
        engine = make_engine("mujoco", scenes.world(hoop, wall))
        start, along = np.zeros((1, 3)), np.array([[1.0, 0.0, 0.0]])
        near = engine.links["hoop::link"].cast_rays(start, along)
        far = engine.links["hoop::link"].cast_rays(start, along, ignore_own=True)
        assert near.distance[0, 0] == pytest.approx(0.3, abs=2e-3)
        assert far.distance[0, 0] == pytest.approx(0.95, abs=1e-4)
