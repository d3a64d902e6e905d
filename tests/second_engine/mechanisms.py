"""Mechanisms of the ten scenes, built from primitive links."""

from __future__ import annotations

import math

from gazelle.description import (
    Box,
    Collision,
    Cylinder,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Link,
    Mimic,
    Model,
    Pose,
    Surface,
)

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def rod(name, length, mass, *, pose=None, along=Z, thick=0.04):
    """Return a link whose frame is at one end of a rod, as a mechanism has it."""
    across, long = mass * thick**2 / 6.0, mass * (length**2 + thick**2) / 12.0
    moments = [across if a else long for a in along]
    centre = Pose(*(0.5 * length * a for a in along))
    return Link(name, pose=pose or Pose(), inertial=Inertial(mass, centre, Inertia(*moments)))


def hinge(name, parent, child, axis=Y, *, pose=None, **options):
    axes = (JointAxis(axis, **options),)
    return Joint(name, "continuous", parent, child, pose=pose or Pose(), axes=axes)


def pendulum():
    return Model("m", links=(rod("rod", 0.5, 1.0),), joints=(hinge("swing", "world", "rod"),))


def double_pendulum():
    """Return rods of different length and mass, so that no term cancels."""
    links = (rod("upper", 0.5, 1.0), rod("lower", 0.3, 0.7, pose=Pose(z=0.5)))
    joints = (hinge("shoulder", "world", "upper"), hinge("elbow", "upper", "lower"))
    return Model("m", links=links, joints=joints)


def four_bar(crank_angle=1.0):
    """Return a crank of 0.2 m, a coupler of 0.5 m and a rocker of 0.4 m, 0.55 m apart.

    The crank starts at an angle [rad] above the ground; coupler and rocker close the triangle.
    """
    crank, coupler, rocker, apart = 0.2, 0.5, 0.4, 0.55
    end = (crank * math.cos(crank_angle), crank * math.sin(crank_angle))
    span = math.dist(end, (apart, 0.0))
    sight = math.atan2(-end[1], apart - end[0])
    at_crank = math.acos((span**2 + coupler**2 - rocker**2) / (2 * span * coupler))
    at_foot = math.acos((span**2 + rocker**2 - coupler**2) / (2 * span * rocker))
    rise, lean = sight + at_crank, sight + math.pi - at_foot
    links = (
        rod("crank", crank, 0.5, pose=Pose(pitch=-crank_angle), along=X),
        rod("coupler", coupler, 0.8, pose=Pose(x=end[0], z=end[1], pitch=-rise), along=X),
        rod("rocker", rocker, 0.6, pose=Pose(x=apart, pitch=-lean), along=X),
    )
    joints = (
        hinge("drive", "world", "crank"),
        hinge("knee", "crank", "coupler"),
        hinge("foot", "world", "rocker"),
        hinge("close", "coupler", "rocker", pose=Pose(x=rocker)),
    )
    return Model("m", links=links, joints=joints)


# Length [m], mass [kg], direction, axis and damping [N m s/rad] of the links of an arm.
_ARM = (
    (0.15, 4.0, Z, Z, 3.0),
    (0.40, 6.0, X, Y, 3.0),
    (0.35, 3.0, X, Y, 2.0),
    (0.10, 1.2, X, X, 0.3),
    (0.10, 1.0, X, Y, 0.3),
    (0.06, 0.4, X, X, 0.1),
)


def arm():
    """Return six axes of an industrial arm: base, shoulder, elbow, three of the wrist."""
    links, joints, end, parent = [], [], Pose(z=0.2), "world"
    for index, (length, mass, along, axis, damping) in enumerate(_ARM, start=1):
        name = f"link_{index}"
        links.append(rod(name, length, mass, pose=end, along=along, thick=0.08))
        joints.append(hinge(f"joint_{index}", parent, name, axis, damping=damping))
        end = end * Pose(*(length * a for a in along))
        parent = name
    return Model("m", links=tuple(links), joints=tuple(joints))


def gripper():
    """Return a finger that is pushed, and a heavier one that follows it at half the speed."""

    def finger(name, mass, y):
        inertia = Inertia(mass * 1e-3, mass * 1e-3, mass * 1e-3)
        return Link(name, pose=Pose(y=y), inertial=Inertial(mass, Pose(z=0.03), inertia))

    push = JointAxis(Y, lower=-0.04, upper=0.04, damping=2.0)
    follow = JointAxis((0.0, -1.0, 0.0), damping=1.0, mimic=Mimic("left", multiplier=0.5))
    joints = (
        Joint("left", "prismatic", "world", "left_finger", axes=(push,)),
        Joint("right", "prismatic", "world", "right_finger", axes=(follow,)),
    )
    links = (finger("left_finger", 0.2, -0.05), finger("right_finger", 0.5, 0.05))
    return Model("m", links=links, joints=joints)


def wheel(mu):
    """Return a cylinder on its rim, free to roll along x."""
    mass, radius, length = 2.0, 0.1, 0.06
    round_, across = mass * radius**2 / 2, mass * (3 * radius**2 + length**2) / 12
    surface = Surface(Friction(mu, mu))
    flat = Pose(roll=math.pi / 2)
    return Model(
        "wheel",
        pose=Pose(z=radius),
        links=(
            Link(
                "link",
                inertial=Inertial(mass, flat, Inertia(across, across, round_)),
                collisions=(Collision("c", Cylinder(radius, length), flat, surface),),
            ),
        ),
    )


def tall_box(name, size, mass, mu, pose):
    """Return a free box."""
    x, y, z = size
    moments = (mass / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y))
    collision = Collision("c", Box(size), surface=Surface(Friction(mu, mu)))
    link = Link("link", inertial=Inertial(mass, inertia=Inertia(*moments)), collisions=(collision,))
    return Model(name, pose=pose, links=(link,))
