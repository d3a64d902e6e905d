"""Small models with one plugin each, as text."""

import gazelle
from gazelle import formats

GROUND = "<include><uri>model://ground_plane</uri></include>"


def base(plugin, wheels=4, *, mu=1.0):
    """Return a box on wheels of radius 0.1 m, 0.4 m between the sides, with a plugin."""
    places = [(0.2, 0.2), (0.2, -0.2), (-0.2, 0.2), (-0.2, -0.2)][:wheels]
    parts = []
    for i, (x, y) in enumerate(places):
        parts.append(
            f"""<link name="wheel{i}"><pose>{x} {y} 0.1 -1.5707963 0 0</pose>
            <inertial><mass>0.5</mass><inertia><ixx>0.002</ixx><iyy>0.002</iyy><izz>0.002</izz>
            </inertia></inertial><collision name="c"><geometry><cylinder><radius>0.1</radius>
            <length>0.04</length></cylinder></geometry><surface><friction><ode><mu>{mu}</mu>
            <mu2>{mu}</mu2></ode></friction></surface></collision></link>
            <joint name="joint{i}" type="revolute"><parent>body</parent><child>wheel{i}</child>
            <axis><xyz>0 0 1</xyz></axis></joint>"""
        )
    return f"""<model name="base"><link name="body"><pose>0 0 0.12 0 0 0</pose><inertial>
    <mass>4</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
    <collision name="c"><geometry><box><size>0.5 0.3 0.08</size></box></geometry></collision>
    </link>{"".join(parts)}{plugin}</model>"""


def block(inside="", plugin="", *, gravity=True):
    """Return a cube of 1 kg and 0.2 m, half a metre up."""
    return f"""<model name="cube"><pose>0 0 0.5 0 0 0</pose><link name="core">
    <gravity>{int(gravity)}</gravity><inertial><mass>1</mass><inertia><ixx>0.01</ixx>
    <iyy>0.01</iyy><izz>0.01</izz></inertia></inertial><collision name="hull"><geometry><box>
    <size>0.2 0.2 0.2</size></box></geometry></collision>{inside}</link>{plugin}</model>"""


def simulate(*models, nworld=1, ground=True, **options):
    """Return a running simulation of some models on the ground."""
    text = f"""<sdf version="1.6"><world name="w">{GROUND if ground else ""}{"".join(models)}
    </world></sdf>"""
    return gazelle.Simulation(formats.load_string(text), nworld=nworld, **options)


def plugin(filename, **tags):
    """Return a ``<plugin>`` with its tags."""
    inside = "".join(f"<{tag}>{text}</{tag}>" for tag, text in tags.items())
    return f'<plugin name="p" filename="{filename}">{inside}</plugin>'
