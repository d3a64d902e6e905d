"""Many robots: what their sensors and drives cost together, and each by itself.

100 robots lie on a ground in three dimensions, each with one sensor of a kind that measures at its
rate, or with a plugin whose topic somebody listens to; or they hang in the air and a drive turns
their wheels. The last case is a batch of worlds with one robot each. The peer is the same world in the
same run, stepped in turns with it, in which Python updates every sensor and plugin by itself; both are
printed without what the physics takes alone.
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

import gazelle
from gazelle import formats
from gazelle.description import Parameters
from gazelle.simulation import JointArray, ModelPlugin, PluginSystem, TwistInput, register

ROBOTS = 100
WINDOWS = 5
BATCH = 256
FEW = 10
STEP = 0.005
ROBOT = """<model name='r{0}'><pose>{1} {2} .1 0 0 {0}</pose><link name='base'><inertial><mass>2</mass>
<inertia><ixx>.02</ixx><iyy>.03</iyy><izz>.04</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial>
<collision name='b'><geometry><box><size>.3 .2 .2</size></box></geometry></collision>{3}</link>{4}</model>"""
GROUND = """<model name='ground'><static>1</static><link name='l'><collision name='c'><geometry><plane>
<normal>0 0 1</normal></plane></geometry></collision></link></model>"""
LIDAR = """<sensor name='s' type='ray'><update_rate>10</update_rate><pose>0 0 .2 0 0 0</pose><ray><scan>
<horizontal><samples>{0}</samples><min_angle>-3</min_angle><max_angle>3</max_angle></horizontal></scan>
<range><min>.05</min><max>4</max></range><noise><type>gaussian</type><stddev>.01</stddev></noise></ray>
</sensor>"""
IMU = """<sensor name='s' type='imu'><update_rate>50</update_rate><imu><angular_velocity><x><noise
type='gaussian'><stddev>.01</stddev></noise></x></angular_velocity></imu></sensor>"""
CONTACT = "<sensor name='s' type='contact'><update_rate>10</update_rate></sensor>"
P3D = """<plugin name='p' filename='libgazebo_ros_p3d.so'><bodyName>base</bodyName><topicName>true</topicName>
<updateRate>50</updateRate></plugin>"""
IMU_PLUGIN = """<plugin name='p' filename='libgazebo_ros_imu.so'><bodyName>base</bodyName><updateRate>50</updateRate>
</plugin>"""
SENSORS = {
    "contact, 10 Hz": CONTACT,
    "IMU, 50 Hz": IMU,
    "lidar, 24 rays, 10 Hz": LIDAR.format(24),
    "lidar, 360 rays, 10 Hz": LIDAR.format(360),
}


WHEEL = """<link name='{0}'><pose>0 {1} 0 -1.5708 0 0</pose><inertial><mass>.3</mass><inertia><ixx>.0004</ixx>
<iyy>.0004</iyy><izz>.0004</izz><ixy>0</ixy><ixz>0</ixz><iyz>0</iyz></inertia></inertial></link><joint
name='{0}_joint' type='continuous'><parent>base</parent><child>{0}</child><axis><xyz>0 0 1</xyz></axis></joint>"""
SLIDE = "<plugin name='p' filename='libgazebo_ros_planar_move.so'/>"
CORNERS = [f"{side}_{end}" for end in ("front", "rear") for side in ("left", "right")]
TAGS = "".join(
    f"<{side}{end}Joint>{side}_{end.lower()}_joint</{side}{end}Joint>"
    for end in ("Front", "Rear")
    for side in ("left", "right")
)
DIFF = """<plugin name='p' filename='libgazebo_ros_diff_drive.so'><leftJoint>left_front_joint</leftJoint>
<rightJoint>right_front_joint</rightJoint><updateRate>50</updateRate></plugin>"""
ENCODERS = DIFF.replace("<updateRate>", "<odometrySource>encoder</odometrySource><updateRate>")
PATIENT = (
    "<plugin name='p' filename='libgazebo_ros_planar_move.so'><cmdTimeout>1</cmdTimeout></plugin>"
)
TRICYCLE = """<plugin name='p' filename='libgazebo_ros_tricycle_drive.so'><updateRate>50</updateRate>
<encoderWheelLeftJoint>left_front_joint</encoderWheelLeftJoint><steeringJoint>left_rear_joint</steeringJoint>
<encoderWheelRightJoint>right_front_joint</encoderWheelRightJoint>
<actuatedWheelJoint>right_rear_joint</actuatedWheelJoint></plugin>"""
KOBUKI = """<plugin name='p' filename='libgazebo_ros_kobuki.so'><imu_name>imu</imu_name>
<left_wheel_joint_name>left_front_joint</left_wheel_joint_name><wheel_separation>.24</wheel_separation>
<right_wheel_joint_name>right_front_joint</right_wheel_joint_name><wheel_diameter>.1</wheel_diameter>
<torque>5</torque><velocity_command_timeout>1</velocity_command_timeout><bumper_name>bumper</bumper_name>
<cliff_sensor_left_name>cliff</cliff_sensor_left_name><cliff_sensor_center_name>cliff</cliff_sensor_center_name>
<cliff_sensor_right_name>cliff</cliff_sensor_right_name>
<cliff_detection_threshold>.2</cliff_detection_threshold></plugin>"""
KOBUKI_SENSORS = """<sensor name='imu' type='imu'/><sensor name='bumper' type='contact'><contact><collision>b</collision>
</contact></sensor><sensor name='cliff' type='ray'><ray><scan><horizontal><samples>1</samples></horizontal>
</scan><range><min>.01</min><max>1</max></range></ray></sensor>"""
SKID = f"""<plugin name='p' filename='libgazebo_ros_skid_steer_drive.so'>{TAGS}<updateRate>50</updateRate>
</plugin>"""


USERS = "<plugin name='p' filename='libbench_rollers.so'/>"


class Rollers(PluginSystem["Roller"]):
    """A drive as a user writes it, in NumPy: one for all robots."""

    def __init__(self, plugins: Sequence[Roller]) -> None:
        super().__init__(plugins)
        linear, angular = np.zeros((2, len(plugins[0].command.linear), len(plugins), 3))
        for row, each in enumerate(plugins):
            each.command.store_in(linear[:, row], angular[:, row])
        self._linear, self._angular = linear, angular
        self._wheels = JointArray([wheel for each in plugins for wheel in each.wheels])

    def update(self, time: float) -> None:  # noqa: ARG002  commands hold for ever
        """Turn the wheels as fast as the commands say."""
        turning = self._angular[..., 2:] * (-0.12, 0.12)
        speeds = (self._linear[..., :1] + turning) / 0.075
        self._wheels.drive(speeds.reshape(len(speeds), -1))


class Roller(ModelPlugin):
    """A robot with the drive of a user."""

    system, update_rate = Rollers, 50.0

    def load(self, robot: gazelle.Robot, parameters: Parameters) -> None:  # noqa: ARG002
        """Add motors to the wheels, and open ``cmd_vel``."""
        self.command = robot.inputs["cmd_vel"] = TwistInput(robot.simulation.nworld, "cmd_vel")
        self.wheels = [robot.joints[f"{name}_joint"] for name in CORNERS[:2]]
        for wheel in self.wheels:
            wheel.add_motor(5.0)


register("libbench_rollers.so", Roller)


@dataclass(frozen=True)
class Case:
    """What each robot has.

    Attributes:
        name: As it is printed.
        sensor: In the robot's link.
        plugin: In the robot.
        wheels: How many wheels it has, with motors.
        air: Whether robots hang in the air; all with wheels do.
        asleep: Whether only the plugin asks its sensors.
        heard: Whether somebody listens.
        most: Robots at most: each alone makes the coming step of all for its IMU.
        nworld: Worlds of one such robot each; 0: many robots in one world.
    """

    name: str
    sensor: str = ""
    plugin: str = ""
    wheels: int = 0
    air: bool = False
    asleep: bool = False
    heard: bool = True
    most: int = 1_000_000
    nworld: int = 0


CASES = (
    *(Case(name, sensor) for name, sensor in SENSORS.items()),
    Case("p3d, 50 Hz", plugin=P3D),
    Case("IMU plugin, 50 Hz", plugin=IMU_PLUGIN),
    Case("diff drive, 50 Hz", plugin=DIFF, wheels=2, heard=False),
    Case("a user's diff drive, 50 Hz", plugin=USERS, wheels=2, heard=False),
    Case("diff drive, odometry heard", plugin=DIFF, wheels=2),
    Case("skid steer, 50 Hz", plugin=SKID, wheels=4, heard=False),
    Case("skid steer, odometry heard", plugin=SKID, wheels=4),
    Case("encoders, 50 Hz", plugin=ENCODERS, wheels=2, heard=False),
    Case("encoders, odometry heard", plugin=ENCODERS, wheels=2),
    Case("tricycle, 50 Hz", plugin=TRICYCLE, wheels=4, heard=False),
    Case("tricycle, odometry heard", plugin=TRICYCLE, wheels=4),
    Case("planar move, every step", plugin=SLIDE, heard=False, air=True),
    Case("planar move, cmdTimeout", plugin=PATIENT, heard=False, air=True),
    Case(
        f"{FEW} Kobukis, every step",
        KOBUKI_SENSORS,
        KOBUKI,
        wheels=2,
        heard=False,
        asleep=True,
        most=FEW,
    ),
    Case(f"{BATCH} worlds, one diff drive", plugin=DIFF, wheels=2, nworld=BATCH),
)


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench many", description=__doc__)
    parser.add_argument("--only", default="", help="only cases whose names have this")
    parser.add_argument("--robots", type=int, default=ROBOTS, help="how many (default 100)")
    args = parser.parse_args()
    print(
        f"{os.cpu_count()} processors, {args.robots} robots, best of {WINDOWS} windows of a simulated "
        f"second in turns, step {STEP * 1e3:g} ms: ms of processor time"
    )
    print(f"{'one on each robot':<28}{'alone':>10}{'together':>10}{'times':>8}")
    for case in (each for each in CASES if args.only in each.name):
        count = 1 if case.nworld else min(args.robots, case.most)
        sims = [running(count, case, how) for how in ("alone", "together", "bare")]
        alone, together, bare = least(sims)
        alone, together = alone - bare, together - bare
        print(f"{case.name:<28}{alone:10.1f}{together:10.1f}{alone / together:8.1f}")


def running(count: int, case: Case, how: str) -> gazelle.Simulation:
    """Return robots that move, with awake sensors and subscribers of their plugins.

    Args:
        count: How many.
        case: What they have.
        how: Whether that is updated ``alone`` or ``together``, or they are ``bare`` of it.
    """
    sim = gazelle.Simulation(
        formats.load_string(world(count, case, bare=how == "bare")),
        "mujoco",
        nworld=max(1, case.nworld),
        threads=1,
    )
    for robot in sim.robots.values():
        for unit in robot.sensors.values():
            changed: Any = unit
            if how == "alone":
                changed.system = lambda: None
            if not case.asleep:
                unit.latest()
        for output in robot.outputs.values() if case.heard else ():
            output.subscribe(lambda _: None)
        set_off(robot, case)
    for entry in sim.entities.plugins:
        if how == "alone":
            entry.alone = True
        elif how == "bare":
            entry.schedule = None  # it gave the wheels their motors
    sim.run(1.0)
    return sim


def set_off(robot: gazelle.Robot, case: Case) -> None:
    """Start robots, by a drive or by their motors."""
    for port in robot.inputs.values():
        if isinstance(port, TwistInput):
            port.send(0.3)
    for wheel in CORNERS[: case.wheels]:
        joint = robot.joints[f"{wheel}_joint"]
        if joint.has_motor:
            joint.drive(4.0)


def world(count: int, case: Case, *, bare: bool) -> str:
    """Return the world as text."""
    physics = f"<physics name='p' type='ode'><max_step_size>{STEP}</max_step_size></physics>"
    wheels = "".join(
        WHEEL.format(name, 0.12 if "left" in name else -0.12) for name in CORNERS[: case.wheels]
    )
    sensor = "" if bare and not case.wheels else case.sensor
    plugin = "" if bare and not case.wheels else case.plugin
    robots = "".join(
        ROBOT.format(i, i % 10, i // 10, sensor, wheels + plugin) for i in range(count)
    )
    rest = "<gravity>0 0 0</gravity>" if case.wheels or case.air else GROUND
    return f"<sdf version='1.7'><world name='w'>{physics}{rest}{robots}</world></sdf>"


def least(sims: list[gazelle.Simulation]) -> list[float]:
    """Return processor time of a simulated second of each [ms], the least of windows in turns."""
    best = [float("inf")] * len(sims)
    for _ in range(WINDOWS):
        for index, sim in enumerate(sims):
            start = time.process_time()
            sim.run(1.0)
            best[index] = min(best[index], (time.process_time() - start) * 1e3)
    return best


if __name__ == "__main__":
    main()
