"""Hollow meshes that move hold, let through and let turn what their triangles do."""

from dataclasses import replace

import hollows
import numpy as np
import pytest
import scenes
import trimesh

from gazelle.description import Cylinder, Mesh, Pose
from gazelle.engines import make_engine
from gazelle.errors import EngineWarning
from gazelle.formats import bounded_pieces, convex
from gazelle.formats.mesh import MeshData


def body(name, data, folder, mass=100.0, pose=None):
    """A free body of a mesh, with the inertia of its box."""
    file = folder / f"{name}.stl"
    trimesh.Trimesh(data.vertices, data.faces, process=False).export(file)
    x, y, z = np.ptp(data.vertices, axis=0).tolist()
    moments = tuple(mass / 12.0 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y))
    return scenes.solid(name, Mesh(file.name, file), mass=mass, moments=moments, pose=pose)


def height(engine, name):
    return float(engine.models[name].placement().position[0, 2])


@pytest.mark.long
@pytest.mark.parametrize("size", [0.1, 1.0, 4.0])
def test_a_ball_lies_on_the_bottom_of_a_mug_it_nearly_fills(size, tmp_path):
    data = hollows.made("mug", size)
    scale = float(np.ptp(data.vertices[:, 2])) / 1.2
    mug = body("mug", data, tmp_path, 100.0 * size, Pose(z=0.6 * scale))
    radius = 0.97 * 0.45 * scale
    ball = scenes.ball(radius=radius, mass=size, pose=Pose(z=0.12 * scale + radius))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), mug, ball), threads=1)
    engine.step(1000)
    assert height(engine, "ball") == pytest.approx(
        0.1 * scale + radius, abs=min(0.005, 0.01 * size)
    )


@pytest.mark.long
@pytest.mark.parametrize("size", [0.5, 1.0, 4.0])
def test_a_piston_slides_through_a_sleeve_with_little_play(size, tmp_path):
    data = hollows.made("sleeve", size)
    radius = float(np.linalg.norm(data.vertices[:, :2], axis=1).min()) * np.cos(np.pi / 64)
    tall = float(np.ptp(data.vertices[:, 2]))
    sleeve = body("sleeve", data, tmp_path, 100.0, Pose(z=tall / 2.0))
    piston = scenes.solid(
        "piston",
        Cylinder(radius - 0.005, tall / 2.0),
        moments=(0.1, 0.1, 0.1),
        pose=Pose(z=tall),
        mu=0.01,
    )
    engine = make_engine("mujoco", scenes.world(scenes.ground(), sleeve, piston), threads=1)
    engine.step(2000)
    assert height(engine, "piston") == pytest.approx(tall / 4.0, abs=0.01)


def test_a_mesh_that_needs_too_many_pieces_is_named_once(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))
    monkeypatch.setattr(convex, "_MEMORY", {})
    monkeypatch.setattr(bounded_pieces, "MOST_PIECES", 5)
    monkeypatch.setattr(bounded_pieces, "_FEW_PIECES", 5)
    data = hollows.made("car body", 1.0)
    one, other = (body("car", data, tmp_path, pose=Pose(x=x, z=1.0)) for x in (0.0, 2.0))
    world = scenes.world(one, replace(other, name="other"))
    with pytest.warns(EngineWarning, match=r"'car.stl' collides up to [\d.]+ m beside") as told:
        make_engine("mujoco", world, threads=1)
    assert len(told) == 1


@pytest.mark.long
def test_a_ball_in_a_sealed_cavity_stays_there(tmp_path):
    inner = trimesh.creation.icosphere(subdivisions=3, radius=0.4)
    inner.invert()
    whole = trimesh.util.concatenate([trimesh.creation.box((1, 1, 1)), inner])
    data = MeshData(np.asarray(whole.vertices, float), np.asarray(whole.faces, np.int32))
    shell = body("shell", data, tmp_path, pose=Pose(z=0.5))
    ball = scenes.ball(radius=0.1, pose=Pose(z=0.5))
    engine = make_engine("mujoco", scenes.world(scenes.ground(), shell, ball), threads=1)
    engine.step(1500)
    assert height(engine, "shell") == pytest.approx(0.5, abs=0.002)
    place = engine.models["ball"].placement().position[0] - (0.0, 0.0, 0.5)
    assert float(np.linalg.norm(place)) == pytest.approx(0.3, abs=0.005)
