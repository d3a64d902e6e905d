"""Controllers in native code act within the physics' steps as they do from Python, bit by bit."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

import gazelle
from gazelle import formats
from gazelle.control import EFFORT, Controller, GoalState, register
from gazelle.control.values import JointTargets, JointTrajectory, TrajectoryGoal, TrajectoryPoint
from gazelle.description import World
from gazelle.engines.mujoco.step import WorldSteps
from gazelle.simulation.replay import Replay
from gazelle.simulation.values import EmergencyStop
from tests.control.arms import JOINTS, arm, arm_text

GAINS = {"p": 300.0, "i": 100.0, "d": 30.0, "i_clamp": 40.0}
LIMIT = '<limit lower="-3" upper="3" effort="60" velocity="4"/>'
SLOW = {LIMIT: LIMIT.replace('velocity="4"', 'velocity="0.3"')}
STOP = {
    "<robotNamespace>/arm</robotNamespace>": "<robotNamespace>/arm</robotNamespace>"
    "<eStopTopic>/e_stop</eStopTopic>"
}


WITH_IMU = {
    "</robot>": '<gazebo reference="lower"><sensor name="imu" type="imu"><always_on>true</always_on>'
    "</sensor></gazebo></robot>"
}


@pytest.fixture
def carried(monkeypatch):
    """Return the count of physics steps with controllers in them."""
    counts = []
    before = WorldSteps.make

    def count(made, steps, systems, now_ns):
        if systems:
            counts.append(steps)
        before(made, steps, systems, now_ns)

    monkeypatch.setattr(WorldSteps, "make", count)
    return counts


def controllers(robot, kind, law):
    low = kind.lower()
    if law == "group":
        robot.controllers.load(
            "arm", {"type": f"{low}_controllers/JointGroup{kind}Controller", "joints": JOINTS}
        )
    elif law == "pid":
        own = {name: {"pid": GAINS} for name in JOINTS}
        of = "effort_controllers/JointGroupPositionController"
        robot.controllers.load("arm", {"type": of, "joints": JOINTS, **own})
    else:
        given = {"type": f"{low}_controllers/JointTrajectoryController", "joints": JOINTS}
        given |= {"gains": dict.fromkeys(JOINTS, GAINS if kind == "Effort" else {"p": 20.0})}
        given |= {"constraints": {"goal_time": 0.2, "shoulder": {"trajectory": 0.3, "goal": 0.15}}}
        robot.controllers.load("arm", given)
    state = {"type": "joint_state_controller/JointStateController", "publish_rate": 50.0}
    robot.controllers.load("states", state)
    robot.controllers.start("arm", "states")


def command(robot, law, number, worlds=None):
    port = robot.controllers["arm"]
    if law != "trajectory":
        values = np.sin([number, 2.0 * number]) * (20.0 if law == "group" else 0.6)
        port.inputs["command"].send(JointTargets(tuple(values)), worlds)
        return None
    points = tuple(
        TrajectoryPoint(
            time=0.2 * k,
            positions=(0.3 * np.sin(number + k), -0.2 * k),
            velocities=(0.0, 0.0) if k > 1 else (0.1, 0.0),
            accelerations=(0.0, 0.0) if k > 2 else (),
        )
        for k in (1, 2, 3)
    )
    goal = TrajectoryGoal(JointTrajectory(tuple(JOINTS), points))
    return port.actions["follow_joint_trajectory"].send(goal, worlds)


def story(kind, law, *, native, nworld=3, replace=None, threads=2, listen=False, gains=None):
    """Run many events; return states of the worlds, and of the goals."""
    sim, robot = arm(kind, nworld=nworld, replace=replace, threads=threads)
    if not native:
        sim.controls_in_step = False
    if gains:
        robot.settings["pid_gains"].send(dict.fromkeys(JOINTS, gains))
    controllers(robot, kind, law)
    heard = []
    if listen:
        robot.controllers["states"].outputs["joint_states"].subscribe(
            lambda each: heard.append((each.stamp, each.position.copy(), each.effort.copy()))
        )
    sim.step(3)
    goals = [command(robot, law, 0.7)]
    sim.step(333)
    some = np.arange(nworld) % 2 == 0
    goals.append(command(robot, law, 1.9, np.flatnonzero(some)))
    sim.step(401)
    if "emergency_stop" in robot.inputs:
        robot.inputs["emergency_stop"].send(EmergencyStop(True))
        sim.step(50)
        robot.inputs["emergency_stop"].send(EmergencyStop(False))
        sim.step(77)
    robot.controllers.stop("arm")
    sim.step(20)
    robot.controllers.start("arm")
    goals.append(command(robot, law, 4.0))
    sim.step(150)
    sim.reset(np.array([0]))
    sim.step(211)
    states = robot.controllers.hardware.state()
    ends = [[] if goal is None else goal.states.tolist() for goal in goals]
    robot.controllers["states"].outputs["joint_states"]
    return sim.engine.snapshot(), states, ends, heard


CASES = [
    ("Effort", "group", {}),
    ("Effort", "pid", {}),
    ("Effort", "pid", {"replace": SLOW}),
    ("Effort", "pid", {"replace": STOP}),
    ("Effort", "trajectory", {}),
    ("Effort", "trajectory", {"replace": STOP}),
    ("Velocity", "group", {}),
    ("Velocity", "trajectory", {"replace": STOP}),
    ("Velocity", "group", {"gains": {"p": 60.0, "i": 5.0, "i_clamp": 9.0}}),
    ("Position", "group", {"gains": GAINS}),
    ("Position", "trajectory", {"gains": GAINS}),
]


@pytest.mark.parametrize(("kind", "law", "options"), CASES)
def test_the_same_bits_as_from_python(carried, kind, law, options):
    one = story(kind, law, native=True, **options)
    assert max(carried) > 1
    assert sum(carried) > 1000
    other = story(kind, law, native=False, **options)
    assert sum(carried) < 2000
    assert np.array_equal(one[0], other[0])
    assert all(np.array_equal(one[1][name], other[1][name], equal_nan=True) for name in other[1])
    assert one[2] == other[2]


@pytest.mark.parametrize(("kind", "law", "options"), CASES[:7])
def test_the_same_bits_at_any_number_of_worlds_and_threads(kind, law, options):
    few = story(kind, law, native=True, nworld=2, threads=1, **options)
    many = story(kind, law, native=True, nworld=9, threads=3, **options)
    assert np.array_equal(few[0], many[0][:2])


@pytest.mark.long
@pytest.mark.parametrize("law", ["pid", "trajectory"])
def test_who_listens_changes_nothing(law):
    quiet, heard = (story("Effort", law, native=True, listen=each) for each in (False, True))
    told = story("Effort", law, native=False, listen=True)
    assert np.array_equal(quiet[0], heard[0])
    assert [each[0] for each in heard[3]] == [each[0] for each in told[3]]
    assert len(heard[3]) > 40
    for one, other in zip(heard[3], told[3], strict=True):
        assert np.array_equal(one[1], other[1])
        assert np.array_equal(one[2], other[2])


def test_a_listener_that_comes_late_is_not_told_what_it_missed(carried):
    sim, robot = arm("Effort")
    controllers(robot, "Effort", "pid")
    sim.run(1.0)
    assert sum(carried) > 900
    stamps = []
    robot.controllers["states"].outputs["joint_states"].subscribe(lambda s: stamps.append(s.stamp))
    sim.run(0.1)
    assert 4 <= len(stamps) <= 6
    assert np.diff(stamps).min() >= 19_000_000


@pytest.mark.long
@pytest.mark.parametrize(("kind", "gains"), [("effort", None), ("position", GAINS)])
def test_grippers_and_sensors_need_no_python_unless_somebody_asks(carried, kind, gains):
    from gazelle.control.values import GripperGoal

    ends, told = [], []
    for native in (True, False):
        sim, robot = arm(kind.title(), nworld=2, replace=WITH_IMU)
        sim.controls_in_step = native
        if gains:
            robot.settings["pid_gains"].send(dict.fromkeys(JOINTS, gains))
        given = {"joint": "elbow", "max_effort": 30.0, "gains": {"elbow": GAINS}}
        robot.controllers.load(
            "hand", {"type": f"{kind}_controllers/GripperActionController", **given}
        )
        imu = {"type": "imu_sensor_controller/ImuSensorController", "publish_rate": 50.0}
        robot.controllers.load("imus", imu)
        robot.controllers.start("hand", "imus")
        before = sum(carried)
        sim.step(300)
        assert (sum(carried) - before > 290) == native
        goal = robot.controllers["hand"].actions["gripper_cmd"].send(GripperGoal(0.3, 40.0))
        sim.step(1500)
        assert goal.states.tolist() == [GoalState.SUCCEEDED] * 2
        stamps = []
        robot.controllers["imus"].outputs["imu"].subscribe(lambda s, to=stamps: to.append(s.stamp))
        before = sum(carried)
        sim.step(200)
        assert (sum(carried) - before > 150) == native
        ends.append((sim.engine.snapshot(), robot.controllers.hardware.state()["effort"]))
        told.append(stamps)
    assert all(np.array_equal(*pair) for pair in zip(*ends, strict=True))
    assert told[0] == told[1]
    assert 9 <= len(told[0]) <= 11


def test_a_goal_ends_in_each_world_by_itself_within_steps(carried):
    sim, robot = arm("Effort", nworld=3)
    controllers(robot, "Effort", "trajectory")
    goal = command(robot, "trajectory", 0.3)
    sim.run(0.1)
    robot.controllers["arm"].inputs["command"].send(JointTrajectory(()), np.array([1]))
    sim.run(2.0)
    assert goal.done
    assert goal.states.tolist() == [GoalState.SUCCEEDED, GoalState.PREEMPTED, GoalState.SUCCEEDED]
    assert sum(carried) > 2000


class Weak(Controller):
    """A user's own beside ours: holds one joint weakly, and counts."""

    interfaces = (EFFORT,)
    updates = 0

    def init(self, parameters):
        self._joint = self.claim(EFFORT, [parameters.text("joint")])

    def update(self, time, period):
        Weak.updates += 1
        self._joint.set_command(-20.0 * self._joint.position - 3.0 * self._joint.velocity)


@pytest.mark.parametrize("native", [True, False])
def test_a_controller_in_python_is_updated_in_every_step_beside_ours(native):
    register("test_within_steps/Weak", Weak)
    Weak.updates = 0
    sim, robot = arm("Effort")
    if not native:
        sim.controls_in_step = False
    robot.controllers.load("weak", {"type": "test_within_steps/Weak", "joint": "elbow"})
    of = "effort_controllers/JointPositionController"
    robot.controllers.load("ours", {"type": of, "joint": "shoulder", "pid": GAINS})
    robot.controllers.start("weak", "ours")
    sim.step(250)
    assert Weak.updates == 250
    robot.controllers.stop("weak")
    sim.step(50)
    assert Weak.updates == 250


def test_a_subclass_with_an_update_of_its_own_is_heard(carried):
    from gazelle.control.joint_pid import JointGroupPositionController

    class Counting(JointGroupPositionController):
        calls = 0

        def update(self, time, period):
            Counting.calls += 1
            super().update(time, period)

    class Named(JointGroupPositionController):
        pass

    for kind in (Counting, Named):
        kind.interfaces = (EFFORT,)
        register(f"test_within_steps/{kind.__name__}", kind)
        sim, robot = arm("Effort")
        own = {name: {"pid": GAINS} for name in JOINTS}
        given = {"type": f"test_within_steps/{kind.__name__}", "joints": JOINTS, **own}
        robot.controllers.load("arm", given)
        robot.controllers.start("arm")
        sim.step(60)
    assert Counting.calls == 60
    assert sum(carried) == 60


def test_forces_of_other_hands_add_up_as_they_do_without_controllers(carried):
    ends = []
    for native in (True, False):
        sim, robot = arm("Effort")
        sim.controls_in_step = native
        controllers(robot, "Effort", "pid")
        sim.run(0.2)
        robot.joints["elbow"].apply_effort(5.0, start=0.3, duration=0.2)
        sim.run(0.6)
        ends.append(sim.engine.snapshot())
    assert np.array_equal(*ends)
    assert sum(carried) > 0


def test_several_robots_each_with_its_own(carried):
    sims = []
    for native in (True, False):
        sim = gazelle.Simulation(World("w"), nworld=2)
        sim.controls_in_step = native
        for number, law in enumerate(("pid", "trajectory", "group")):
            text = arm_text("Effort").replace("two_link_arm", f"arm_{number}")
            robot = sim.spawn(
                formats.load_model_string(text),
                name=f"arm_{number}",
                pose=gazelle.Pose(x=3.0 * number),
            )
            controllers(robot, "Effort", law)
            command(robot, law, 0.5)
        sim.step(200)
        sim.delete("arm_1")
        sim.step(200)
        sims.append(sim.engine.snapshot())
    assert np.array_equal(*sims)
    assert sum(carried) > 390  # the first message is published from Python


def test_a_recording_replays(tmp_path):
    sim, robot = arm("Effort", nworld=2)
    controllers(robot, "Effort", "pid")
    sim.step(40)
    with sim.record(tmp_path / "run.log"):
        command(robot, "pid", 1.0)
        sim.step(40)
    with Replay(tmp_path / "run.log") as again:
        assert again.run() > 0
        assert np.array_equal(again.simulation.engine.snapshot(), sim.engine.snapshot())


@pytest.mark.slow
def test_python_runs_the_sources_of_native_code():
    code = (
        "from tests.control.test_within_steps import *\n"
        "import gazelle.native\n"
        "assert gazelle.native.BUILD == 'python'\n"
        "sim, robot = arm('Effort')\n"
        "controllers(robot, 'Effort', 'trajectory')\n"
        "command(robot, 'trajectory', 0.3)\n"
        "sim.step(40)\n"
        "print(sim.engine.snapshot().tobytes().hex())\n"
    )
    ends = [
        subprocess.run(
            [sys.executable, "-c", code.replace("'python'", f"'{build}'") if build else code],
            env={**os.environ, "GAZELLE_NATIVE": build},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for build in ("python", "baseline")
    ]
    assert ends[0] == ends[1]
