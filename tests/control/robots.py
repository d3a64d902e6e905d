"""Descriptions of bases and arms for controllers that are tested without a simulation."""

from __future__ import annotations

from gazelle import formats

LINK = """<link name="{name}"><inertial><mass value="1"/><inertia ixx="0.01" iyy="0.01" izz="0.01"
 ixy="0" ixz="0" iyz="0"/></inertial><collision><geometry>{shape}</geometry></collision></link>"""
JOINT = """<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>
<origin xyz="{at}"/><axis xyz="0 1 0"/>{limit}</joint>"""
ROUND = '<cylinder radius="0.11" length="0.05"/>'


def urdf(*parts):
    """Return a robot of a body and some links on joints: (joint, type, place, shape, limit)."""
    text = LINK.format(name="base", shape='<box size="1 1 0.1"/>')
    for name, kind, at, shape, limit in parts:
        text += LINK.format(name=f"{name}_link", shape=shape)
        text += JOINT.format(
            name=name, kind=kind, parent="base", child=f"{name}_link", at=at, limit=limit
        )
    return formats.load_model_string(f'<robot name="r">{text}</robot>')


def wheels(**places):
    """Return a base with round wheels of 0.11 m."""
    return urdf(*((name, "continuous", at, ROUND, "") for name, at in places.items()))


DIFF = wheels(left="0 0.15 0.1", right="0 -0.15 0.1")
TURN = '<limit lower="-2" upper="2" effort="100" velocity="10"/>'
ARM = urdf(
    ("one", "revolute", "0 0 0", ROUND, TURN),
    ("two", "continuous", "1 0 0", ROUND, ""),
    ("slide", "prismatic", "2 0 0", ROUND, '<limit lower="0" upper="5" effort="9" velocity="1"/>'),
)
