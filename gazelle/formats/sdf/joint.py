"""``<joint>`` with its axes."""

from __future__ import annotations

import math
from typing import get_args

from gazelle.description import (
    Joint,
    JointAxis,
    JointPhysics,
    JointType,
    Mimic,
    Parameters,
    Pose,
    Vector3,
)
from gazelle.errors import FormatError, did_you_mean
from gazelle.formats import values
from gazelle.formats.axis import direction, travel
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.frames import MODEL, WORLD, Scope
from gazelle.formats.sdf.leftover import leftover
from gazelle.formats.sdf.own import own_safety
from gazelle.formats.sdf.own_joint import TYPE
from gazelle.formats.sdf.pose import frame_of, read_pose
from gazelle.formats.sdf.sensor import read_sensor

_TYPES: tuple[JointType, ...] = get_args(JointType)
_AXIS_TAGS = ("axis", "axis2")
_AXES: dict[str, int] = {
    "ball": 0,
    "fixed": 0,
    "floating": 0,
    "universal": 2,
    "revolute2": 2,
    "gearbox": 2,
}


def read_joints(
    node: Parameters, scope: Scope, version: tuple[int, int], reading: Reading
) -> tuple[Joint, ...]:
    """Read the joints of a model or world, without those that Gazebo cannot make.

    These are of an unknown type, or of a link that is not there.

    Raises:
        FormatError: A value of a joint makes no sense.
    """
    joints = []
    for child in node.find_all("joint"):
        ends = (values.word(child, "parent"), values.word(child, "child"))
        lost = next((end for end in ends if scope.lacks(end)), None)
        if lost is not None:
            reading.note(f"'{lost}' is of a model that was not found: the joint is left out", child)
            continue
        try:
            frame = _joined(child, scope)
        except FormatError as error:
            reading.tolerate(error, "the joint is left out")
            continue
        joints.append(read_joint(child, frame, scope, version, reading))
    return tuple(joints)


def _joined(node: Parameters, scope: Scope) -> tuple[JointType, str, str]:
    """Return the type of a joint and the links that it joins.

    Raises:
        FormatError: It names no link that is there, an unknown type, or one link twice.
    """
    parent, child = (body(node, tag, scope) for tag in ("parent", "child"))
    if parent == child:
        raise values.fail(node, f"the joint connects the link '{child}' to itself")
    return joint_type(node), parent, child


def read_joint(
    node: Parameters,
    joined: tuple[JointType, str, str],
    scope: Scope,
    version: tuple[int, int],
    reading: Reading,
) -> Joint:
    """Read a joint, its pose and axes turned into the child link's and its own frame."""
    name = values.attribute(node, "name")
    kind, parent, child = joined
    pose = _pose_in_child(node, name, child, scope)
    return Joint(
        name=name,
        type=kind,
        parent=parent,
        child=child,
        pose=pose,
        axes=tuple(read_axis(axis, name, scope, version, reading) for axis in _axes(node, kind)),
        thread_pitch=_thread_pitch(node),
        gearbox_ratio=values.real(node, "gearbox_ratio", 1.0),
        gearbox_reference_body=values.word(node, "gearbox_reference_body"),
        physics=read_joint_physics(node.find("physics")),
        safety=own_safety(node),
        sensors=tuple(
            read_sensor(child, lambda part: read_pose(part.find("pose")))
            for child in node.find_all("sensor")
        ),
        extras=tuple(
            leftover(child, {"use_parent_model_frame": None})
            for child in node.children
            if child.tag in _AXIS_TAGS[_AXES.get(kind, 1) :]
        ),
        source=node.source,
    )


def _axes(node: Parameters, kind: JointType) -> list[Parameters]:
    """Return the axis elements that the type has; the default one where the file gives none."""
    count = _AXES.get(kind, 1)
    return [node.find(tag) or Parameters("axis", source=node.source) for tag in _AXIS_TAGS[:count]]


def joint_type(node: Parameters) -> JointType:
    """Return the type of a joint.

    Raises:
        FormatError: There is no such type.
    """
    text = node.attributes.get(TYPE, "") or values.attribute(node, "type")
    for known in _TYPES:
        if text.lower() == known:
            return known
    raise values.fail(node, f"unknown joint type '{text}'", hint=did_you_mean(text, _TYPES))


def body(node: Parameters, tag: str, scope: Scope) -> str:
    """Return the link of a joint's ``<parent>`` or ``<child>``: a frame stands for its link.

    Raises:
        FormatError: It is missing, or there is no such link or frame.
    """
    element = node.find(tag)
    # files before SDF 1.3 name the link in an attribute
    text = "" if element is None else element.text or element.attributes.get("link", "")
    if element is None or not text:
        raise values.fail(node, f"a <joint> needs a <{tag}>")
    if text == WORLD:
        if tag == "child" and not scope.has(text):
            raise values.fail(element, "the world cannot be the child of a joint")
        return WORLD
    if text != MODEL and not scope.has(text):
        raise values.fail(
            element,
            f"the joint's {tag} '{text}' is not a link or frame of this model",
            hint=did_you_mean(text, scope.entries),
        )
    return scope.body_of(text, element)


def _pose_in_child(node: Parameters, name: str, child: str, scope: Scope) -> Pose:
    """Return the joint frame in the child link: SDF writes it in the child or a named frame."""
    written = node.find("pose")
    named = values.word(node, "child")
    if not frame_of(written) and named == child:
        return read_pose(written)
    return scope.pose(child, node).inverse() * scope.pose(name, node)


def read_axis(
    node: Parameters, joint: str, scope: Scope, version: tuple[int, int], reading: Reading
) -> JointAxis:
    """Read ``<axis>`` or ``<axis2>``, its direction turned into the joint frame."""
    lower, upper = _travel(node, reading)
    return JointAxis(
        xyz=_direction(node, joint, scope, version, reading),
        lower=lower,
        upper=upper,
        effort=_or_endless(node, "limit/effort"),
        velocity=_or_endless(node, "limit/velocity"),
        stiffness=values.real(node, "limit/stiffness", 1e8),
        dissipation=values.real(node, "limit/dissipation", 1.0),
        damping=values.real(node, "dynamics/damping", 0.0),
        friction=values.real(node, "dynamics/friction", 0.0),
        spring_reference=values.real(node, "dynamics/spring_reference", 0.0),
        spring_stiffness=values.real(node, "dynamics/spring_stiffness", 0.0),
        mimic=_mimic(node.find("mimic")),
    )


def _travel(node: Parameters, reading: Reading) -> tuple[float, float]:
    lower = values.limit(node, "limit/lower", -math.inf)
    upper = values.limit(node, "limit/upper", math.inf)
    return travel(lower, upper, node.find("limit") or node, reading)


def _or_endless(node: Parameters, path: str) -> float:
    value = values.limit(node, path, -1.0)
    return math.inf if value < 0.0 else value


def _direction(
    node: Parameters, joint: str, scope: Scope, version: tuple[int, int], reading: Reading
) -> Vector3:
    """Return the axis in the joint frame.

    Up to SDF 1.4 it is written in the model frame; in 1.5 and 1.6
    if ``<use_parent_model_frame>`` is set; since 1.7 ``expressed_in`` names the frame.
    """
    place = node.find("xyz")
    written = direction(values.vector(node, "xyz", (0.0, 0.0, 1.0)), place or node, reading)
    frame = "" if place is None else place.attributes.get("expressed_in", "")
    in_model = values.flag(node, "use_parent_model_frame", default=version <= (1, 4))
    if in_model and version <= (1, 6):
        frame = MODEL
    if not frame or frame == joint:
        return written
    turned = scope.pose(frame, place or node).rotate(written)
    x, y, z = scope.pose(joint, node).inverse().rotate(turned)
    return (x, y, z)


def _mimic(node: Parameters | None) -> Mimic | None:
    if node is None:
        return None
    return Mimic(
        joint=values.attribute(node, "joint"),
        axis=1 if node.attributes.get("axis") == "axis2" else 0,
        multiplier=values.real(node, "multiplier", 1.0),
        offset=values.real(node, "offset", 0.0),
        reference=values.real(node, "reference", 0.0),
    )


def _thread_pitch(node: Parameters) -> float:
    """Return rad/m, left-handed; ``<screw_thread_pitch>`` is metres a turn, right-handed."""
    pitch = node.find("screw_thread_pitch")
    if pitch is None or not pitch.text:
        return values.real(node, "thread_pitch", 1.0)
    metres = values.parse_real(pitch, pitch.text, "<screw_thread_pitch>")
    if metres == 0.0:
        raise values.fail(pitch, "<screw_thread_pitch> must not be zero")
    return -2.0 * math.pi / metres


def read_joint_physics(node: Parameters | None) -> JointPhysics:
    """Read ``<physics>`` of a joint."""
    if node is None:
        return JointPhysics()
    feedback = values.flag(node, "ode/provide_feedback", default=False)
    fudge = node.find("ode/fudge_factor")
    damper = values.flag(node, "ode/cfm_damping", default=False)
    return JointPhysics(
        provide_feedback=values.flag(node, "provide_feedback", default=feedback),
        implicit_spring_damper=values.flag(node, "ode/implicit_spring_damper", default=damper),
        fudge_factor=None if fudge is None else values.real(node, "ode/fudge_factor", 0.0),
        cfm=values.real(node, "ode/cfm", 0.0),
        erp=values.real(node, "ode/erp", 0.2),
        stop_cfm=values.real(node, "ode/limit/cfm", 0.0),
        stop_erp=values.real(node, "ode/limit/erp", 0.2),
        suspension_cfm=values.real(node, "ode/suspension/cfm", 0.0),
        suspension_erp=values.real(node, "ode/suspension/erp", 0.2),
        must_be_loop_joint=values.flag(node, "simbody/must_be_loop_joint", default=False),
    )
