"""Builders of worlds, models and sensors from Python.

Functions return descriptions of models, lights, sensors and physics; ``WorldBuilder`` combines
them; ``office`` and ``outdoor`` return complete worlds.
"""

from gazelle.builders.controllers import ControlFiles, control_files
from gazelle.builders.errors import BuildError
from gazelle.builders.floors import floor, ground, lamp, sun
from gazelle.builders.furniture import (
    cabinet,
    chair,
    desk,
    office_chair,
    round_table,
    shelf,
    sofa,
    table,
    whiteboard,
)
from gazelle.builders.inertia import solid_inertial
from gazelle.builders.land import Terrain, hills, terrain
from gazelle.builders.laws import (
    PLANETS,
    PRESETS,
    Planet,
    on_planet,
    physics,
    planet,
    with_physics,
)
from gazelle.builders.nature import bush, log, plant, rock, tree
from gazelle.builders.obstacles import random_obstacles, random_plants
from gazelle.builders.paint import PALETTE, Paint, material
from gazelle.builders.placing import Disc, Place, Rectangle, Zone, along, footprints, scatter
from gazelle.builders.plan import plan_places, plan_size, plan_walls
from gazelle.builders.presets import office, outdoor
from gazelle.builders.robots import (
    add_joint_properties,
    add_link_properties,
    add_plugin,
    add_sensor,
    add_transmission,
    add_transmissions,
    keep_fixed_joint,
)
from gazelle.builders.sensors import (
    camera,
    contact_sensor,
    depth_camera,
    gps,
    imu,
    lidar,
    plugin,
)
from gazelle.builders.solids import Part, assemble, box, cylinder, post, slab, sphere
from gazelle.builders.structures import building, fence, road
from gazelle.builders.walling import Opening, door, room, walls, window
from gazelle.builders.world import WorldBuilder

__all__ = [
    "PALETTE",
    "PLANETS",
    "PRESETS",
    "BuildError",
    "ControlFiles",
    "Disc",
    "Opening",
    "Paint",
    "Part",
    "Place",
    "Planet",
    "Rectangle",
    "Terrain",
    "WorldBuilder",
    "Zone",
    "add_joint_properties",
    "add_link_properties",
    "add_plugin",
    "add_sensor",
    "add_transmission",
    "add_transmissions",
    "along",
    "assemble",
    "box",
    "building",
    "bush",
    "cabinet",
    "camera",
    "chair",
    "contact_sensor",
    "control_files",
    "cylinder",
    "depth_camera",
    "desk",
    "door",
    "fence",
    "floor",
    "footprints",
    "gps",
    "ground",
    "hills",
    "imu",
    "keep_fixed_joint",
    "lamp",
    "lidar",
    "log",
    "material",
    "office",
    "office_chair",
    "on_planet",
    "outdoor",
    "physics",
    "plan_places",
    "plan_size",
    "plan_walls",
    "planet",
    "plant",
    "plugin",
    "post",
    "random_obstacles",
    "random_plants",
    "road",
    "rock",
    "room",
    "round_table",
    "scatter",
    "shelf",
    "slab",
    "sofa",
    "solid_inertial",
    "sphere",
    "sun",
    "table",
    "terrain",
    "tree",
    "walls",
    "whiteboard",
    "window",
    "with_physics",
]
