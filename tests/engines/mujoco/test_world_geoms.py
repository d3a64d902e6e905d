"""Thousands of static shapes in one model behave like shapes added one by one."""

import time
from dataclasses import replace

import mujoco
import numpy as np
import pytest
import scenes
import trimesh
from PIL import Image

from gazelle.description import (
    Box,
    Contact,
    Cylinder,
    Heightmap,
    Link,
    Mesh,
    Model,
    Plane,
    Polyline,
    Pose,
    Sphere,
    Surface,
)
from gazelle.engines import make_engine
from gazelle.engines.mujoco.compiler import contact_pairs, world_geoms
from gazelle.engines.mujoco.compiler.geom_names import geom_ids, geom_names
from gazelle.engines.mujoco.compiler.shapes import ShapeBuilder
from gazelle.engines.mujoco.compiler.spec import CompilerInput, compile_world

FIELDS = ("geom_pos", "geom_quat", "geom_size", "geom_type", "geom_friction", "geom_group")


def town(folder):
    """Return static shapes of all kinds, some of them shared, and a few falling things."""
    parts = [trimesh.creation.box((0.2, 0.3, 0.1 * k)) for k in range(1, 6)]
    for k, part in enumerate(parts):
        part.apply_translation((0.5 * k, 0.0, 0.05 * k))
    file = folder / "row.stl"
    trimesh.util.concatenate(parts).export(file)
    Image.fromarray(np.arange(25, dtype=np.uint8).reshape(5, 5)).save(folder / "ground.png")
    outline = ((0.0, 0.0), (0.4, 0.0), (0.4, 0.1), (0.1, 0.1), (0.1, 0.4), (0.0, 0.4))
    shapes = (
        Plane(),
        Box((0.3, 0.3, 0.3)),
        Mesh(file.name, file),
        Mesh(file.name, file, scale=(1.0, 1.0, 2.0)),
        Cylinder(0.1, 0.5),
        Heightmap("ground.png", folder / "ground.png", size=(2.0, 2.0, 0.2)),
        Polyline((outline,), 0.5),
        Mesh(file.name, file),
    )
    still = [
        scenes.solid(f"m{i}", shape, static=True, pose=Pose(x=4.0 * (i % 3), y=4.0 * (i // 3)))
        for i, shape in enumerate(shapes)
    ]
    loose = [
        scenes.solid(f"ball{i}", Sphere(0.1), pose=Pose(x=4.0 * (i % 3) + 0.2, z=1.5))
        for i in range(3)
    ]
    return scenes.world(*still[:4], loose[0], *still[4:], *loose[1:])


@pytest.mark.parametrize(("few", "together"), [(0, 1), (2, 3), (5, 100)])
def test_a_world_is_the_same_however_it_is_put_together(tmp_path, monkeypatch, few, together):
    world = town(tmp_path)
    plain = compile_world(CompilerInput(world, 0.001))
    engine = make_engine("mujoco", world)
    monkeypatch.setattr(world_geoms, "_FEW", few)
    monkeypatch.setattr(world_geoms, "_TOGETHER", together)
    other = compile_world(CompilerInput(world, 0.001))
    assert other.geoms.keys() == plain.geoms.keys()
    for name, geoms in plain.geoms.items():
        rows = [plain.model.geom(geom).id for geom in geoms]
        same = [other.model.geom(geom).id for geom in other.geoms[name]]
        for field in FIELDS:
            a, b = getattr(plain.model, field)[rows], getattr(other.model, field)[same]
            np.testing.assert_array_equal(a, b, err_msg=f"{name} {field}")
        for row, twin in zip(rows, same, strict=True):
            if (mesh := plain.model.geom_dataid[row]) >= 0 and mesh < plain.model.nmesh:
                a, b = plain.model.mesh(mesh), other.model.mesh(other.model.geom_dataid[twin])
                assert int(a.vertnum[0]) == int(b.vertnum[0])
    again = make_engine("mujoco", world)
    engine.step(600)
    again.step(600)
    for i in range(3):
        here, there = (e.links[f"ball{i}::link"].placement().position for e in (engine, again))
        np.testing.assert_allclose(here, there, atol=1e-9)


def test_nothing_is_said_of_how_a_world_is_put_together(tmp_path, monkeypatch, recwarn, capfd):
    monkeypatch.setattr(world_geoms, "_FEW", 1)
    monkeypatch.chdir(tmp_path)
    make_engine("mujoco", town(tmp_path)).step(1)
    assert [str(each.message) for each in recwarn] == []
    assert capfd.readouterr() == ("", "")
    assert not (tmp_path / "MUJOCO_LOG.TXT").exists()


@pytest.mark.long
def test_collisions_and_frictions_of_ten_thousand_shapes_are_found_by_name():
    count = 10_000
    collision = scenes.solid("x", Box((0.1, 0.1, 0.1))).links[0].collisions[0]
    collisions = tuple(
        replace(collision, name=f"c{i}", pose=Pose(x=0.2 * (i % 100), y=0.2 * (i // 100)))
        for i in range(count)
    )
    still = Model("m", links=(Link("l", collisions=collisions),), static=True)
    ball = scenes.solid("ball", Sphere(0.1), pose=Pose(x=10.0, y=19.0, z=0.5))
    engine = make_engine("mujoco", scenes.world(still, ball))
    engine.step(1000)
    assert engine.links["ball::link"].placement().position[0, 2] > 0.1
    engine.set_parameter("collision_friction", "m::l::c9999", 0.3)
    assert engine.parameter("collision_friction", "m::l::c9999").tolist() == [[0.3]]


def processor_time_of(count):
    """Return processor time of adding a wall of meshes, each there once [s]."""
    spec = mujoco.MjSpec()
    world = world_geoms.WorldGeoms(spec)
    builder = ShapeBuilder(spec, world.name_later)
    corners, sides = np.vstack([np.zeros(3), np.eye(3)]), np.array([[0, 2, 1], [0, 1, 3]])
    start = time.process_time()
    for i in range(count):
        shape = builder.mesh_geom(
            i, corners, sides, Pose(), mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
        )
        world.add_geom(name=f"g{i}", **shape)
    world.finish()
    return time.process_time() - start


@pytest.mark.long
def test_four_times_as_many_shapes_take_hardly_more_than_four_times_as_long():
    """With each four thousand that come all names of the model were listed, of meshes as well."""
    few, many = processor_time_of(25_000), processor_time_of(100_000)
    assert many < 8.0 * few


@pytest.mark.parametrize("count", [500, 1000, 2000, 4000])
def test_a_mesh_of_many_pieces_is_told_from_springs_piece_by_piece_no_more(
    tmp_path, monkeypatch, count
):
    """What bounces, is soft or rubs by direction is compared with collisions, not with pieces."""
    parts = [trimesh.creation.box((0.1, 0.1, 0.1)) for _ in range(5)]
    for k, part in enumerate(parts):
        part.apply_translation((0.5 * k, 0.0, 0.0))
    file = tmp_path / "row.stl"
    trimesh.util.concatenate(parts).export(file)
    still = [
        scenes.solid(f"m{i}", Mesh(file.name, file), static=True, pose=Pose(y=0.5 * i))
        for i in range(count // 5)
    ]
    asked = []
    monkeypatch.setattr(contact_pairs, "_may_touch", lambda *pair: bool(asked.append(pair)))
    ball = scenes.solid("ball", Sphere(0.1), pose=Pose(z=3.0))
    soft = replace(ball.links[0].collisions[0], surface=Surface(contact=Contact(kp=1e4, kd=1.0)))
    ball = replace(ball, links=(replace(ball.links[0], collisions=(soft,)),))
    compiled = compile_world(CompilerInput(scenes.world(ball, *still), 0.001))
    assert compiled.model.ngeom >= count
    assert 0 < len(asked) <= count // 5 + 1


def test_names_of_all_geoms_are_those_that_mujoco_gives(tmp_path):
    model = compile_world(CompilerInput(town(tmp_path), 0.001)).model
    names = [model.geom(number).name for number in range(model.ngeom)]
    assert geom_names(model) == names
    assert geom_ids(model) == {name: model.geom(name).id for name in names}
