"""Hollow meshes that move hold, let through and let turn what their triangles do."""

from dataclasses import replace

import hollows
import numpy as np
import pytest
import scenes
import trimesh

import gazelle
from gazelle import formats
from gazelle.description import Cylinder, Joint, JointAxis, Mesh, Pose
from gazelle.engines import make_engine
from gazelle.errors import EngineWarning
from gazelle.geometry import bounded_pieces
from gazelle.geometry import convex_decomposition as convex
from gazelle.geometry.mesh_data import MeshData
from gazelle.geometry.surface import clean


def body(name, data, folder, mass=100.0, pose=None):
    """Return a free body of a mesh, with the inertia of its box."""
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


def on_axle(model, kind, axis, **options):
    """Attach a model of one link to the world by a joint."""
    joint = Joint("axle", kind, "world", "link", axes=(JointAxis(axis, **options),))
    return replace(model, joints=(joint,))


@pytest.mark.long
@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
@pytest.mark.parametrize("size", [0.05, 0.3, 2.0])
@pytest.mark.parametrize("teeth", [20, 30])
def test_gears_turn_one_another_at_the_ratio_of_their_teeth(teeth, size, step, tmp_path):
    scale = size / float(np.linalg.norm(hollows.involute_gear().extents))
    models = []
    for name, count, turn in (("driver", 20, 0.0), ("driven", teeth, np.pi / teeth)):
        mesh = hollows.involute_gear(count)
        mesh.apply_transform(np.diag([scale, scale, scale, 1.0]))
        data = MeshData(np.asarray(mesh.vertices, float), np.asarray(mesh.faces, np.int32))
        mass = 1000.0 * float(mesh.volume)
        at = Pose(x=scale * 0.05 * (20 + teeth), yaw=turn) if name == "driven" else Pose()
        free = on_axle(body(name, data, tmp_path, mass, at), "continuous", (0.0, 0.0, 1.0))
        rubs = scenes.with_surface(free, scenes.rubber(0.1))
        load = 0.0 if name == "driver" else 0.5 * mass * size**2
        models.append(on_axle(rubs, "continuous", (0.0, 0.0, 1.0), damping=load))
    engine = make_engine("mujoco", scenes.world(*models, gravity=(0, 0, 0), step=step), threads=1)
    engine.add_motor("driver::axle", [0.2 * models[0].links[0].inertial.mass * (20.0 * size) ** 2])
    engine.joints["driver::axle"].set_motor_velocity(2.0)
    count = round(2.0 / step)
    engine.step(count)
    turned = float(engine.joints["driver::axle"].position()[0, 0])
    followed = float(engine.joints["driven::axle"].position()[0, 0])
    assert turned == pytest.approx(2.0 * count * step, rel=0.1)
    assert followed == pytest.approx(-turned * 20.0 / teeth, abs=0.02)


@pytest.mark.long
@pytest.mark.parametrize("step", [0.001, 0.002, 0.005])
@pytest.mark.parametrize("size", [0.05, 0.3, 2.0])
@pytest.mark.parametrize("name", ["bowl", "thin bowl"])
def test_a_ball_rolls_on_the_triangles_of_a_bowl_that_is_shaken(name, size, step, tmp_path):
    data = hollows.made(name, size)
    rim = float(np.linalg.norm(data.vertices[:, :2], axis=1).max()) / float(
        1.05 if name == "bowl" else 1.01
    )
    radius, top = 0.2 * rim, float(data.vertices[:, 2].max())
    bowl = on_axle(body("bowl", data, tmp_path, 10.0), "prismatic", (1.0, 0.0, 0.0))
    ball = scenes.ball(
        radius=radius,
        mass=0.1,
        pose=Pose(x=0.25 * rim, z=top - np.sqrt((0.79 * rim) ** 2 - (0.25 * rim) ** 2)),
    )
    engine = make_engine("mujoco", scenes.world(bowl, ball, step=step), threads=1)
    engine.add_motor("bowl::axle", [1e4])
    pace = 0.6 * np.sqrt(5.0 * 9.8 / (7.0 * 0.8 * rim))  # of its own swings
    surface = clean(data.vertices, data.faces)
    for k in range(40):
        engine.joints["bowl::axle"].set_motor_velocity(0.2 * rim * pace * np.cos(0.2 * k))
        engine.step(max(1, round(0.2 / pace / step)))
        centre = (
            engine.models["ball"].placement().position
            - engine.links["bowl::link"].placement().position
        )
        gap = float(hollows.distances(surface, centre)[0]) - radius
        assert abs(gap) <= min(0.005, 0.01 * size)


@pytest.mark.long
@pytest.mark.parametrize("step", [0.001, 0.005])
@pytest.mark.parametrize("size", [0.05, 0.3, 2.0])
def test_notched_fingers_centre_a_bar(size, step, tmp_path):
    data = hollows.made("finger", size)
    unit, half = float(np.ptp(data.vertices[:, 0])), float(data.vertices[:, 1].max())
    radius, away = 0.1 * unit, half + 0.2 * unit
    fingers = []
    for name, side, turn in (("left", -1.0, 0.0), ("right", 1.0, np.pi)):
        at = Pose(y=side * away, yaw=turn)
        finger = scenes.with_surface(body(name, data, tmp_path, 0.2, at), scenes.rubber(0.3))
        fingers.append(on_axle(finger, "prismatic", (0.0, 1.0, 0.0), lower=-away, upper=away))
    bar = scenes.solid(
        "bar",
        Cylinder(radius, 0.25 * unit),
        mass=0.05,
        moments=(0.02 * radius**2,) * 3,
        pose=Pose(x=0.03 * unit),
        mu=0.3,
    )
    world = scenes.world(*fingers, bar, gravity=(0, 0, 0), step=step)
    engine = make_engine("mujoco", world, threads=1)
    for name in ("left", "right"):
        engine.joints[f"{name}::axle"].set_effort(0.5 * max(1.0, 4.0 * size))
    engine.step(round(0.7 * max(1.0, np.sqrt(size)) / step))
    place = engine.models["bar"].placement().position[0]
    deep = half - 0.12 * unit + np.sqrt(2.0) * radius
    bound = min(0.005, 0.01 * size)
    assert place[0] == pytest.approx(0.0, abs=bound)
    for name in ("left", "right"):
        apart = abs(float(engine.links[f"{name}::link"].placement().position[0, 1]) - place[1])
        assert apart == pytest.approx(deep, abs=bound)


def wheel_on_an_axle(height, friction):
    """Return a wheel of 0.1 m on an axle fixed to the world."""
    mu = f"<surface><friction><ode><mu>{friction}</mu><mu2>{friction}</mu2></ode></friction></surface>"
    return formats.load_string(
        f"""<sdf version="1.6"><world name="w"><include><uri>model://ground_plane</uri></include>
        <model name="m"><pose>0 0 {height} 1.5707963 0 0</pose><link name="l"><inertial><mass>1</mass>
        <inertia><ixx>0.003</ixx><iyy>0.003</iyy><izz>0.005</izz></inertia></inertial>
        <collision name="c"><geometry><cylinder><radius>0.1</radius><length>0.04</length></cylinder>
        </geometry>{mu}</collision></link><joint name="j" type="revolute"><parent>world</parent>
        <child>l</child><axis><xyz>0 0 1</xyz></axis></joint></model></world></sdf>"""
    )


@pytest.mark.parametrize(
    ("height", "friction", "turns"), [(0.1, 1.0, 0.0), (0.10001, 1.0, 1.0), (0.1, 0.0, 1.0)]
)
def test_a_wheel_on_a_fixed_axle_turns_unless_it_touches_with_friction(height, friction, turns):
    """As docs/explanation/physics.md says: friction lets a contact slide only as far as it parts."""
    with gazelle.Simulation(wheel_on_an_axle(height, friction), threads=1) as sim:
        joint = sim.robots["m"].joints["j"]
        joint.apply_effort(0.2)
        sim.run(seconds=0.1)
        assert float(np.ravel(joint.velocity)[0]) == pytest.approx(turns * 4.0, abs=0.02)


@pytest.mark.parametrize("corner", [(0.0, 0.0, 0.0), (0.0, 1e-9, 0.0)])
def test_a_mesh_without_area_is_named_once(corner, tmp_path):
    file = tmp_path / "line.stl"
    points = [(0.0, 0.0, 0.0), (1e-9, 0.0, 0.0), (2e-9, 0.0, 0.0), corner]
    trimesh.Trimesh(points, [(0, 1, 2), (0, 1, 3)], process=False).export(file)
    lines = [scenes.solid(name, Mesh(file.name, file)) for name in ("one", "other")]
    with pytest.warns(EngineWarning, match=r"'line.stl' does not collide: .* no area") as told:
        engine = make_engine("mujoco", scenes.world(*lines), threads=1)
    assert len(told) == 1
    engine.step(2)
