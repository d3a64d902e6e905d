"""The true map of a world is what stands there at a height, to the cell."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import gazelle
from gazelle.cli.main import main
from gazelle.description import Box, Collision, Cylinder, Link, Model, Plugin, Pose, Sphere, World
from gazelle.errors import SimulationError
from gazelle.formats import load_map
from gazelle.navigation.true_map import true_map


def world_of(*things):
    models = []
    for number, (shape, pose) in enumerate(things):
        link = Link("link", collisions=(Collision("c", geometry=shape),))
        models.append(Model(f"m{number}", pose=pose, static=True, links=(link,)))
    return World("w", models=tuple(models))


def centres(grid):
    rows, columns = grid.data.shape
    x = grid.origin.x + (np.arange(columns) + 0.5) * grid.resolution
    y = grid.origin.y + (np.arange(rows) + 0.5) * grid.resolution
    return np.meshgrid(x, y)


def test_a_box_on_the_lattice_is_its_cells_and_no_more():
    grid = true_map(world_of((Box((0.2, 0.1, 1.0)), Pose(0.1, 0.05, 0.5))), 0.2, margin=0.1)
    assert grid.data.shape == (6, 8)
    assert (grid.origin.x, grid.origin.y) == pytest.approx((-0.1, -0.1))
    assert (grid.data == 100).sum() == 8
    assert (grid.data[2:4, 2:6] == 100).all()


@given(
    st.floats(-2, 2), st.floats(-2, 2), st.floats(0, 3.1), st.floats(0.02, 2), st.floats(0.02, 2)
)
def test_cells_of_turned_boxes_are_those_that_they_reach_into(x, y, yaw, width, depth):
    grid = true_map(world_of((Box((width, depth, 1.0)), Pose(x, y, 0.5, yaw=yaw))), margin=0.2)
    cx, cy = centres(grid)
    dx, dy = cx - x, cy - y
    along = np.abs(np.cos(yaw) * dx + np.sin(yaw) * dy)
    aside = np.abs(-np.sin(yaw) * dx + np.cos(yaw) * dy)
    within = (along <= width / 2) & (aside <= depth / 2)
    reach = grid.resolution * 0.7072
    beyond = (along > width / 2 + reach) | (aside > depth / 2 + reach)
    assert (grid.data[within] == 100).all()
    assert (grid.data[beyond] == 0).all()


def test_only_what_is_at_the_height_counts():
    things = world_of((Box((1, 1, 0.1)), Pose(z=0.05)), (Cylinder(0.3, 1.0), Pose(3.0, 0, 0.5)))
    grid = true_map(things, 0.5)
    assert (grid.data == 100).sum() * 0.0025 == pytest.approx(np.pi * 0.09, rel=0.2)
    assert grid.origin.x > 1.0
    low = true_map(things, 0.05)
    assert low.data.shape[1] > grid.data.shape[1]


def test_spheres_are_cut_where_they_are():
    grid = true_map(world_of((Sphere(0.5), Pose(z=0.0))), 0.3, resolution=0.02)
    inside = (grid.data == 100).sum() * 0.0004
    assert inside == pytest.approx(np.pi * 0.4**2, rel=0.08)


def test_robots_are_left_out_and_an_area_may_be_given():
    robot = Model(
        "r",
        links=(Link("l", collisions=(Collision("c", geometry=Box((1, 1, 1))),)),),
        plugins=(Plugin("p", "libx.so"),),
    )
    world = World("w", models=(robot,))
    with pytest.raises(SimulationError, match="nothing stands"):
        true_map(world)
    grid = true_map(world, area=(-1, -1, 1, 2), resolution=0.1)
    assert grid.data.shape == (30, 20)
    assert not grid.data.any()


@pytest.mark.parametrize("wrong", [{"resolution": 0.0}, {"resolution": 1e-9}, {"margin": -1.0}])
def test_what_cannot_be_a_map_is_refused(wrong):
    with pytest.raises(SimulationError):
        true_map(world_of((Box((1, 1, 1)), Pose())), 0.2, **wrong)


def test_the_command_writes_what_loads_again(tmp_path, capsys):
    assert main(["map", "turtlebot3_world", str(tmp_path / "tb3")]) == 0
    assert "wrote" in capsys.readouterr().out
    grid = load_map(tmp_path / "tb3.yaml")
    known = true_map(gazelle.load("turtlebot3_world"), 0.2)
    assert np.array_equal(grid.data, known.data)
    assert (grid.data == 100).sum() > 500
