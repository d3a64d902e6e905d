"""Worlds that tests build from descriptions, without files."""

import math
from dataclasses import replace

from gazelle.description import (
    Box,
    Collision,
    Contact,
    Cylinder,
    Friction,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    Lidar,
    Link,
    Model,
    Noise,
    Parameters,
    Physics,
    Plane,
    Plugin,
    Pose,
    Scan,
    Sensor,
    Sphere,
    Surface,
    World,
)


def rubber(mu=1.0):
    return Surface(Friction(mu, mu), Contact())


def with_surface(model, surface):
    """Return a model of one link with another surface."""
    link = model.links[0]
    collisions = tuple(replace(c, surface=surface) for c in link.collisions)
    return replace(model, links=(replace(link, collisions=collisions),))


def ground(mu=100.0):
    return Model(
        "ground_plane",
        static=True,
        links=(Link("link", collisions=(Collision("c", Plane(), surface=rubber(mu)),)),),
    )


def solid(name, shape, *, mass=1.0, moments=(0.01, 0.01, 0.01), pose=None, mu=1.0, static=False):
    """Return a free body of one shape."""
    inertia = Inertia(*moments)
    link = Link(
        "link",
        inertial=Inertial(mass, inertia=inertia),
        collisions=(Collision("c", shape, surface=rubber(mu)),),
    )
    return Model(name, pose=pose or Pose(), static=static, links=(link,))


def ball(name="ball", radius=0.1, mass=1.0, **options):
    moment = 0.4 * mass * radius**2
    return solid(name, Sphere(radius), mass=mass, moments=(moment,) * 3, **options)


def box(name="box", size=(0.2, 0.2, 0.2), mass=1.0, **options):
    x, y, z = size
    moments = tuple(mass / 12.0 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y))
    return solid(name, Box(size), mass=mass, moments=moments, **options)


def world(*models, step=0.001, gravity=(0.0, 0.0, -9.8)):
    return World("test", models=models, gravity=gravity, physics=(Physics(max_step_size=step),))


def tags(tag, **values):
    return Parameters(tag, children=tuple(Parameters(k, str(v)) for k, v in values.items()))


def drive_plugin(**values):
    settings = {
        "leftJoint": "wheel_left_joint",
        "rightJoint": "wheel_right_joint",
        "wheelSeparation": 0.16,
        "wheelDiameter": 0.066,
        "wheelAcceleration": 1,
        "wheelTorque": 10,
        "updateRate": 30,
        "publishWheelJointState": "true",
        **values,
    }
    return Plugin("drive", "libgazebo_ros_diff_drive.so", tags("plugin", **settings))


def lidar(samples=24, stddev=0.0, **options):
    scan = Scan(samples, min_angle=0.0, max_angle=6.28319)
    noise = Noise("gaussian", stddev=stddev) if stddev else Noise()
    settings = {"range_min": 0.12, "range_max": 3.5, **options}
    return Sensor(
        "lds",
        "ray",
        pose=Pose(x=-0.032, z=0.182),
        update_rate=5.0,
        lidar=Lidar(scan, noise=noise, **settings),
    )


def burger(name="burger", pose=None, samples=24, stddev=0.0, **drive):
    """Return the TurtleBot3 burger's figures, its fixed links lumped into the base."""
    wheel_inertial = Inertial(0.02849894, inertia=Inertia(1.1175580e-5, 1.1192413e-5, 2.0712558e-5))
    surface = rubber(0.1)
    tilt = -1.57

    def wheel(side, y):
        return Link(
            f"wheel_{side}_link",
            pose=Pose(y=y, z=0.033, roll=tilt),
            inertial=wheel_inertial,
            collisions=(Collision("c", Cylinder(0.033, 0.018), surface=surface),),
        )

    base = Link(
        "base_footprint",
        inertial=Inertial(0.944735, Pose(x=-0.0043, z=0.0307), Inertia(0.0060, 0.0059, 0.0041)),
        collisions=(
            Collision("base", Box((0.14, 0.14, 0.143)), Pose(x=-0.032, z=0.08), rubber(1.0)),
            Collision(
                "caster", Box((0.03, 0.009, 0.02)), Pose(-0.081, 0.0, 0.005, roll=tilt), surface
            ),
            Collision("lidar", Cylinder(0.055, 0.0315), Pose(x=-0.017, z=0.1755), rubber(1.0)),
        ),
        sensors=(lidar(samples, stddev), Sensor("imu", "imu", update_rate=100.0)),
    )
    joints = tuple(
        Joint(
            f"wheel_{side}_joint",
            "continuous",
            "base_footprint",
            f"wheel_{side}_link",
            axes=(JointAxis(),),
        )
        for side in ("left", "right")
    )
    return Model(
        name,
        pose=pose or Pose(),
        links=(base, wheel("left", 0.08), wheel("right", -0.08)),
        joints=joints,
        plugins=(drive_plugin(**drive),),
    )


CART_TRACK, CART_RADIUS = 0.5, 0.1


def cart(width, mu=1.0, roll=-1.57, drag=0.3, caster=None, name="cart"):
    """Return two driven wheels, so wide and on axles turned so, and a caster behind."""
    caster = caster or Collision("caster", Sphere(0.02), Pose(-0.3, 0.0, 0.02))
    rubbing = replace(caster, surface=rubber(drag))
    base = Link(
        "base",
        inertial=Inertial(5.0, Pose(x=-0.1, z=0.1), Inertia(0.05, 0.08, 0.1)),
        collisions=(rubbing,),
    )

    def wheel(side, y):
        shape = Collision("c", Cylinder(CART_RADIUS, width), surface=rubber(mu))
        moments = Inertia(0.003, 0.003, 0.005)
        pose = Pose(y=y, z=CART_RADIUS, roll=roll)
        return Link(side, pose=pose, inertial=Inertial(0.5, inertia=moments), collisions=(shape,))

    joints = tuple(
        Joint(f"{side}_joint", "continuous", "base", side, axes=(JointAxis(),))
        for side in ("left", "right")
    )
    links = (base, wheel("left", CART_TRACK / 2.0), wheel("right", -CART_TRACK / 2.0))
    return Model(name, links=links, joints=joints)


def wall(name, x, y, yaw, length=4.0, thickness=0.15):
    shape = Box((length, thickness, 0.5))
    link = Link("link", collisions=(Collision("c", shape, Pose(z=0.25)),))
    return Model(name, pose=Pose(x, y, yaw=yaw), static=True, links=(link,))


def square(half=1.925):
    """Return four walls around the origin, as in stage 1."""
    quarter = math.pi / 2
    return (
        wall("north", 0.0, half, 0.0),
        wall("south", 0.0, -half, 0.0),
        wall("east", half, 0.0, quarter),
        wall("west", -half, 0.0, quarter),
    )
