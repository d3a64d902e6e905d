"""The courier goes where it is told, in its office, and touches nothing but the floor."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import gazelle
from gazelle.builders import cabinet
from gazelle.description import Pose
from gazelle.errors import PluginWarning, SimulationError, SimulationWarning
from gazelle.navigation import GoalPose, GoToGoal
from gazelle.navigation.grid import dilate

GOALS = [(0.7, -1.3), (1.5, 0.3), (-0.6, -2.2)]
FLOORS = ("ground", "floor", "rug")


class Courier:
    """A courier in a world, and what it touches."""

    def __init__(self, sim):
        self.sim = sim
        self.robot = sim.spawn("courier", namespace="/")
        self.seeker = next(e.plugin for e in sim.plugins if isinstance(e.plugin, GoToGoal))
        self.own = [
            f"{link.name}::{shape.name}"
            for link in self.robot.links.values()
            for shape in link.description.collisions
        ]
        self.touched = set()

    def go(self, x, y, *, within, yaw=None):
        """Send it and wait; whether it came [simulated s]."""
        self.robot.inputs["goal"].send(GoalPose(x, y, yaw))
        end = self.sim.time + within
        while not self.seeker.arrived.all() and self.sim.time < end:
            self.sim.run(seconds=0.05)
            others = self.sim.engine.contacts([self.own]).named().others
            self.touched |= {name for name in others if not name.startswith(FLOORS)}
        return bool(self.seeker.arrived.all())

    def off(self, x, y):
        return float(np.hypot(self.robot.pose.x - x, self.robot.pose.y - y))


@pytest.fixture
def courier():
    with gazelle.Simulation("office", seed=2) as sim:
        yield Courier(sim)


@pytest.mark.long
def test_goals_are_reached_without_a_touch(courier):
    ways = []
    courier.robot.outputs["path"].subscribe(ways.append)
    for x, y in GOALS:
        assert courier.go(x, y, within=15.0)
        assert courier.off(x, y) < 0.12
    assert courier.touched == set()
    longest = max((way.poses[0] for way in ways), key=len)
    assert longest.shape[1] == 3
    assert ways[0].frame == "odom"
    assert np.hypot(*np.diff(longest[:, :2], axis=0).T).max() < 0.15
    assert not len(ways[-1].poses[0])


@pytest.mark.long
def test_what_turns_up_in_its_way_is_driven_around():
    with gazelle.Simulation("empty") as sim:
        courier = Courier(sim)
        courier.robot.inputs["goal"].send(GoalPose(3.2, 0.0))
        sim.run(seconds=1.0)
        sim.spawn(replace(cabinet("cabinet"), pose=Pose(1.8, 0.1)))
        assert courier.go(3.2, 0.0, within=20.0)
        assert courier.off(3.2, 0.0) < 0.12
        assert courier.touched == set()


def reachable(courier, count, seed):
    """Return random reachable places: short rays at some heights find obstacles."""
    cell = 0.025
    x, y = np.arange(-7.1, 7.1, cell), np.arange(-5.1, 5.1, cell)
    at = np.stack(np.meshgrid(x, y, indexing="ij"), axis=-1)
    taken = np.zeros(at.shape[:2], np.bool_)
    for height in (0.02, 0.085, 0.25):
        starts = np.concatenate((at, np.full((*taken.shape, 1), height)), axis=-1).reshape(-1, 3)
        along = np.tile((1.0, 0.0, 0.0), (len(starts), 1))
        hits = courier.sim.engine.links["courier::base_footprint"].cast_rays(starts, along)
        taken |= (hits.from_inside[0] | (hits.distance[0] < cell)).reshape(taken.shape)
    taken &= np.hypot(at[..., 0], at[..., 1]) > 0.3  # its own wheels
    open_to = flooded(~dilate(taken, 0.33 / cell), np.hypot(*np.moveaxis(at, -1, 0)).argmin())
    places = at[open_to & ~dilate(taken, 0.4 / cell)]
    return places[np.random.default_rng(seed).choice(len(places), count, replace=False)]


def flooded(mask, start):
    """Return the connected part of a mask around a cell."""
    from scipy import ndimage

    parts, _ = ndimage.label(mask)
    return parts == parts.ravel()[start]


@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2])
def test_random_goals_are_reached_without_a_touch(courier, seed):
    for x, y in reachable(courier, 10, seed):
        assert courier.go(x, y, within=60.0), (x, y)
        assert courier.off(x, y) < 0.12
        assert courier.touched == set(), (x, y)


def test_without_a_goal_it_does_nothing(courier):
    courier.robot.inputs["cmd_vel"].send(0.3, 0.0)
    courier.sim.run(seconds=0.5)
    assert courier.robot.twist.linear[0] == pytest.approx(0.3, abs=0.02)
    assert not courier.robot.sensors["laser"].awake


def test_a_goal_in_an_unknown_frame_is_left_out(courier):
    with pytest.warns(SimulationWarning, match=r"frame 'moon'.*'odom' or 'map'"):
        courier.robot.inputs["goal"].send(GoalPose(1.0, 0.0, frame="moon"))
    assert not courier.seeker.active
    courier.robot.inputs["goal"].send(GoalPose(1.0, 0.0, frame="/map"))
    assert courier.seeker.active


def test_a_goal_is_finite(courier):
    with pytest.raises(SimulationError, match="not finite"):
        courier.robot.inputs["goal"].send(GoalPose(float("nan"), 0.0))


def test_a_reset_forgets_the_goal(courier):
    courier.robot.inputs["goal"].send(GoalPose(2.0, 0.0))
    courier.sim.run(seconds=1.0)
    courier.sim.reset()
    assert not courier.seeker.active
    assert not len(courier.robot.outputs["path"].last.poses[0])
    courier.sim.run(seconds=0.5)
    assert courier.robot.pose.x == pytest.approx(0.0, abs=1e-3)


@pytest.mark.long
def test_a_snapshot_goes_on_to_the_bit(courier):
    sim = courier.sim
    courier.robot.inputs["goal"].send(GoalPose(0.7, -1.3))
    sim.run(seconds=1.5)
    taken = sim.snapshot()
    ends = []
    for _ in range(2):
        sim.run(seconds=1.5)
        ends.append(courier.robot.pose)
        sim.restore(taken)
    assert ends[0] == ends[1]


@pytest.mark.long
def test_worlds_of_a_batch_have_goals_of_their_own():
    with gazelle.Simulation("empty", nworld=3) as sim:
        courier = Courier(sim)
        goal = courier.robot.inputs["goal"]
        goal.send(GoalPose(0.6, 0.0), np.array([0]))
        goal.send(GoalPose(0.0, 0.6), np.array([2]))
        sim.run(seconds=6.0)
        assert courier.seeker.arrived.tolist() == [True, False, True]
        wanted = [(0.6, 0.0), (0.0, 0.0), (0.0, 0.6)]
        np.testing.assert_allclose(courier.robot.position[:, :2], wanted, atol=0.12)


def test_a_robot_without_a_laser_is_told():
    blind = gazelle.load("courier").models[0]
    with gazelle.Simulation("empty") as sim, pytest.warns(PluginWarning, match="no laser"):
        robot = sim.spawn(without_sensors(blind))
    assert "goal" not in robot.inputs


def test_a_robot_without_a_drive_is_told():
    model = gazelle.load("courier").models[0]
    kept = tuple(plugin for plugin in model.plugins if "drive" not in plugin.name)
    with gazelle.Simulation("empty") as sim:
        robot = sim.spawn(replace(model, plugins=kept))
        with pytest.raises(SimulationError, match="no drive"):
            robot.inputs["goal"].send(GoalPose(1.0, 0.0))


def without_sensors(model):
    return replace(model, links=tuple(replace(link, sensors=()) for link in model.links))
