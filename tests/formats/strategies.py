"""Random descriptions, as a reader could have made them."""

from dataclasses import replace

from hypothesis import strategies as st

from gazelle.description import (
    Atmosphere,
    Attenuation,
    Bounce,
    Box,
    Camera,
    Capsule,
    Collision,
    Cone,
    Contact,
    ContactSensor,
    Cylinder,
    Ellipsoid,
    Empty,
    Frame,
    Friction,
    Heightmap,
    Image,
    Imu,
    Inertia,
    Inertial,
    Joint,
    JointAxis,
    JointPhysics,
    Lidar,
    Light,
    Link,
    Material,
    Mesh,
    Mimic,
    Model,
    Ode,
    Parameters,
    Physics,
    Plane,
    Polyline,
    Pose,
    SafetyController,
    Scan,
    Scene,
    Sensor,
    Sphere,
    SphericalCoordinates,
    Surface,
    TorsionalFriction,
    Transmission,
    Visual,
    World,
)
from tests.formats.value_strategies import (
    colors,
    counts,
    elements,
    flags,
    masses,
    named_elements,
    names,
    noises,
    not_negative,
    plugins,
    poses,
    positive,
    reals,
    units,
    vectors,
)

AXES = {"ball": 0, "fixed": 0, "floating": 0, "universal": 2, "revolute2": 2, "gearbox": 2}
TREE_JOINTS = ("revolute", "continuous", "prismatic", "fixed")
JOINTS = (*TREE_JOINTS, *AXES, "screw", "planar")
SENSORS = ("ray", "gpu_lidar", "imu", "camera", "multicamera", "contact", "gps", "altimeter")
SOFT = Parameters(
    "soft_contact", children=(Parameters("dart", children=(Parameters("damping", "3"),)),)
)

uris = st.builds("model://{}/x.{}".format, st.sampled_from(["gone", "lost"]), st.just("dae"))

shapes = st.one_of(
    st.just(Empty()),
    st.builds(Box, vectors(positive)),
    st.builds(Sphere, positive),
    st.builds(Cylinder, positive, positive),
    st.builds(Capsule, positive, positive),
    st.builds(Cone, positive, positive),
    st.builds(Ellipsoid, vectors(positive)),
    st.builds(Plane, units(), vectors(positive, 2)),
    st.builds(Mesh, uris, st.none(), vectors(), st.none() | st.just("part"), flags),
    st.builds(Heightmap, uris, st.none(), vectors(positive), vectors(), counts),
    st.builds(Image, uris, st.none(), positive, st.integers(0, 255), positive, counts),
    st.builds(
        Polyline,
        st.lists(st.lists(vectors(size=2), max_size=4).map(tuple), min_size=1, max_size=3).map(
            tuple
        ),
        positive,
    ),
)
urdf_shapes = st.one_of(
    st.builds(Box, vectors(positive)),
    st.builds(Sphere, positive),
    st.builds(Cylinder, positive, positive),
    st.builds(Mesh, uris, st.none(), vectors()),
)

surfaces = st.builds(
    Surface,
    st.builds(
        Friction,
        not_negative,
        not_negative,
        vectors(),
        reals,
        reals,
        st.none() | st.builds(TorsionalFriction, positive, flags, positive, positive, reals),
    ),
    st.builds(Contact, *([positive] * 6), counts, counts, flags, counts),
    st.builds(Bounce, positive, positive),
    st.sampled_from([(), (SOFT,)]),
)
materials = st.builds(
    Material,
    *([st.none() | colors] * 4),
    st.none() | st.just("Own/Paint"),
    st.lists(names, max_size=2).map(tuple),
) | st.just(Material((0.3, 0.3, 0.3, 1.0), (0.7, 0.7, 0.7, 1.0), script="Gazebo/Grey"))

scans = st.builds(Scan, counts, reals, reals, reals)


@st.composite
def lidars(draw):
    near = draw(not_negative)
    far = near + draw(positive) if draw(flags) else float("inf")
    return Lidar(draw(scans), draw(scans), near, far, draw(reals), draw(noises))


def cameras(name):
    optional = st.none() | positive
    return st.builds(
        Camera,
        name,
        poses(),
        reals,
        counts,
        counts,
        st.sampled_from(["R8G8B8", "L8"]),
        reals,
        reals,
        optional,
        optional,
        noises,
        vectors(size=5),
        vectors(size=2),
        st.none() | named_elements("lens"),
    )


@st.composite
def sensors(draw, name=names):
    kind = draw(st.sampled_from(SENSORS))
    own = {
        "ray": {"lidar": lidars()},
        "gpu_lidar": {"lidar": lidars()},
        "imu": {
            "imu": st.builds(
                Imu,
                vectors(noises),
                vectors(noises),
                st.sampled_from(["CUSTOM", "ENU"]),
                vectors(),
                flags,
            )
        },
        "camera": {"cameras": st.tuples(cameras(names | st.just("")))},
        "multicamera": {"cameras": st.tuples(cameras(names), cameras(names))},
        "contact": {
            "contact": st.builds(ContactSensor, st.lists(names, max_size=2).map(tuple), names)
        },
    }.get(kind, {})
    return Sensor(
        draw(name),
        kind,
        draw(poses()),
        draw(not_negative),
        draw(flags),
        draw(flags),
        draw(names | st.just("")),
        **{key: draw(value) for key, value in own.items()},
        settings=Parameters("sensor", children=tuple(draw(st.lists(elements(), max_size=2)))),
        plugins=tuple(draw(st.lists(plugins, max_size=1))),
    )


@st.composite
def inertials(draw):
    a, b, c = draw(vectors(st.floats(1e-6, 1e3)))
    x, y, z = draw(vectors(st.floats(-0.3, 0.3)))
    small = min(a, b, c)
    return Inertial(draw(masses), draw(poses()), Inertia(a, b, c, x * small, y * small, z * small))


def distinct(strategy, size=2):
    """Return some values with names of their own."""
    return st.lists(strategy, max_size=size, unique_by=lambda part: part.name).map(tuple)


lights = st.builds(
    Light,
    names,
    st.sampled_from(["directional", "point", "spot"]),
    poses(),
    colors,
    colors,
    vectors(),
    st.builds(Attenuation, not_negative | st.just(float("inf")), reals, reals, reals),
    flags,
    reals,
    reals,
    reals,
    reals,
)


def links(name, shape=shapes):
    return st.builds(
        Link,
        name,
        poses(),
        st.none() | inertials(),
        distinct(st.builds(Collision, names, shape, poses(), surfaces, reals, counts)),
        distinct(
            st.builds(
                Visual, names, shape, poses(), st.none() | materials, reals, flags, reals, counts
            )
        ),
        distinct(sensors()),
        distinct(lights),
        flags,
        flags,
        st.none() | flags,
        flags,
        reals,
        reals,
        st.lists(named_elements("audio_sink"), max_size=1).map(tuple),
    )


@st.composite
def axes(draw, mimicked="other"):
    lower = draw(st.floats(-1e6, 0) | st.just(float("-inf")))
    upper = draw(st.floats(0, 1e6) | st.just(float("inf")))
    endless = not_negative | st.just(float("inf"))
    mimic = st.builds(Mimic, st.just(mimicked), st.integers(0, 1), reals, reals, reals)
    return JointAxis(
        draw(units()),
        lower,
        upper,
        draw(endless),
        draw(endless),
        *(draw(reals) for _ in range(6)),
        draw(st.none() | mimic),
    )


@st.composite
def joints(draw, name, parent, child, kinds=JOINTS):
    kind = draw(st.sampled_from(kinds))
    return Joint(
        name,
        kind,
        parent,
        child,
        draw(poses()),
        tuple(draw(axes()) for _ in range(AXES.get(kind, 1))),
        draw(reals),
        draw(reals),
        draw(st.just("") | names),
        JointPhysics(
            draw(flags),
            draw(flags),
            draw(st.none() | reals),
            *(draw(reals) for _ in range(6)),
            draw(flags),
        ),
        draw(st.none() | st.builds(SafetyController, *[reals] * 4)),
        draw(distinct(sensors(), 1)),
    )


transmissions = st.builds(
    Transmission,
    names,
    names,
    st.lists(st.tuples(names, st.lists(names, max_size=2).map(tuple)), max_size=2).map(tuple),
    st.lists(st.tuples(names, reals), max_size=2).map(tuple),
)


@st.composite
def models(draw, name="model", depth=1):
    """Return a model of a chain of links, with frames, and perhaps a nested model."""
    count = draw(st.integers(1, 3))
    bodies = tuple(draw(links(st.just(f"link{i}"))) for i in range(count))
    nested = (draw(models("inner", depth - 1)),) if depth and draw(flags) else ()
    ends = [f"link{i}" for i in range(count)] + [f"inner::{m.links[0].name}" for m in nested]
    held = [
        draw(joints(f"joint{i}", parent, child))
        for i, (parent, child) in enumerate(zip(["world", *ends], ends, strict=False))
        if draw(flags)
    ]
    return Model(
        name,
        draw(poses()),
        *(draw(flags) for _ in range(4)),
        draw(st.sampled_from(["", "link0"])),
        "",
        bodies,
        tuple(held),
        nested,
        tuple(
            Frame(f"frame{i}", draw(st.sampled_from(["", *ends])), draw(poses())) for i in range(2)
        ),
        tuple(draw(st.lists(plugins, max_size=1))),
        tuple(draw(st.lists(transmissions, max_size=1))),
        tuple(draw(st.lists(named_elements("gripper"), max_size=1))),
    )


@st.composite
def worlds(draw):
    held = tuple(draw(models(f"model{i}", depth=1 - i)) for i in range(draw(st.integers(0, 2))))
    ends = [f"{model.name}::{model.links[0].name}" for model in held]
    return World(
        draw(names),
        held,
        tuple(draw(st.lists(physics, max_size=2))),
        *(draw(vectors()) for _ in range(3)),
        draw(st.builds(Atmosphere, names, reals, reals, reals)),
        draw(st.none() | st.builds(SphericalCoordinates, names, *[reals] * 4)),
        draw(st.builds(Scene, colors, colors, flags, flags, flags)),
        draw(distinct(lights)),
        tuple(Frame(f"frame{i}", end, draw(poses())) for i, end in enumerate(["", *ends])),
        (draw(joints("between", "world", ends[0])),) if ends and draw(flags) else (),
        tuple(draw(st.lists(plugins, max_size=1))),
        draw(st.none() | poses()),
        (),
        tuple(draw(st.lists(named_elements("road"), max_size=1))),
    )


physics = st.builds(
    Physics,
    names,
    flags,
    st.sampled_from(["ode", "bullet"]),
    positive,
    reals,
    reals,
    counts,
    st.builds(Ode, names, reals, counts, counts, reals, names, *[reals] * 4),
)


@st.composite
def robots(draw):
    """Return a robot in URDF's range: a tree of links whose frames are at their joints."""
    count = draw(st.integers(1, 4))
    bodies, held = [], []
    for i in range(count):
        surface = replace(draw(surfaces), extras=())
        bodies.append(
            Link(
                f"link{i}",
                Pose() if i == 0 else draw(poses()),
                draw(inertials()),
                tuple(
                    Collision(
                        f"link{i}_collision" + (f"_{n}" if n else ""), shape, draw(poses()), surface
                    )
                    for n, shape in enumerate(draw(st.lists(urdf_shapes, max_size=2)))
                ),
                sensors=draw(distinct(sensors().filter(lambda s: s.type != "contact"), 1)),
                lights=draw(distinct(lights, 1)),
                gravity=draw(flags),
                self_collide=draw(st.none() | flags),
            )
        )
        if i:
            parent = f"link{draw(st.integers(0, i - 1))}"
            joint = draw(joints(f"joint{i}", parent, f"link{i}", TREE_JOINTS))
            held.append(_of_urdf(joint))
    return Model(
        "robot",
        draw(poses()),
        links=tuple(bodies),
        joints=tuple(held),
        plugins=tuple(draw(st.lists(plugins, max_size=1))),
        transmissions=tuple(draw(st.lists(transmissions, max_size=1))),
    )


def _of_urdf(joint):
    """Return the joint without what URDF lacks."""
    usual = JointAxis()
    kept = []
    for axis in joint.axes:
        free = joint.type == "continuous"
        kept.append(
            JointAxis(
                axis.xyz,
                usual.lower if free else axis.lower,
                usual.upper if free else axis.upper,
                axis.effort,
                axis.velocity,
                damping=axis.damping,
                friction=axis.friction,
                spring_reference=axis.spring_reference,
                spring_stiffness=axis.spring_stiffness,
            )
        )
    return Joint(
        joint.name,
        joint.type,
        joint.parent,
        joint.child,
        axes=tuple(kept),
        physics=replace(joint.physics, must_be_loop_joint=False),
        safety=joint.safety,
        sensors=joint.sensors,
    )
