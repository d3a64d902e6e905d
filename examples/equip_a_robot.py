"""Give a plain URDF a lidar, an IMU, a camera, friction and transmissions, and drive outdoors.

    python examples/equip_a_robot.py --out /tmp/robot

Writes ``robot.urdf`` with all ``<gazebo>`` and ``<transmission>`` elements, and ``mars.world``.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path

import gazelle
from gazelle.builders import (
    Disc,
    WorldBuilder,
    add_link_properties,
    add_sensor,
    add_transmissions,
    camera,
    hills,
    imu,
    lidar,
)
from gazelle.description import Pose
from gazelle.formats import load_model_string, save

CART = """<?xml version="1.0"?>
<robot name="cart">
  <link name="base">
    <inertial>
      <mass value="8"/>
      <inertia ixx="0.09" iyy="0.17" izz="0.23" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <collision><geometry><box size="0.5 0.3 0.2"/></geometry></collision>
    <visual>
      <geometry><box size="0.5 0.3 0.2"/></geometry>
      <material name="orange"><color rgba="0.9 0.5 0.15 1"/></material>
    </visual>
  </link>
  <link name="mast">
    <inertial>
      <mass value="0.5"/>
      <inertia ixx="0.002" iyy="0.002" izz="0.001" ixy="0" ixz="0" iyz="0"/>
    </inertial>
    <visual><geometry><cylinder radius="0.04" length="0.2"/></geometry></visual>
  </link>
  <joint name="pan" type="revolute">
    <parent link="base"/>
    <child link="mast"/>
    <origin xyz="0 0 0.2"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1.5" upper="1.5" effort="1" velocity="2"/>
    <dynamics damping="0.1"/>
  </joint>
</robot>
"""


def equip(text: str) -> str:
    """Return the robot's text with what a simulation needs; its own text stays as it is."""
    scanner = lidar("scanner", pose=Pose(z=0.12), samples=180, noise=0.01, range_max=20.0)
    eye = camera("eye", pose=Pose(x=0.05), horizontal_fov=math.radians(80.0))
    text = add_sensor(text, "mast", scanner)
    text = add_sensor(text, "mast", eye)
    text = add_sensor(text, "base", imu(accel_noise=0.02, rate_noise=0.001))
    text = add_link_properties(text, "base", mu1=0.6, mu2=0.6, material="Gazebo/Orange")
    return add_transmissions(text)


def main() -> None:
    """Write the robot, put it on a hill on Mars, and read its sensors."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--out", type=Path, default=Path())
    args = parser.parse_args()
    args.out.mkdir(parents=True, exist_ok=True)

    robot_file = args.out / "robot.urdf"
    robot_file.write_text(equip(CART), encoding="utf-8")

    land = hills(args.seed, length=30.0, width=30.0, height=1.5)
    builder = WorldBuilder("mars", seed=args.seed).terrain(land, color="clay").planet("mars")
    builder.sun().keep_clear(Disc(0.0, 0.0, 2.0))
    builder.plants(6, kinds=("rock",), height=(0.5, 1.5), name="rock")
    world = builder.build()
    save(world, args.out / "mars.world")

    cart = load_model_string(robot_file.read_text(encoding="utf-8"))
    with gazelle.Simulation(world) as sim:
        robot = sim.spawn(cart, name="cart", pose=Pose(z=builder.level(0.0, 0.0) + 0.3))
        sim.run(seconds=2.0)
        ranges = robot.sensors["scanner"].read().ranges
        gravity = robot.sensors["imu"].read().linear_acceleration
        print(f"at {robot.pose}; nearest echo {min(ranges):.2f} m")
        print(f"felt acceleration {math.hypot(*gravity):.2f} m/s²")


if __name__ == "__main__":
    main()
