"""``<model>`` with its frames and transmissions."""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Frame, Model, Parameters, Transmission
from gazelle.errors import FormatError
from gazelle.formats.sdf.own import STATIC, TRANSMISSION, fixed_whole
from gazelle.formats.write.element import distinct, element, inside, leaf, pose_leaf
from gazelle.formats.write.sdf.joint import write_joint
from gazelle.formats.write.sdf.link import write_link
from gazelle.formats.write.sdf.plugin import write_plugin
from gazelle.formats.write.writing import Writing


def write_model(model: Model, writing: Writing) -> Parameters:
    """Write a model and all that is nested in it."""
    with inside("model", model):
        if model.actor is not None:
            return write_actor(model, model.actor)
        _refuse_unreadable(model)
        return element(
            "model",
            pose_leaf(model.pose),
            leaf(STATIC if _held_by_joints(model) else "static", model.static, False),
            leaf("self_collide", model.self_collide, False),
            leaf("allow_auto_disable", model.allow_auto_disable, True),
            leaf("enable_wind", model.enable_wind, False),
            *(write_link(link, writing, static=model.static) for link in model.links),
            *(write_joint(joint, writing) for joint in model.joints),
            *map(write_frame, model.frames),
            *(write_part(nested, writing) for nested in model.models),
            *model.extras,
            *map(write_plugin, model.plugins),
            *(write_transmission(each, TRANSMISSION) for each in model.transmissions),
            name=model.name,
            canonical_link=model.canonical_link,
        )


def write_actor(model: Model, actor: Parameters) -> Parameters:
    """Write the actor that a model stands for, where the model is now."""
    return element("actor", pose_leaf(model.pose), *actor.children, name=model.name)


def write_part(model: Model, writing: Writing) -> Parameters:
    """Write a model of a world or of a model.

    One without links is saved as static, as which readers take it: nothing moves it anyway.
    """
    if not _is_complete(model):
        writing.note(
            f"the model '{model.name}' has no link and is saved as static",
            model.source,
            hint="perhaps what it includes was not found",
        )
        model = replace(model, static=True)
    return write_model(model, writing)


def _held_by_joints(model: Model) -> bool:
    """Return whether the model is a robot of a URDF, static only since its joints hold all of it."""
    element = (model.source.element if model.source is not None else None) or ""
    return element.startswith("robot") and bool(model.links) and fixed_whole(model)


def _is_complete(model: Model) -> bool:
    """Return whether readers accept the model: it has a link, or is static."""
    return any(placed.model.static or placed.model.links for placed in model.walk())


def _refuse_unreadable(model: Model) -> None:
    for tag, parts in (
        ("link", model.links),
        ("joint", model.joints),
        ("frame", model.frames),
        ("model", model.models),
    ):
        distinct(tag, parts)
    if not _is_complete(model):
        raise FormatError(
            f"the model '{model.name}' has no link",
            hint="give it one, or make it static; perhaps what it includes was not found",
        )


def write_frame(frame: Frame) -> Parameters:
    """Write ``<frame>``."""
    with inside("frame", frame):
        return element(
            "frame", pose_leaf(frame.pose), name=frame.name, attached_to=frame.attached_to
        )


def write_transmission(transmission: Transmission, tag: str) -> Parameters:
    """Write URDF's ``<transmission>``."""
    count = len(transmission.joints)
    numbers = zip(
        transmission.joint_roles or ("",) * count,
        transmission.offsets or (0.0,) * count,
        transmission.joint_reductions or (1.0,) * count,
        strict=True,
    )
    joints = (
        element(
            "joint",
            leaf("role", role, ""),
            *(leaf("hardwareInterface", i) for i in interfaces),
            leaf("offset", offset, 0.0),
            leaf("mechanicalReduction", reduction, 1.0),
            name=name,
        )
        for (name, interfaces), (role, offset, reduction) in zip(
            transmission.joints, numbers, strict=True
        )
    )
    roles = transmission.actuator_roles or ("",) * len(transmission.actuators)
    actuators = (
        element(
            "actuator", leaf("role", role, ""), leaf("mechanicalReduction", reduction), name=name
        )
        for (name, reduction), role in zip(transmission.actuators, roles, strict=True)
    )
    return element(
        tag, leaf("type", transmission.type, ""), *joints, *actuators, name=transmission.name
    )
