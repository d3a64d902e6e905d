"""``<gazebo>`` elements: what URDF itself has no words for."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import TypeVar

from gazelle.description import (
    Collision,
    Contact,
    Friction,
    Joint,
    JointPhysics,
    Light,
    Link,
    Model,
    Parameters,
    Pose,
    Sensor,
)
from gazelle.formats.write.element import element, group, leaf
from gazelle.formats.write.sdf.joint import write_joint as write_sdf_joint
from gazelle.formats.write.sdf.joint import write_joint_physics
from gazelle.formats.write.sdf.link import visual_extras, write_light, write_material
from gazelle.formats.write.sdf.plugin import write_plugin
from gazelle.formats.write.sdf.sensor import write_sensor
from gazelle.formats.write.sdf.surface import write_surface
from gazelle.formats.write.urdf.link import (
    moved,
    plain_material,
    read_names,
    surface_link,
    surfaces,
    visuals_of,
)
from gazelle.formats.write.urdf.tree import WORLD, WrittenTree
from gazelle.formats.write.writing import Writing

PartT = TypeVar("PartT", Sensor, Light)


def gazebo_of_link(link: Link, shift: Pose, writing: Writing) -> Parameters | None:
    """Return surfaces, materials, sensors and flags of a link."""
    names = read_names(link)
    solid = surfaces(link)
    return _referring(
        link.name,
        *(_surface(solid[0][0]) if solid else ()),
        *_visuals(link, writing),
        leaf("turnGravityOff", not link.gravity, False),
        leaf("selfCollide", link.self_collide),
        leaf("enable_wind", link.enable_wind, False),
        leaf("kinematic", link.kinematic, False),
        group(
            "velocity_decay",
            leaf("linear", link.velocity_decay_linear, 0.0),
            leaf("angular", link.velocity_decay_angular, 0.0),
        ),
        *(write_sensor(_watching(_placed(each, shift), names)) for each in link.sensors),
        *(write_light(_placed(light, shift)) for light in link.lights),
        *link.extras,
    )


def gazebo_of_joint(joint: Joint, shift: Pose) -> Parameters | None:
    """Return springs, engine terms and sensors of a joint, and the mark of a kept fixed one."""
    axis = joint.axes[0] if joint.axes else None
    return _referring(
        joint.name,
        leaf("preserveFixedJoint", True) if joint.type == "fixed" else None,
        None if axis is None else leaf("springReference", axis.spring_reference, 0.0),
        None if axis is None else leaf("springStiffness", axis.spring_stiffness, 0.0),
        *_physics(joint.physics),
        *(write_sensor(_placed(sensor, shift)) for sensor in joint.sensors),
    )


def gazebo_of_model(model: Model, tree: WrittenTree, writing: Writing) -> Parameters | None:
    """Return flags, plugins, and joints that close loops, in SDF's words."""
    held = any(joint.parent == WORLD for joint in tree.joints.values())
    loops = (
        replace(joint, pose=moved(tree.shifts[joint.child], joint.pose)) for joint in tree.loops
    )
    return group(
        "gazebo",
        leaf("static", model.static) if held or model.static else None,
        leaf("self_collide", model.self_collide, False),
        leaf("allow_auto_disable", model.allow_auto_disable, True),
        leaf("enable_wind", model.enable_wind, False),
        *(write_sdf_joint(joint, writing) for joint in loops),
        *model.extras,
        *map(write_plugin, model.plugins),
    )


def _referring(name: str, *children: Parameters | None) -> Parameters | None:
    found = element("gazebo", *children, reference=name)
    return found if found.children else None


def _placed(part: PartT, shift: Pose) -> PartT:
    return replace(part, pose=moved(shift, part.pose))


def gazebo_of_surface(link: Link, group: int) -> Parameters | None:
    """Return the surface of a link that holds further collisions of another one."""
    return _referring(surface_link(link, group), *_surface(surfaces(link)[group][0]))


def _surface(first: Collision) -> Iterable[Parameters | None]:
    """Return contact terms of a collision, which all of its link share."""
    friction, contact = first.surface.friction, first.surface.contact
    usual, normal = Friction(), Contact()
    rest = replace(
        first.surface,
        friction=replace(friction, mu=usual.mu, mu2=usual.mu2, fdir1=usual.fdir1),
        contact=replace(
            contact,
            kp=normal.kp,
            kd=normal.kd,
            max_vel=normal.max_vel,
            min_depth=normal.min_depth,
        ),
    )
    return (
        leaf("mu1", friction.mu, usual.mu),
        leaf("mu2", friction.mu2, usual.mu2),
        leaf("fdir1", friction.fdir1, usual.fdir1),
        leaf("kp", contact.kp, normal.kp),
        leaf("kd", contact.kd, normal.kd),
        leaf("maxVel", contact.max_vel, normal.max_vel),
        leaf("minDepth", contact.min_depth, normal.min_depth),
        leaf("maxContacts", first.max_contacts, 10),
        leaf("laserRetro", first.laser_retro, 0.0),
        group("collision", write_surface(rest)),
    )


def _visuals(link: Link, writing: Writing) -> Iterable[Parameters | None]:
    """Return looks, which ``<gazebo>`` assigns to all visuals of a link alike."""
    shown = visuals_of(link)
    if not shown:
        return ()
    first = shown[0]
    material = first.material
    shared = all(visual.material == material for visual in shown)
    if not shared:
        for visual in shown:
            if visual.material is not None and visual.material != plain_material(visual.material):
                writing.note(
                    f"URDF has one full material a link: '{visual.name}' keeps its colour only",
                    visual.source,
                )
    for other in shown[1:]:
        if visual_extras(other) != visual_extras(first):
            writing.note(
                f"URDF has one transparency and shadow a link: '{other.name}' gets those of "
                f"'{first.name}'",
                other.source,
            )
    full = shared and material is not None and material != plain_material(material)
    return (
        group(
            "visual",
            *visual_extras(first),
            write_material(material, writing) if full and material is not None else None,
        ),
    )


def _watching(sensor: Sensor, names: dict[str, str]) -> Sensor:
    if sensor.contact is None:
        return sensor
    watched = tuple(names.get(name, name) for name in sensor.contact.collisions)
    return replace(sensor, contact=replace(sensor.contact, collisions=watched))


def _physics(physics: JointPhysics) -> Iterable[Parameters | None]:
    usual = JointPhysics()
    rest = replace(
        usual,
        cfm=physics.cfm,
        erp=physics.erp,
        suspension_cfm=physics.suspension_cfm,
        suspension_erp=physics.suspension_erp,
    )
    return (
        leaf("provideFeedback", physics.provide_feedback, False),
        leaf("implicitSpringDamper", physics.implicit_spring_damper, False),
        leaf("fudgeFactor", physics.fudge_factor),
        leaf("stopCfm", physics.stop_cfm, usual.stop_cfm),
        leaf("stopErp", physics.stop_erp, usual.stop_erp),
        write_joint_physics(rest),
    )
