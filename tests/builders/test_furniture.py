"""Furniture is to scale, stands still, and stays where it is when it can be pushed."""

import pytest

import gazelle
from gazelle.builders import (
    BuildError,
    bush,
    cabinet,
    chair,
    desk,
    footprints,
    ground,
    log,
    office_chair,
    plant,
    rock,
    round_table,
    shelf,
    sofa,
    table,
    tree,
    whiteboard,
)
from gazelle.description import Pose, World

MOVABLE = (desk, table, round_table, chair, office_chair, shelf, cabinet, sofa)
FIXED = (whiteboard, tree, bush, rock, plant, log)


@pytest.mark.parametrize("make", MOVABLE + FIXED)
def test_things_stand_still_unless_told(make):
    assert make().static


def test_movable_things_stay_where_they_are():
    models = [ground()]
    for number, make in enumerate(MOVABLE):
        models.append(make(pose=Pose(3.0 * number, yaw=0.3 * number), movable=True))
    with gazelle.Simulation(World(models=tuple(models))) as sim:
        sim.run(1.0)
        for model in models[1:]:
            now = sim.robots[model.name].pose
            assert now.is_close(model.pose, position=5e-3, angle=5e-3), model.name


@pytest.mark.parametrize("make", MOVABLE)
def test_centre_of_mass_is_above_what_it_stands_on(make):
    model = make(movable=True)
    center = model.links[0].inertial.pose
    assert 0.0 < center.z < 1.2
    assert min(zone.distance(center.x, center.y) for zone in footprints(model)) <= 0.0


def test_sizes_are_those_asked_for():
    top = table(length=2.0, width=1.0, height=0.7).links[0].collisions[0]
    assert top.geometry.size[:2] == (2.0, 1.0)
    assert top.pose.z + top.geometry.size[2] / 2 == pytest.approx(0.7)


@pytest.mark.parametrize(
    ("make", "options"),
    [
        (table, {"length": 0.1}),
        (table, {"height": 0.01}),
        (round_table, {"height": 0.05}),
        (shelf, {"boards": 1}),
        (shelf, {"boards": 40}),
        (sofa, {"width": 0.5}),
        (tree, {"kind": "palm"}),
        (tree, {"height": 0.0}),
    ],
)
def test_impossible_furniture_is_refused(make, options):
    with pytest.raises(BuildError):
        make(**options)
