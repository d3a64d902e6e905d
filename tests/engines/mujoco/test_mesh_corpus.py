"""The largest meshes of public robots and worlds: rays and contacts are where trimesh has them."""

import numpy as np
import pytest
import scenes
import trimesh
from mesh_rays import first_hits, rays_at

from gazelle.description import Mesh
from gazelle.engines import make_engine
from gazelle.errors import FormatError
from gazelle.formats import load_mesh
from gazelle.geometry.convex_decomposition import decompose
from gazelle.geometry.hull import convex_hull

pytestmark = pytest.mark.corpus

COUNT = 5
RAYS = 200


@pytest.fixture(scope="module")
def largest(corpus):
    """Return the meshes of the most triangles, each shape once, in metres."""
    found = {}
    for file in sorted(corpus.rglob("*")):
        if file.suffix.lower() in {".stl", ".dae", ".obj"} and file.stat().st_size > 50_000:
            try:
                mesh = load_mesh(Mesh(file.name, file))
            except FormatError:
                continue
            found.setdefault((len(mesh.faces), len(mesh.vertices)), (file, mesh))
    return [found[key] for key in sorted(found, reverse=True)[:COUNT]]


@pytest.mark.long
@pytest.mark.parametrize("place", range(COUNT))
def test_beams_meet_the_triangles_of_the_file(largest, place, tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    file, data = largest[place]
    mesh = trimesh.Trimesh(data.vertices, data.faces, process=False)
    start, along = rays_at(mesh, RAYS, place)
    expected = np.concatenate(
        [first_hits(mesh, start[i : i + 5], along[i : i + 5]) for i in range(0, RAYS, 5)]
    )
    thing = scenes.solid("thing", Mesh(file.name, file), static=True)
    eye = scenes.solid("eye", scenes.Sphere(1e-3), pose=scenes.Pose(z=50.0))
    engine = make_engine("mujoco", scenes.world(thing, eye))
    hits = engine.links["eye::link"].cast_rays(start - (0.0, 0.0, 50.0), along, ignore_own=True)
    found = hits.distance[0]
    size = float(np.linalg.norm(mesh.extents))
    same = np.isclose(found, expected, atol=1e-3 * size) | (np.isinf(found) & np.isinf(expected))
    assert np.isfinite(expected).sum() > RAYS / 10
    assert same.mean() >= 0.98, file  # the rest graze an edge


@pytest.mark.parametrize("static", [True, False])
@pytest.mark.parametrize("place", range(COUNT))
def test_pieces_cover_the_surface_within_what_they_promise(
    largest, place, static, tmp_path, monkeypatch
):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    file, data = largest[place]
    mesh = trimesh.Trimesh(data.vertices, data.faces, process=False)
    pieces = decompose(data, static=static)
    assert pieces.gap <= pieces.promised, file
    points, _ = trimesh.sample.sample_surface(mesh, 400, seed=place)
    nearest = np.full(len(points), np.inf)
    for piece in pieces.solids:
        low, high = piece.vertices.min(axis=0), piece.vertices.max(axis=0)
        reach = pieces.gap + 1e-3
        near = ((points > low - reach) & (points < high + reach)).all(axis=1)
        hull = convex_hull(piece.vertices) if near.any() else None
        if hull is not None:
            nearest[near] = np.minimum(nearest[near], -hull.depth(points[near]))
    if static:
        assert nearest.max() <= pieces.gap + 1e-4, file
    else:  # what no air from outside touches is not followed
        assert (nearest <= pieces.gap).mean() > 0.9, file
