"""Meshes that stand still are touched where they are: bowls, doors, terrain, stairs."""

import math

import numpy as np
import pytest
import scenes
import trimesh

from gazelle.description import Mesh, Pose
from gazelle.engines import make_engine


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def standing(folder, mesh, name="thing", *, static=True, **options):
    mesh.export(folder / f"{name}.stl")
    shape = Mesh(f"{name}.stl", folder / f"{name}.stl")
    return scenes.solid(name, shape, static=static, **options)


def bowl(sections, rings, radius=1.0, thick=0.05):
    angles = np.linspace(0.0, np.pi / 2.0, rings)
    outer = (radius + thick) * np.stack([np.sin(angles), -np.cos(angles)], axis=1)
    inner = radius * np.stack([np.sin(angles), -np.cos(angles)], axis=1)[::-1]
    return trimesh.creation.revolve(np.concatenate([outer, inner]), sections=sections)


def period(engine, name="ball", seconds=8.0, step=0.001):
    """Return mean time between two passages through x = 0 in the same direction [s]."""
    last, passages = engine.models[name].placement().position[0, 0], []
    for count in range(round(seconds / step)):
        engine.step()
        x = engine.models[name].placement().position[0, 0]
        if last < 0.0 <= x:
            passages.append(count * step)
        last = x
    return float(np.diff(passages).mean())


@pytest.mark.long
@pytest.mark.parametrize(("sections", "rings"), [(64, 33), (128, 65)])
def test_a_ball_rolls_in_a_bowl_as_fast_as_it_should(tmp_path, sections, rings):
    """T = 2 pi sqrt(7 (R - r) / 5 g) for small swings of a ball that rolls."""
    dish = standing(tmp_path, bowl(sections, rings), pose=Pose(z=1.2))
    away, radius = 0.2, 0.1
    height = 1.2 - (1.0 - radius) * math.cos(math.asin(away / (1.0 - radius)))
    moment = 0.4 * radius**2
    ball = scenes.solid(
        "ball", scenes.Sphere(radius), mass=1.0, moments=(moment,) * 3,
        pose=Pose(x=away, z=height + 0.001),
    )  # fmt: skip
    engine = make_engine("mujoco", scenes.world(dish, ball))
    expected = 2.0 * math.pi * math.sqrt(7.0 * (1.0 - radius) / 5.0 / 9.8)
    assert period(engine) == pytest.approx(expected, rel=0.04)


def house(width=6.0, depth=4.0, thick=0.15, height=2.5, door=(2.0, 3.0)):
    """Return four walls as one mesh, of which that at y = 0 has a door, and a floor."""

    def box(x, y, u, v, low=0.0, high=height):
        part = trimesh.creation.box((u - x, v - y, high - low))
        return part.apply_translation(((x + u) / 2, (y + v) / 2, (low + high) / 2))

    return trimesh.util.concatenate(
        [
            box(0, 0, door[0], thick),
            box(door[1], 0, width, thick),
            box(door[0], 0, door[1], thick, 2.0),
            box(0, depth - thick, width, depth),
            box(0, thick, thick, depth - thick),
            box(width - thick, thick, width, depth - thick),
            box(0, 0, width, depth, -0.1, 0.0),
        ]
    )


def test_a_body_slides_in_by_the_door_and_nowhere_else(tmp_path):
    walls = standing(tmp_path, house(), "house")
    for x, enters in ((2.5, True), (1.0, False), (4.5, False)):
        puck = scenes.box(size=(0.5, 0.5, 0.3), mu=0.0, pose=Pose(x=x, y=-0.6, z=0.151))
        ground = scenes.solid("yard", scenes.Box((20, 20, 0.2)), pose=Pose(z=-0.1), static=True)
        engine = make_engine("mujoco", scenes.world(ground, walls, puck))
        engine.models["box"].set_motion(np.array([[0.0, 1.5, 0.0]]), np.zeros((1, 3)))
        for _ in range(1500):
            engine.step()
        y = engine.models["box"].placement().position[0, 1]
        assert (y > 1.0) == enters, x
        assert y < 3.6


@pytest.mark.parametrize("seed", range(3))
def test_balls_come_to_rest_on_the_ground_that_rays_see(tmp_path, seed):
    chance = np.random.default_rng(seed)
    count = 25
    x, y = np.meshgrid(np.linspace(-4, 4, count), np.linspace(-4, 4, count))
    z = chance.uniform(0.0, 0.4, x.shape)
    corner = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    faces = np.concatenate(
        [
            np.stack([corner, corner + 1, corner + count + 1], 1),
            np.stack([corner, corner + count + 1, corner + count], 1),
        ]
    )
    mesh = trimesh.Trimesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), faces)
    land = standing(tmp_path, mesh, "land", mu=1.0)
    balls = [
        scenes.ball(f"ball_{i}", pose=Pose(*chance.uniform(-2.5, 2.5, 2), 0.9)) for i in range(4)
    ]
    engine = make_engine("mujoco", scenes.world(land, *balls))
    for _ in range(2500):
        engine.step()
    for ball in balls:
        position = engine.models[ball.name].placement().position[0]
        distance = closest(mesh, position)[1]
        assert position[2] > 0.05  # it did not fall through
        assert distance == pytest.approx(0.1, abs=0.006)


def land(count, rough, *, flipped=False, scattered=False):
    """Return rolling ground over 10 m by 6 m, with cells split one way or the other."""
    chance = np.random.default_rng(3)
    x, y = np.meshgrid(np.linspace(-4, 6, count), np.linspace(-2, 4, count))
    if scattered:
        inner = (slice(1, -1), slice(1, -1))
        x[inner] += chance.uniform(-0.3, 0.3, x[inner].shape) * 10.0 / count
        y[inner] += chance.uniform(-0.3, 0.3, y[inner].shape) * 6.0 / count
    z = 0.4 * np.sin(x) * np.cos(1.3 * y) + chance.uniform(-rough, rough, x.shape)
    a = (np.arange(count - 1)[:, None] * count + np.arange(count - 1)).ravel()
    b, c, d = a + 1, a + count, a + count + 1
    halves = [(a, b, c), (b, d, c)] if flipped else [(a, b, d), (a, d, c)]
    faces = np.concatenate([np.stack(each, 1) for each in halves])
    return trimesh.Trimesh(np.column_stack([x.ravel(), y.ravel(), z.ravel()]), faces)


@pytest.mark.parametrize(
    ("mesh", "fields"),
    [
        (land(60, 0.05), 1),
        (land(60, 0.05, flipped=True), 1),
        (land(60, 0.0, scattered=True), 1),
        (land(20, 0.05), 0),
    ],
    ids=["grid", "flipped", "scattered", "small"],
)
def test_ground_of_many_triangles_is_one_field_of_heights(tmp_path, mesh, fields):
    pose = Pose(1.0, -2.0, 0.5, 0.05, -0.1, 0.7)
    ground = standing(tmp_path, mesh, "land", pose=pose, mu=1.0)
    chance = np.random.default_rng(0)
    places = [pose.apply((*chance.uniform((-2, -1), (4, 3)), 0.7)) for _ in range(5)]
    balls = [scenes.ball(f"ball_{i}", pose=Pose(*place)) for i, place in enumerate(places)]
    engine = make_engine("mujoco", scenes.world(ground, *balls))
    assert engine.running.batch.model.nhfield == fields
    placed = mesh.copy().apply_transform(pose.matrix())
    touched = 0
    for _ in range(8):
        for _ in range(100):
            engine.step()
        for ball in balls:
            name = f"{ball.name}::{ball.links[0].name}::{ball.links[0].collisions[0].name}"
            if len(engine.contacts([[name]]).named().depth):
                touched += 1
                position = engine.models[ball.name].placement().position[0]
                assert closest(placed, position)[1] == pytest.approx(0.1, abs=0.012)
    assert touched > 5


def closest(mesh, point):
    """Return the nearest place on a mesh: over all triangles, without an index."""
    places = trimesh.triangles.closest_point(mesh.triangles, np.tile(point, (len(mesh.faces), 1)))
    distances = np.linalg.norm(places - point, axis=1)
    row = int(distances.argmin())
    return places[row], float(distances[row]), row


@pytest.mark.parametrize("width", [1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4])
def test_slivers_of_a_mesh_do_no_harm(tmp_path, width):
    """Triangles as thin as rounding, as exporters leave them along edges, have no hull."""
    wall = house()
    chance = np.random.default_rng(2)
    slivers = []
    for _ in range(30):
        start = chance.uniform((0.0, 0.0, 0.5), (6.0, 1.0, 2.5))
        end = start + np.eye(3)[1] * chance.uniform(1.0, 3.0)
        middle = start + 0.7 * (end - start) + np.array([0.0, 0.0, width])
        slivers.append(trimesh.Trimesh([start, end, middle], [[0, 1, 2]], process=False))
    mesh = trimesh.util.concatenate([wall, *slivers])
    text = trimesh.exchange.obj.export_obj(mesh, digits=12)  # STL has single precision
    (tmp_path / "house.obj").write_text(text)
    shape = Mesh("house.obj", tmp_path / "house.obj")
    walls = scenes.solid("walls", shape, static=True)
    ball = scenes.ball(pose=Pose(3.0, 2.0, 0.2))
    engine = make_engine("mujoco", scenes.world(walls, ball))
    for _ in range(600):
        engine.step()
    assert engine.models["ball"].placement().position[0, 2] == pytest.approx(0.1, abs=0.01)
