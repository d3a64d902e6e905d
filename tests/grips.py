"""Two fingers, what they grip, and how far what is held creeps."""

import numpy as np
import scenes

from gazelle.description import (
    Box,
    Capsule,
    Collision,
    Cylinder,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Model,
    Pose,
    Sphere,
)

G, MU, MASS = 9.8, 0.8, 0.5
SHAPES = {
    "box": Box((0.05, 0.05, 0.05)),
    "ball": Sphere(0.025),
    "upright cylinder": Cylinder(0.025, 0.08),
    "capsule": Capsule(0.025, 0.04),
}
MARGIN_OF_TWO = MASS * G / MU  # [N] of each finger


def gripper():
    """Return two fingers on slides, that close along y."""

    def finger(name, y):
        shape = Collision("c", Box((0.06, 0.02, 0.06)), surface=scenes.rubber(MU))
        inertial = Inertial(0.1, inertia=Inertia(1e-4, 1e-4, 1e-4))
        return Link(name, pose=Pose(y=y, z=0.5), inertial=inertial, collisions=(shape,))

    base = Link("base", pose=Pose(z=1.0), inertial=Inertial(1.0, inertia=Inertia(0.01, 0.01, 0.01)))
    joints = (
        Joint("hold", "fixed", "world", "base"),
        Joint("left_joint", "prismatic", "base", "left", axes=(JointAxis((0.0, 1.0, 0.0)),)),
        Joint("right_joint", "prismatic", "base", "right", axes=(JointAxis((0.0, -1.0, 0.0)),)),
    )
    return Model("g", links=(base, finger("left", -0.035), finger("right", 0.035)), joints=joints)


def creep(engine, model, seconds):
    """Return how far a model moves in a minute [mm], from some seconds."""
    start = engine.models[model].placement().position[0].copy()
    engine.step(round(seconds / engine.time_step))
    way = engine.models[model].placement().position[0] - start
    return float(np.linalg.norm(way)) * 1000.0 * 60.0 / seconds
