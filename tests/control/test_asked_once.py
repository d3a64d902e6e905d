"""Robots whose controllers are native code are asked when something changes, and always tell the truth."""

from __future__ import annotations

import threading

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control import GoalState
from gazelle.control.values import JointTargets, JointTrajectory, TrajectoryGoal, TrajectoryPoint
from gazelle.description import World
from gazelle.simulation import WorldPlugin
from gazelle.simulation.control_loop import ControlLoop
from gazelle.simulation.scheduled_plugin import make_scheduled
from tests.control.arms import JOINTS, arm, arm_text

GAINS = {"p": 300.0, "i": 100.0, "d": 30.0, "i_clamp": 40.0}
PID = {
    "type": "effort_controllers/JointGroupPositionController",
    "joints": JOINTS,
    **{name: {"pid": GAINS} for name in JOINTS},
}
TRAJECTORY = {
    "type": "effort_controllers/JointTrajectoryController",
    "joints": JOINTS,
    "gains": dict.fromkeys(JOINTS, GAINS),
    "constraints": {"goal_time": 0.5},
}


@pytest.fixture
def asked(monkeypatch):
    """Return the count of questions to robots, who runs them in steps."""
    counts = []
    before = ControlLoop.in_step

    def count(loop):
        counts.append(loop)
        return before(loop)

    monkeypatch.setattr(ControlLoop, "in_step", count)
    return counts


def arms(count, given):
    sim = gazelle.Simulation(World("w"))
    model = formats.load_model_string(arm_text("Effort"))
    places = [gazelle.Pose(x=3.0 * number) for number in range(count)]
    robots = [sim.spawn(model, name=f"arm_{n}", pose=at) for n, at in enumerate(places)]
    for robot in robots:
        robot.controllers.load("arm", given)
        robot.controllers.start("arm")
    sim.step(3)
    return sim, robots


def test_robots_to_which_nothing_is_done_are_not_asked(asked):
    sim, robots = arms(4, PID)
    asked.clear()
    for _ in range(50):
        sim.step()
    sim.step(100)
    assert not asked
    robots[2].controllers["arm"].inputs["command"].send(JointTargets((0.3, 0.1)))
    sim.step(50)
    assert len(asked) == 1
    robots[1].controllers.stop("arm")
    sim.step()
    assert len(asked) == 2


def test_robots_in_which_nothing_runs_are_not_asked_until_something_is_done_to_them(asked):
    sim, robots = arms(3, PID)
    for robot in robots:
        robot.controllers.stop("arm")
    for loop in {id(each): each for each in asked}.values():
        loop.reset(None)  # else the efforts of the stopped controllers act on
    sim.step()
    asked.clear()
    for _ in range(20):
        sim.step()
    sim.step(100)
    assert not asked
    before = robots[1].joints["shoulder"].positions().copy()
    robots[1].controllers.start("arm")
    robots[1].controllers["arm"].inputs["command"].send(JointTargets((0.5, 0.1)))
    sim.step(200)
    assert len(asked) <= 2
    assert np.abs(robots[1].joints["shoulder"].positions() - before).max() > 0.1


def test_efforts_that_a_stopped_controller_left_act_on_within_limits(asked):
    sim, (robot,) = arms(1, PID)
    robot.controllers["arm"].inputs["command"].send(JointTargets((1.5, 0.0)))
    sim.step(5)
    robot.controllers.stop("arm")
    asked.clear()
    for _ in range(5):
        sim.step()
    assert len(asked) == 5


def test_the_time_of_the_last_update_is_known_at_once_and_asks_nobody(asked):
    sim, (robot,) = arms(1, PID)
    asked.clear()
    for _ in range(20):
        sim.step()
        last = sim.clock.now_ns - sim.clock.step_ns
        assert robot.controllers.now_ns == last
        assert robot.controllers["arm"].now_ns == last
    assert not asked


def test_another_thread_sees_the_time_between_two_steps():
    sim, (robot,) = arms(1, PID)
    controller, seen = robot.controllers["arm"], []
    stop = threading.Event()

    def look():
        while not stop.is_set():
            seen.append(controller.now_ns)

    thread = threading.Thread(target=look)
    thread.start()
    try:
        sim.step(2000)
    finally:
        stop.set()
        thread.join(60.0)
    assert controller.now_ns == sim.clock.now_ns - sim.clock.step_ns
    assert seen == sorted(seen)


def test_a_goal_that_nobody_watches_has_ended_when_one_looks(asked):
    sim, (robot,) = arms(1, TRAJECTORY)
    points = (TrajectoryPoint(time=0.2, positions=(0.1, 0.1), velocities=(0.0, 0.0)),)
    goal = TrajectoryGoal(JointTrajectory(tuple(JOINTS), points))
    given = robot.controllers["arm"].actions["follow_joint_trajectory"].send(goal)
    for _ in range(1000):
        sim.step()
        if given.done:
            break
    assert given.state == GoalState.SUCCEEDED
    asked.clear()
    sim.step()
    sim.step(50)
    assert len(asked) == 1


class _Late(WorldPlugin):
    """Does something between two steps, once."""

    update_rate = 10.0
    due_ns = 300_000_000

    def load(self, simulation, parameters):
        self._simulation, self.work = simulation, lambda: None

    def on_update(self, time):
        if self._simulation.clock.now_ns == self.due_ns:
            self.work()


@pytest.mark.parametrize("what", ["stop", "send", "press", "period", "reset", "restore"])
def test_what_a_plugin_does_to_a_robot_holds_from_the_same_step_on(what):
    ends = []
    for native in (True, False):
        sim, robot = arm("Effort", nworld=2)
        sim.controls_in_step = native
        robot.controllers.load("arm", PID)
        robot.controllers.start("arm")
        entry = next(each for each in sim.plugins if isinstance(each.plugin, ControlLoop))
        loop, late = entry.plugin, _Late()
        late.load(sim, None)
        sim.plugins.append(make_scheduled(late, "late", ""))
        sim.step(100)
        kept = loop.state()
        late.work = {
            "stop": lambda robot=robot: robot.controllers.stop("arm"),
            "send": lambda robot=robot: (
                robot.controllers["arm"].inputs["command"].send(JointTargets((0.5, -0.4)))
            ),
            "press": lambda loop=loop: loop.press(np.array([1]), on=True),
            "period": lambda loop=loop: loop.set_period(0.004),
            "reset": lambda loop=loop: loop.reset(np.array([1])),
            "restore": lambda loop=loop, kept=kept: loop.restore(kept),
        }[what]
        sim.step(450)
        times = [loop.state()["times"], robot.controllers.now_ns]
        ends.append((sim.engine.snapshot(), *times))
    assert np.array_equal(ends[0][0], ends[1][0])
    assert np.array_equal(ends[0][1], ends[1][1])
    assert ends[0][2] == ends[1][2]


def test_a_snapshot_in_the_middle_is_that_of_a_run_from_python():
    states = []
    for native in (True, False):
        sim, robot = arm("Effort", nworld=2)
        sim.controls_in_step = native
        robot.controllers.load("arm", PID)
        kind = "joint_state_controller/JointStateController"
        robot.controllers.load("states", {"type": kind, "publish_rate": 30.0})
        robot.controllers.start("arm", "states")
        for _ in range(77):
            sim.step()
        loop = next(each.plugin for each in sim.plugins if isinstance(each.plugin, ControlLoop))
        states.append(loop.state())
    assert states[0].keys() == states[1].keys()
    for name, value in states[0].items():
        assert np.array_equal(value, states[1][name], equal_nan=value.dtype.kind == "f"), name


def test_a_step_of_another_length_is_known_to_robots_that_are_not_asked():
    ends = []
    for native in (True, False):
        sim, (robot,) = arms(1, PID)
        sim.controls_in_step = native
        robot.controllers["arm"].inputs["command"].send(JointTargets((0.3, 0.1)))
        sim.step(20)
        sim.physics.time_step = 0.0007
        sim.step(20)
        ends.append((sim.engine.snapshot(), robot.controllers.now_ns))
    assert np.array_equal(ends[0][0], ends[1][0])
    assert ends[0][1] == ends[1][1]
