"""``<robot>``: a URDF as the model that libsdformat would make of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from gazelle.description import (
    Collision,
    Frame,
    Inertial,
    Joint,
    JointAxis,
    JointPhysics,
    JointType,
    Link,
    Model,
    Parameters,
    Pose,
)
from gazelle.formats import values
from gazelle.formats.inertia_repair import valid_inertial
from gazelle.formats.reading import Reading
from gazelle.formats.sdf.build import made, with_child
from gazelle.formats.sdf.frames import MODEL, Scope
from gazelle.formats.sdf.joint import read_joint_physics, read_joints
from gazelle.formats.sdf.link import read_link
from gazelle.formats.sdf.model import read_model
from gazelle.formats.sdf.model_drafts import draft_model
from gazelle.formats.sdf.model_frames import ModelFrames, add_model, draft_part, name_frames
from gazelle.formats.sdf.own import fixed_whole
from gazelle.formats.sdf.plugin import read_plugin
from gazelle.formats.sdf.pose import read_pose
from gazelle.formats.sdf.sensor import read_sensor
from gazelle.formats.urdf.elements import Paint, read_origin, read_paint
from gazelle.formats.urdf.extensions import LINK_SDF, Extensions, drop_unused, read_extensions
from gazelle.formats.urdf.lump import body_inertial
from gazelle.formats.urdf.lumped_plugins import plugins
from gazelle.formats.urdf.parts import (
    PartReader,
    read_collisions,
    read_lights,
    read_sensors,
    read_visuals,
)
from gazelle.formats.urdf.schema import note_unknown
from gazelle.formats.urdf.transmission import read_transmission
from gazelle.formats.urdf.tree import LumpedLink, UrdfTree, bodies, read_tree, require_links
from gazelle.formats.urdf.upright import upright

_SDF = (1, 7)
"""The version that SDF within a URDF is read as."""
_LINK_EXTRAS = {"audio_sink", "audio_source", "battery", "must_be_base_link", "projector"}


def read_robot(root: Parameters, reading: Reading) -> Model:
    """Read the model of a ``<robot>``, links joined by fixed joints lumped into one.

    Each lumped link stays as a ``Frame`` of the model, so that its name can be found.

    Raises:
        FormatError: The robot is not a tree, has no mass, or an element is wrong.
    """
    require_links(root)
    name = values.attribute(root, "name")
    note_unknown(root, reading)
    tree = read_tree(root, reading)
    extensions = read_extensions(root, reading)
    drop_unused(extensions, set(tree.links), set(tree.joints), reading)
    found = bodies(tree, extensions)
    robot = PartReader(extensions, _paints(root, reading), reading, _poses(found, tree))
    kept = _with_mass(found, root, reading)
    model = Model(
        name=name,
        pose=read_origin(root.find("origin")),
        links=tuple(_link(body, robot) for body in kept),
        joints=tuple(_joint(body, robot) for body in kept if body.joint is not None),
        frames=tuple(frame for body in kept for frame in _frames(body)),
        transmissions=tuple(
            read_transmission(node, reading) for node in root.find_all("transmission")
        ),
        source=root.source,
    )
    return _with_model_extensions(model, robot, plugins(found, extensions))


def _poses(found: Iterable[LumpedLink], tree: UrdfTree) -> dict[str, Pose]:
    """Return poses of links and joints in the model; a joint's frame is that of its child."""
    links = {member.link.name: body.pose * member.pose for body in found for member in body.members}
    joints = {
        name: links[joint.child] for name, joint in tree.joints.items() if joint.child in links
    }
    return {**joints, **links}


def _paints(root: Parameters, reading: Reading) -> dict[str, Paint]:
    """Return materials by name: those of the robot, then those defined in visuals.

    A name stands for its first definition; later ones are ignored, as in urdfdom.
    """
    paints: dict[str, Paint] = {}
    for node in root.find_all("material"):
        paints.setdefault(values.attribute(node, "name"), read_paint(node, reading))
    for link in root.find_all("link"):
        for visual in link.find_all("visual"):
            inline = visual.find("material")
            if inline is not None and inline.children:
                paints.setdefault(inline.attributes.get("name", ""), read_paint(inline, reading))
    paints.pop("", None)
    return paints


def _with_mass(found: list[LumpedLink], root: Parameters, reading: Reading) -> list[LumpedLink]:
    """Return bodies with a mass and a parent with one; others are noted and left out.

    A robot with no mass at all is kept whole: it can still be shown and planned for.
    """
    if all(body_inertial(body) is None for body in found):
        reading.note(
            "no link has a mass: the robot can be shown and planned for, but not simulated",
            root,
            "add an <inertial> to each link that moves",
        )
        return found
    kept: list[LumpedLink] = []
    gone: set[str] = set()
    for body in found:
        if body.parent in gone:
            gone.add(body.name)
        elif body_inertial(body) is None:
            gone.add(body.name)
            below = f", nor are the {len(body.children)} links below it" if body.children else ""
            reading.note(
                f"link '{body.name}' has no mass and is not simulated{below}",
                body.link.node,
                "give it an <inertial>, or join it by a fixed joint to a link that has one",
            )
        else:
            kept.append(body)
    return kept


def _link(body: LumpedLink, robot: PartReader) -> Link:
    names = [member.link.name for member in body.members]
    extensions = robot.extensions
    sdf = _sdf_children(names, extensions)
    gravity = values.flag(sdf, "gravity", default=True)
    self_collide: bool | None = None
    if sdf.find("self_collide") is not None:
        self_collide = values.flag(sdf, "self_collide", default=False)
    damping = 0.0
    for name in names:
        off = extensions.yes(name, "turnGravityOff")
        gravity = gravity if off is None else not off
        own = extensions.yes(name, "selfCollide")
        self_collide = self_collide if own is None else own
        damping = extensions.real(name, "dampingFactor", damping)
    collisions = read_collisions(body, robot)
    return Link(
        name=body.name,
        pose=body.pose,
        inertial=_inertial(body, collisions, robot.reading),
        collisions=collisions,
        visuals=read_visuals(body, robot),
        sensors=read_sensors(body, robot),
        lights=read_lights(body, robot),
        gravity=gravity,
        enable_wind=values.flag(sdf, "enable_wind", default=False),
        self_collide=self_collide,
        kinematic=values.flag(sdf, "kinematic", default=False),
        velocity_decay_linear=values.real(sdf, "velocity_decay/linear", damping),
        velocity_decay_angular=values.real(sdf, "velocity_decay/angular", damping),
        extras=tuple(_extras(body, extensions)),
        source=body.link.node.source,
    )


def _extras(body: LumpedLink, extensions: Extensions) -> Iterator[Parameters]:
    """Yield elements that are kept unchanged; a projector of a lumped link keeps its pose."""
    for member in body.members:
        for child in extensions.of(member.link.name):
            if child.tag not in _LINK_EXTRAS:
                continue
            if child.tag == "projector" and member.joint is not None:
                place = upright(member.pose * read_pose(child.find("pose")))
                numbers = " ".join(map(repr, (*place.position, *place.rpy)))
                yield with_child(child, made("pose", numbers, like=child))
            else:
                yield child


def _inertial(
    body: LumpedLink, collisions: tuple[Collision, ...], reading: Reading
) -> Inertial | None:
    inertial = body_inertial(body)
    if inertial is None:
        return None
    node = body.link.node.find("inertial") or body.link.node
    return valid_inertial(inertial, collisions, node, reading)


def _sdf_children(names: list[str], extensions: Extensions) -> Parameters:
    """Return SDF children of all links of a body, as those of one ``<link>``."""
    children = [child for name in names for child in extensions.of(name) if child.tag in LINK_SDF]
    return Parameters("link", children=tuple(children))


def _frames(body: LumpedLink) -> list[Frame]:
    return [
        Frame(
            member.link.name,
            body.name,
            member.pose,
            member.link.node.source,
            member.joint.name if member.joint else "",
        )
        for member in body.members[1:]
    ]


def _joint(body: LumpedLink, robot: PartReader) -> Joint:
    joint = body.joint
    if joint is None:
        raise values.fail(body.link.node, "the root has no joint")
    extensions = robot.extensions
    kind: JointType = "revolute" if joint.type == "continuous" else joint.type
    axes = () if joint.axis is None else (_axis(joint.axis, joint.name, extensions),)
    preserved = extensions.yes(joint.name, "preserveFixedJoint")
    unlumped = extensions.yes(joint.name, "disableFixedJointLumping")
    if kind == "fixed" and unlumped and not preserved:
        kind, axes = "revolute", (JointAxis(lower=0.0, upper=0.0),)
    return Joint(
        name=joint.name,
        type=kind,
        parent=body.parent,
        child=body.name,
        axes=axes,
        physics=_physics(joint.name, extensions),
        safety=joint.safety,
        sensors=tuple(
            read_sensor(node, lambda part: read_pose(part.find("pose")))
            for node in extensions.of(joint.name)
            if node.tag == "sensor" and joint.name not in {body.name, body.parent}
        ),
        source=joint.node.source,
    )


def _axis(axis: JointAxis, joint: str, extensions: Extensions) -> JointAxis:
    return replace(
        axis,
        spring_reference=extensions.real(joint, "springReference", axis.spring_reference),
        spring_stiffness=extensions.real(joint, "springStiffness", axis.spring_stiffness),
    )


def _physics(joint: str, extensions: Extensions) -> JointPhysics:
    physics = read_joint_physics(extensions.last(joint, "physics"))
    feedback = extensions.yes(joint, "provideFeedback")
    damper = extensions.yes(joint, "implicitSpringDamper", "cfmDamping")
    fudge = extensions.last(joint, "fudgeFactor")
    return replace(
        physics,
        provide_feedback=physics.provide_feedback if feedback is None else feedback,
        implicit_spring_damper=physics.implicit_spring_damper if damper is None else damper,
        fudge_factor=physics.fudge_factor
        if fudge is None
        else extensions.real(joint, "fudgeFactor", 0.0),
        stop_cfm=extensions.real(joint, "stopCfm", physics.stop_cfm),
        stop_erp=extensions.real(joint, "stopErp", physics.stop_erp),
    )


def _with_model_extensions(
    model: Model, robot: PartReader, plugin_nodes: tuple[Parameters, ...]
) -> Model:
    """Add plugins, SDF links and joints, and flags of ``<gazebo>`` elements without a reference.

    Plugins on a link become the model's, as Gazebo runs them there.
    """
    extensions = robot.extensions
    nodes = list(extensions.of(""))
    sdf = Parameters("model", children=tuple(reversed(nodes)))
    scope = Scope(MODEL, canonical=model.links[0].name if model.links else "")
    name_frames(scope, model)
    nested = _draft_parts(nodes, scope, robot.reading)
    static = extensions.yes("", "static")
    return replace(
        model,
        static=fixed_whole(model) if static is None else static,
        self_collide=values.flag(sdf, "self_collide", default=False),
        allow_auto_disable=values.flag(sdf, "allow_auto_disable", default=True),
        enable_wind=values.flag(sdf, "enable_wind", default=False),
        links=(
            *model.links,
            *(read_link(node, scope, robot.reading) for node in nodes if node.tag == "link"),
        ),
        joints=(
            *model.joints,
            *read_joints(Parameters("model", children=tuple(nodes)), scope, _SDF, robot.reading),
        ),
        models=tuple(read_model(inner, scope, robot.reading) for inner in nested),
        plugins=tuple(map(read_plugin, plugin_nodes)),
        extras=tuple(node for node in nodes if node.tag == "gripper"),
    )


def _draft_parts(nodes: list[Parameters], scope: Scope, reading: Reading) -> list[ModelFrames]:
    """Return the SDF models among some elements; the scope has the frames of all of them then.

    A joint may be called as the model that it holds, and means that model's links.
    """
    nested = [draft_model(node, _SDF, reading, _leave_out) for node in nodes if node.tag == "model"]
    for inner in nested:
        add_model(scope, inner)
    for node in nodes:
        draft_part(node, scope)
    return nested


def _leave_out(node: Parameters, _: tuple[int, int], reading: Reading) -> None:
    """Note that an ``<include>`` within a URDF is left out."""
    reading.note("an <include> within a URDF is left out", node)
