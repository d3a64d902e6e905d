"""Robots of Stage files go to goals by the stack of any other robot: by their rangers and drives."""

import math

import numpy as np
import pytest

import gazelle
from gazelle.description.occupancy import OccupancyMap
from gazelle.errors import SimulationError
from gazelle.navigation.outline import outline_of
from gazelle.stage import stage_of

ROOM = """
interval_sim 100
define laser ranger
( sensor ( range [0.05 6.0] fov 270 samples 136 ) size [0.1 0.1 0.1] pose [0.05 0 -0.1 0] )
define sonars ranger
(
  sensor ( range [0.05 3.0] fov 20 pose [0.1 0.1 0 45] )
  sensor ( range [0.05 3.0] fov 20 pose [0.1 -0.1 0 -45] )
)
define base position ( size [0.3 0.24 0.2] localization "gps" )
define wall model ( size [0.1 4 0.5] )
wall ( pose [3 0 0 0] ) wall ( pose [-3 0 0 0] )
wall ( size [6 0.1 0.5] pose [0 2 0 0] ) wall ( size [6 0.1 0.5] pose [0 -2 0 0] )
model ( name "crate" size [0.4 1.2 0.5] pose [0 0.2 0 0] )
"""
CAN_TURN = {
    "global_costmap": {"inflation_layer": {"inflation_radius": 0.5}},
    "local_costmap": {"inflation_layer": {"inflation_radius": 0.5}},
    "DWAPlannerROS": {
        "max_vel_x": 0.7, "max_vel_trans": 0.7, "acc_lim_x": 2.0, "min_vel_theta": 0.3, "vth_samples": 20,
    },
}  # fmt: skip
SIDEWAYS = {
    "max_vel_y": 0.5, "min_vel_y": -0.5, "acc_lim_y": 2.0, "vy_samples": 7, "vx_samples": 7, "vth_samples": 7,
}  # fmt: skip


@pytest.fixture
def start(tmp_path):
    """Yield a function that makes a simulation of a room with robots."""
    made = []

    def make(robots, **options):
        path = tmp_path / "room.world"
        path.write_text(ROOM + robots)
        made.append(gazelle.Simulation(path, engine="planar", seed=0, threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()


def off(robot, x, y, world=0):
    return math.dist(robot.planar_pose()[world, :2], (x, y))


def run_until_done(sim, tasks, seconds=40.0):
    """Run, and see that no robot is ever stopped by what it met."""
    while not all(task.done for task in tasks) and sim.time < seconds:
        sim.step()
        assert not stage_of(sim).stalled.any()
    return [task.text for task in tasks]


def test_two_robots_go_around_what_stands_there_and_each_other(start):
    sim = start(
        'base ( name "a" pose [-1.5 0 0 0] laser() ) base ( name "b" pose [1.5 0 0 180] laser() )'
    )
    robots = [sim.robots[name] for name in "ab"]
    for robot in robots:
        robot.navigation.configure(CAN_TURN)
    tasks = [robots[0].navigation.go_to(1.5, 0.5, 0.0), robots[1].navigation.go_to(-1.5, -0.5)]
    assert run_until_done(sim, tasks) == ["Goal reached."] * 2
    assert off(robots[0], 1.5, 0.5) < 0.2
    assert off(robots[1], -1.5, -0.5) < 0.2
    assert abs(robots[0].pose.yaw) < 0.3
    assert not stage_of(sim).commands.any()


def test_the_map_is_that_of_the_world_without_robots(start):
    sim = start('base ( name "a" pose [-1.5 0 0 0] laser() ) base ( name "b" pose [2 0 0 0] )')
    grid = sim.robots["a"].navigation.map()
    taken = {
        place: bool(grid.data[tuple(cell_of(grid, *place))] == 100)
        for place in ((0.0, 0.2), (-3.0, 1.0), (0.0, -2.0), (2.0, 0.0), (-1.5, 0.0), (1.0, 1.0))
    }
    assert list(taken.values()) == [True, True, True, False, False, False]


def cell_of(grid, x, y):
    """Return row and column."""
    column = (x - grid.origin.x) / grid.resolution
    return int((y - grid.origin.y) / grid.resolution), int(column)


@pytest.mark.long
def test_what_its_map_lacks_is_seen_by_the_laser_in_each_world_not_by_sonars(start):
    sim = start(
        'base ( name "a" pose [-1.5 0 0 0] drive "omni" sonars() laser() )',
        nworld=2,
    )
    robot = sim.robots["a"]
    empty = OccupancyMap(np.zeros((120, 160), np.int8), 0.05, gazelle.Pose(-4.0, -3.0))
    values = {**CAN_TURN, "DWAPlannerROS": CAN_TURN["DWAPlannerROS"] | SIDEWAYS}
    robot.navigation.configure(values, grid=empty)
    tasks = [
        robot.navigation.go_to(1.0, side, 0.0, worlds=np.array([world]))
        for world, side in enumerate((0.6, -0.2))
    ]
    aside = np.zeros(2, np.bool_)
    while not all(task.done for task in tasks) and sim.time < 30.0:
        sim.step()
        assert not stage_of(sim).stalled.any()
        aside |= np.abs(stage_of(sim).commands[:, 0, 1]) > 0.1
    assert [task.text for task in tasks] == ["Goal reached."] * 2
    assert aside.all()
    assert all(off(robot, 1.0, side, world) < 0.2 for world, side in enumerate((0.6, -0.2)))
    sim.reset()
    assert robot.navigation.go_to(-1.0, 0.0).wait(20.0)


def test_odometry_that_errs_is_mended_by_the_laser(start):
    sim = start(
        'base ( name "a" pose [-1.5 0 0 0] localization "odom" odom_error [0.05 0.05 0 0.05] laser() )'
    )
    robot = sim.robots["a"]
    robot.navigation.configure(CAN_TURN, localization="amcl")
    assert run_until_done(sim, [robot.navigation.go_to(1.5, 0.5)]) == ["Goal reached."]
    assert off(robot, 1.5, 0.5) < 0.3


def test_what_cannot_be_navigated_says_why(start):
    sim = start(
        'base ( name "blind" pose [1.5 0 0 0] )\n'
        'base ( name "car" pose [-1.5 0 0 0] drive "car" laser() )'
    )
    with pytest.raises(SimulationError, match=r"'blind' has no laser[\s\S]*'ranger'"):
        sim.robots["blind"].navigation.go_to(0.0, 1.0)
    with pytest.raises(SimulationError, match="'car' has Ackermann steering"):
        sim.robots["car"].navigation.go_to(0.0, 1.0)
    with pytest.raises(SimulationError, match="'crate' has no drive"):
        sim.robots["crate"].navigation.go_to(0.0, 1.0)


def test_an_outline_has_the_corners_of_blocks_that_are_no_boxes(start):
    sim = start("""
        base (
          name "a" pose [-1.5 0 0 0] laser()
          block ( points 3 point[0] [0 0] point[1] [4 2] point[2] [0 4] z [0 1] )
        )""")
    found = outline_of(sim.robots["a"].description)
    assert found[:, 0].max() == pytest.approx(0.15)
    corners = {(round(x, 3), round(y, 3)) for x, y in found.tolist()}
    assert corners == {(-0.15, -0.12), (-0.15, 0.12), (0.15, 0.0)}
