"""Controllers: what they add to a physics step, in one world and in many, and many robots at once.

The peer is the same scene in the same run without controllers, stepped in turns with it: what a
controller costs is a share of the physics step. It is in the pose that controllers hold, without
gravity, as MuJoCo takes no sines of joints that are at zero. Goals are printed beside figures.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from dataclasses import replace

import gazelle
from gazelle import formats
from gazelle.control import EFFORT, Controller, ControllerParameters, register
from gazelle.control.values import BaseTwist, JointTargets, JointTrajectory, TrajectoryPoint
from gazelle.description import World

STEP = 0.001
WINDOWS = 15
JOINTS = tuple(f"joint_{number}" for number in range(1, 8))
TARGETS = (0.3, 0.4, -0.2, 0.3, 0.2, -0.3, 0.1)
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
    print(f"{os.cpu_count()} processors, best of {WINDOWS} windows of processor time, step 1 ms")
    print("7 joints, effort PID at 1 kHz     us/step without       with      share    goal")
    for nworld, goal in GOALS.items():
        one_arm(nworld, goal, args.seconds)
    own_class(args.seconds)
    many_arms(args.seconds)
    many_bases(args.seconds)


def arm_text() -> str:
    """The URDF of an arm of seven joints that hangs down, commanded by efforts."""
    parts = ['<robot name="arm"><link name="world"/>']
    parent = "world"
    for number, name in enumerate(JOINTS):
        mass, axis = 3.0 - 0.35 * number, "0 0 1" if number % 2 else "0 1 0"
        parts.append(
            f'<link name="link_{number}"><inertial><origin xyz="0 0 -0.1"/><mass value="{mass}"/>'
            '<inertia ixx="0.06" iyy="0.06" izz="0.04" ixy="0" ixz="0" iyz="0"/></inertial></link>'
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/>'
            f'<child link="link_{number}"/><origin xyz="0 0 {2.0 if number == 0 else -0.2}"/>'
            f'<axis xyz="{axis}"/><limit lower="-2.9" upper="2.9" effort="87" velocity="2.2"/>'
            f'<dynamics damping="0.5"/></joint><transmission name="drive_{number}">'
            "<type>transmission_interface/SimpleTransmission</type>"
            f'<joint name="{name}"><hardwareInterface>hardware_interface/EffortJointInterface'
            f'</hardwareInterface></joint><actuator name="motor_{number}"/></transmission>'
        )
        parent = f"link_{number}"
    plugin = '<gazebo><plugin name="control" filename="libgazebo_ros_control.so"/></gazebo>'
    return "".join([*parts, plugin, "</robot>"])


def arms(nworld: int, count: int = 1) -> tuple[gazelle.Simulation, list[gazelle.Robot]]:
    """Arms side by side at the targets, with nothing loaded."""
    world = World("lab", gravity=(0.0, 0.0, 0.0))
    sim = gazelle.Simulation(world, nworld=nworld, time_step=STEP, threads=1)
    model = formats.load_model_string(arm_text())
    side = 10
    places = [gazelle.Pose(x=2.0 * (i % side), y=2.0 * (i // side)) for i in range(count)]
    robots = [sim.spawn(model, name=f"arm_{i}", pose=at) for i, at in enumerate(places)]
    for robot in robots:
        for name, target in zip(JOINTS, TARGETS, strict=True):
            robot.joints[name].position = target
    return sim, robots


def driven(nworld: int, kind: str, **more: object) -> gazelle.Simulation:
    """An arm under a controller."""
    sim, (robot,) = arms(nworld)
    robot.controllers.load("arm", {"type": kind, "joints": list(JOINTS), **more})
    robot.controllers.start("arm")
    if kind == GROUP:
        robot.controllers["arm"].inputs["command"].send(JointTargets(TARGETS))
    return sim


def stepping(sim: gazelle.Simulation, count: int = 200) -> Callable[[], int]:
    """Make steps; returns how many."""

    def work() -> int:
        sim.step(count)
        return count

    return work


def least(work: list[Callable[[], int]], seconds: float) -> list[float]:
    """Processor time of a step of each [us], the least of windows in turns."""
    best = [float("inf")] * len(work)
    for each in work:
        each()
    for _ in range(WINDOWS):
        for index, each in enumerate(work):
            done, start = 0, time.process_time()
            while time.process_time() - start < seconds / WINDOWS:
                done += each()
            best[index] = min(best[index], (time.process_time() - start) / done * 1e6)
    return best


def row(what: str, bare: float, full: float, goal: float | None) -> None:
    """Print what a step takes without and with controllers."""
    share = (full - bare) / bare
    said = "" if goal is None else f"{goal:8.0%}"
    print(f"{what:<34}{bare:12.2f}{full:13.2f}{share:11.0%}{said}")


def one_arm(nworld: int, goal: float, seconds: float) -> None:
    """A PID for each of seven joints."""
    gains = {f"{name}/pid": GAINS for name in JOINTS}
    nested = {name: {"pid": gains[f"{name}/pid"]} for name in JOINTS}
    bare, full = least(
        [stepping(arms(nworld)[0]), stepping(driven(nworld, GROUP, **nested))], seconds
    )
    row(f"  {nworld} world{'s' * (nworld > 1)}", bare, full, goal)


def own_class(seconds: float) -> None:
    """A user's own class in Python: it is called in every step."""
    for nworld in GOALS:
        sims = [arms(nworld)[0], driven(nworld, "bench/SpringDamper")]
        bare, full = least([stepping(sim) for sim in sims], seconds)
        row(f"  a user's class, {nworld} world{'s' * (nworld > 1)}", bare, full, None)


def many_arms(seconds: float) -> None:
    """100 arms that follow trajectories, in one process."""
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
    bare = arms(1, 100)[0]
    kinds = [(bare, 20), (sim, 20), (bare, 1), (sim, 1)]
    free, full, one_free, one_full = least([stepping(each, n) for each, n in kinds], seconds)
    print(
        f"100 arms with a trajectory controller each: {1000.0 / full:.2f} times real time "
        f"(goal: above 1), {full - free:,.0f} us of {full:,.0f} us a step are control"
    )
    print(
        f"the same in calls of step() for one step each: {1000.0 / one_full:.2f} times real time, "
        f"{one_full - one_free:,.0f} us of {one_full:,.0f} us a step are control"
    )


def base_text(*, controlled: bool) -> str:
    """The URDF of a base on two wheels and a caster, whose wheels may be under control."""
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
    """Bases that drive circles, by controllers or by motors alone."""
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
    """100 bases that drive circles, in one process."""
    sims = [bases(100, controlled=controlled) for controlled in (False, True)]
    free, full = least([stepping(sim, 20) for sim in sims], seconds)
    print(
        f"100 bases with a diff_drive_controller each: {1000.0 / full:.2f} times real time, "
        f"{full - free:,.0f} us of {full:,.0f} us a step are control"
    )


if __name__ == "__main__":
    main()
