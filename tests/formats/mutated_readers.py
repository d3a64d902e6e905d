"""Readers of descriptions: worlds, robots, maps, meshes, pictures.

Readers return nothing; they raise what Gazelle raises.
"""

from __future__ import annotations

import re
from pathlib import Path

import gazelle
from gazelle import formats
from gazelle.formats.lint import lint

ARM = "fetch"
"""The bundled robot that parameters of arms are read for."""

MESHED = """<sdf version='1.6'><world name='w'><model name='s'><static>1</static><link name='l'>
<collision name='c'><geometry><mesh><uri>{0}</uri></mesh></geometry></collision><visual name='v'><geometry>
<mesh><uri>{0}</uri></mesh></geometry></visual></link></model><model name='m'><pose>9 0 9 0 0 0</pose>
<link name='l'><collision name='c'><geometry><mesh><uri>{0}</uri></mesh></geometry></collision></link>
</model></world></sdf>"""
PAINTED = """<sdf version='1.6'><world name='w'><model name='m'><static>1</static><link name='l'>
<visual name='v'><geometry><box><size>1 1 1</size></box></geometry><material><script><uri>{0}</uri>
<name>{1}</name></script></material></visual></link></model></world></sdf>"""
HILLS = """<sdf version='1.6'><world name='w'><model name='m'><static>1</static><link name='l'>
<collision name='c'><geometry><heightmap><uri>{0}</uri><size>9 9 2</size></heightmap></geometry></collision>
</link></model></world></sdf>"""
MAPPED = "image: {0}\nresolution: 0.1\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.2\n"


def simulated(world: gazelle.description.World) -> None:
    """Run a step, and draw a picture."""
    from gazelle.sensors import View, look_at

    if not any(placed.model.links for model in world.models for placed in model.walk()):
        return
    with gazelle.Simulation(world) as sim:
        sim.step(1)
        sim.render(View(look_at((3.0, 3.0, 3.0), (0.0, 0.0, 0.0)), 8, 8))


def description(path: Path) -> None:
    """Check, load, lint, write, run."""
    world = formats.load(path)
    lint(world)
    formats.to_string(world, "sdf")
    simulated(world)


def robot(path: Path) -> None:
    """Read a robot like `description`, and plan."""
    from gazelle.kinematics import RobotModel

    description(path)
    model = formats.load_model(path)
    formats.to_string(model, "urdf")
    RobotModel(model)


def stage(path: Path) -> None:
    """Run a step of Stage's world."""
    from gazelle.stage import StageSimulation

    formats.check(path)
    with StageSimulation(path) as sim:
        sim.step(1)


def stage_part(path: Path) -> None:
    """Read a file that a world includes."""
    world = path.with_name("mutated_including.world")
    world.write_text(f'include "{path.name}"\nfloorplan model()\n')
    stage(world)


def occupancy(path: Path) -> None:
    """Read a map, and its world."""
    formats.load_map(path)
    simulated(formats.load(path))


def map_picture(path: Path) -> None:
    """Read the picture of a map."""
    about = path.with_name("mutated_about.yaml")
    about.write_text(MAPPED.format(path.name))
    occupancy(about)


def _world_around(path: Path, text: str) -> None:
    world = path.with_name("mutated_around.world")
    world.write_text(text)
    description(world)


def mesh(path: Path) -> None:
    """Read a body that moves and one that does not."""
    _world_around(path, MESHED.format(path.name))


def texture(path: Path) -> None:
    """Read a picture as elevations and as colour."""
    _world_around(path, HILLS.format(path.name))


def material(path: Path) -> None:
    """Read a script of materials."""
    found = re.search(rb"^material\s+(\w+)", path.read_bytes(), re.MULTILINE)
    name = found[1].decode("ascii", "replace") if found else "a"
    _world_around(path, PAINTED.format(path.name, name))


def model_folder(path: Path) -> None:
    """Read the manifest of a model."""
    description(path.parent)


def semantics(path: Path) -> None:
    """Read an SRDF, with its robot."""
    from gazelle.kinematics import RobotModel

    formats.check(path, urdf=ARM)
    RobotModel(formats.load_model(ARM), formats.load_srdf(path))
