"""Contacts have memory, however many shapes a body has; where they do not, a warning says so."""

import warnings

import numpy as np
import pytest
import scenes

import gazelle
from gazelle.description import Box, Collision, Inertia, Inertial, Link, Model, Pose
from gazelle.engines.mujoco.compiler import constraint_memory
from gazelle.errors import EngineWarning

SHAPES, BODIES = 20, 10
MASS, TIME = 2.0, 0.05


def brushes():
    """Return plates of many bristles each that stand on the ground."""
    side = 0.02
    places = [(i * 2 * side, k * 2 * side) for i in range(SHAPES) for k in range(SHAPES)]
    bristles = tuple(
        Collision(f"c{n}", Box((side, side, side)), pose=Pose(x, y, 0.5 * side))
        for n, (x, y) in enumerate(places)
    )
    centre = Pose(SHAPES * side, SHAPES * side, side)
    link = Link(
        "l",
        inertial=Inertial(mass=MASS, inertia=Inertia(0.1, 0.1, 0.2), pose=centre),
        collisions=bristles,
    )
    return scenes.world(
        scenes.ground(),
        *(Model(f"brush{n}", pose=Pose(x=2.0 * n), links=(link,)) for n in range(BODIES)),
    )


def test_contacts_of_many_shapes_have_memory():
    with warnings.catch_warnings():
        warnings.simplefilter("error", EngineWarning)
        sim = gazelle.Simulation(brushes(), time_step=0.001)
        sim.step(int(TIME / 0.001))
    heights = [sim.robots[f"brush{n}"].pose.z for n in range(BODIES)]
    np.testing.assert_allclose(heights, 0.0, atol=1e-3)


def test_contacts_that_are_left_out_are_reported(monkeypatch):
    monkeypatch.setattr(constraint_memory, "_FOR_SHAPE", 0)
    sim = gazelle.Simulation(brushes(), time_step=0.001)
    with pytest.warns(EngineWarning, match="more contacts than MuJoCo has memory for") as caught:
        sim.step(3)
    assert len([each for each in caught if "memory" in str(each.message)]) == 1
