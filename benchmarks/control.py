"""Controllers: what they add to a physics step, in one world and in many, and many robots at once.

The peer is the same scene in the same run, in which nothing can be controlled: arms without a
plugin and without velocity limits, in the pose that controllers hold, pushed by the efforts with
which they hold it. So its physics is the same (MuJoCo leaves out what is zero), and all that control
costs is seen. Both make steps in turns, in many short windows; a share is the median of pairs of them.
Goals are printed beside figures.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import cache
from statistics import median

import gazelle
from gazelle import formats
from gazelle.control import EFFORT, JOINT_STATE, Controller, ControllerParameters, register
from gazelle.control.values import BaseTwist, JointTargets, JointTrajectory, TrajectoryPoint
from gazelle.description import World
from gazelle.simulation.control_loop import ControlLoop

STEP = 0.001
WINDOWS = 60
JOINTS = tuple(f"joint_{number}" for number in range(1, 8))
TARGETS = (0.2, 0.3, -0.5, -0.2, 0.2, 0.1, -0.4)  # pushed by constant efforts it stays there
GROUP = "effort_controllers/JointGroupPositionController"
TRAJECTORY = "effort_controllers/JointTrajectoryController"
DIFF_DRIVE = "diff_drive_controller/DiffDriveController"
GAINS = {"p": 200.0, "i": 20.0, "d": 10.0, "i_clamp": 10.0}
GOALS = {1: 0.15, 256: 0.05}


class SpringDamper(Controller):
    """A user's own: a spring and a damper on every joint, in Python."""

    interfaces = (EFFORT,)

    def init(self, parameters: ControllerParameters) -> None:
        """Read ``joints``."""
        self._joints = self.claim(EFFORT, parameters.names("joints"))

    def update(self, time: float, period: float) -> None:  # noqa: ARG002  it needs neither
        """Pull every joint to its target."""
        joints = self._joints
        joints.set_command(200.0 * (TARGETS - joints.position) - 10.0 * joints.velocity)


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench control", description=__doc__)
    parser.add_argument("--seconds", type=float, default=3.0, help="a window (default 3)")
    args = parser.parse_args()
    register("bench/SpringDamper", SpringDamper)
    print(f"{os.cpu_count()} processors, {WINDOWS} pairs of windows of processor time, step 1 ms")
    print("7 joints, effort PID at 1 kHz     us/step without       with      share    goal")
    for nworld, goal in GOALS.items():
        one_arm(nworld, goal, args.seconds)
    own_class(args.seconds)
    many_arms(args.seconds)
    many_bases(args.seconds)


def arm_text(*, controlled: bool = True) -> str:
    """Return the URDF of a hanging arm of seven joints, commanded by efforts if at all."""
    fastest = 2.2 if controlled else 1e16
    parts = ['<robot name="arm"><link name="world"/>']
    parent = "world"
    for number, name in enumerate(JOINTS):
        mass = 3.0 - 0.35 * number
        parts.append(
            f'<link name="link_{number}"><inertial><origin xyz="0 0 -0.1"/><mass value="{mass}"/>'
            '<inertia ixx="0.06" iyy="0.06" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/>'
            f'<child link="link_{number}"/><origin xyz="0 0 {2.0 if number == 0 else -0.2}"/>'
            f'<axis xyz="0 1 0"/><limit lower="-2.9" upper="2.9" effort="87" velocity="{fastest}"/>'
            f'<dynamics damping="0.5"/></joint><transmission name="drive_{number}">'
            "<type>transmission_interface/SimpleTransmission</type>"
            f'<joint name="{name}"><hardwareInterface>hardware_interface/EffortJointInterface'
            f'</hardwareInterface></joint><actuator name="motor_{number}"/></transmission>'
        )
        parent = f"link_{number}"
    if controlled:
        parts.append('<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>')
    return "".join([*parts, "</robot>"])


def arms(
    nworld: int, count: int = 1, *, controlled: bool = True
) -> tuple[gazelle.Simulation, list[gazelle.Robot]]:
    """Return arms side by side at the targets, with nothing loaded."""
    sim = gazelle.Simulation(World("lab"), nworld=nworld, time_step=STEP, threads=1)
    model = formats.load_model_string(arm_text(controlled=controlled))
    side = 10
    places = [gazelle.Pose(x=2.0 * (i % side), y=2.0 * (i // side)) for i in range(count)]
    robots = [sim.spawn(model, name=f"arm_{i}", pose=at) for i, at in enumerate(places)]
    for robot in robots:
        for name, target in zip(JOINTS, TARGETS, strict=True):
            robot.joints[name].position = target
    return sim, robots


def driven(nworld: int, kind: str, **more: object) -> gazelle.Simulation:
    """Return an arm under a controller that holds it."""
    sim, (robot,) = arms(nworld)
    robot.controllers.load("arm", {"type": kind, "joints": list(JOINTS), **more})
    robot.controllers.start("arm")
    if kind == GROUP:
        robot.controllers["arm"].inputs["command"].send(JointTargets(TARGETS))
    return sim


def held() -> gazelle.Simulation:
    """Return an arm in one world under a PID for each joint."""
    return driven(1, GROUP, **{name: {"pid": GAINS} for name in JOINTS})


@cache
def holding() -> Mapping[str, float]:
    """Return the efforts with which a controller holds an arm at the targets, by joint [N m]."""
    sim = held()
    sim.run(20.0)
    loop = next(each.plugin for each in sim.plugins if isinstance(each.plugin, ControlLoop))
    states = loop.hardware.interface(JOINT_STATE)
    return dict(zip(states.resources, states.effort[0].tolist(), strict=True))


def bare(nworld: int, count: int = 1) -> gazelle.Simulation:
    """Return arms held by constant efforts, without controllers."""
    sim, robots = arms(nworld, count, controlled=False)
    for robot in robots:
        for name, effort in holding().items():
            robot.joints[name].effort = effort
    return sim


def stepping(sim: gazelle.Simulation, count: int = 200) -> Callable[[], int]:
    """Make steps; returns how many."""

    def work() -> int:
        sim.step(count)
        return count

    return work


def in_turns(work: list[Callable[[], int]], seconds: float) -> list[tuple[float, float]]:
    """Return processor times of a step without and with control [us]."""
    taken: list[list[float]] = [[] for _ in work]
    for each in work:
        each()
    for _ in range(WINDOWS):
        for each, times in zip(work, taken, strict=True):
            done, start = 0, time.process_time()
            while time.process_time() - start < seconds / WINDOWS:
                done += each()
            times.append((time.process_time() - start) / done * 1e6)
    pairs = zip(taken[::2], taken[1::2], strict=True)
    return [
        (median(free), median(b - a for a, b in zip(free, full, strict=True)))
        for free, full in pairs
    ]


def row(what: str, free: float, more: float, goal: float | None) -> None:
    """Print what a step takes without and with controllers."""
    said = "" if goal is None else f"{goal:8.0%}"
    print(f"{what:<34}{free:12.2f}{free + more:13.2f}{more / free:11.1%}{said}")


def one_arm(nworld: int, goal: float, seconds: float) -> None:
    """Measure a PID for each of seven joints."""
    nested = {name: {"pid": GAINS} for name in JOINTS}
    sims = [bare(nworld), driven(nworld, GROUP, **nested)]
    ((free, more),) = in_turns([stepping(sim) for sim in sims], seconds)
    row(f"  {nworld} world{'s' * (nworld > 1)}", free, more, goal)


def own_class(seconds: float) -> None:
    """Measure a user's own class in Python, called in every step."""
    for nworld in GOALS:
        sims = [bare(nworld), driven(nworld, "bench/SpringDamper")]
        ((free, more),) = in_turns([stepping(sim) for sim in sims], seconds)
        row(f"  a user's class, {nworld} world{'s' * (nworld > 1)}", free, more, None)


def many_arms(seconds: float) -> None:
    """Measure 100 arms that follow trajectories, in one process."""
    sim, robots = arms(1, 100)
    gains = dict.fromkeys(JOINTS, GAINS)
    points = [
        TrajectoryPoint(
            time=float(second),
            positions=tuple((-1) ** second * value for value in TARGETS),
            velocities=(0.0,) * len(JOINTS),
        )
        for second in range(1, 3000)
    ]
    for robot in robots:
        given = {"type": TRAJECTORY, "joints": list(JOINTS), "gains": gains}
        robot.controllers.load("arm", given)
        robot.controllers.start("arm")
        robot.controllers["arm"].inputs["command"].send(JointTrajectory(JOINTS, tuple(points)))
    peer = bare(1, 100)
    kinds = [(peer, 20), (sim, 20), (peer, 1), (sim, 1)]
    several, single = in_turns([stepping(each, n) for each, n in kinds], seconds)
    say("100 arms with a trajectory controller each", several, " (goal: above 1)")
    say("the same in calls of step() for one step each", single)


def say(what: str, found: tuple[float, float], goal: str = "") -> None:
    """Print how fast many robots are, and what of that is control."""
    free, more = found
    print(
        f"{what}: {1000.0 / (free + more):.2f} times real time{goal}, "
        f"{more:,.0f} us of {free + more:,.0f} us a step are control"
    )


def base_text(*, controlled: bool) -> str:
    """Return the URDF of a base on two wheels and a caster, whose wheels may be under control."""
    body = (
        '<inertial><origin xyz="-0.05 0 0.1"/><mass value="5"/>'
        '<inertia ixx="0.1" iyy="0.1" izz="0.15" ixy="0" ixz="0" iyz="0"/></inertial>'
        '<collision><origin xyz="-0.2 0 0.05"/><geometry><sphere radius="0.05"/></geometry></collision>'
    )
    parts = [f'<robot name="base"><link name="base">{body}</link>']
    for side, y in (("left", 0.2), ("right", -0.2)):
        parts.append(
            f'<link name="{side}"><inertial><mass value="0.5"/><inertia ixx="0.002" iyy="0.002" izz="0.003" '
            'ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry><cylinder radius="0.1" length="0.04"/>'
            f'</geometry></collision></link><joint name="{side}_wheel" type="continuous">'
            f'<parent link="base"/><child link="{side}"/><origin xyz="0 {y} 0.1" rpy="-1.5707963 0 0"/>'
            '<axis xyz="0 0 1"/><limit effort="20" velocity="50"/></joint>'
            f'<transmission name="drive_{side}"><type>transmission_interface/SimpleTransmission</type>'
            f'<joint name="{side}_wheel"><hardwareInterface>hardware_interface/VelocityJointInterface'
            f'</hardwareInterface></joint><actuator name="motor_{side}"/></transmission>'
        )
    parts.append('<gazebo reference="base"><mu1>0</mu1><mu2>0</mu2></gazebo>')
    if controlled:
        parts.append('<gazebo><plugin name="c" filename="libgazebo_ros_control.so"/></gazebo>')
    return "".join([*parts, "</robot>"])


def bases(count: int, *, controlled: bool) -> gazelle.Simulation:
    """Return bases that drive circles, by controllers or by motors alone."""
    model = formats.load_model_string(base_text(controlled=controlled))
    places = [gazelle.Pose(x=2.0 * (i % 10), y=2.0 * (i // 10)) for i in range(count)]
    many = [replace(model, name=f"base_{i}", pose=at) for i, at in enumerate(places)]
    world = formats.load("empty")
    sim = gazelle.Simulation(replace(world, models=(*world.models, *many)), threads=1)
    variances = {f"{name}_covariance_diagonal": [0.001] * 6 for name in ("pose", "twist")}
    given = {"left_wheel": "left_wheel", "right_wheel": "right_wheel", "cmd_vel_timeout": 1e6}
    for robot in (sim.robots[each.name] for each in many):
        if controlled:
            robot.controllers.load("base", {"type": DIFF_DRIVE, **given, **variances})
            robot.controllers.start("base")
            twist = BaseTwist((0.3, 0.0, 0.0), (0.0, 0.0, 0.5))
            robot.controllers["base"].inputs["cmd_vel"].send(twist)
        else:
            for side, speed in (("left", 2.0), ("right", 4.0)):
                robot.joints[f"{side}_wheel"].add_motor(20.0)
                robot.joints[f"{side}_wheel"].drive(speed)
    return sim


def many_bases(seconds: float) -> None:
    """Measure 100 bases that drive circles, in one process."""
    sims = [bases(100, controlled=controlled) for controlled in (False, True)]
    (found,) = in_turns([stepping(sim, 20) for sim in sims], seconds)
    say("100 bases with a diff_drive_controller each", found)


if __name__ == "__main__":
    main()
