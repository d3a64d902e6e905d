"""Joints: how two links may move against each other."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Literal

from gazelle.description.nan_refusal import refuses_nan
from gazelle.description.parameters import Parameters
from gazelle.description.pose import Pose, Vector3
from gazelle.description.sensor import Sensor
from gazelle.description.source import Source

JointType = Literal[
    "revolute",
    "continuous",
    "prismatic",
    "fixed",
    "ball",
    "universal",
    "screw",
    "revolute2",
    "gearbox",
    "planar",
    "floating",
]


@refuses_nan
@dataclass(frozen=True, slots=True)
class Mimic:
    """position = multiplier * (leader's position - reference) + offset.

    Attributes:
        joint: Name of the leading joint, in the same model.
        axis: Axis of the leader: 0 or 1.
        multiplier: Dimensionless, or rad/m and m/rad between kinds.
        offset: [m or rad].
        reference: [m or rad].
    """

    joint: str
    axis: int = 0
    multiplier: float = 1.0
    offset: float = 0.0
    reference: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class SafetyController:
    """URDF's soft limits: ``k_velocity``, ``k_position`` and the soft range [m or rad]."""

    k_velocity: float
    k_position: float = 0.0
    soft_lower_limit: float = 0.0
    soft_upper_limit: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class JointAxis:
    """One axis of motion.

    Attributes:
        xyz: Unit vector in the joint frame, whatever frame the file used.
        lower: Lower limit [m or rad].
        upper: Upper limit [m or rad].
        effort: Largest force or torque [N or N m].
        velocity: Largest speed [m/s or rad/s].
        stiffness: Of the limit stop [N/m or N m/rad].
        dissipation: Of the limit stop [N s/m or N m s/rad].
        damping: Viscous damping [N s/m or N m s/rad].
        friction: Static friction [N or N m].
        spring_reference: Position of rest of the spring [m or rad].
        spring_stiffness: [N/m or N m/rad].
        armature: Inertia of what turns in the drive, seen from the joint [kg or kg m²]: it resists
            the joint's acceleration and nothing else. No file format that is read has it.
        mimic: The joint this axis follows, or None.
    """

    xyz: Vector3 = (0.0, 0.0, 1.0)
    lower: float = -math.inf
    upper: float = math.inf
    effort: float = math.inf
    velocity: float = math.inf
    stiffness: float = 1e8
    dissipation: float = 1.0
    damping: float = 0.0
    friction: float = 0.0
    spring_reference: float = 0.0
    spring_stiffness: float = 0.0
    mimic: Mimic | None = None
    armature: float = 0.0


@refuses_nan
@dataclass(frozen=True, slots=True)
class JointPhysics:
    """Engine terms of a joint (SDF ``<physics><ode>``); defaults are SDF 1.7's.

    ``must_be_loop_joint`` is a hint for Simbody and has no effect elsewhere.
    """

    provide_feedback: bool = False
    implicit_spring_damper: bool = False
    fudge_factor: float | None = None
    cfm: float = 0.0
    erp: float = 0.2
    stop_cfm: float = 0.0
    stop_erp: float = 0.2
    suspension_cfm: float = 0.0
    suspension_erp: float = 0.2
    must_be_loop_joint: bool = False


@refuses_nan
@dataclass(frozen=True, slots=True)
class Joint:
    """A joint between two links of a model.

    Attributes:
        name: Unique in its model.
        type: SDF's and URDF's types.
        parent: Parent link, scoped by ``::`` within the model; ``world`` for the world.
        child: Child link, scoped by ``::`` within the model.
        pose: The joint frame in the child link's frame.
        axes: None for fixed and ball, one or two for the others.
        thread_pitch: Of a screw joint: angle a metre [rad/m], as SDF's ``screw_thread_pitch``
            turned into a rate.
        gearbox_ratio: Of a gearbox.
        gearbox_reference_body: Link the gearbox's angles are measured from.
        physics: Engine terms.
        safety: URDF's soft limits, or None.
        sensors: Force-torque sensors.
        extras: Elements without effect, kept as in the file: the axis of a fixed joint.
    """

    name: str
    type: JointType
    parent: str
    child: str
    pose: Pose = field(default_factory=Pose)
    axes: tuple[JointAxis, ...] = ()
    thread_pitch: float = 1.0
    gearbox_ratio: float = 1.0
    gearbox_reference_body: str = ""
    physics: JointPhysics = field(default_factory=JointPhysics)
    safety: SafetyController | None = None
    sensors: tuple[Sensor, ...] = ()
    extras: tuple[Parameters, ...] = field(default=(), hash=False)
    source: Source | None = field(default=None, compare=False, repr=False)
