"""Meshes of many pieces that overlap are let out as slowly as shapes of one piece."""

import math

import numpy as np
import pytest
import scenes
import trimesh

from gazelle.description import Contact, Friction, Mesh, Pose, Surface
from gazelle.engines import make_engine


@pytest.fixture(autouse=True)
def _own_cache(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "cache"))


def corner():
    """Return an L of two bars."""
    one, two = trimesh.creation.box((0.4, 0.1, 0.2)), trimesh.creation.box((0.1, 0.3, 0.2))
    one.apply_translation((0.1, 0.0, 0.0))
    two.apply_translation((-0.05, 0.2, 0.0))
    return trimesh.util.concatenate([one, two])


MESHES = {"corner": corner, "ring": lambda: trimesh.creation.torus(0.2, 0.06, 24, 12)}


def thing(folder, kind, name, pose, max_vel, *, static=False):
    surface = Surface(Friction(1.0, 1.0), Contact(max_vel=max_vel))
    if kind == "box":
        made = scenes.box(name, (0.3, 0.3, 0.3), pose=pose, static=static)
    else:
        MESHES[kind]().export(folder / f"{kind}.stl")
        shape = Mesh(f"{kind}.stl", folder / f"{kind}.stl")
        made = scenes.solid(name, shape, moments=(0.02,) * 3, pose=pose, static=static)
    return scenes.with_surface(made, surface)


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.1, 0.05)])
@pytest.mark.parametrize("depth", [0.05, 0.1])
@pytest.mark.parametrize(
    ("below", "above"),
    [("corner", "corner"), ("corner", "ring"), ("box", "corner"), ("ring", "ring")],
)
def test_what_overlaps_is_not_thrown_out(tmp_path, below, above, depth, x, y):
    """It was, at up to 5 m/s; what drops from 0.3 m bounces no higher than this."""
    base = thing(tmp_path, below, "below", Pose(z=0.1), 0.01, static=True)
    body = thing(tmp_path, above, "above", Pose(x, y, 0.3 - depth), 0.01)
    engine = make_engine("mujoco", scenes.world(scenes.ground(), base, body))
    fastest = 0.0
    for _ in range(200):
        engine.step(5)
        fastest = max(fastest, float(engine.links["above::link"].motion().linear[0, 2]))
    assert fastest < 0.3


@pytest.mark.long
@pytest.mark.parametrize("mu", [0.0, 0.05, 1.0])
@pytest.mark.parametrize(
    ("below", "above", "pose"),
    [
        ("ring", "ring", Pose(0.02, 0.1, 0.15, 0.9, 0.3, 0.5)),
        ("corner", "corner", Pose(0.1, 0.086, 0.214, 0.75, -0.88, -0.33)),
        ("ring", "box", Pose(0.0, -0.05, 0.1)),
        ("box", "ring", Pose(-0.13, -0.08, 0.16, -0.2, 0.98, 0.85)),
    ],
)
def test_what_is_caught_in_something_gains_no_energy(tmp_path, below, above, pose, mu):
    """They left at up to 8 m/s, and without friction at 280."""
    base = thing(tmp_path, below, "below", Pose(z=0.1), 0.1, static=True)
    body = thing(tmp_path, above, "above", pose, 0.1)
    surface = Surface(Friction(mu, mu), Contact(max_vel=0.1))
    models = (scenes.ground(mu), *(scenes.with_surface(each, surface) for each in (base, body)))
    engine = make_engine("mujoco", scenes.world(*models))
    fallen = 0.0
    for _ in range(200):
        engine.step(5)
        fallen = max(fallen, pose.z - engine.models["above"].placement().position[0, 2])
        speed = np.linalg.norm(engine.links["above::link"].motion().linear[0])
        assert speed < 0.4 + math.sqrt(2.0 * 9.8 * fallen)


@pytest.mark.parametrize("kind", ["corner", "ring", "box"])
def test_what_is_in_the_ground_rises_at_max_vel_in_all_its_pieces(tmp_path, kind):
    half = {"corner": 0.1, "ring": 0.06, "box": 0.15}[kind]
    body = thing(tmp_path, kind, "body", Pose(z=half - 0.05), 0.1)
    engine = make_engine(
        "mujoco",
        scenes.world(
            scenes.with_surface(scenes.ground(), Surface(contact=Contact(max_vel=0.1))), body
        ),
    )
    for tenth in range(1, 9):
        engine.step(100)
        height = engine.models["body"].placement().position[0, 2] - half
        assert height == pytest.approx(min(0.0, 0.01 * tenth - 0.05), abs=4e-3)


def test_a_saved_state_goes_on_alike_while_something_is_let_out_and_it_ends(tmp_path):
    base = thing(tmp_path, "box", "below", Pose(z=0.1), 0.1, static=True)
    body = thing(tmp_path, "corner", "above", Pose(0.1, 0.05, 0.2), 0.1)
    world = scenes.world(scenes.ground(), base, body)
    engine, other = (make_engine("mujoco", world) for _ in range(2))
    start = engine.snapshot()
    for steps in (300, 600, 100):  # before, while and after the surfaces rise
        engine.step(steps)
        other.restore(engine.snapshot())
        engine.step(200)
        other.step(200)
        assert (engine.snapshot() == other.snapshot()).all()
    engine.step(5000)
    assert not engine.running.overlaps.any
    engine.reset()
    assert (engine.snapshot() == start).all()
