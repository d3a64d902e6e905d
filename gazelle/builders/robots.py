"""Preparation of robots for simulation: contact and joint properties, sensors, plugins and more.

Every function takes the text of a URDF (or xacro) file and gives text with the elements
added, or takes a ``Model`` and gives a model that means the same as that text would.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, TypeVar

from gazelle.argument_checks import checked
from gazelle.builders import urdf_text
from gazelle.builders.elements import Value, element, group
from gazelle.builders.errors import BuildError
from gazelle.builders.paint import material as material_of
from gazelle.description import (
    Collision,
    Joint,
    JointAxis,
    Link,
    Model,
    Parameters,
    Plugin,
    Sensor,
    Transmission,
    Vector3,
)
from gazelle.errors import did_you_mean
from gazelle.formats.write.sdf.plugin import write_plugin
from gazelle.formats.write.sdf.sensor import write_sensor

RobotT = TypeVar("RobotT", str, Model)

_EFFORT = "hardware_interface/EffortJointInterface"
_SIMPLE = "transmission_interface/SimpleTransmission"


@checked(BuildError)
def add_link_properties(
    robot: RobotT,
    link: str,
    *,
    mu1: float | None = None,
    mu2: float | None = None,
    fdir1: Vector3 | None = None,
    kp: float | None = None,
    kd: float | None = None,
    max_vel: float | None = None,
    min_depth: float | None = None,
    max_contacts: int | None = None,
    laser_retro: float | None = None,
    material: str | None = None,
    gravity: bool | None = None,
    self_collide: bool | None = None,
    damping: float | None = None,
) -> RobotT:
    """Set contact, look and motion of a link; those that are None stay.

    Args:
        robot: URDF text or a model.
        link: Its name.
        mu1: Friction coefficient along ``fdir1``.
        mu2: Friction coefficient across it.
        fdir1: First friction direction, in the collision's frame.
        kp: Contact stiffness [N/m].
        kd: Contact damping [N s/m].
        max_vel: Largest velocity that correcting a penetration may cause [m/s].
        min_depth: Penetration that is left uncorrected [m].
        max_contacts: Most contact points with one other collision.
        laser_retro: Intensity that lidars report.
        material: Name of a Gazebo material script, such as ``Gazebo/Grey``.
        gravity: Whether gravity pulls it.
        self_collide: Whether it collides with links of its own model.
        damping: Fraction of velocity lost.

    Raises:
        BuildError: There is no such link, or nothing is requested.
    """
    values: dict[str, Value | None] = {
        "mu1": mu1, "mu2": mu2, "fdir1": fdir1, "kp": kp, "kd": kd, "maxVel": max_vel,
        "minDepth": min_depth, "maxContacts": max_contacts, "laserRetro": laser_retro,
        "material": material, "turnGravityOff": None if gravity is None else not gravity,
        "selfCollide": self_collide, "dampingFactor": damping,
    }  # fmt: skip
    properties = _given(values, f"link '{link}'")
    if isinstance(robot, str):
        urdf_text.check_name(robot, "link", link)
        return urdf_text.insert(robot, [_tags(link, properties)])
    found = _link(robot, link)
    surface = {"mu": mu1, "mu2": mu2, "fdir1": fdir1}
    contact = {"kp": kp, "kd": kd, "max_vel": max_vel, "min_depth": min_depth}
    own = {"laser_retro": laser_retro, "max_contacts": max_contacts}
    changed = replace(
        found,
        collisions=tuple(_touch(each, surface, contact, own) for each in found.collisions),
        gravity=found.gravity if gravity is None else gravity,
        self_collide=found.self_collide if self_collide is None else self_collide,
        velocity_decay_linear=found.velocity_decay_linear if damping is None else damping,
        velocity_decay_angular=found.velocity_decay_angular if damping is None else damping,
    )
    return _with_link(robot, changed if material is None else _painted(changed, material))


@checked(BuildError)
def add_joint_properties(
    robot: RobotT,
    joint: str,
    *,
    provide_feedback: bool | None = None,
    implicit_spring_damper: bool | None = None,
    stop_cfm: float | None = None,
    stop_erp: float | None = None,
    fudge_factor: float | None = None,
    spring_stiffness: float | None = None,
    spring_reference: float | None = None,
) -> RobotT:
    """Set terms of a joint that URDF lacks; those that are None stay.

    Args:
        robot: URDF text or a model.
        joint: Its name; no fixed joint.
        provide_feedback: Whether its forces are measured.
        implicit_spring_damper: Whether spring and damper are integrated implicitly.
        stop_cfm: Softness of its limits.
        stop_erp: Error reduction of its limits, 0 to 1.
        fudge_factor: Scale of the motor's force at a limit.
        spring_stiffness: [N/m or N m/rad].
        spring_reference: Rest position of the spring [m or rad].

    Raises:
        BuildError: There is no such joint, or nothing is requested.
    """
    values: dict[str, Value | None] = {
        "provideFeedback": provide_feedback, "implicitSpringDamper": implicit_spring_damper,
        "stopCfm": stop_cfm, "stopErp": stop_erp, "fudgeFactor": fudge_factor,
        "springStiffness": spring_stiffness, "springReference": spring_reference,
    }  # fmt: skip
    properties = _given(values, f"joint '{joint}'")
    if isinstance(robot, str):
        urdf_text.check_name(robot, "joint", joint)
        return urdf_text.insert(robot, [_tags(joint, properties)])
    found = _joint(robot, joint)
    physics = {
        "provide_feedback": provide_feedback, "implicit_spring_damper": implicit_spring_damper,
        "stop_cfm": stop_cfm, "stop_erp": stop_erp, "fudge_factor": fudge_factor,
    }  # fmt: skip
    springs = {"spring_stiffness": spring_stiffness, "spring_reference": spring_reference}
    changed = replace(
        found,
        physics=replace(found.physics, **_set(physics)),
        axes=tuple(_sprung(axis, springs) for axis in found.axes),
    )
    joints = tuple(changed if each.name == joint else each for each in robot.joints)
    return replace(robot, joints=joints)


@checked(BuildError)
def keep_fixed_joint(text: str, joint: str) -> str:
    """Return URDF text with a fixed joint that keeps its two links apart, instead of lumping them.

    Raises:
        BuildError: There is no such joint.
    """
    urdf_text.check_name(text, "joint", joint)
    tags: dict[str, Value] = {"disableFixedJointLumping": True, "preserveFixedJoint": True}
    return urdf_text.insert(text, [_tags(joint, tags)])


@checked(BuildError)
def add_transmission(
    robot: RobotT,
    joint: str,
    *,
    interface: str = _EFFORT,
    reduction: float = 1.0,
    name: str = "",
) -> RobotT:
    """Return a simple transmission, through which ros_control moves a joint.

    Args:
        robot: URDF text or a model.
        joint: Its name.
        interface: ``hardware_interface/EffortJointInterface``, or that of position or
            velocity.
        reduction: Turns of the motor a turn of the joint.
        name: Of the transmission; empty for the joint's with ``_transmission``.

    Raises:
        BuildError: There is no such joint, or it has a transmission of that name already.
    """
    if reduction == 0.0:
        raise BuildError("a mechanical reduction must not be zero")
    called = name or f"{joint}_transmission"
    if called in _transmissions(robot):
        raise BuildError(f"the robot has a transmission '{called}' already")
    motor = f"{joint}_motor"
    if isinstance(robot, str):
        urdf_text.check_name(robot, "joint", joint)
        node = element(
            "transmission",
            None,
            element("type", _SIMPLE),
            element(
                "joint",
                None,
                element("hardwareInterface", interface),
                attributes={"name": joint},
            ),
            element(
                "actuator",
                None,
                element("hardwareInterface", interface),
                element("mechanicalReduction", reduction),
                attributes={"name": motor},
            ),
            attributes={"name": called},
        )
        return urdf_text.insert(robot, [node])
    _joint(robot, joint)
    added = Transmission(
        called, _SIMPLE, joints=((joint, (interface,)),), actuators=((motor, float(reduction)),)
    )
    return replace(robot, transmissions=(*robot.transmissions, added))


@checked(BuildError)
def add_transmissions(robot: RobotT, *, interface: str = _EFFORT, reduction: float = 1.0) -> RobotT:
    """Return a simple transmission for each moving joint that has none and follows no other.

    Raises:
        BuildError: The text is xacro, with macros that may make joints that cannot be seen.
    """
    for joint in _moving(robot):
        robot = add_transmission(robot, joint, interface=interface, reduction=reduction)
    return robot


@checked(BuildError)
def add_sensor(robot: RobotT, link: str, sensor: Sensor) -> RobotT:
    """Return a sensor on a link, or on a frame that was a link before it was lumped.

    Args:
        robot: URDF text or a model.
        link: Its name.
        sensor: Made with ``camera``, ``lidar``, ``imu``, ... or taken from another model.

    Raises:
        BuildError: There is no such link, or it has a sensor of that name already.
    """
    if isinstance(robot, str):
        urdf_text.check_name(robot, "link", link)
        return urdf_text.insert(robot, [urdf_text.gazebo(link, (write_sensor(sensor),))])
    return _fitted(robot, link, sensor)


@checked(BuildError)
def add_plugin(robot: RobotT, plugin: Plugin) -> RobotT:
    """Return a plugin of the model, such as one made with ``plugin``."""
    if isinstance(robot, str):
        urdf_text.root_of(robot)
        return urdf_text.insert(robot, [urdf_text.gazebo("", (write_plugin(plugin),))])
    return replace(robot, plugins=(*robot.plugins, plugin))


def _fitted(model: Model, link: str, sensor: Sensor) -> Model:
    """Return the model with a sensor on a link, or on the frame of a lumped link."""
    frame = next((each for each in model.frames if each.name == link and each.attached_to), None)
    if frame is not None:
        link = frame.attached_to
        sensor = replace(sensor, pose=frame.pose * sensor.pose)
    owner = _link(model, link)
    if any(each.name == sensor.name for each in owner.sensors):
        raise BuildError(f"link '{link}' has a sensor '{sensor.name}' already")
    return _with_link(model, replace(owner, sensors=(*owner.sensors, sensor)))


def _given(values: dict[str, Value | None], what: str) -> dict[str, Value]:
    present = {name: value for name, value in values.items() if value is not None}
    if not present:
        raise BuildError(f"no property of {what} was given")
    return present


def _tags(reference: str, values: dict[str, Value]) -> Parameters:
    return urdf_text.gazebo(reference, group("gazebo", **values).children)


def _set(values: Mapping[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def _touch(
    collision: Collision,
    friction: Mapping[str, Any],
    contact: Mapping[str, Any],
    own: Mapping[str, Any],
) -> Collision:
    surface = collision.surface
    surface = replace(
        surface,
        friction=replace(surface.friction, **_set(friction)),
        contact=replace(surface.contact, **_set(contact)),
    )
    return replace(collision, surface=surface, **_set(own))


def _painted(link: Link, script: str) -> Link:
    paint = material_of(script)
    return replace(link, visuals=tuple(replace(each, material=paint) for each in link.visuals))


def _sprung(axis: JointAxis, springs: Mapping[str, Any]) -> JointAxis:
    return replace(axis, **_set(springs))


def _link(model: Model, name: str) -> Link:
    for link in model.links:
        if link.name == name:
            return link
    for frame in model.frames:
        if frame.name == name:
            raise BuildError(
                f"'{name}' is a frame of link '{frame.attached_to}', not a link",
                hint="add the properties to the text, before fixed joints are lumped",
            )
    names = [link.name for link in model.links]
    raise BuildError(f"model '{model.name}' has no link '{name}'", hint=did_you_mean(name, names))


def _joint(model: Model, name: str) -> Joint:
    for joint in model.joints:
        if joint.name == name:
            return joint
    names = [joint.name for joint in model.joints]
    raise BuildError(f"model '{model.name}' has no joint '{name}'", hint=did_you_mean(name, names))


def _with_link(model: Model, link: Link) -> Model:
    links = tuple(link if each.name == link.name else each for each in model.links)
    return replace(model, links=links)


def _transmissions(robot: str | Model) -> set[str]:
    if isinstance(robot, Model):
        return {each.name for each in robot.transmissions}
    root = urdf_text.root_of(robot)
    return {node.attributes.get("name", "") for node in root.find_all("transmission")}


def _moving(robot: str | Model) -> list[str]:
    """Return actuated joints without a transmission."""
    if isinstance(robot, Model):
        driven = {joint for each in robot.transmissions for joint, _ in each.joints}
        return [
            joint.name
            for joint in robot.joints
            if joint.axes and joint.name not in driven and not any(a.mimic for a in joint.axes)
        ]
    if urdf_text.is_xacro(robot):
        raise BuildError(
            "the joints of a xacro file are known only after it is expanded",
            hint="name the joints, with add_transmission",
        )
    root = urdf_text.root_of(robot)
    driven = {
        joint.attributes.get("name", "")
        for each in root.find_all("transmission")
        for joint in each.find_all("joint")
    }
    return [
        name
        for node in root.find_all("joint")
        if (name := node.attributes.get("name", "")) not in driven
        and node.attributes.get("type") in {"revolute", "continuous", "prismatic"}
        and "mimic" not in node
    ]
