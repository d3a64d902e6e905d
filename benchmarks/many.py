"""Many robots in one world: what their sensors cost together, and each by itself.

100 robots lie on a ground in three dimensions, each with one sensor of a kind that measures at its
rate, or with a plugin whose topic somebody listens to. The peer is the same world in the same run, stepped in turns with it, in which Python measures
every sensor by itself; both are printed without what the physics takes alone.
"""

from __future__ import annotations

import argparse
import os
import time
from typing import Any

import gazelle
from gazelle import formats

ROBOTS = 100
WINDOWS = 5
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


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(prog="gazelle bench many", description=__doc__)
    parser.add_argument("--robots", type=int, default=ROBOTS, help="how many (default 100)")
    args = parser.parse_args()
    print(
        f"{os.cpu_count()} processors, {args.robots} robots, best of {WINDOWS} windows of a simulated "
        f"second in turns, step {STEP * 1e3:g} ms: ms of processor time"
    )
    print(f"{'one on each robot':<28}{'alone':>10}{'together':>10}{'times':>8}")
    parts = {name: (sensor, "") for name, sensor in SENSORS.items()}
    for name, part in {
        **parts,
        "p3d, 50 Hz": ("", P3D),
        "IMU plugin, 50 Hz": ("", IMU_PLUGIN),
    }.items():
        alone, together, bare = least(
            [
                world(args.robots, *part, grouped=False),
                world(args.robots, *part),
                world(args.robots),
            ]
        )
        alone, together = alone - bare, together - bare
        print(f"{name:<28}{alone:10.1f}{together:10.1f}{alone / together:8.1f}")


def world(
    count: int, sensor: str = "", plugin: str = "", *, grouped: bool = True
) -> gazelle.Simulation:
    """Robots whose sensors are awake, and whose plugins are listened to."""
    physics = f"<physics name='p' type='ode'><max_step_size>{STEP}</max_step_size></physics>"
    robots = "".join(ROBOT.format(i, i % 10, i // 10, sensor, plugin) for i in range(count))
    text = f"<sdf version='1.7'><world name='w'>{physics}{GROUND}{robots}</world></sdf>"
    sim = gazelle.Simulation(formats.load_string(text), "mujoco", threads=1)
    for robot in sim.robots.values():
        for unit in robot.sensors.values():
            changed: Any = unit
            if not grouped:
                changed.kind = lambda: None
            unit.latest()
        for output in robot.outputs.values():
            output.subscribe(lambda _: None)
    for entry in sim.entities.plugins:
        alone: Any = entry.plugin
        if not grouped:
            alone.kind = lambda: None
    sim.run(1.0)
    return sim


def least(sims: list[gazelle.Simulation]) -> list[float]:
    """Processor time of a simulated second of each [ms], the least of windows in turns."""
    best = [float("inf")] * len(sims)
    for _ in range(WINDOWS):
        for index, sim in enumerate(sims):
            start = time.process_time()
            sim.run(1.0)
            best[index] = min(best[index], (time.process_time() - start) * 1e3)
    return best


if __name__ == "__main__":
    main()
