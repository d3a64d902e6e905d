"""``<joint>`` with its axes."""

from __future__ import annotations

import math

from gazelle.description import Joint, JointAxis, JointPhysics, Mimic, Parameters, SafetyController
from gazelle.formats.sdf.own import SAFETY
from gazelle.formats.sdf.own_joint import JOINT, TYPE
from gazelle.formats.write.element import element, group, inside, leaf, limit, pose_leaf, written
from gazelle.formats.write.sdf.sensor import write_sensor
from gazelle.formats.write.writing import Writing

_NOT_SDF = {"planar", "floating"}


def write_joint(joint: Joint, writing: Writing) -> Parameters:
    """Write a joint."""
    if joint.type in _NOT_SDF:
        writing.note(
            f"SDF has no '{joint.type}' joint: other programs ignore '{joint.name}'",
            joint.source,
        )
    note_armature(joint, writing)
    with inside("joint", joint):
        return element(
            JOINT if joint.type in _NOT_SDF else "joint",
            pose_leaf(joint.pose),
            leaf("parent", joint.parent),
            leaf("child", joint.child),
            leaf("gearbox_ratio", joint.gearbox_ratio, 1.0),
            leaf("gearbox_reference_body", joint.gearbox_reference_body, ""),
            leaf("thread_pitch", joint.thread_pitch, 1.0),
            *map(write_axis, ("axis", "axis2"), joint.axes),
            *joint.extras,
            write_joint_physics(joint.physics),
            None if joint.safety is None else write_safety(joint.safety, SAFETY),
            *map(write_sensor, joint.sensors),
            name=joint.name,
            **_types(joint),
        )


def note_armature(joint: Joint, writing: Writing) -> None:
    """Warn that no format can hold a joint's resistance to acceleration."""
    if any(axis.armature for axis in joint.axes):
        writing.note(f"no format has an armature: that of '{joint.name}' is left out", joint.source)


def _types(joint: Joint) -> dict[str, str]:
    """Return the type as an attribute.

    Gazebo Classic has free revolute joints, no continuous ones.
    """
    axis = joint.axes[0] if joint.axes else JointAxis()
    if joint.type == "continuous" and axis.lower == -math.inf and axis.upper == math.inf:
        return {"type": "revolute", TYPE: joint.type}
    return {"type": joint.type}


def write_axis(tag: str, axis: JointAxis) -> Parameters:
    """Write ``<axis>`` or ``<axis2>``, its direction in the joint frame."""
    return element(
        tag,
        leaf("xyz", axis.xyz),
        None if axis.mimic is None else write_mimic(axis.mimic),
        group(
            "dynamics",
            leaf("damping", axis.damping, 0.0),
            leaf("friction", axis.friction, 0.0),
            leaf("spring_reference", axis.spring_reference, 0.0),
            leaf("spring_stiffness", axis.spring_stiffness, 0.0),
        ),
        group(
            "limit",
            limit("lower", axis.lower, -math.inf),
            limit("upper", axis.upper, math.inf),
            limit("effort", axis.effort, math.inf),
            limit("velocity", axis.velocity, math.inf),
            leaf("stiffness", axis.stiffness, 1e8),
            leaf("dissipation", axis.dissipation, 1.0),
        ),
    )


def write_mimic(mimic: Mimic) -> Parameters:
    """Write ``<mimic>``, of SDF 1.11."""
    return element(
        "mimic",
        leaf("multiplier", mimic.multiplier),
        leaf("offset", mimic.offset),
        leaf("reference", mimic.reference),
        joint=mimic.joint,
        axis="axis2" if mimic.axis == 1 else "axis",
    )


def write_joint_physics(physics: JointPhysics) -> Parameters | None:
    """Write ``<physics>`` with ODE's terms that differ from the defaults.

    Two stand twice, under their old names too, as libsdformat writes them.
    """
    usual = JointPhysics()
    own = ("implicit_spring_damper", "fudge_factor", "cfm", "erp")
    feedback = leaf("provide_feedback", physics.provide_feedback, False)
    return group(
        "physics",
        feedback,
        group(
            "ode",
            feedback,
            leaf("cfm_damping", physics.implicit_spring_damper, False),
            *(leaf(name, getattr(physics, name), getattr(usual, name)) for name in own),
            group(
                "limit",
                leaf("cfm", physics.stop_cfm, usual.stop_cfm),
                leaf("erp", physics.stop_erp, usual.stop_erp),
            ),
            group(
                "suspension",
                leaf("cfm", physics.suspension_cfm, usual.suspension_cfm),
                leaf("erp", physics.suspension_erp, usual.suspension_erp),
            ),
        ),
        group("simbody", leaf("must_be_loop_joint", physics.must_be_loop_joint, False)),
    )


def write_safety(safety: SafetyController, tag: str) -> Parameters:
    """Write URDF's soft limits."""
    return element(
        tag,
        k_velocity=written(safety.k_velocity),
        k_position=written(safety.k_position),
        soft_lower_limit=written(safety.soft_lower_limit),
        soft_upper_limit=written(safety.soft_upper_limit),
    )
