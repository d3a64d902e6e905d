"""``<gazebo>`` elements: what URDF itself has no words for.

Their camel-case children and what they mean are those of libsdformat's URDF converter
(sdformat.org, "SDFormat extensions to URDF").
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats import values
from gazelle.formats.reading import Reading
from gazelle.formats.sdf import schema

_YES = {"true", "yes", "1"}

LINK = {
    "canonicalBody", "collision", "dampingFactor", "fdir1", "kd", "kp", "laserRetro", "material",
    "maxContacts", "maxVel", "minDepth", "mu1", "mu2", "selfCollide", "turnGravityOff", "visual",
}  # fmt: skip
"""Children that the converter knows on a link."""

LINK_SDF = {
    "audio_sink", "audio_source", "battery", "enable_wind", "gravity", "kinematic", "light",
    "must_be_base_link", "plugin", "projector", "self_collide", "sensor", "velocity_decay",
}  # fmt: skip
"""Children in SDF's own words, put into the link as they are."""

JOINT = {
    "cfmDamping", "disableFixedJointLumping", "fudgeFactor", "implicitSpringDamper", "physics",
    "plugin", "preserveFixedJoint", "provideFeedback", "sensor", "springReference", "springStiffness",
    "stopCfm", "stopErp",
}  # fmt: skip
"""Children on a joint."""

MODEL = {
    "allow_auto_disable", "canonicalBody", "enable_wind", "gripper", "joint", "link", "model", "plugin",
    "self_collide", "static",
}  # fmt: skip
"""Children of a ``<gazebo>`` without a reference."""


@dataclass(slots=True)
class Extensions:
    """All ``<gazebo>`` elements of a robot, by what they refer to; empty for the model."""

    by_reference: dict[str, list[Parameters]] = field(default_factory=dict)

    def of(self, reference: str) -> Iterator[Parameters]:
        """Yield the children of all elements with that reference, in file order."""
        for node in self.by_reference.get(reference, ()):
            yield from node.children

    def last(self, reference: str, *tags: str) -> Parameters | None:
        """Return the last child with one of the tags, which is the one that counts."""
        found = None
        for child in self.of(reference):
            if child.tag in tags:
                found = child
        return found

    def real(self, reference: str, tag: str, default: float) -> float:
        """Return a number."""
        child = self.last(reference, tag)
        return default if child is None else values.parse_real(child, text(child), f"<{tag}>")

    def yes(self, reference: str, *tags: str) -> bool | None:
        """Return whether a flag is set; None if the file does not set it."""
        child = self.last(reference, *tags)
        return None if child is None else text(child).lower() in _YES


def text(node: Parameters) -> str:
    """Return the value of a child, which may also stand in an attribute."""
    return node.attributes.get("value", "").strip() or node.text


def read_extensions(root: Parameters, reading: Reading) -> Extensions:
    """Read all ``<gazebo>`` elements of a ``<robot>``."""
    extensions = Extensions()
    for node in root.find_all("gazebo"):
        reference = node.attributes.get("reference", "")
        extensions.by_reference.setdefault(reference, []).append(schema.tolerated(node, reading))
    return extensions


def drop_unused(
    extensions: Extensions, links: set[str], joints: set[str], reading: Reading
) -> None:
    """Remove elements without a target, and note them and meaningless children."""
    for reference, nodes in list(extensions.by_reference.items()):
        if reference and reference not in links and reference not in joints:
            reading.note(
                f"<gazebo> refers to '{reference}', which is not a link or joint, and was ignored",
                nodes[0],
                did_you_mean(reference, links | joints),
            )
            del extensions.by_reference[reference]
            continue
        known = _known(reference, links, joints)
        for child in extensions.of(reference):
            if child.tag not in known and ":" not in child.tag:
                reading.note(
                    f"<{child.tag}> in a <gazebo> is not supported here and was ignored",
                    child,
                    did_you_mean(child.tag, known),
                )


def _known(reference: str, links: set[str], joints: set[str]) -> set[str]:
    if not reference:
        return MODEL
    known: set[str] = set()
    if reference in links:
        known |= LINK | LINK_SDF
    if reference in joints:
        known |= JOINT
    return known
