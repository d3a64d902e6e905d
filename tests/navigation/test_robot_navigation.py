"""Robots of a simulation go to goals by themselves, in simulated time, and touch nothing."""

import math

import numpy as np
import pytest

import gazelle
from gazelle.description import Box, Capsule, Collision, Cylinder, Link, Model, Pose, Sphere
from gazelle.errors import Error, SimulationError
from gazelle.navigation.costmap.footprint import placed
from gazelle.navigation.outline import outline_of
from gazelle.navigation.true_map import true_map


def burger(sim, name="burger", **place):
    return sim.spawn("turtlebot3_burger", name=name, namespace=f"/{name}", pose=Pose(**place))


def off(robot, x, y, world=0):
    return float(np.hypot(*(robot.planar_pose()[world, :2] - (x, y))))


@pytest.fixture
def world():
    with gazelle.Simulation("turtlebot3_world", engine="planar", seed=1) as sim:
        yield sim


def stands_free(sim, robot):
    """Return whether no corner of its outline is in a solid."""
    grid = true_map(sim.world, 0.1, resolution=0.02)
    x, y, heading = robot.planar_pose()[0].tolist()
    corners = placed(0.95 * outline_of(robot.description), x, y, heading)
    columns, rows = ((corners - (grid.origin.x, grid.origin.y)) / 0.02).astype(int).T
    return not grid.data[rows, columns].any()


@pytest.mark.long
@pytest.mark.parametrize("localization", ["truth", "amcl"])
def test_a_robot_goes_around_the_pillars(world, localization):
    robot = burger(world, x=-2.0, y=-0.5)
    robot.navigation.configure(localization=localization)
    for x, y, yaw in ((0.55, 0.55, 0.0), (1.8, 0.5, 1.0)):
        task = robot.navigation.go_to(x, y, yaw)
        assert not task.done
        while not task.done and world.time < 90.0:
            world.run(seconds=0.5)
            assert stands_free(world, robot)
        assert task.text == "Goal reached."
        assert off(robot, x, y) < 0.2
        assert abs(math.remainder(robot.pose.yaw - yaw, 2 * math.pi)) < 0.35
        assert stands_free(world, robot)


@pytest.mark.long
def test_robots_on_one_map_keep_out_of_each_others_way(world):
    robots = [burger(world, "a", x=-1.7, y=-0.5), burger(world, "b", x=1.7, y=0.5, yaw=3.1)]
    tasks = [robots[0].navigation.go_to(1.7, 0.5), robots[1].navigation.go_to(-1.7, -0.5)]
    while not all(task.done for task in tasks) and world.time < 120.0:
        world.run(seconds=0.5)
        assert math.dist(robots[0].position[0, :2], robots[1].position[0, :2]) > 0.15
    assert [task.text for task in tasks] == ["Goal reached."] * 2


def test_every_world_has_its_own_goal():
    with gazelle.Simulation("turtlebot3_world", engine="planar", nworld=2, seed=1) as sim:
        robot = burger(sim, x=-2.0, y=-0.5)
        first = robot.navigation.go_to(-1.5, -0.5, worlds=np.array([0]))
        second = robot.navigation.go_to(-1.8, 0.6, worlds=np.array([1]))
        assert first.wait(60.0)
        assert second.wait(60.0)
        assert off(robot, -1.5, -0.5, 0) < 0.2
        assert off(robot, -1.8, 0.6, 1) < 0.2


def test_it_is_the_same_every_time():
    def run():
        with gazelle.Simulation("turtlebot3_world", engine="planar", seed=1) as sim:
            robot = burger(sim, x=-2.0, y=-0.5)
            robot.navigation.configure(localization="amcl")
            robot.navigation.go_to(-0.5, -0.1)
            sim.run(seconds=5.0)
            return robot.planar_pose()

    assert np.array_equal(run(), run())


def test_a_goal_that_cannot_be_reached_is_given_up(world):
    robot = burger(world, x=-2.0, y=-0.5)
    robot.navigation.configure({"planner_patience": 0.5, "recovery_behavior_enabled": False})
    task = robot.navigation.go_to(20.0, 0.0)
    assert not task.wait(20.0)
    assert task.done
    assert task.text.startswith("Failed to find a valid plan.")


def test_a_goal_can_be_cancelled(world):
    robot = burger(world, x=-2.0, y=-0.5)
    task = robot.navigation.go_to(1.0, 0.5)
    world.run(seconds=3.0)
    robot.navigation.cancel()
    world.run(seconds=1.0)
    before = robot.planar_pose().copy()
    world.run(seconds=1.0)
    assert task.done
    assert not task.succeeded
    assert np.allclose(robot.planar_pose(), before, atol=1e-3)


def test_a_planner_of_ones_own_is_used(world):
    from gazelle.navigation.planners import GlobalPlannerPlugin, register_global

    class Straight(GlobalPlannerPlugin):
        calls = 0

        def make_plan(self, start, goal, tolerance=None):
            type(self).calls += 1
            share = np.linspace(0.0, 1.0, 50)[:, None]
            return np.array(start) * (1 - share) + np.array(goal) * share

    register_global("mine/Straight", Straight)
    robot = burger(world, x=-2.0, y=-0.5)
    robot.navigation.configure({"base_global_planner": "mine/Straight"})
    assert robot.navigation.go_to(-1.5, -0.5).wait(30.0)
    assert Straight.calls > 0


def test_what_is_wrong_is_named(world):
    robot = burger(world, x=-2.0, y=-0.5)
    with pytest.raises(SimulationError, match="truth, amcl or slam"):
        robot.navigation.configure(localization="gps")
    with pytest.raises(Error, match="controller_frequency"):
        robot.navigation.configure({"controller_frequency": 0.0})
    with pytest.raises(Error, match="finite"):
        robot.navigation.go_to(math.nan, 0.0)
    box = world.spawn(
        Model(
            "box",
            links=(Link("l", collisions=(Collision("c", geometry=Box((1, 1, 1))),)),),
            pose=Pose(x=5),
        )
    )
    with pytest.raises(SimulationError, match="no drive"):
        box.navigation.go_to(0, 0)


def test_an_outline_is_the_hull_of_the_shapes():
    def model(*shapes):
        return Model("m", links=tuple(
            Link(f"l{i}", pose=pose, collisions=(Collision("c", geometry=shape),))
            for i, (shape, pose) in enumerate(shapes)
        ))  # fmt: skip

    found = outline_of(model((Box((0.4, 0.2, 0.1)), Pose()), (Sphere(0.05), Pose(x=0.3))))
    assert found.min(axis=0) == pytest.approx((-0.2, -0.1))
    assert found.max(axis=0) == pytest.approx((0.35, 0.1))
    round_one = outline_of(model((Cylinder(0.2, 0.1), Pose())))
    assert np.hypot(*round_one.T) == pytest.approx(0.2)
    lying = outline_of(model((Capsule(0.1, 0.4), Pose(pitch=math.pi / 2))))
    assert lying.max(axis=0) == pytest.approx((0.3, 0.1), abs=0.01)
    assert outline_of(model()) is None
