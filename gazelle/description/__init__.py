"""Description of a world: plain data in SDF's vocabulary, SI units and radians.

A description is never changed once read: make a changed one with
``dataclasses.replace``. All poses are resolved: a link's is in its model's frame, a
collision's, visual's or sensor's in its link's, a joint's in its child link's.
"""

from gazelle.description.content import FileContent
from gazelle.description.geometry import (
    Box,
    Capsule,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    Image,
    Mesh,
    Plane,
    Polyline,
    Sphere,
)
from gazelle.description.inertial import Inertia, Inertial
from gazelle.description.joint import (
    Joint,
    JointAxis,
    JointPhysics,
    JointType,
    Mimic,
    SafetyController,
)
from gazelle.description.light import Attenuation, Light
from gazelle.description.link import Collision, Link, Visual
from gazelle.description.material import Color, Material
from gazelle.description.model import TRANSMISSION_WIDTHS, Frame, Model, PlacedModel, Transmission
from gazelle.description.noise import Noise, NoiseType
from gazelle.description.occupancy import OccupancyMap
from gazelle.description.parameters import Parameters
from gazelle.description.physics import Ode, Physics
from gazelle.description.plugin import Plugin
from gazelle.description.pose import Pose, Quaternion, Vector3
from gazelle.description.sensor import Camera, ContactSensor, Imu, Lidar, Scan, Sensor
from gazelle.description.source import Source
from gazelle.description.srdf import (
    DisabledCollision,
    EndEffector,
    JointGroup,
    JointGroupState,
    Semantics,
    VirtualJoint,
)
from gazelle.description.surface import Bounce, Contact, Friction, Surface, TorsionalFriction
from gazelle.description.world import Atmosphere, Scene, SphericalCoordinates, World

__all__ = [
    "TRANSMISSION_WIDTHS",
    "Atmosphere",
    "Attenuation",
    "Bounce",
    "Box",
    "Camera",
    "Capsule",
    "Collision",
    "Color",
    "Cone",
    "Contact",
    "ContactSensor",
    "Cylinder",
    "DisabledCollision",
    "Ellipsoid",
    "Empty",
    "EndEffector",
    "FileContent",
    "Frame",
    "Friction",
    "Geometry",
    "Heightmap",
    "Image",
    "Imu",
    "Inertia",
    "Inertial",
    "Joint",
    "JointAxis",
    "JointGroup",
    "JointGroupState",
    "JointPhysics",
    "JointType",
    "Lidar",
    "Light",
    "Link",
    "Material",
    "Mesh",
    "Mimic",
    "Model",
    "Noise",
    "NoiseType",
    "OccupancyMap",
    "Ode",
    "Parameters",
    "Physics",
    "PlacedModel",
    "Plane",
    "Plugin",
    "Polyline",
    "Pose",
    "Quaternion",
    "SafetyController",
    "Scan",
    "Scene",
    "Semantics",
    "Sensor",
    "Source",
    "Sphere",
    "SphericalCoordinates",
    "Surface",
    "TorsionalFriction",
    "Transmission",
    "Vector3",
    "VirtualJoint",
    "Visual",
    "World",
]
