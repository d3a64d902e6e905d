"""Meshes become convex pieces that fill no hole."""

import tracemalloc

import numpy as np
import pytest
import trimesh
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle.description import Mesh
from gazelle.formats import load_mesh
from gazelle.geometry import convex_decomposition as convex
from gazelle.geometry import piece_cache
from gazelle.geometry.convex_decomposition import decompose
from gazelle.geometry.hull import convex_hull, hulls_of
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.polygons import planar_area, planar_hull
from gazelle.geometry.surface import clean, components


def convex_pieces(mesh, static=False):
    return list(decompose(mesh, static=static).solids)


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    """Isolate the user's cache."""
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    convex._MEMORY.clear()
    yield
    convex._MEMORY.clear()


def data(*meshes):
    whole = trimesh.util.concatenate(meshes) if len(meshes) > 1 else meshes[0]
    return MeshData(np.asarray(whole.vertices, float), np.asarray(whole.faces, np.int32))


def volume(piece):
    a, b, c = (piece.vertices[piece.faces[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->", a, np.cross(b, c))) / 6.0


def inside(pieces, points, margin=0.0):
    """Return whether each point lies in the hull of some piece, by more than the margin."""
    points = np.asarray(points, float)
    found = np.zeros(len(points), bool)
    for piece in pieces:
        hull = convex_hull(piece.vertices)
        if hull is not None:
            found |= hull.depth(points) > margin
    return found


def ring(outer=1.0, inner=0.8, height=0.5):
    return trimesh.creation.annulus(inner, outer, height, sections=32)


def l_shape():
    return extruded([(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)])


def extruded(corners, height=1.0):
    """Return a prism over a polygon that the corner 0 sees wholly."""
    n = len(corners)
    low = [(x, y, 0.0) for x, y in corners]
    high = [(x, y, height) for x, y in corners]
    fan = [(0, i, i + 1) for i in range(1, n - 1)]
    faces = [(c, b, a) for a, b, c in fan] + [(a + n, b + n, c + n) for a, b, c in fan]
    for i in range(n):
        j = (i + 1) % n
        faces += [(i, j, j + n), (i, j + n, i + n)]
    return trimesh.Trimesh(low + high, faces, process=False)


@pytest.mark.parametrize(
    "mesh",
    [
        trimesh.creation.box((1, 2, 3)),
        trimesh.creation.icosphere(subdivisions=3),
        trimesh.creation.cylinder(0.5, 2.0),
        trimesh.creation.box((0.1, 0.1, 0.001)),
    ],
    ids=["box", "ball", "cylinder", "plate"],
)
def test_a_convex_mesh_stays_whole(mesh):
    (piece,) = convex_pieces(data(mesh))
    assert volume(piece) == pytest.approx(mesh.volume, rel=1e-6)


def test_a_small_dent_is_filled_and_a_deep_one_is_not():
    def dented(depth):
        mesh = trimesh.creation.box((1, 1, 1)).subdivide().subdivide()
        top = np.abs(mesh.vertices - (0.0, 0.0, 0.5)).sum(axis=1).argmin()
        mesh.vertices[top] -= (0.0, 0.0, depth)
        return data(mesh)

    assert len(convex_pieces(dented(0.004))) == 1
    assert len(convex_pieces(dented(0.008), static=True)) == 1
    deep = convex_pieces(dented(0.2))
    assert len(deep) > 1
    assert not inside(deep, [[0.0, 0.0, 0.45]]).any()


def test_parts_that_do_not_touch_are_pieces_of_their_own():
    boxes = [trimesh.creation.box((1, 1, 1)).apply_translation((3.0 * i, 0, 0)) for i in range(3)]
    pieces = convex_pieces(data(*boxes))
    assert [volume(piece) for piece in pieces] == pytest.approx([1.0] * 3)
    assert not inside(pieces, [[1.5, 0, 0], [4.5, 0, 0]]).any()


@pytest.mark.parametrize("static", [True, False])
def test_a_ring_keeps_its_hole(static):
    pieces = convex_pieces(data(ring()), static=static)
    assert len(pieces) > 1
    angles = np.linspace(0.0, 2.0 * np.pi, 50) + 0.01
    circle = np.stack([np.cos(angles), np.sin(angles), np.zeros(50)], axis=1)
    assert not inside(pieces, [[0, 0, 0], *(0.75 * circle)]).any()
    assert inside(pieces, 0.95 * circle).all()
    assert inside(pieces, 0.805 * circle).all()
    assert not inside(pieces, 1.02 * circle).any()


@pytest.mark.parametrize("static", [True, False])
def test_pieces_of_an_angle_fill_it_and_no_more(static):
    pieces = convex_pieces(data(l_shape()), static=static)
    assert not inside(pieces, [[1.5, 1.5, 0.5], [1.1, 1.1, 0.5], [-0.1, 1, 0.5]]).any()
    near_surface = [[0.02, 1, 0.5], [1.98, 0.5, 0.5], [0.5, 1.98, 0.5], [0.5, 0.4, 0.98]]
    assert inside(pieces, near_surface).all()


def test_a_thick_box_with_a_cavity_stays_hollow():
    outer = trimesh.creation.box((2, 2, 2))
    inner = trimesh.creation.box((1.8, 1.8, 1.8))
    inner.invert()
    pieces = convex_pieces(data(outer, inner), static=True)
    assert not inside(pieces, [[0, 0, 0], [0.85, 0.85, 0.85]]).any()
    assert inside(pieces, [[0.98, 0, 0], [0.92, 0, 0], [0, -0.96, 0]]).all()


@pytest.mark.parametrize("static", [True, False])
def test_an_open_box_is_not_closed(static):
    box = trimesh.creation.box((1, 1, 1))
    box.update_faces(box.face_normals[:, 2] < 0.5)  # no lid
    pieces = convex_pieces(data(box), static=static)
    assert len(pieces) >= 5
    assert not inside(pieces, [[0, 0, 0.45], [0, 0, -0.4]]).any()
    assert inside(pieces, [[0, 0, -0.499], [0.499, 0, 0]]).all()


def test_a_sheet_drawn_from_both_sides_is_one_thin_piece():
    square = trimesh.Trimesh(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]],
        [[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]],
        process=False,
    )
    for static in (True, False):
        (piece,) = convex_pieces(data(square), static=static)
        assert 0.0 < volume(piece) <= 0.0101


def test_pieces_are_convex_and_look_outwards():
    for mesh in (ring(), l_shape(), trimesh.creation.torus(1.0, 0.2)):
        for piece in convex_pieces(data(mesh)):
            a, b, c = (piece.vertices[piece.faces[:, i]] for i in range(3))
            normals = np.cross(b - a, c - a)
            heights = normals @ piece.vertices.T - np.einsum("ij,ij->i", normals, a)[:, None]
            assert heights.max() <= 1e-5
            assert volume(piece) > 0.0


@settings(max_examples=40, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(1, 30), st.sampled_from([0.0, 1.0, 1e-4, 1e4]))
def test_any_triangles_become_finite_pieces(seed, count, scale):
    chance = np.random.default_rng(seed)
    vertices = chance.integers(-3, 4, (count + 2, 3)) * scale
    faces = chance.integers(0, count + 2, (count, 3)).astype(np.int32)
    for piece in convex_pieces(MeshData(vertices, faces)):
        assert np.isfinite(piece.vertices).all()
        assert piece.faces.max() < len(piece.vertices)


def test_pieces_are_made_once_and_slow_ones_kept_on_disk(monkeypatch):
    monkeypatch.setattr(convex, "SLOW", -1.0)
    first = convex_pieces(data(ring()))
    assert len(list(piece_cache.folder().glob("*.npz"))) == 1
    monkeypatch.setattr(convex, "_cut", None)
    assert convex_pieces(data(ring())) == first  # from memory
    convex._MEMORY.clear()
    again = convex_pieces(data(ring()))  # from disk
    assert len(again) == len(first)
    for one, other in zip(first, again, strict=True):
        np.testing.assert_array_equal(one.vertices, other.vertices)
        np.testing.assert_array_equal(one.faces, other.faces)


def test_a_damaged_file_of_the_cache_is_made_anew(monkeypatch):
    monkeypatch.setattr(convex, "SLOW", -1.0)
    count = len(convex_pieces(data(ring())))
    (file,) = piece_cache.folder().glob("*.npz")
    for content in (b"", b"PK\x03\x04 rubbish", file.read_bytes()[:200]):
        file.write_bytes(content)
        convex._MEMORY.clear()
        assert len(convex_pieces(data(ring()))) == count


def test_a_cache_that_cannot_be_written_does_no_harm(tmp_path, monkeypatch):
    (tmp_path / "cache").write_text("a file, no folder")
    monkeypatch.setattr(convex, "SLOW", -1.0)
    assert convex_pieces(data(ring()))


def test_vertices_of_pieces_cannot_be_changed_by_accident():
    (piece,) = convex_pieces(data(trimesh.creation.box((1, 1, 1))))
    with pytest.raises(ValueError, match="read-only"):
        piece.vertices[0, 0] = 1.0


@settings(max_examples=60, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(4, 200), st.sampled_from(["ball", "grid"]))
def test_the_hull_holds_all_points_and_is_that_of_scipy(seed, count, kind):
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(seed).normal(size=(count, 3))
    if kind == "grid":
        points = np.round(points)
    hull = convex_hull(points)
    if hull is None:
        assert np.linalg.matrix_rank(points - points[0], tol=1e-6) < 3
        return
    assert hull.depth(points).min() > -4e-6 * np.linalg.norm(np.ptp(points, axis=0))
    solid = MeshData(points, hull.faces.astype(np.int32))
    assert volume(solid) == pytest.approx(spatial.ConvexHull(points).volume, rel=1e-5)


@settings(max_examples=30, deadline=None)
@given(st.integers(0, 2**32 - 1), st.integers(4, 60), st.sampled_from([1e-3, 1.0, 1e4]))
def test_many_hulls_at_once_are_those_made_one_by_one(seed, count, scale):
    chance = np.random.default_rng(seed)
    clouds = [scale * (chance.normal(size=(count, 3)) + 5.0) for _ in range(3)]
    for cloud, (corners, faces) in zip(clouds, hulls_of(clouds), strict=True):
        hull = convex_hull(cloud)
        assert hull.depth(corners).max() <= 1e-5 * scale
        assert volume(MeshData(corners, faces)) == pytest.approx(
            volume(MeshData(cloud, hull.faces.astype(np.int32))), rel=1e-4
        )


def test_the_hull_in_the_plane():
    points = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.5, 0.5], [0.5, 0]], float)
    assert planar_hull(points).tolist() == [0, 1, 2, 3]
    assert planar_area(points[planar_hull(points)]) == 1.0


@pytest.mark.long
@pytest.mark.parametrize("count", [30, 100])
def test_nearly_convex_meshes_of_many_vertices_take_little_memory(count):
    mesh = trimesh.creation.uv_sphere(radius=0.5, count=[count, count])
    vertices = np.array(mesh.vertices)
    vertices[len(vertices) // 2] *= 0.995
    nearly = MeshData(vertices, np.asarray(mesh.faces, np.int32))
    tracemalloc.start()
    (piece,) = convex_pieces(nearly)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert len(piece.vertices) == len(vertices)
    assert most < 5_000 * len(vertices) + 100e6
    vertices[len(vertices) // 2] *= 0.9
    assert len(convex_pieces(MeshData(vertices, nearly.faces))) > 1


def test_surfaces_are_welded_and_cleaned():
    box = trimesh.creation.box((1, 1, 1))
    soup = box.triangles.reshape(-1, 3)
    faces = np.arange(len(soup), dtype=np.int32).reshape(-1, 3)
    faces = np.concatenate([faces, faces[:1, ::-1], [[0, 0, 1]]]).astype(np.int32)
    surface = clean(soup, faces)
    assert (len(surface.vertices), len(surface.faces)) == (8, 12)
    assert surface.is_closed()
    assert surface.volume == pytest.approx(1.0)
    assert components(surface).max() == 0
    starts = np.array([[0.0, 0.1, 0.2], [2, 0, 0], [-2, 0.1, 0.2]])
    hits, behind = surface.rays.first_hits(starts, np.array([[1.0, 0, 0]] * 3))
    # Rays start 3 um beside where they should, so that none passes along an edge.
    np.testing.assert_allclose(hits, [0.5, np.inf, 1.5], atol=3e-6)
    assert behind.tolist() == [True, False, False]


@pytest.mark.corpus
def test_walls_of_the_corpus_keep_a_robot_inside(corpus):
    walls = corpus / "ROBOTIS-GIT__turtlebot3_simulations/turtlebot3_gazebo/models/turtlebot3_world"
    mesh = load_mesh(Mesh("wall.dae", walls / "meshes/wall.dae", scale=(0.25, 0.25, 0.25)))
    pieces = convex_pieces(mesh)
    x, y = np.meshgrid(np.linspace(-2.2, 2.2, 23), np.linspace(-2.2, 2.2, 23))
    floor = np.column_stack([x.ravel(), y.ravel(), np.full(x.size, 0.1)])
    floor = floor[np.hypot(x, y).ravel() < 2.2]
    assert not inside(pieces, floor).any()
    low, high = mesh.bounds
    pieces_low = np.min([piece.vertices.min(axis=0) for piece in pieces], axis=0)
    pieces_high = np.max([piece.vertices.max(axis=0) for piece in pieces], axis=0)
    np.testing.assert_allclose((pieces_low, pieces_high), (low, high), atol=1e-6)


def test_what_takes_long_is_told(monkeypatch, caplog):
    caplog.set_level("INFO", logger="gazelle.geometry.convex_decomposition")
    monkeypatch.setattr(convex, "_LARGE", 100)
    convex_pieces(data(l_shape()))
    assert not caplog.records
    monkeypatch.setattr(convex, "_EVERY", 0.0)
    convex_pieces(data(ring()))
    assert "cutting meshes of 256 triangles into convex pieces: 0 of 1" in caplog.text
    assert "cutting meshes into convex pieces: 1 of 1" in caplog.text


@settings(max_examples=60, deadline=None)
@given(
    st.integers(0, 2**32 - 1),
    st.integers(4, 300),
    st.sampled_from(["ball", "sphere", "grid", "box", "plates", "line", "plane", "one place"]),
    st.sampled_from([1e-3, 1.0, 1e4]),
    st.sampled_from([0.0, 1e-9, 1e-6]),
)
def test_hulls_of_many_points_in_planes_are_closed_and_hold_all(seed, count, kind, scale, noise):
    chance = np.random.default_rng(seed)
    points = chance.normal(size=(count, 3))
    if kind == "sphere":
        points /= np.linalg.norm(points, axis=1)[:, None]
    elif kind == "grid":
        points = np.round(points)
    elif kind == "box":
        points = np.clip(points, -0.5, 0.5)
    elif kind == "plates":
        points[:, 2] = chance.integers(0, 2, count)
    elif kind == "line":
        points = points[:, :1] * [1.0, 2.0, 3.0]
    elif kind == "plane":
        points[:, 1] = 0.25
    elif kind == "one place":
        points[:] = points[0]
    points = scale * (points + noise * chance.normal(size=(count, 3)) + 3.0)
    size = float(np.linalg.norm(np.ptp(points, axis=0)))
    hull = convex_hull(points)
    if hull is None:
        spans = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)
        assert spans[-1] <= 1e-5 * max(spans[0], 1e-9 * scale)
        return
    edges = {(f[i], f[(i + 1) % 3]) for f in hull.faces.tolist() for i in range(3)}
    assert len(edges) == 3 * len(hull.faces)
    assert edges == {(b, a) for a, b in edges}
    corners = len(np.unique(hull.faces))
    assert corners - len(edges) // 2 + len(hull.faces) == 2  # Euler
    # Nothing stands out, and the planes are those of the corners, within the grid.
    assert hull.depth(points).min() >= -4e-6 * size
    heights = np.einsum("ijk,ik->ij", points[hull.faces], hull.normals) - hull.offsets[:, None]
    assert heights.min() >= -4e-6 * size
    assert heights.max() <= 1e-11 * scale


def test_what_is_nearly_flat_but_for_rounding_is_not_taken_for_convex():
    """Faces of a hull that are slivers have planes that their rounded corners do not tell."""
    step = np.array([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]], float)
    stairs = trimesh.creation.extrude_triangulation(
        step, [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]], 1.0
    )
    for seed in range(20):
        chance = np.random.default_rng(seed)
        vertices = stairs.vertices * 0.59 + 4e-8 * chance.normal(size=stairs.vertices.shape)
        pieces = decompose(
            MeshData(vertices, np.asarray(stairs.faces, np.int32)), static=bool(seed % 2)
        )
        assert not pieces.whole
        assert len(pieces.solids) > 1
