"""Fast bodies jump over nothing where the fleet sweeps, and are unchanged where they are slow."""

from __future__ import annotations

import math

import numpy as np
import pytest
import scenes
from hypothesis import given, settings
from hypothesis import strategies as st

from gazelle import Pose, Simulation
from gazelle.description import Box
from gazelle.engines.planar import Body, Drive, Fleet
from gazelle.engines.planar.shapes import slimness
from gazelle.geometry.planar_part import PlanarPart
from gazelle.stage import StageSimulation

HALF = 2.0  # of the room's side [m]
BODIES = {
    "disc": PlanarPart.circle(0.0, 0.0, 0.1),
    "box": PlanarPart(((-0.2, -0.1), (0.2, -0.1), (0.2, 0.1), (-0.2, 0.1))),
    "bar": PlanarPart(((-0.5, -0.05), (0.5, -0.05), (0.5, 0.05), (-0.5, 0.05))),
}


def room():
    """Return four walls without thickness."""
    corners = [(-HALF, -HALF), (HALF, -HALF), (HALF, HALF), (-HALF, HALF)]
    pairs = zip(corners, corners[1:] + corners[:1], strict=True)
    return [PlanarPart(pair, closed=False) for pair in pairs]


def fleet(shape, kind="omni", **options):
    options.setdefault("time_step", 0.1)
    return Fleet([Body((BODIES[shape],), drive=Drive(kind))], room(), **options)


def escapes(made, commands):
    """Return whether the body is ever outside the room."""
    for command in commands:
        made.command[:] = command
        made.step()
        if np.abs(made.pose[..., :2]).max() > HALF:
            return True
    return False


speeds = st.tuples(st.floats(-30, 30), st.floats(-30, 30), st.floats(-20, 20))


@settings(max_examples=60)
@given(shape=st.sampled_from(list(BODIES)), commands=st.lists(speeds, min_size=1, max_size=20))
def test_nothing_leaves_a_closed_room(shape, commands):
    assert not escapes(fleet(shape, sweep=True), commands)


@pytest.mark.parametrize("kind", ["diff", "omni", "car"])
@pytest.mark.parametrize("speed", [math.inf, 900.0, 123.0])
def test_speeds_up_to_a_thousand_strides_a_step_are_swept(kind, speed):
    made = fleet("disc", kind, sweep=True)
    assert not escapes(made, [(speed, 0.0, 0.1)] * 5)
    assert np.isfinite(made.pose).all()


def test_without_sweeping_a_fast_body_leaves():
    assert escapes(fleet("disc"), [(9.0, 0.0, 0.0)] * 20)


def test_a_fast_body_comes_as_near_to_a_wall_as_its_stride():
    made = fleet("disc", sweep=True)
    made.command[:] = (40.0, 0.0, 0.0)
    made.step(3)
    assert HALF - 0.2 <= made.pose[0, 0, 0] <= HALF - 0.1
    assert made.stalled[0, 0]


def test_fast_bodies_do_not_pass_through_each_other():
    bodies = [Body((BODIES["disc"],), (x, 0.0, 0.0), drive=Drive("omni")) for x in (-1.5, 0.0, 1.5)]
    made = Fleet(bodies, room(), time_step=0.1, sweep=True)
    made.command[0] = [(20.0, 0, 0), (0, 0, 0), (-30.0, 0, 0)]
    for _ in range(10):
        made.step()
        x = made.pose[0, :, 0]
        assert (np.diff(x) >= 0.2 - 1e-9).all()


@pytest.mark.parametrize("nworld", [1, 4])
@pytest.mark.parametrize("threads", [1, 2])
def test_slow_bodies_move_to_the_bit_as_without(nworld, threads):
    random = np.random.default_rng(0)
    pair = [fleet("box", "diff", sweep=sweep, nworld=nworld, threads=threads) for sweep in (0, 1)]
    for _ in range(100):
        command = random.uniform((-0.5, 0.0, -1.0), (0.5, 0.0, 1.0), (nworld, 1, 3))
        for each in pair:
            each.command[:] = command
            each.step()
    np.testing.assert_array_equal(pair[0].pose, pair[1].pose)


def test_a_world_does_not_depend_on_how_fast_others_go():
    alone, among = fleet("box", sweep=True), fleet("box", sweep=True, nworld=3)
    among.command[1:] = 25.0
    for each in (alone, among):
        each.command[0] = (3.0, 1.0, 2.0)
        each.step(7)
    np.testing.assert_array_equal(alone.pose[0], among.pose[0])


def test_a_crowd_by_many_threads_is_as_by_one():
    random = np.random.default_rng(1)
    places = [(x, y) for x in np.linspace(-1.8, 1.8, 13) for y in np.linspace(-1.8, 1.8, 13)]
    bodies = [
        Body((PlanarPart.circle(0, 0, 0.05),), (x, y, 0.0), drive=Drive("omni")) for x, y in places
    ]
    made = [Fleet(bodies, room(), sweep=True, threads=count) for count in (1, 2)]
    for _ in range(5):
        command = random.uniform(-10.0, 10.0, (1, len(bodies), 3))
        for each in made:
            each.command[:] = command
            each.step()
    np.testing.assert_array_equal(made[0].pose, made[1].pose)
    assert np.abs(made[0].pose[..., :2]).max() < HALF


@pytest.mark.parametrize("wanted", [True, False])
def test_a_simulation_sweeps_where_contacts_are_looked_for_ahead(wanted):
    wall = scenes.solid("wall", Box((0.02, 4.0, 1.0)), pose=Pose(x=1.0), static=True)
    with Simulation(scenes.world(wall, step=0.1), engine="planar") as sim:
        sim.physics.speculative_contacts = wanted
        box = sim.spawn(scenes.box(), name="box")
        box.set_twist((7.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        sim.step(5)
        assert bool(box.pose.x < 0.9) is wanted


def test_a_stage_world_sweeps_where_asked(tmp_path):
    path = tmp_path / "fast.world"
    path.write_text(
        'position ( name "r" size [.2 .2 .2] velocity_bounds [-9 9 -9 9 -9 9 -90 90] )\n'
        "model ( size [.02 4 1] pose [1 0 0 0] )"
    )
    for sweep in (False, True):
        sim = StageSimulation(path, sweep=sweep)
        sim.commands[0, 0, 0] = 7.0
        sim.step(5)
        assert bool(sim.poses[0, 0, 0] < 0.9) is sweep


@settings(max_examples=50)
@given(st.integers(3, 9), st.floats(0.05, 2.0), st.floats(0.0, 6.3))
def test_slimness_of_a_regular_polygon_is_its_inner_radius(corners, radius, turn):
    angles = turn + 2.0 * np.pi * np.arange(corners) / corners
    polygon = radius * np.stack((np.cos(angles), np.sin(angles)), axis=1)
    assert slimness(polygon) == pytest.approx(radius * math.cos(math.pi / corners))
