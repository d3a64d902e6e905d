"""Colours of Gazebo's material scripts, by name.

Figures of plain materials are those of Gazebo classic's ``gazebo.material``. Those made
of a picture have no colour there: a typical one of the thing they show stands in.
"""

from __future__ import annotations

from dataclasses import replace

from gazelle.description import Color, Material

STANDARD = "file://media/materials/scripts/gazebo.material"
"""URI by which files name Gazebo's own scripts."""

URDF_COLOR = "gazelle:color"
"""Attribute of a ``<material>``: the colour of a URDF that its colours were made of."""

_PREFIX = "Gazebo/"

# ambient and diffuse colour of each
_PLAIN: dict[str, tuple[Color, Color]] = {
    "Grey": ((0.3, 0.3, 0.3, 1.0), (0.7, 0.7, 0.7, 1.0)),
    "Gray": ((0.3, 0.3, 0.3, 1.0), (0.7, 0.7, 0.7, 1.0)),
    "DarkGrey": ((0.175, 0.175, 0.175, 1.0), (0.175, 0.175, 0.175, 1.0)),
    "DarkGray": ((0.175, 0.175, 0.175, 1.0), (0.175, 0.175, 0.175, 1.0)),
    "White": ((1.0, 1.0, 1.0, 1.0), (1.0, 1.0, 1.0, 1.0)),
    "FlatBlack": ((0.1, 0.1, 0.1, 1.0), (0.1, 0.1, 0.1, 1.0)),
    "Black": ((0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0, 1.0)),
    "Red": ((1.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0)),
    "RedBright": ((0.87, 0.26, 0.07, 1.0), (0.87, 0.26, 0.07, 1.0)),
    "Green": ((0.0, 1.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)),
    "Blue": ((0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 1.0, 1.0)),
    "SkyBlue": ((0.13, 0.44, 0.7, 1.0), (0.0, 0.0, 1.0, 1.0)),
    "Yellow": ((1.0, 1.0, 0.0, 1.0), (1.0, 1.0, 0.0, 1.0)),
    "ZincYellow": ((0.9725, 0.9529, 0.2078, 1.0), (0.9725, 0.9529, 0.2078, 1.0)),
    "DarkYellow": ((0.7, 0.7, 0.0, 1.0), (0.7, 0.7, 0.0, 1.0)),
    "Purple": ((1.0, 0.0, 1.0, 1.0), (1.0, 0.0, 1.0, 1.0)),
    "Turquoise": ((0.0, 1.0, 1.0, 1.0), (0.0, 1.0, 1.0, 1.0)),
    "Orange": ((1.0, 0.5088, 0.0468, 1.0), (1.0, 0.5088, 0.0468, 1.0)),
    "Indigo": ((0.33, 0.0, 0.5, 1.0), (0.33, 0.0, 0.5, 1.0)),
    "WhiteGlow": ((1.0, 1.0, 1.0, 1.0), (1.0, 1.0, 1.0, 1.0)),
    "RedGlow": ((1.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0)),
    "GreenGlow": ((0.0, 1.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)),
    "BlueGlow": ((0.0, 0.0, 1.0, 1.0), (0.0, 0.0, 1.0, 1.0)),
    "YellowGlow": ((1.0, 1.0, 0.0, 1.0), (1.0, 1.0, 0.0, 1.0)),
    "PurpleGlow": ((1.0, 0.0, 1.0, 1.0), (1.0, 0.0, 1.0, 1.0)),
    "TurquoiseGlow": ((0.0, 1.0, 1.0, 1.0), (0.0, 1.0, 1.0, 1.0)),
    "GreenTransparent": ((0.0, 1.0, 0.0, 0.5), (0.0, 1.0, 0.0, 0.5)),
    "BlueTransparent": ((0.0, 0.0, 1.0, 0.5), (0.0, 0.0, 1.0, 0.5)),
    "DarkMagentaTransparent": ((0.6, 0.0, 0.6, 0.5), (0.6, 0.0, 0.6, 0.5)),
    "GreyTransparent": ((0.5, 0.5, 0.5, 0.5), (0.5, 0.5, 0.5, 0.5)),
    "BlackTransparent": ((0.0, 0.0, 0.0, 0.5), (0.0, 0.0, 0.0, 0.5)),
    "YellowTransparent": ((1.0, 1.0, 0.0, 0.5), (1.0, 1.0, 0.0, 0.5)),
    "LightOn": ((0.0, 1.0, 0.0, 1.0), (0.0, 1.0, 0.0, 1.0)),
    "LightOff": ((1.0, 0.0, 0.0, 1.0), (1.0, 0.0, 0.0, 1.0)),
    "LightBlueLaser": ((0.5, 0.5, 1.0, 0.4), (0.5, 0.5, 1.0, 0.4)),
    "BlueLaser": ((0.0, 0.0, 1.0, 0.4), (0.0, 0.0, 1.0, 0.4)),
    "OrangeTransparent": ((1.0, 0.44, 0.0, 0.5), (1.0, 0.44, 0.0, 0.5)),
    "Pioneer2Body": ((0.481193, 0.000123, 0.000123, 1.0), (0.681193, 0.000923, 0.000923, 1.0)),
    "Gold": ((0.4, 0.24869, 0.020759, 1.0), (0.8, 0.64869, 0.120759, 1.0)),
    "RedTransparent": ((1.0, 0.0, 0.0, 0.5), (1.0, 0.0, 0.0, 0.5)),
}

_PICTURES: dict[str, Color] = {
    "Bricks": (0.6, 0.33, 0.26, 1.0),
    "BuildingFrame": (0.6, 0.6, 0.6, 1.0),
    "CeilingTiled": (0.9, 0.9, 0.88, 1.0),
    "CloudySky": (0.6, 0.75, 0.9, 1.0),
    "Footway": (0.6, 0.6, 0.58, 1.0),
    "Grass": (0.3, 0.5, 0.2, 1.0),
    "GreyGradientSky": (0.7, 0.7, 0.7, 1.0),
    "Lane_1": (0.3, 0.3, 0.3, 1.0),
    "Lanes_2": (0.3, 0.3, 0.3, 1.0),
    "Lanes_4": (0.3, 0.3, 0.3, 1.0),
    "Lanes_6": (0.3, 0.3, 0.3, 1.0),
    "Motorway": (0.3, 0.3, 0.3, 1.0),
    "PaintedWall": (0.85, 0.83, 0.78, 1.0),
    "Pedestrian": (0.6, 0.6, 0.58, 1.0),
    "PioneerBody": (0.8, 0.1, 0.1, 1.0),
    "Primary": (0.3, 0.3, 0.3, 1.0),
    "Residential": (0.35, 0.35, 0.35, 1.0),
    "Road": (0.3, 0.3, 0.3, 1.0),
    "Runway": (0.25, 0.25, 0.27, 1.0),
    "Secondary": (0.3, 0.3, 0.3, 1.0),
    "Steps": (0.55, 0.53, 0.5, 1.0),
    "Tertiary": (0.35, 0.35, 0.35, 1.0),
    "Trunk": (0.3, 0.3, 0.3, 1.0),
    "Wood": (0.65, 0.45, 0.26, 1.0),
    "WoodFloor": (0.7, 0.5, 0.3, 1.0),
    "WoodPallet": (0.72, 0.56, 0.36, 1.0),
}


def script_colors(name: str) -> tuple[Color, Color] | None:
    """Return (ambient, diffuse) of a material script such as ``Gazebo/Grey``, or None."""
    short = name.removeprefix(_PREFIX)
    if short in _PLAIN:
        return _PLAIN[short]
    picture = _PICTURES.get(short)
    return None if picture is None else (picture, picture)


def brightened(color: Color) -> Color:
    """Return a URDF's colour as libsdformat writes it, for Gazebo's light of 0.8."""
    red, green, blue, alpha = color
    return (min(1.0, red / 0.8), min(1.0, green / 0.8), min(1.0, blue / 0.8), alpha)


def with_urdf_color(material: Material, color: Color) -> Material:
    """Return the material with a URDF's colour, unless it sets a colour besides its script's."""
    shown = with_script_colors(material)
    return replace(
        shown,
        ambient=shown.ambient or color,
        diffuse=shown.diffuse or color,
        urdf_color=color,
    )


def with_script_colors(material: Material) -> Material:
    """Return the material with its script's colours where it has none of its own."""
    known = None if material.script is None else script_colors(material.script)
    if known is None:
        return material
    return replace(
        material,
        ambient=material.ambient or known[0],
        diffuse=material.diffuse or known[1],
    )
