"""Pieces of meshes that move stay within a bound of the triangles, whatever their shape and size."""

import itertools

import hollows
import numpy as np
import pytest
import trimesh

from gazelle.geometry import convex_decomposition as convex
from gazelle.geometry.convex_decomposition import decompose
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.surface import clean


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    convex._MEMORY.clear()
    yield
    convex._MEMORY.clear()


def data(*meshes):
    whole = trimesh.util.concatenate(meshes)
    return MeshData(np.asarray(whole.vertices, float), np.asarray(whole.faces, np.int32))


def inside(pieces, points):
    found = np.zeros(len(points), bool)
    for piece in pieces.solids:
        found |= convex.convex_hull(piece.vertices).depth(np.asarray(points, float)) > 0.0
    return found


@pytest.mark.long
@pytest.mark.parametrize("size", [0.1, 1.0, 4.0])
@pytest.mark.parametrize("name", hollows.SHAPES)
def test_pieces_keep_to_the_triangles(name, size):
    mesh = hollows.made(name, size)
    pieces = decompose(mesh, static=False)
    bound = min(0.005, 0.01 * size)
    assert pieces.promised == pytest.approx(bound)
    assert pieces.gap <= pieces.promised * (1.0 + 1e-9)
    assert hollows.protrusion(mesh, pieces) <= bound * (1.0 + 1e-9)
    assert hollows.uncovered(mesh, pieces) <= 1e-5 * size
    assert 1 < len(pieces.solids) < 600


def overlapping(seed):
    """Return some bodies of all kinds, each through others."""
    chance, parts = np.random.default_rng(seed), []
    for kind in chance.integers(0, 4, 8):
        a, b, c = chance.uniform(0.1, 0.5, 3)
        part = (
            trimesh.creation.box((2.0 * a, b, c)),
            trimesh.creation.cylinder(a, b + c, sections=16),
            trimesh.creation.annulus(a, a + 0.1, b, sections=24),
            hollows.extruded(a * np.array([(0, 0), (3, 0), (3, 1), (1, 1), (1, 3), (0, 3)]), b),
        )[kind]
        part.apply_transform(trimesh.transformations.random_rotation_matrix(chance.random(3)))
        parts.append(part.apply_translation(chance.uniform(-0.3, 0.3, 3)))
    return data(*parts)


@pytest.mark.long
@pytest.mark.parametrize("size", [0.1, 0.5, 2.0])
@pytest.mark.parametrize("seed", range(4))
def test_bodies_that_overlap_keep_to_the_bound(seed, size):
    mesh = overlapping(seed)
    mesh = MeshData(mesh.vertices * size / np.linalg.norm(np.ptp(mesh.bounds, axis=0)), mesh.faces)
    pieces = decompose(mesh, static=False)
    assert pieces.gap == pytest.approx(min(0.005, 0.01 * size))
    assert hollows.protrusion(mesh, pieces) <= pieces.gap


def test_places_within_several_bodies_of_a_mesh_are_inside_it():
    cavity = trimesh.creation.box((0.4, 0.4, 0.4))
    cavity.invert()
    mesh = data(
        trimesh.creation.box((1, 1, 1)),
        cavity,
        trimesh.creation.box((2, 0.2, 0.2)).apply_translation((1.3, 0.0, 0.0)),
    )
    places = {(0.4, 0, 0): True, (0.1, 0.02, 0): False, (0.35, 0.3, 0): True, (1.5, 0, 0): True,
              (1.5, 0.2, 0): False, (0.7, 0.3, 0.3): False}  # fmt: skip
    surface = clean(mesh.vertices, mesh.faces)
    found = hollows.inside(surface, np.array(list(places)) + np.array([0.0, 0.003, 0.007]))
    assert found.tolist() == list(places.values())


@pytest.mark.parametrize("name", ["car body", "finger", "bracket", "mug"])
def test_a_mesh_turned_inside_out_is_the_same_body(name):
    mesh = hollows.made(name, 1.0)
    turned = MeshData(mesh.vertices, np.ascontiguousarray(mesh.faces[:, ::-1]))
    pieces = decompose(turned, static=False)
    assert hollows.protrusion(mesh, pieces, 1000) <= 0.005
    assert hollows.uncovered(mesh, pieces) <= 1e-5


@pytest.mark.parametrize("size", [0.1, 1.0, 4.0])
def test_a_sealed_cavity_stays_hollow(size):
    inner = trimesh.creation.icosphere(subdivisions=2, radius=0.4)
    inner.invert()
    mesh = data(trimesh.creation.box((1, 1, 1)), inner)
    pieces = decompose(MeshData(size * mesh.vertices, mesh.faces), static=False)
    points = size * 0.37 * np.concatenate([np.eye(3), -np.eye(3), np.zeros((1, 3))])
    assert not inside(pieces, points).any()
    assert inside(pieces, size * np.array([[0.499, 0, 0], [0, 0.41, 0], [0.45, 0.45, 0.45]])).any()


def test_sheets_bent_to_a_box_are_not_filled():
    box = trimesh.creation.box((1, 1, 1))
    box.update_faces(box.face_normals[:, 2] < 0.5)
    for mesh in (data(box), data(box.subdivide().subdivide())):
        pieces = decompose(mesh, static=False)
        assert not inside(pieces, [[0, 0, 0], [0.48, 0.48, 0.48], [0.0, 0.48, -0.48]]).any()
        assert inside(pieces, [[0.499, 0, 0], [0, 0, -0.499]]).all()


def test_parts_are_merged_only_where_no_air_is_between():
    for apart, count in ((0.09, 1), (0.2, 2)):
        plates = [
            trimesh.creation.box((1, 1, 0.1)).apply_translation((0, 0, apart * i)) for i in (0, 1)
        ]
        assert len(decompose(data(*plates), static=False).solids) == count


@pytest.mark.long
def test_what_needs_too_many_pieces_says_how_far_it_is_off(monkeypatch):
    mesh = hollows.made("bowl", 1.0)
    monkeypatch.setattr("gazelle.geometry.bounded_pieces.MOST_PIECES", 60)
    monkeypatch.setattr("gazelle.geometry.bounded_pieces._FEW_PIECES", 60)
    pieces = decompose(mesh, static=False)
    assert len(pieces.solids) <= 60
    assert pieces.gap > pieces.promised
    assert hollows.protrusion(mesh, pieces, 1000) <= pieces.gap


THIN = ["thin bowl", "thin mug", "thin tube", "crate"]


@pytest.mark.parametrize("static", [False, True])
@pytest.mark.parametrize("size", [0.05, 0.3, 2.0])
@pytest.mark.parametrize("name", THIN)
def test_vessels_with_thin_walls_stay_hollow(name, size, static):
    """No place of such a surface is deep in its hull, as with a body that has small dents."""
    mesh = hollows.made(name, size)
    pieces = decompose(mesh, static=static)
    assert not pieces.whole
    top, middle = float(mesh.vertices[:, 2].max()), mesh.vertices.mean(axis=0)
    column = np.linspace(0.0, 0.999 * top, 40)[:, None] * (0.0, 0.0, 1.0)
    assert not inside(pieces, column + middle * (1.0, 1.0, 0.0)).any()


@pytest.mark.parametrize("size", [0.05, 0.3, 1.0, 2.0, 4.0])
@pytest.mark.parametrize("name", ["crate", "funnel", "thin tube"])
def test_no_lid_lies_across_an_opening(name, size):
    """The rim of an opening is flat, and so is what would close it."""
    mesh = hollows.made(name, size)
    low, high = (float(f(mesh.vertices[:, 2])) for f in (np.min, np.max))
    ends = [high] if name == "crate" else [low, high]
    rise = np.linspace(0.0, 0.02, 21) * (high - low)
    column = np.concatenate([abs(end) - rise for end in ends])
    column = np.where(np.arange(len(column)) < len(rise), np.sign(ends[0]), 1.0) * column
    points = column[:, None] * (0.0, 0.0, 1.0)
    assert not inside(decompose(mesh, static=False), points).any()


OUTLINES = {
    "slot behind a face": [(0, 0), (1, 0), (1, 0.4), (0.48, 0.4), (0.48, 0.05), (0.42, 0.05),
                           (0.42, 0.4), (0, 0.4)],
    "sharp edges": [(0, 0), (4, 0), (3, 0.6), (2.2, 0.6), (2, 0.3), (1.8, 0.6), (1, 0.6)],
}  # fmt: skip


@pytest.mark.parametrize("size", [0.02, 0.3, 3.0])
@pytest.mark.parametrize("name", OUTLINES)
def test_polygons_are_thickened_within_the_body_only(name, size):
    mesh = hollows.extruded(np.array(OUTLINES[name], float), 0.7)
    mesh.apply_scale(size / float(np.linalg.norm(mesh.extents)))
    solid = data(mesh)
    bounds = {True: 2e-4 * size, False: min(0.005, 0.01 * size)}
    for static, bound in bounds.items():
        assert hollows.protrusion(solid, decompose(solid, static=static)) <= bound


@pytest.mark.parametrize("size", [0.05, 0.3, 2.0])
def test_triangles_without_a_width_leave_a_body_closed(size):
    mesh = hollows.made("involute gear", size)
    assert clean(mesh.vertices, mesh.faces).is_closed()
    pieces = decompose(mesh, static=False)
    assert pieces.closed
    assert len(pieces.solids) < 80  # of 424 as sheets


@pytest.mark.parametrize("count", [1, 2, 5, 12])
def test_corners_on_the_edges_of_a_box_divide_what_is_beside_them(count):
    """One face of a box has corners on an edge; slivers close the gap to the other."""
    box = trimesh.creation.box((1.0, 1.0, 1.0))
    a, b, c = next(tri for tri in box.faces.tolist() if _is_cut_edge(box, tri))
    way = np.linspace(0.0, 1.0, count + 2)[1:-1, None]
    more = box.vertices[a] + way * (box.vertices[b] - box.vertices[a])
    line = [a, *range(8, 8 + count), b]
    fan = [(u, v, c) for u, v in itertools.pairwise(line)]
    slivers = [(line[i + 1], line[i], b) for i in range(count)]
    kept = [tri for tri in box.faces.tolist() if tri != [a, b, c]]
    mesh = MeshData(
        np.concatenate([box.vertices, more]), np.array([*kept, *fan, *slivers], np.int32)
    )
    surface = clean(mesh.vertices, mesh.faces)
    assert surface.is_closed()
    assert surface.volume == pytest.approx(1.0)
    assert float(surface.areas.sum()) == pytest.approx(6.0)
    assert decompose(mesh, static=False).whole


def _is_cut_edge(box, tri):
    a, b, _ = (np.asarray(box.vertices[corner]) for corner in tri)
    return np.count_nonzero(np.abs(a - b) > 0.5) == 1


def boxes(*places):
    return data(*(trimesh.creation.box((1, 1, 1)).apply_translation(place) for place in places))


TOUCHING = {
    "at a corner": ([(0, 0, 0), (1, 1, 1)], 2, (1, 0, 0)),
    "along an edge": ([(0, 0, 0), (1, 1, 0)], 2, (0.8, 0.2, 0.1)),
    "along faces": ([(0, 0, 0), (1, 0, 0), (2, 0, 0)], 1, (1, 0, 0.6)),
    "around a hole": (
        [(x, y, 0) for x in (0, 1, 2) for y in (0, 1, 2) if (x, y) != (1, 1)],
        4,
        (1, 1, 0.1),
    ),
    "as bricks": ([(0, 0, 0), (1, 0, 0), (0.5, 0, 1), (1.5, 0, 1)], 2, (-0.4, 0, 0.6)),
}


@pytest.mark.parametrize("name", TOUCHING)
def test_bodies_that_touch_are_bodies_and_merge_where_they_fit(name):
    places, count, air = TOUCHING[name]
    mesh = boxes(*places)
    surface = clean(mesh.vertices, mesh.faces)
    assert surface.is_closed()
    assert surface.volume == pytest.approx(len(places))
    pieces = decompose(mesh, static=False)
    assert pieces.gap <= pieces.promised
    assert len(pieces.solids) == count
    assert inside(pieces, np.array(places) + 0.4).all()
    assert not inside(pieces, [air]).any()


def test_a_slab_of_tiles_is_one_piece_and_one_of_uneven_tiles_keeps_to_the_bound():
    chance = np.random.default_rng(0)
    for spread, few in ((0.0, 1), (0.1, 64)):
        places = [(x, y, chance.uniform(-spread, spread)) for x in range(8) for y in range(8)]
        mesh = boxes(*places)
        pieces = decompose(mesh, static=False)
        assert pieces.gap <= pieces.promised
        assert len(pieces.solids) <= few
        assert hollows.protrusion(mesh, pieces, 500) <= pieces.promised


def test_sheets_drawn_from_both_sides_stay_sheets():
    vessel = trimesh.creation.box((1, 1, 1))
    vessel.update_faces(vessel.face_normals[:, 2] < 0.5)
    fin = trimesh.Trimesh([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [(0, 1, 2)], process=False)
    fin.apply_translation((0.5, 0.0, 0.0))
    for sheet in (vessel, fin):
        back = sheet.copy()
        back.invert()
        for mesh in (data(sheet, back), data(back, sheet)):
            surface = clean(mesh.vertices, mesh.faces)
            assert len(surface.faces) == len(sheet.faces)
            assert not surface.is_closed()


def test_tiles_a_hair_apart_merge_where_there_would_be_too_many(monkeypatch):
    monkeypatch.setattr("gazelle.geometry.bounded_pieces.MOST_PIECES", 20)
    monkeypatch.setattr("gazelle.geometry.bounded_pieces._FEW_PIECES", 20)
    mesh = boxes(*((1.0005 * x, 1.0005 * y, 0) for x in range(6) for y in range(6)))
    pieces = decompose(mesh, static=False)
    assert len(pieces.solids) <= 20
    assert pieces.gap <= pieces.promised


@pytest.mark.parametrize("name", ["bowl", "spikes"])
def test_the_error_of_too_few_pieces_is_measured(name, monkeypatch):
    monkeypatch.setattr("gazelle.geometry.bounded_pieces.MOST_PIECES", 20)
    monkeypatch.setattr("gazelle.geometry.bounded_pieces._FEW_PIECES", 20)
    monkeypatch.setattr("gazelle.geometry.bounded_pieces._MOST_POLYGONS", 400)
    if name == "spikes":
        ball = trimesh.creation.icosphere(subdivisions=3)
        ball.vertices *= 1.0 + 0.2 * np.random.default_rng(0).random((len(ball.vertices), 1))
        mesh = data(ball)
    else:
        mesh = hollows.made(name, 1.0)
    pieces = decompose(mesh, static=False)
    measured = hollows.protrusion(mesh, pieces, 1000)
    assert len(pieces.solids) <= 20
    assert pieces.promised < measured <= pieces.gap <= 2.5 * measured


@pytest.mark.parametrize("size", [0.05, 0.8])
def test_small_static_meshes_keep_to_a_share_of_their_size(size):
    ball = trimesh.creation.icosphere(subdivisions=3)
    ball.vertices *= 1.0 + 0.02 * np.random.default_rng(0).random((len(ball.vertices), 1))
    ball.apply_scale(size / float(np.linalg.norm(ball.extents)))
    pieces = decompose(data(ball), static=True)
    assert pieces.promised == pytest.approx(0.01 * size)
    assert pieces.gap <= pieces.promised


@pytest.mark.parametrize("static", [False, True])
def test_a_mesh_in_wrong_units_collides_all_over(static):
    mesh = hollows.made("bracket", 1e6)
    pieces = decompose(mesh, static=static)
    assert hollows.uncovered(mesh, pieces, 500) <= 10.0


@pytest.mark.parametrize("name", ["bracket", "thin mug", "torus"])
def test_triangles_turned_over_at_random_are_turned_back(name):
    mesh = hollows.made(name, 1.0)
    faces = mesh.faces.copy()
    some = np.random.default_rng(0).random(len(faces)) < 0.3
    faces[some] = faces[some, ::-1]
    surface = clean(mesh.vertices, faces)
    assert surface.is_closed()
    assert surface.volume == pytest.approx(clean(mesh.vertices, mesh.faces).volume)
    pieces = decompose(MeshData(mesh.vertices, faces), static=False)
    assert len(pieces.solids) < 60
    assert hollows.protrusion(mesh, pieces, 500) <= pieces.gap <= pieces.promised
