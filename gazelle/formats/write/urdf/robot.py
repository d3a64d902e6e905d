"""``<robot>``: one model as URDF."""

from __future__ import annotations

from collections.abc import Iterator

from gazelle.description import Frame, Link, Model, Parameters, Pose, World
from gazelle.errors import FormatError
from gazelle.formats.write.element import element, inside
from gazelle.formats.write.sdf.model import write_transmission
from gazelle.formats.write.urdf.gazebo import (
    gazebo_of_joint,
    gazebo_of_link,
    gazebo_of_model,
    gazebo_of_surface,
)
from gazelle.formats.write.urdf.joint import write_joint
from gazelle.formats.write.urdf.link import (
    surface_link,
    surfaces,
    write_collisions,
    write_link,
    write_origin,
)
from gazelle.formats.write.urdf.tree import WORLD, WrittenTree, tree_of
from gazelle.formats.write.writing import Writing

_OF_WORLDS = ("extras", "frames", "joints", "lights", "plugins", "states")


def write_urdf(content: World | Model, writing: Writing) -> Parameters:
    """Write the root element.

    Raises:
        FormatError: There is not one model; or it has nested ones, a joint that URDF lacks,
            or no tree of links.
    """
    model = content if isinstance(content, Model) else _only_model(content, writing)
    with inside("model", model):
        if model.models:
            raise FormatError(
                f"URDF has no nested models, such as '{model.models[0].name}'",
                source=model.models[0].source,
            )
        tree = tree_of(model, writing)
        return element("robot", *_content(model, tree, writing), name=model.name)


def _only_model(world: World, writing: Writing) -> Model:
    if len(world.models) != 1:
        raise FormatError(
            f"a URDF holds one model, but this world has {len(world.models)}",
            source=world.source,
            hint="save one of its models" if world.models else None,
        )
    lost = [name for name in _OF_WORLDS if getattr(world, name)]
    if lost:
        writing.note(f"URDF holds only a model: of the world {', '.join(lost)} are left out", None)
    return world.models[0]


def _content(model: Model, tree: WrittenTree, writing: Writing) -> Iterator[Parameters | None]:
    yield write_origin(model.pose)
    joints = list(tree.joints.values())
    if any(joint.parent == WORLD for joint in joints):
        yield element("link", name=WORLD)
    massless = all(link.inertial is None for link in model.links)
    for link in model.links:
        if link.inertial is None and not massless:
            writing.note(
                f"link '{link.name}' has no inertial: SDF's default of 1 kg is written",
                link.source,
            )
        yield write_link(link, tree.shifts[link.name], writing, massless=massless)
        yield from _surfaces(link, tree, writing)
    for joint in joints:
        yield write_joint(joint, tree.origin(joint), writing)
    for frame in model.frames:
        yield from _frame(frame, model, tree, writing)
    for transmission in model.transmissions:
        yield write_transmission(transmission, "transmission")
    for link in model.links:
        yield gazebo_of_link(link, tree.shifts[link.name], writing)
    for joint in joints:
        yield gazebo_of_joint(joint, tree.shifts[joint.child])
    yield gazebo_of_model(model, tree, writing)


def _surfaces(link: Link, tree: WrittenTree, writing: Writing) -> Iterator[Parameters | None]:
    """Yield links for the collisions of a link that have other surfaces than its first."""
    for group in range(1, len(surfaces(link))):
        name = surface_link(link, group)
        shift = tree.shifts[link.name]
        yield element("link", *write_collisions(link, group, shift, writing), name=name)
        yield _fixed(f"{name}_joint", link.name, name, Pose())
        yield gazebo_of_surface(link, group)


def _fixed(name: str, parent: str, child: str, pose: Pose) -> Parameters:
    return element(
        "joint",
        write_origin(pose),
        element("parent", link=parent),
        element("child", link=child),
        name=name,
        type="fixed",
    )


def _frame(frame: Frame, model: Model, tree: WrittenTree, writing: Writing) -> Iterator[Parameters]:
    """Yield a frame as a link without mass, fixed at the frame, which readers lump again."""
    if frame.name in tree.links or frame.name == WORLD:
        writing.note(f"URDF names links only: the frame '{frame.name}' is left out", frame.source)
        return
    link = frame.attached_to or model.canonical_link or model.links[0].name
    if link not in tree.links:
        writing.note(f"the frame '{frame.name}' is on no link and left out", frame.source)
        return
    pose = frame.pose if frame.attached_to else tree.links[link].pose.inverse() * frame.pose
    shift = tree.shifts[link]
    origin = pose if shift == Pose() else shift * pose
    taken = {joint.name for joint in model.joints}
    taken |= {other.joint for other in model.frames if other.name != frame.name}
    name = frame.joint or f"{frame.name}_joint"
    while name in taken:
        name += "_"
    with inside("frame", frame):
        yield element("link", name=frame.name)
        yield _fixed(name, link, frame.name, origin)
