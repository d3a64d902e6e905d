"""Models before they are read: all frames named, so that poses can be resolved.

A model file names frames before it defines them, and a joint may reach into a nested or
included model. So a first pass collects the frames (a ``ModelFrames``), a second one reads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from gazelle.description import Model, Parameters, Pose
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.frames import MODEL, WORLD, NamedFrame, Scope
from gazelle.formats.sdf.pose import frame_of, read_pose

Version = tuple[int, int]


@dataclass(slots=True)
class ModelFrames:
    """A model with known frames.

    Attributes:
        node: The ``<model>``; for an included one, that of its own file.
        version: Of the file it stands in.
        name: Its name, after an include's override.
        pose: As written, in the frame ``relative_to`` of the parent.
        relative_to: Frame of the parent.
        placement_frame: Its own frame that ``pose`` places.
        static: Override of an include; None for the model's own value.
        plugins: ``<plugin>`` elements that an include adds.
        file: File to read it from, when it is another one.
        scope: Its frames.
        nested: Models inside, in file order.
        model: Set when it is already read, as a URDF is.
    """

    node: Parameters
    version: Version
    name: str
    pose: Pose
    relative_to: str = ""
    placement_frame: str = ""
    static: bool | None = None
    plugins: list[Parameters] = field(default_factory=list)
    file: Path | None = None
    scope: Scope = field(default_factory=lambda: Scope(MODEL))
    nested: list[ModelFrames] = field(default_factory=list)
    model: Model | None = None

    @property
    def placed(self) -> Pose:
        """The pose of the model frame in the frame ``relative_to``."""
        if not self.placement_frame:
            return self.pose
        return self.pose * self.scope.pose(self.placement_frame, self.node).inverse()


Includer = Callable[[Parameters, Version, Reading], ModelFrames | None]


def add_model(scope: Scope, draft: ModelFrames) -> None:
    """Add the name of a model to the scope around it."""
    scope.add(
        draft.name, NamedFrame(draft.node, draft.placed, draft.relative_to, scope=draft.scope)
    )


def draft_part(node: Parameters, scope: Scope) -> None:
    """Add the frame of a link, joint or frame; ignore other elements.

    Raises:
        FormatError: It has no name, or one that SDF keeps for itself.
    """
    drafter = _DRAFTERS.get(node.tag)
    if drafter is not None:
        _note_reserved(node, scope)
        drafter(node, scope)


def _note_reserved(node: Parameters, scope: Scope) -> None:
    """Note a reserved name, which Gazebo accepts, unless two frames have it.

    Raises:
        FormatError: It is the name of the model's own frame.
    """
    name = values.attribute(node, "name")
    if name != WORLD and not (len(name) > 4 and name.startswith("__") and name.endswith("__")):
        return
    message = f"SDF keeps the name '{name}' for itself"
    if scope.reading is None or name == MODEL:
        raise values.fail(node, message)
    scope.reading.fault(f"{message}: it was taken", node)


def draft_link(node: Parameters, scope: Scope) -> None:
    """Add a link's frame."""
    pose = node.find("pose")
    name = values.attribute(node, "name")
    scope.add(name, NamedFrame(node, read_pose(pose), frame_of(pose)))


def draft_joint(node: Parameters, scope: Scope) -> None:
    """Add a joint's frame, by default relative to its child's."""
    pose = node.find("pose")
    child = values.word(node, "child")
    name = values.attribute(node, "name")
    scope.add(name, NamedFrame(node, read_pose(pose), frame_of(pose) or child, child))


def draft_frame(node: Parameters, scope: Scope) -> None:
    """Add an explicit frame, which is written in the frame it is attached to."""
    pose = node.find("pose")
    attached = node.attributes.get("attached_to", "")
    name = values.attribute(node, "name")
    scope.add(name, NamedFrame(node, read_pose(pose), frame_of(pose) or attached, attached))


def name_frames(scope: Scope, model: Model) -> None:
    """Add the links, frames and joints of a model that is already read to a scope."""
    for link in model.links:
        place = Parameters("link", source=link.source)
        scope.add(link.name, NamedFrame(place, link.pose))
    for frame in model.frames:
        place = Parameters("frame", source=frame.source)
        entry = NamedFrame(place, frame.pose, frame.attached_to, frame.attached_to)
        scope.add(frame.name, entry)
    for joint in model.joints:
        place = Parameters("joint", source=joint.source)
        scope.add(joint.name, NamedFrame(place, joint.pose, joint.child, joint.child))


_DRAFTERS: dict[str, Callable[[Parameters, Scope], None]] = {
    "frame": draft_frame,
    "joint": draft_joint,
    "link": draft_link,
}
