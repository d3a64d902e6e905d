"""``<joint>`` of URDF."""

from __future__ import annotations

import math

from gazelle.description import Joint, JointAxis, Mimic, Parameters, Pose
from gazelle.formats.write.element import element, endless, inside, written
from gazelle.formats.write.sdf.joint import note_armature, write_safety
from gazelle.formats.write.urdf.link import write_origin
from gazelle.formats.write.writing import Writing


def write_joint(joint: Joint, origin: Pose, writing: Writing) -> Parameters:
    """Write a joint at ``origin`` in its parent's frame, as its child's frame is."""
    note_armature(joint, writing)
    with inside("joint", joint):
        kind = joint_kind(joint)
        axis = joint.axes[0] if joint.axes and kind not in {"fixed", "floating"} else None
        if axis is not None and (axis.stiffness, axis.dissipation) != (1e8, 1.0):
            writing.note("URDF has no stiffness of a joint's stop: it is left out", joint.source)
        return element(
            "joint",
            write_origin(origin),
            element("parent", link=joint.parent),
            element("child", link=joint.child),
            *(() if axis is None else _axis(axis, kind)),
            None if joint.safety is None else write_safety(joint.safety, "safety_controller"),
            name=joint.name,
            type=kind,
        )


def joint_kind(joint: Joint) -> str:
    """Return URDF's type: a revolute joint without limits is called continuous there."""
    free = joint.axes and joint.axes[0].lower == -math.inf and joint.axes[0].upper == math.inf
    return "continuous" if joint.type == "revolute" and free else joint.type


def _axis(axis: JointAxis, kind: str) -> tuple[Parameters | None, ...]:
    dynamics = None
    if axis.damping or axis.friction:
        dynamics = element(
            "dynamics", damping=written(axis.damping), friction=written(axis.friction)
        )
    return (
        element("axis", xyz=written(axis.xyz)),
        _limit(axis, kind),
        dynamics,
        None if axis.mimic is None else _mimic(axis.mimic),
    )


def _limit(axis: JointAxis, kind: str) -> Parameters | None:
    most = {"effort": endless(axis.effort), "velocity": endless(axis.velocity)}
    if kind in {"revolute", "prismatic"}:
        return element("limit", lower=endless(axis.lower), upper=endless(axis.upper), **most)
    if math.isinf(axis.effort) and math.isinf(axis.velocity):
        return None
    return element("limit", **most)


def _mimic(mimic: Mimic) -> Parameters:
    """Return the mimic; the reference position, which URDF lacks, goes into the offset."""
    offset = mimic.offset - mimic.multiplier * mimic.reference
    return element(
        "mimic",
        joint=mimic.joint,
        multiplier=written(mimic.multiplier),
        offset=written(offset),
    )
