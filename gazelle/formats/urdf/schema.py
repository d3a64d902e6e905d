"""Schema of URDF: a check that names unknown elements and attributes.

The elements are those of urdfdom's parser and of the URDF page of the ROS wiki
(wiki.ros.org/urdf/XML), and of ``<ros2_control>``. urdfdom passes over all others without a
word, so that a ``<colision>`` collides with nothing.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from gazelle.description import Parameters
from gazelle.errors import did_you_mean
from gazelle.formats.reading import Reading


@dataclass(frozen=True, slots=True)
class ElementSchema:
    """Attributes and children that an element may have; whole, if for another reader.

    Attributes:
        attributes: Names.
        children: Elements by tag.
        whole: True if its contents are not checked.
    """

    attributes: frozenset[str] = frozenset()
    children: Mapping[str, ElementSchema] = field(default_factory=dict)
    whole: bool = False


def _kind(attributes: str = "", **children: ElementSchema) -> ElementSchema:
    return ElementSchema(frozenset(attributes.split()), children)


_ANY = ElementSchema(whole=True)
_ORIGIN = _kind("xyz rpy quat_xyzw")
_MATERIAL = _kind("name", color=_kind("rgba"), texture=_kind("filename"))
_GEOMETRY = _kind(
    box=_kind("size"),
    capsule=_kind("radius length"),
    cylinder=_kind("radius length"),
    mesh=_kind("filename scale"),
    sphere=_kind("radius"),
)
_LINK = _kind(
    "name type",
    collision=_kind(
        "name group",
        contact_coefficients=_kind("mu kp kd"),
        geometry=_GEOMETRY,
        material=_ANY,  # colours that some programs show
        origin=_ORIGIN,
        verbose=_ANY,
    ),
    inertial=_kind(inertia=_kind("ixx ixy ixz iyy iyz izz"), mass=_kind("value"), origin=_ORIGIN),
    # of Bullet and of the sensor proposal, which urdfdom leaves alone too
    contact=_ANY,
    self_collision_checking=_ANY,
    sensor=_ANY,
    visual=_kind("name", geometry=_GEOMETRY, material=_MATERIAL, origin=_ORIGIN),
)
_JOINT = _kind(
    "name type",
    axis=_kind("xyz rpy"),  # the tutorial of URDF itself writes an rpy
    calibration=_kind("rising falling reference_position"),
    child=_kind("link"),
    dynamics=_kind("damping friction"),
    limit=_kind("lower upper effort velocity acceleration jerk"),
    mimic=_kind("joint multiplier offset"),
    origin=_ORIGIN,
    parent=_kind("link"),
    safety_controller=_kind("soft_lower_limit soft_upper_limit k_position k_velocity"),
)
_ROBOT = _kind(
    "name version",
    gazebo=_ANY,
    joint=_JOINT,
    link=_LINK,
    material=_MATERIAL,
    # of the sensor proposal, of ros2_control, of the PR2, and of other programs
    sensor=_ANY,
    ros2_control=_ANY,
    transmission=_ANY,
    group=_ANY,
    mujoco=_ANY,
    origin=_ORIGIN,
)


def note_unknown(root: Parameters, reading: Reading) -> None:
    """Note unknown elements and attributes of a ``<robot>``."""
    _check(root, _ROBOT, reading)


def _check(node: Parameters, kind: ElementSchema, reading: Reading) -> None:
    if kind.whole:
        return
    for name in node.attributes:
        if name not in kind.attributes and ":" not in name and name != "xmlns":
            reading.note(
                f"the attribute '{name}' is not defined for <{node.tag}> in URDF and was ignored",
                node,
                did_you_mean(name, kind.attributes),
            )
    for child in node.children:
        inner = kind.children.get(child.tag)
        if inner is not None:
            _check(child, inner, reading)
        elif ":" not in child.tag:
            reading.note(
                f"<{child.tag}> is not a URDF element of <{node.tag}> and was ignored",
                child,
                did_you_mean(child.tag, kind.children),
            )
