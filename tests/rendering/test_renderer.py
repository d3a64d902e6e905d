"""Pictures against rays through the middles of pixels, and in every build."""

import hashlib
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from gazelle import EngineError, native
from gazelle.description import (
    Attenuation,
    Box,
    Cylinder,
    Light,
    Link,
    Material,
    Model,
    Plane,
    Pose,
    Scene,
    Sphere,
    Visual,
    World,
)
from gazelle.engines.tracer import make_tracer
from gazelle.rendering import PinholeLens, Renderer
from gazelle.sensors import View, look_at, range_image, render

LENS = PinholeLens(96, 72, 1.2, 0.1, 60.0)


def model(name, geometry, pose, color=(0.7, 0.7, 0.7, 1.0)):
    visual = Visual("visual", geometry=geometry, material=Material(diffuse=color))
    return Model(name, links=(Link("link", visuals=(visual,)),), pose=pose)


def boxes(seed, count=12, **world):
    """Return a floor with boxes that stand and lean on it."""
    random = np.random.default_rng(seed)
    models = [model("floor", Plane(size=(30.0, 30.0)), Pose())]
    for number in range(count):
        place, turn = random.uniform(-4.0, 4.0, 3), random.uniform(-3.0, 3.0, 3)
        pose = Pose(*place[:2], abs(place[2]) / 2.0, *turn)
        color = (*random.uniform(0.0, 1.0, 3), 1.0)
        models.append(model(f"box{number}", Box(tuple(random.uniform(0.2, 2.0, 3))), pose, color))
    return World(models=tuple(models), **world)


def shot(world, pose, lens=LENS, **options):
    """Return one picture of a described world."""
    frames = Renderer(world, **options).render(
        lens, np.array([pose.position]), np.array([pose.quaternion])
    )
    return frames.color[0], frames.depth[0], frames.labels[0]


def seen_by_rays(world, pose, lens=LENS):
    """Return depths and visuals of ray hits."""
    tracer = make_tracer(world)
    focal = lens.focal
    x, y = np.meshgrid(
        (np.arange(lens.width) + 0.5 - lens.width / 2) / focal,
        (np.arange(lens.height) + 0.5 - lens.height / 2) / focal,
    )
    ways = np.stack((np.ones_like(x), -x, -y), axis=-1).reshape(-1, 3)
    along = np.linalg.norm(ways, axis=1)
    ways = (ways / along[:, None]) @ pose.matrix()[:3, :3].T
    met = tracer.trace(np.tile(pose.position, (len(ways), 1)), np.ascontiguousarray(ways))
    depth = (met.distance / along).reshape(lens.height, lens.width)
    return np.where(depth < lens.far, depth, np.inf), met.visual.reshape(depth.shape)


def inner(labels):
    """Return pixels whose neighbours all show the same."""
    same = np.ones_like(labels, bool)
    for axis in (0, 1):
        for shift in (-1, 1):
            same &= np.roll(labels, shift, axis) == labels
    same[[0, -1]], same[:, [0, -1]] = False, False
    return same


EYES = [(6.0, 1.0, 2.5), (-5.0, -5.0, 1.0), (0.5, 0.2, 7.0), (2.0, -3.0, 0.3)]


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("eye", EYES)
def test_flat_shapes_have_exact_depths_and_labels(seed, eye):
    world, pose = boxes(seed), look_at(eye, (0.0, 0.0, 0.3))
    _, depth, labels = shot(world, pose)
    wanted, visual = seen_by_rays(world, pose)
    same = labels == np.where(np.isinf(wanted), -1, visual)
    assert same.mean() > 0.995
    assert same[inner(visual)].all()
    near = same & np.isfinite(wanted)
    assert np.abs(depth[near] - wanted[near]).max() < 1e-3
    assert np.isinf(depth[labels < 0]).all()


def test_round_shapes_are_seen_where_they_are():
    parts = [
        model("ball", Sphere(0.5), Pose(0.0, 0.6, 0.5)),
        model("can", Cylinder(0.4, 1.0), Pose(0.0, -0.6, 0.5)),
    ]
    world, pose = World(models=tuple(parts)), look_at((3.0, 0.0, 1.2), (0.0, 0.0, 0.4))
    _, depth, labels = shot(world, pose)
    wanted, visual = seen_by_rays(world, pose)
    assert (labels == np.where(np.isinf(wanted), -1, visual)).mean() > 0.98
    both = np.isfinite(depth) & np.isfinite(wanted)
    # A polygon of 32 sides is cos(pi / 32) of its circle, and less along a slanting view.
    assert np.abs(depth[both] - wanted[both]).mean() < 0.01


def test_a_plane_that_passes_under_the_camera_is_cut_at_the_nearest_depth():
    world = World(models=(model("floor", Plane(size=(40.0, 40.0)), Pose()),))
    pose = Pose(0.0, 0.0, 0.5, 0.0, 0.2, 0.7)
    _, depth, _ = shot(world, pose)
    wanted, _ = seen_by_rays(world, pose)
    both = np.isfinite(depth) & np.isfinite(wanted)
    assert np.abs(depth[both] - wanted[both]).max() < 1e-3
    assert (np.isfinite(depth) == np.isfinite(wanted)).mean() > 0.999
    steep = Pose(0.0, 0.0, 0.5, 0.0, math.pi / 2)
    assert (shot(world, steep, PinholeLens(64, 64, 1.0, 0.6, 5.0))[2] == -1).all()
    assert (shot(world, steep, PinholeLens(64, 64, 1.0, 0.4, 5.0))[2] == 0).all()


@pytest.mark.parametrize("seed", range(5))
def test_triangles_that_share_edges_leave_no_gap_and_overlap_nowhere(seed):
    """A floor of many triangles covers just what one rectangle covers, at any view."""
    random = np.random.default_rng(seed)
    tiles = []
    edges = [np.sort([-3.0, 3.0, *random.uniform(-3.0, 3.0, 9)]) for _ in range(2)]
    for x0, x1 in zip(edges[0], edges[0][1:], strict=False):
        for y0, y1 in zip(edges[1], edges[1][1:], strict=False):
            middle = Pose((x0 + x1) / 2, (y0 + y1) / 2)
            tiles.append(model(f"t{len(tiles)}", Plane(size=(x1 - x0, y1 - y0)), middle))
    whole = World(models=(model("floor", Plane(size=(6.0, 6.0)), Pose()),))
    eye = (*random.uniform(-5.0, 5.0, 2), random.uniform(0.5, 4.0))
    pose = look_at(eye, (*random.uniform(-1.0, 1.0, 2), 0.0))
    _, _, tiled = shot(World(models=tuple(tiles)), pose)
    _, _, one = shot(whole, pose)
    assert ((tiled >= 0) == (one >= 0)).mean() > 0.998  # rims differ by roundings of corners
    inside = inner(one)
    assert (tiled[inside] >= 0).sum() == (one[inside] >= 0).sum()


def test_what_faces_away_is_not_seen():
    world = World(models=(model("floor", Plane(size=(4.0, 4.0)), Pose()),))
    assert (shot(world, look_at((0.1, 0.0, -2.0), (0.0, 0.0, 0.0)))[2] == -1).all()


LIGHTS = {
    "sun": Light("sun", "directional", direction=(-0.4, 0.3, -0.8), diffuse=(0.6, 0.5, 0.4, 1.0)),
    "bulb": Light(
        "bulb",
        "point",
        pose=Pose(1.0, 1.0, 4.0),
        diffuse=(0.9, 0.9, 0.9, 1.0),
        attenuation=Attenuation(20.0, 0.3, 0.1, 0.01),
    ),
    "spot": Light(
        "spot",
        "spot",
        pose=Pose(-1.0, 0.0, 5.0),
        attenuation=Attenuation(20.0, 0.5, 0.05, 0.0),
        spot_inner_angle=0.5,
        spot_outer_angle=0.9,
    ),
}


@pytest.mark.parametrize("lights", [("sun",), ("bulb",), ("sun", "spot"), ("sun", "bulb", "spot")])
@pytest.mark.parametrize("sky", [False, True])
def test_colours_are_near_those_of_traced_rays(lights, sky):
    scene = Scene(shadows=False, grid=False, sky=sky)
    world = boxes(3, lights=tuple(LIGHTS[name] for name in lights), scene=scene)
    pose = look_at((6.0, 2.0, 3.0), (0.0, 0.0, 0.3))
    color, _, labels = shot(world, pose, gamma=1.35)
    traced = render(
        make_tracer(world), world, View(pose, LENS.width, LENS.height, LENS.horizontal_fov, 1)
    )
    difference = np.abs(color.astype(int) - traced.astype(int))
    assert difference[inner(labels) & (labels >= 0)].mean() < 1.0
    assert difference[inner(labels) & (labels < 0)].mean() < 8.0


def test_what_glows_is_seen_without_any_light():
    glowing = Material(diffuse=(0.0, 0.0, 0.0, 1.0), emissive=(0.2, 0.4, 0.6, 1.0))
    visual = Visual("visual", geometry=Box((1.0, 1.0, 1.0)), material=glowing)
    world = World(models=(Model("lamp", links=(Link("link", visuals=(visual,)),)),))
    color, _, labels = shot(world, look_at((3.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    assert (color[labels == 0] == (51, 102, 153)).all()


def many(threads):
    """Return pictures of three worlds, whose boxes are elsewhere in each, by six cameras."""
    world = boxes(7, lights=(LIGHTS["sun"], LIGHTS["bulb"]))
    renderer = Renderer(world, nworld=3, threads=threads)
    random = np.random.default_rng(0)
    for link in renderer.links[1:]:
        turns = random.normal(size=(3, 4))
        turns /= np.linalg.norm(turns, axis=1, keepdims=True)
        renderer.place(link, random.uniform(-3.0, 3.0, (3, 3)), turns)
    poses = [look_at(eye, (0.0, 0.0, 0.4)) for eye in (*EYES, (4.0, 4.0, 1.0), (0.0, 6.0, 2.0))]
    return renderer.render(
        LENS,
        np.array([pose.position for pose in poses]),
        np.array([pose.quaternion for pose in poses]),
        np.array([0, 1, 2, 2, 1, 0]),
    )


def digest(frames):
    return hashlib.sha256(
        frames.color.tobytes() + frames.depth.tobytes() + frames.labels.tobytes()
    ).hexdigest()


def test_a_camera_may_leave_out_one_link():
    world = World(
        models=(
            model("near", Box((1.0, 1.0, 1.0)), Pose(3.0)),
            model("far", Box((1.0, 9.0, 9.0)), Pose(6.0)),
        )
    )
    renderer = Renderer(world)
    lens, eyes, ahead = (
        PinholeLens(9, 9, 0.5),
        np.zeros((3, 3)),
        np.tile((0.0, 0.0, 0.0, 1.0), (3, 1)),
    )
    near, far = (renderer.links.index(f"{name}::link") for name in ("near", "far"))
    frames = renderer.render(lens, eyes, ahead, np.zeros(3, int), unseen=np.array([-1, near, far]))
    assert frames.depth[:, 4, 4] == pytest.approx([2.5, 5.5, 2.5])
    assert frames.labels[:, 4, 4].tolist() == [near, far, near]
    assert np.isinf(frames.depth[2, 0, 0])


def test_a_fourth_byte_of_colours_is_255():
    world, pose = boxes(0), look_at(EYES[0], (0.0, 0.0, 0.3))
    where = np.array([pose.position]), np.array([pose.quaternion])
    three = Renderer(world).render(LENS, *where).color
    four = Renderer(world).render(LENS, *where, channels=4).color
    np.testing.assert_array_equal(four[..., :3], three)
    assert (four[..., 3] == 255).all()


@pytest.mark.parametrize("fov", [0.5, 1.3])
def test_pixels_need_not_be_square(fov):
    lens = PinholeLens(80, 60, 1.0, 0.1, 20.0, vertical_fov=fov)
    world = World(models=(model("wall", Box((0.2, 1.0, 1.0)), Pose(3.1)),))
    _, depth, _ = shot(world, Pose(), lens)
    rows, columns = (np.flatnonzero(np.isfinite(depth).any(axis=k)) for k in (1, 0))
    for found, size, angle in ((rows, 60, fov), (columns, 80, 1.0)):
        half = size / 2.0 / math.tan(angle / 2.0) * 0.5 / 3.0
        assert found[0] == max(math.ceil(size / 2.0 - half - 0.5), 0)
        assert found[-1] == min(math.ceil(size / 2.0 + half - 0.5), size) - 1


def test_pictures_do_not_depend_on_threads():
    assert digest(many(1)) == digest(many(3))


@pytest.mark.long
@pytest.mark.parametrize("build", ["baseline"])
def test_pictures_are_the_same_in_every_build(build):
    if native.BUILD not in ("avx2", "baseline"):
        pytest.skip("only one build is looked at here")
    code = f"import sys; sys.path.insert(0, {str(Path(__file__).parent)!r})\n"
    code += "import test_renderer as t; print(t.digest(t.many(2)))"
    done = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, "GAZELLE_NATIVE": build},
        capture_output=True,
        text=True,
        check=True,
        timeout=300,
    )
    assert done.stdout.strip() == digest(many(2))


def test_links_can_be_put_somewhere_else():
    world = World(models=(model("cube", Box((1.0, 1.0, 1.0)), Pose()),))
    renderer = Renderer(world, nworld=2)
    renderer.place(
        "cube::link", np.array([[0.0, 0.0, 9.0]]), np.array([[0.0, 0.0, 0.0, 1.0]]), np.array([1])
    )
    pose = look_at((4.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    frames = renderer.render(
        LENS, np.tile(pose.position, (2, 1)), np.tile(pose.quaternion, (2, 1)), want=("labels",)
    )
    assert frames.color.shape == (0, 72, 96, 3)
    assert (frames.labels[0] == 0).any()
    assert (frames.labels[1] == -1).all()


def test_an_empty_world_is_background():
    color, depth, labels = shot(World(scene=Scene(background=(1.0, 0.5, 0.0, 1.0))), Pose())
    assert (color == (255, 128, 0)).all()
    assert np.isinf(depth).all()
    assert (labels == -1).all()


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"width": 0}, "between 1 and"),
        ({"width": 10**6, "height": 10**6}, "between 1 and"),
        ({"horizontal_fov": 3.2}, "between 0 and 180 degrees"),
        ({"near": 0.0}, "above zero"),
        ({"near": 5.0, "far": 2.0}, "from 5 to 2 m"),
    ],
)
def test_lenses_that_cannot_be_are_refused(change, words):
    with pytest.raises(EngineError, match=words):
        PinholeLens(**change)


def test_wrong_wishes_are_refused():
    renderer = Renderer(World())
    place, turn = np.zeros((1, 3)), np.array([[0.0, 0.0, 0.0, 1.0]])
    with pytest.raises(EngineError, match="colour"):
        renderer.render(LENS, place, turn, want=("colour",))
    with pytest.raises(EngineError, match="worlds 0 to 0"):
        renderer.render(LENS, place, turn, np.array([1]))


def test_ranges_of_the_ray_traced_view_agree():
    world, pose = boxes(1), look_at((6.0, 1.0, 2.5), (0.0, 0.0, 0.3))
    ranges = range_image(make_tracer(world), View(pose, 96, 72, 1.2))
    _, depth, labels = shot(world, pose)
    assert (ranges >= depth - 1e-3)[inner(labels)].all()
