"""Convex pieces are where the mesh is: nothing is missing, nothing is made up, within a bound."""

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.geometry import convex_decomposition as convex
from gazelle.geometry.convex_decomposition import PROMISED, decompose
from gazelle.geometry.hull import convex_hull
from gazelle.geometry.mesh_data import MeshData

SKIN = 0.01


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    convex._MEMORY.clear()


def data(mesh):
    return MeshData(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int32))


def outside(pieces, points):
    """Return the largest distance of points out of the nearest piece [m]; negative inside."""
    nearest = np.full(len(points), np.inf)
    for piece in pieces.solids:
        hull = convex_hull(piece.vertices)
        if hull is not None:
            nearest = np.minimum(nearest, -hull.depth(points))
    return nearest


def on(mesh, count, seed=0):
    return trimesh.sample.sample_surface(mesh, count, seed=seed)


def bowl(sections=32, rings=12, radius=1.0, thick=0.05):
    angles = np.linspace(0.0, np.pi / 2.0, rings)
    outer = (radius + thick) * np.stack([np.sin(angles), -np.cos(angles)], axis=1)
    inner = radius * np.stack([np.sin(angles), -np.cos(angles)], axis=1)[::-1]
    return trimesh.creation.revolve(np.concatenate([outer, inner]), sections=sections)


def walls(outline, thick, height, doors=()):
    """Return a house of one mesh: boxes along an outline, with gaps, all welded together."""
    parts = []
    for (x, y), (u, v) in zip(outline, outline[1:] + outline[:1], strict=True):
        length = float(np.hypot(u - x, v - y))
        gaps = [(a, b) for wall, a, b in doors if wall == len(parts)]
        spans = [(0.0, gaps[0][0]), (gaps[0][1], length)] if gaps else [(0.0, length)]
        group = []
        for start, end in spans:
            box = trimesh.creation.box((end - start, thick, height))
            box.apply_translation(((start + end) / 2.0, 0.0, height / 2.0))
            box.apply_transform(
                trimesh.transformations.rotation_matrix(np.arctan2(v - y, u - x), (0, 0, 1))
            )
            group.append(box.apply_translation((x, y, 0.0)))
        parts.append(trimesh.util.concatenate(group))
    return trimesh.util.concatenate(parts)


def stairs(count=8):
    rim = [(0.0, 0.0), (0.3 * count, 0.0)]
    for i in range(count, 0, -1):
        rim += [(0.3 * i, 0.18 * i), (0.3 * (i - 1), 0.18 * i)]
    points = [(x, side, z) for side in (0.0, 1.0) for x, z in rim]
    n, faces = len(rim), []
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, i + n, j + n), (i, j + n, j)]
    for i in range(count):  # each step is a column below its top
        top, next_top = n - 2 - 2 * i, n - 1 - 2 * i
        faces += [(0, next_top, top), (n, n + top, n + next_top)]
    return trimesh.Trimesh(points, faces)


SOLIDS = {
    "torus": lambda: trimesh.creation.torus(1.0, 0.2),
    "thin torus": lambda: trimesh.creation.torus(1.0, 0.02),
    "bowl": bowl,
    "small bowl": lambda: bowl(radius=0.05, thick=0.004),
    "ring": lambda: trimesh.creation.annulus(0.4, 0.5, 0.3),
    "large ring": lambda: trimesh.creation.annulus(4.0, 5.0, 3.0),
    "capsule": lambda: trimesh.creation.capsule(1.0, 0.3),
    "house": lambda: walls([(0, 0), (6, 0), (6, 4), (0, 4)], 0.15, 2.5, [(0, 2.0, 3.0)]),
}


@pytest.mark.parametrize("name", SOLIDS)
@pytest.mark.parametrize("static", [True, False])
def test_the_whole_surface_is_covered_and_no_air_is(name, static):
    mesh = SOLIDS[name]()
    pieces = decompose(data(mesh), static=static)
    assert pieces.gap <= pieces.promised
    reach = max(pieces.gap, 1e-6)
    points, faces = on(mesh, 1500)
    inwards = points - 1e-4 * mesh.scale * mesh.face_normals[faces]
    assert outside(pieces, inwards).max() <= reach
    beyond = points + (1.05 * reach + 1e-4) * mesh.face_normals[faces]
    air = ~near(mesh, beyond, reach)
    few = 0.05 if name == "house" else 0.01  # whose walls run into each other
    assert (outside(pieces, beyond[air]) <= 0.0).mean() < few


def near(mesh, points, distance):
    """Return points in the mesh, or nearer to it than this: the other side of a gap."""
    return closest(mesh, points) < 0.999 * distance


def closest(mesh, points):
    """Return distance to the nearest of many places on a mesh, at least the true one [m]."""
    spatial = pytest.importorskip("scipy.spatial")
    places, _ = on(mesh, 200_000, 1)
    found, _ = spatial.cKDTree(places).query(points)
    return found


@pytest.mark.parametrize("scale", [0.01, 1.0, 30.0])
def test_what_stands_still_is_followed_whatever_its_size(scale):
    mesh = trimesh.creation.torus(1.0, 0.3, major_sections=64, minor_sections=32)
    mesh.apply_scale(scale)
    pieces = decompose(data(mesh), static=True)
    assert pieces.gap <= PROMISED
    points, faces = on(mesh, 500)
    assert outside(pieces, points - 1e-5 * scale * mesh.face_normals[faces]).max() <= pieces.gap


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(4, 14), st.floats(0.05, 1.5))
def test_rough_ground_is_followed(seed, count, height):
    chance = np.random.default_rng(seed)
    x, y = np.meshgrid(np.linspace(-3, 3, count), np.linspace(-3, 3, count))
    z = chance.uniform(0.0, height, x.shape)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + count + 1], 1),
            np.stack([corner, corner + count + 1, corner + count], 1),
        ]
    )
    mesh = trimesh.Trimesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), faces)
    pieces = decompose(data(mesh), static=True)
    points, rows = on(mesh, 300, seed)
    normals = mesh.face_normals[rows]
    assert outside(pieces, points - 1e-4 * normals).max() <= pieces.gap
    assert (outside(pieces, points + (pieces.gap + SKIN + 0.01) * normals) > 0.0).mean() > 0.9


def test_a_room_seen_from_within_is_hollow():
    room = trimesh.creation.box((4.0, 3.0, 2.5))
    room.invert()
    pieces = decompose(data(room), static=True)
    assert not pieces.whole
    assert (outside(pieces, np.array([[0.0, 0, 0], [1.9, 1.4, 1.2]])) > 0.0).all()
    assert (outside(pieces, np.array([[2.003, 0, 0], [0, 0, -1.253]])) < 0.0).all()


def test_a_wall_with_a_window_keeps_it():
    wall = trimesh.creation.box((4.0, 0.2, 3.0))
    frame = [(-0.5, -0.4), (0.7, -0.4), (0.7, 0.8), (-0.5, 0.8)]
    outer = [(-2.0, -1.5), (2.0, -1.5), (2.0, 1.5), (-2.0, 1.5)]
    points = [(x, y, z) for y in (-0.1, 0.1) for x, z in outer + frame]
    faces = []
    for i in range(4):
        j = (i + 1) % 4
        faces += [(i, j, 4 + j), (i, 4 + j, 4 + i)]
        faces += [(8 + j, 8 + i, 12 + j), (12 + j, 8 + i, 12 + i)]
        faces += [(j, i, 8 + i), (j, 8 + i, 8 + j), (4 + i, 4 + j, 12 + i), (12 + i, 4 + j, 12 + j)]
    holed = trimesh.Trimesh(points, faces)
    assert holed.is_watertight
    assert holed.volume == pytest.approx(wall.volume - 1.2 * 1.2 * 0.2)
    for static in (True, False):
        pieces = decompose(data(holed), static=static)
        through = np.array([[0.1, y, 0.2] for y in np.linspace(-0.5, 0.5, 11)])
        through = np.concatenate(
            [through + shift * np.array([0.55, 0, 0.55]) for shift in (-1, 0, 1)]
        )
        assert (outside(pieces, through) > 0.0).all()
        assert (outside(pieces, np.array([[1.5, 0.09, 0], [0.1, -0.09, 1.2]])) < 0.0).all()


def test_stairs_are_stairs():
    steps = stairs()
    pieces = decompose(data(steps), static=True)
    for i in range(8):
        x = 0.3 * i + 0.15
        heights = np.array([[x, 0.5, 0.18 * (i + 1) - 0.005], [x, 0.5, 0.18 * (i + 1) + 0.005]])
        below, above = outside(pieces, heights)
        assert below <= 0.0 < above


@pytest.mark.long
def test_much_is_done_soon():
    """Hundreds of thousands of triangles take seconds, not minutes."""
    import time

    mesh = trimesh.creation.icosphere(subdivisions=6)
    mesh.vertices[:, 2] += 0.2 * np.sin(9.0 * mesh.vertices[:, 0])
    start = time.process_time()
    decompose(data(mesh), static=False)
    assert time.process_time() - start < 20.0  # 4 to 6 s, more beside others
