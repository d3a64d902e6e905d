"""Worlds of any numbers run, and robots of them never overlap what they did not at first."""

import math

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from stage_samples import draw, write

from gazelle.stage import StageSimulation

shapely = pytest.importorskip("shapely")

lengths = st.one_of(st.just(0.0), st.floats(1e-3, 3.0))
places = st.floats(-3.0, 3.0)
angles = st.floats(-720.0, 720.0)


@st.composite
def sensors(draw_from):
    fov = draw_from(st.one_of(st.just(0.0), angles))
    far = draw_from(lengths)
    return (
        f"sensor ( fov {fov!r} samples {draw_from(st.integers(1, 40))} range [ 0 {far!r} ] "
        f"pose [ {draw_from(places)!r} 0 {draw_from(places)!r} {draw_from(angles)!r} ] )"
    )


@st.composite
def models(draw_from):
    x, y, a = draw_from(places), draw_from(places), draw_from(angles)
    size = [draw_from(lengths) for _ in range(3)]
    common = f"pose [ {x!r} {y!r} 0 {a!r} ] size [ {size[0]!r} {size[1]!r} {size[2]!r} ]"
    kind = draw_from(st.sampled_from(["model", "position", "position", "picture"]))
    if kind == "picture":
        return f'model ( {common} bitmap "map.png" boundary 1 )'
    if kind == "model":
        return f"model ( {common} ranger_return {draw_from(st.sampled_from([-1, 0, 1]))} )"
    drive = draw_from(st.sampled_from(["diff", "omni", "car"]))
    where = draw_from(st.sampled_from(["gps", "odom"]))
    ranger = " ".join(draw_from(st.lists(sensors(), max_size=2)))
    return (
        f'position ( {common} drive "{drive}" localization "{where}" '
        f"noblocks {draw_from(st.integers(0, 1))} ranger ( {ranger} ) )"
    )


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("any")
    draw(folder, ["##.#", "#..#", "#.##"])
    return folder


once = settings(max_examples=30, suppress_health_check=[HealthCheck.too_slow])


@once
@given(parts=st.lists(models(), min_size=1, max_size=5), seed=st.integers(0, 100))
def test_it_runs(folder, parts, seed):
    file = write(folder, "\n".join(parts))
    rng = np.random.default_rng(seed)
    with StageSimulation(file, threads=1, seed=seed) as sim:
        for _ in range(5):
            sim.commands[:] = rng.uniform(-1.0, 1.0, sim.commands.shape)
            sim.step()
            for scanner in range(sim.scanners):
                ranges = sim.scan(scanner)
                assert np.isfinite(ranges).all()
                assert (ranges >= 0.0).all()
        assert np.isfinite(sim.poses).all()
        assert np.isfinite(sim.odometry).all()


def footprint(width, depth, x, y, yaw):
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (width / 2, depth / 2)
    cos, sin = math.cos(yaw), math.sin(yaw)
    return shapely.Polygon(corners @ np.array([[cos, sin], [-sin, cos]]) + (x, y))


@once
@given(
    robots=st.lists(
        st.tuples(st.floats(0.1, 0.9), st.floats(0.1, 0.9), angles), min_size=2, max_size=9
    ),
    seed=st.integers(0, 100),
)
def test_robots_never_overlap(folder, robots, seed):
    text = "".join(
        f"position ( pose [ {i % 3} {i // 3} 0 {a!r} ] size [ {w / 2!r} {d / 2!r} 1 ] "
        f'drive "omni" )\n'
        for i, (w, d, a) in enumerate(robots)
    )
    rng = np.random.default_rng(seed)
    with StageSimulation(write(folder, text), threads=1) as sim:
        drift = rng.uniform(-1.0, 1.0, sim.commands.shape)
        for _ in range(10):
            sim.commands[:] = drift + rng.uniform(-0.5, 0.5, sim.commands.shape)
            sim.step()
            shapes = [
                footprint(w / 2, d / 2, *pose)
                for (w, d, _), pose in zip(robots, sim.poses[0], strict=True)
            ]
            first, second = np.triu_indices(len(shapes), 1)
            shared = shapely.intersection(np.take(shapes, first), np.take(shapes, second))
            assert shapely.area(shared).max() < 1e-9
