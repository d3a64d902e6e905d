"""The ten scenes: what moves, what is compared, how close the engines are and why not closer."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import scenes
from second_engine import mechanisms
from second_engine.comparing import Measure, Scene

from gazelle import assets
from gazelle.description import Cylinder, Link, Pose
from gazelle.formats import load

STILL = (0.0, 0.0, 0.0)

SAME = "the same integrator; what is left is rounding"
DAMPING = "damping is implicit here and explicit in Bullet: an error of first order in the step"
PIVOT = "both are 2 mrad off the limit of small steps at 1 ms, not in quite the same way"
LOOP = "how far the loop opens, with the square of the step: 0.15 mm here, 0.12 mm in Bullet"
DEPTH = "how deep a contact rests, and how soft it is"
IMPACT = "when in a step an impact falls, and how soft it is"
CREEP = "friction that holds creeps a little there"
RIM = "sliding contacts: the wheels slip for the first 0.2 s, the caster all the way"
LIMIT = "a stop takes the velocity within a step in both; what is left is rounding"


def joints(*names: str):
    """Return a reader of joint positions."""
    return lambda engine: [float(engine.joints[f"m::{n}"].position()[0, 0]) for n in names]


def places(link: str, *axes: int):
    """Return a reader of coordinates of a link's origin."""
    return lambda engine: [float(engine.links[link].placement().position[0, a]) for a in axes]


def tilt(link: str):
    """Return a reader of the angle between a link's z axis and up."""

    def read(engine: Any) -> list[float]:
        pose = Pose.from_quaternion((0, 0, 0), engine.links[link].placement().quaternion[0])
        x, y, z = pose.rotate((0.0, 0.0, 1.0))
        return [math.atan2(math.hypot(x, y), z)]

    return read


def heading(link: str):
    """Return a reader of a link's x direction as a point on a circle, which has no jumps."""

    def read(engine: Any) -> list[float]:
        pose = Pose.from_quaternion((0, 0, 0), engine.links[link].placement().quaternion[0])
        x, y, _ = pose.rotate((1.0, 0.0, 0.0))
        return [x, y]

    return read


def spin(link: str):
    """Return a reader of the angular velocity about y."""
    return lambda engine: [float(engine.links[link].motion().angular[0, 1])]


def set_joints(**angles: float):
    """Return a start at joint positions."""

    def start(engine: Any) -> None:
        for name, angle in angles.items():
            engine.joints[f"m::{name}"].set_position(angle)

    return start


def nothing(_: Any) -> None:
    """Start as described."""


def thrown(model: str, speed: float):
    """Return a start with a speed along x."""
    return lambda engine: engine.models[model].set_motion((speed, 0.0, 0.0), STILL)


def squeezed(engine: Any) -> None:
    """Start with a push on the leading finger."""
    engine.joints["m::left"].set_effort(1.0)


def driven(engine: Any) -> None:
    """Start with the wheels commanded unequally."""
    for side, speed in (("left", 6.0), ("right", 4.0)):
        joint = f"turtlebot3_burger::wheel_{side}_joint"
        engine.add_motor(joint, 10.0)
        engine.joints[joint].set_motor_velocity(speed)


def sliding():
    block = mechanisms.tall_box("block", (0.4, 0.4, 0.1), 1.0, 0.3, Pose(z=0.05))
    return scenes.world(scenes.ground(1.0), block)


def tilting():
    """Return a box on its lower edge, leaning a tenth of a radian too far to stand."""
    width, height = 0.1, 0.4
    reach, corner = math.hypot(width, height) / 2.0, math.atan2(width, height)
    lean = corner + 0.1
    pose = Pose(x=reach * math.sin(0.1), z=reach * math.cos(0.1), pitch=lean)
    block = mechanisms.tall_box("block", (width, 0.2, height), 1.0, 0.8, pose)
    return scenes.world(scenes.ground(1.0), block)


def rolling():
    return scenes.world(scenes.ground(1.0), mechanisms.wheel(0.5))


def stacked():
    """Return five boxes, each smaller and a little aside, 2 mm of air under each."""
    boxes = (
        mechanisms.tall_box(
            f"box_{i}",
            (0.2 - 0.02 * i, 0.2 - 0.02 * i, 0.1),
            1.0,
            0.5,
            Pose(x=0.01 * (-1) ** i, z=0.05 + 0.1 * i + 0.002 * (i + 1)),
        )
        for i in range(5)
    )
    return scenes.world(scenes.ground(0.5), *boxes)


def stack(engine: Any) -> list[float]:
    positions = [engine.links[f"box_{i}::link"].placement().position[0] for i in range(5)]
    return [float(value) for value in np.concatenate(positions)]


def burger():
    """Return the burger on narrow wheels with level axles, whose wheel contacts are clear."""
    robot = load(assets.robot("turtlebot3_burger")).models[0]
    return scenes.world(scenes.ground(1.0), replace(robot, links=tuple(map(_trued, robot.links))))


def _trued(link: Link) -> Link:
    collisions = tuple(
        replace(
            each,
            pose=_level(each.pose),
            geometry=Cylinder(each.geometry.radius, 0.001)
            if link.name.startswith("wheel")
            else each.geometry,
        )
        for each in link.collisions
    )
    return replace(link, pose=_level(link.pose), collisions=collisions)


def _level(pose: Pose) -> Pose:
    """Return the pose with a quarter of a turn where the file says -1.57."""
    return Pose(*pose.position, roll=-math.pi / 2) if pose.roll == -1.57 else pose


ARM = [f"joint_{i}" for i in range(1, 7)]
BASE = "turtlebot3_burger::base_footprint"

SCENES = (
    Scene(
        "pendulum",
        lambda: scenes.world(mechanisms.pendulum()),
        set_joints(swing=1.0),
        5.0,
        (Measure("angle", "mrad", joints("swing"), 1e-6, SAME),),
    ),
    Scene(
        "double pendulum",
        lambda: scenes.world(mechanisms.double_pendulum()),
        set_joints(shoulder=2.0, elbow=-1.0),
        3.0,
        (Measure("both angles", "mrad", joints("shoulder", "elbow"), 1e-6, SAME),),
    ),
    Scene(
        "sliding block",
        sliding,
        thrown("block", 1.5),
        0.9,
        (
            Measure("distance", "mm", places("block::link", 0), 0.1, DEPTH),
            Measure("height", "mm", places("block::link", 2), 0.15, DEPTH),
            Measure("where it stops", "mm", places("block::link", 0, 1, 2), 0.05, CREEP, 0.6),
        ),
    ),
    Scene(
        "tilting block",
        tilting,
        nothing,
        0.5,
        (Measure("angle until it strikes", "mrad", tilt("block::link"), 0.8, PIVOT),),
    ),
    Scene(
        "rolling wheel",
        rolling,
        thrown("wheel", 1.5),
        2.0,
        (
            Measure("distance", "mm", places("wheel::link", 0), 0.6, DEPTH),
            Measure("height", "mm", places("wheel::link", 2), 0.05, DEPTH),
            Measure("spin when it rolls", "rad/s", spin("wheel::link"), 0.006, CREEP, 0.3),
        ),
    ),
    Scene(
        "four-bar",
        lambda: scenes.world(mechanisms.four_bar()),
        nothing,
        3.0,
        (Measure("three angles", "mrad", joints("drive", "knee", "foot"), 110.0, LOOP),),
    ),
    Scene(
        "stacked boxes",
        stacked,
        nothing,
        2.0,
        (
            Measure("positions while they land", "mm", stack, 1.3, IMPACT),
            Measure("where they rest", "mm", stack, 0.2, CREEP, 1.0),
        ),
    ),
    Scene(
        "burger",
        burger,
        driven,
        5.0,
        (
            Measure("position", "mm", places(BASE, 0, 1, 2), 2.0, RIM),
            Measure("heading", "mrad", heading(BASE), 4.0, RIM),
        ),
    ),
    Scene(
        "arm of six axes",
        lambda: scenes.world(mechanisms.arm()),
        set_joints(joint_1=0.5, joint_2=-0.7, joint_3=0.4, joint_4=0.8, joint_5=0.5),
        3.0,
        (Measure("six angles", "mrad", joints(*ARM), 4.0, DAMPING),),
    ),
    Scene(
        "mimic gripper",
        lambda: scenes.world(mechanisms.gripper()),
        squeezed,
        1.0,
        (
            Measure("both fingers", "mm", joints("left", "right"), 0.25, DAMPING),
            Measure("where they stop", "mm", joints("left", "right"), 1e-4, LIMIT, 0.7),
        ),
    ),
)
