"""``<model>`` from its draft."""

from __future__ import annotations

from contextlib import nullcontext
from dataclasses import replace

from gazelle.description import Frame, Model, Parameters
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.actor import ACTOR
from gazelle.formats.sdf.frames import Scope
from gazelle.formats.sdf.joint import read_joints
from gazelle.formats.sdf.link import read_link
from gazelle.formats.sdf.model_frames import ModelFrames
from gazelle.formats.sdf.own import own_static, own_transmissions
from gazelle.formats.sdf.plugin import read_plugin, read_plugins
from gazelle.formats.sdf.pose import frame_of, read_pose

_EXTRAS = ("gripper",)


def read_model(draft: ModelFrames, outer: Scope, reading: Reading) -> Model:
    """Read the model, posed in the scope around it."""
    pose = draft.placed
    if draft.relative_to:
        pose = outer.pose(draft.relative_to, draft.node) * pose
    with nullcontext() if draft.file is None else reading.inside(draft.file, draft.node):
        model = _content(draft, reading) if draft.model is None else draft.model
    return replace(
        model,
        name=draft.name,
        pose=pose,
        static=model.static if draft.static is None else draft.static,
        placement_frame=draft.placement_frame,
        plugins=(*model.plugins, *map(read_plugin, draft.plugins)),
    )


def _content(draft: ModelFrames, reading: Reading) -> Model:
    node, scope = draft.node, draft.scope
    static = values.flag(node, "static", default=own_static(node)) or draft.static is True
    if not (static or scope.canonical or scope.missing or _holds_static(draft)):
        reading.fault(f"the model '{draft.name}' has no link", node)
    return Model(
        name=draft.name,
        static=static,
        self_collide=values.flag(node, "self_collide", default=False),
        allow_auto_disable=values.flag(node, "allow_auto_disable", default=True),
        enable_wind=values.flag(node, "enable_wind", default=False),
        canonical_link=node.attributes.get("canonical_link", ""),
        links=tuple(
            read_link(child, scope, reading, static=static) for child in node.find_all("link")
        ),
        joints=read_joints(node, scope, draft.version, reading),
        models=tuple(read_model(inner, scope, reading) for inner in draft.nested),
        frames=tuple(read_frame(child, scope) for child in node.find_all("frame")),
        plugins=read_plugins(node),
        transmissions=own_transmissions(node, reading),
        extras=tuple(child for child in node.children if child.tag in _EXTRAS),
        actor=node.find(f"{ACTOR}/actor"),
        source=node.source,
    )


def _holds_static(draft: ModelFrames) -> bool:
    """Return whether a nested model is static, so that this one needs no link."""
    return any(
        inner.static
        or values.flag(inner.node, "static", default=False)
        or (inner.static is None and _holds_static(inner))
        for inner in draft.nested
    )


def read_frame(node: Parameters, scope: Scope) -> Frame:
    """Read an explicit frame, posed in the link that it moves with."""
    name = values.attribute(node, "name")
    link = scope.link_of(name, node)
    place = node.find("pose")
    if frame_of(place) in {"", link} and node.attributes.get("attached_to", "") == link:
        pose = read_pose(place)
    else:
        pose = scope.pose(name, node)
        if link:
            pose = scope.pose(link, node).inverse() * pose
    return Frame(name=name, attached_to=link, pose=pose, source=node.source)
