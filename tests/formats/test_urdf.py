"""URDF becomes the model that libsdformat makes of it."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from xml_samples import INERTIAL, joint, link, urdf, urdf_joint, urdf_link

from gazelle import FormatError, Pose
from gazelle.description import Box, Empty, Inertia, Inertial
from gazelle.errors import FormatWarning
from gazelle.formats.urdf.lump import combine

BOX = "<geometry><box size='1 1 1'/></geometry>"


def origin(xyz, rpy="0 0 0"):
    return f"<origin xyz='{xyz}' rpy='{rpy}'/>"


def test_a_joint_places_its_child():
    m = urdf(
        urdf_link("a")
        + urdf_link("b")
        + urdf_joint(
            "j",
            "a",
            "b",
            "revolute",
            origin("1 0 0", "0 0 1.5707963267948966")
            + "<axis xyz='0 0 2'/><limit lower='-1' upper='2' effort='3' velocity='4'/>"
            "<dynamics damping='.5' friction='.25'/>",
        )
    )
    axis = joint(m, "j").axes[0]
    assert link(m, "b").pose.is_close(Pose(1, 0, 0, 0, 0, math.pi / 2))
    assert joint(m, "j").pose == Pose()
    assert axis.xyz == (0, 0, 1)
    assert (axis.lower, axis.upper, axis.effort, axis.velocity) == (-1, 2, 3, 4)
    assert (axis.damping, axis.friction) == (0.5, 0.25)


def test_a_continuous_joint_turns_without_end():
    m = urdf(urdf_link("a") + urdf_link("b") + urdf_joint("j", "a", "b", "continuous"))
    axis = joint(m, "j").axes[0]
    assert axis.xyz == (1, 0, 0)
    assert (axis.lower, axis.upper, axis.effort) == (-math.inf, math.inf, math.inf)


def test_mimic_safety_and_transmission_are_kept():
    m = urdf(
        urdf_link("a")
        + urdf_link("b")
        + urdf_joint(
            "j",
            "a",
            "b",
            "continuous",
            "<mimic joint='k' multiplier='2' offset='.1'/>"
            "<safety_controller k_velocity='10' soft_upper_limit='1'/>",
        )
        + "<transmission name='t'><type>transmission_interface/SimpleTransmission</type>"
        "<joint name='j'><hardwareInterface>EffortJointInterface</hardwareInterface></joint>"
        "<actuator name='m'><mechanicalReduction>30</mechanicalReduction></actuator>"
        "</transmission>"
    )
    found = joint(m, "j")
    assert (found.axes[0].mimic.joint, found.axes[0].mimic.multiplier) == ("k", 2.0)
    assert (found.safety.k_velocity, found.safety.soft_upper_limit) == (10.0, 1.0)
    assert m.transmissions[0].joints == (("j", ("EffortJointInterface",)),)
    assert m.transmissions[0].actuators == (("m", 30.0),)


LUMPED = (
    urdf_link("a", f"{INERTIAL}<collision>{BOX}</collision>")
    + urdf_link("b", f"{INERTIAL}<collision>{BOX}</collision><visual>{BOX}</visual>")
    + urdf_link("c", f"<collision name='tip'>{origin('0 1 0')}{BOX}</collision>")
    + urdf_joint("ab", "a", "b", "fixed", origin("1 0 0"))
    + urdf_joint("bc", "b", "c", "fixed", origin("1 0 0", "0 0 1.5707963267948966"))
)


def test_links_on_fixed_joints_become_one():
    m = urdf(LUMPED)
    body = link(m, "a")
    assert [found.name for found in m.links] == ["a"]
    assert m.joints == ()
    assert [collision.name for collision in body.collisions] == [
        "a_collision",
        "a_fixed_joint_lump__b_collision_1",
        "a_fixed_joint_lump__tip_collision_2",
    ]
    assert [visual.name for visual in body.visuals] == ["a_fixed_joint_lump__b_visual"]
    assert body.collisions[2].pose.is_close(Pose(1, 0, 0, 0, 0, math.pi / 2))
    assert body.inertial.mass == 2.0
    assert body.inertial.pose.is_close(Pose(x=0.5))
    assert body.inertial.inertia == Inertia(2.0, 2.5, 2.5, 0.0, 0.0, 0.0)


def test_lumped_links_stay_as_frames():
    b, c = urdf(LUMPED).frames
    assert (b.name, b.attached_to) == ("b", "a")
    assert b.pose.is_close(Pose(x=1))
    assert (c.name, c.attached_to) == ("c", "a")
    assert c.pose.is_close(Pose(2, 0, 0, 0, 0, math.pi / 2))


def test_what_hangs_on_a_lumped_link_hangs_on_the_body():
    m = urdf(LUMPED + urdf_link("d") + urdf_joint("cd", "c", "d", "continuous", origin("1 0 0")))
    assert (joint(m, "cd").parent, joint(m, "cd").child) == ("a", "d")
    assert link(m, "d").pose.is_close(Pose(2, 1, 0, 0, 0, math.pi / 2))


@pytest.mark.parametrize(
    ("tag", "kind", "limits"),
    [("preserveFixedJoint", "fixed", ()), ("disableFixedJointLumping", "revolute", ((0, 0),))],
)
def test_fixed_joints_can_be_kept(tag, kind, limits):
    m = urdf(LUMPED + f"<gazebo reference='ab'><{tag}>true</{tag}></gazebo>")
    assert [found.name for found in m.links] == ["a", "b"]
    assert joint(m, "ab").type == kind
    assert tuple((axis.lower, axis.upper) for axis in joint(m, "ab").axes) == limits
    assert [frame.name for frame in m.frames] == ["c"]


def test_the_fixed_joint_to_the_world_stays_and_makes_the_whole_static():
    m = urdf("<link name='world'/>" + urdf_link("a") + urdf_joint("j", "world", "a"))
    assert joint(m, "j").parent == "world"
    assert [found.name for found in m.links] == ["a"]
    assert m.static
    arm = urdf(
        "<link name='world'/>"
        + urdf_link("a")
        + urdf_link("b")
        + urdf_joint("j", "world", "a")
        + urdf_joint("k", "a", "b", "continuous")
    )
    assert not arm.static


def test_a_link_without_mass_is_left_out_with_all_below_it():
    with pytest.warns(FormatWarning, match="'b' has no mass and is not simulated, nor are the 1"):
        m = urdf(
            urdf_link("a")
            + urdf_link("b", "")
            + urdf_link("c")
            + urdf_joint("ab", "a", "b", "continuous")
            + urdf_joint("bc", "b", "c", "continuous")
        )
    assert [found.name for found in m.links] == ["a"]


def test_a_massless_root_takes_the_mass_of_what_is_fixed_to_it():
    m = urdf(urdf_link("foot", "") + urdf_link("base") + urdf_joint("j", "foot", "base"))
    assert [found.name for found in m.links] == ["foot"]
    assert m.links[0].inertial.mass == 1.0
    assert m.frames[0].name == "base"


def test_a_robot_without_any_mass_is_kept_to_be_looked_at():
    with pytest.warns(FormatWarning, match="no link has a mass"):
        m = urdf(urdf_link("a", f"<visual>{BOX}</visual>"))
    assert m.links[0].visuals[0].geometry == Box((1, 1, 1))


def test_gazebo_extensions_of_links():
    m = urdf(
        LUMPED + "<gazebo reference='b'><mu1>.1</mu1><mu2 value='.2'/><kp>5</kp><kd>6</kd>"
        "<minDepth>.01</minDepth><maxVel>.1</maxVel><fdir1>1 0 0</fdir1>"
        "<material>Gazebo/Blue</material><selfCollide>true</selfCollide>"
        "<turnGravityOff>true</turnGravityOff><dampingFactor>.3</dampingFactor></gazebo>"
    )
    body = m.links[0]
    plain, marked, _ = (collision.surface for collision in body.collisions)
    assert (marked.friction.mu, marked.friction.mu2, marked.friction.fdir1) == (0.1, 0.2, (1, 0, 0))
    contact = marked.contact
    assert (contact.kp, contact.kd, contact.min_depth, contact.max_vel) == (5, 6, 0.01, 0.1)
    assert plain.friction.mu == 1.0
    assert body.visuals[0].material.diffuse == (0, 0, 1, 1)
    assert body.self_collide
    assert not body.gravity
    assert body.velocity_decay_linear == 0.3


def test_sensors_move_with_their_link_and_name_its_collisions():
    m = urdf(
        LUMPED + "<gazebo reference='b'><sensor name='s' type='contact'><pose>0 0 1 0 0 0</pose>"
        "<contact><collision>b_collision</collision></contact></sensor></gazebo>"
    )
    sensor = m.links[0].sensors[0]
    assert sensor.pose.is_close(Pose(1, 0, 1))
    assert sensor.contact.collisions == ("a_fixed_joint_lump__b_collision_1",)


def test_gazebo_extensions_of_joints():
    m = urdf(
        urdf_link("a")
        + urdf_link("b")
        + urdf_joint("j", "a", "b", "continuous")
        + "<gazebo reference='j'><provideFeedback>true</provideFeedback><stopErp>.4</stopErp>"
        "<implicitSpringDamper>1</implicitSpringDamper><springStiffness>7</springStiffness>"
        "<sensor name='ft' type='force_torque'/></gazebo>"
    )
    found = joint(m, "j")
    assert found.physics.provide_feedback
    assert found.physics.implicit_spring_damper
    assert found.physics.stop_erp == 0.4
    assert found.axes[0].spring_stiffness == 7
    assert found.sensors[0].type == "force_torque"


def test_gazebo_extensions_of_the_model():
    m = urdf(
        urdf_link("a")
        + urdf_link("b")
        + urdf_joint("j", "a", "b", "continuous")
        + "<gazebo><static>true</static><plugin name='p' filename='libp.so'><x>1</x></plugin>"
        "<joint name='loop' type='ball'><parent>a</parent><child>b</child></joint></gazebo>"
    )
    assert m.static
    assert m.plugins[0].parameters.get("x", 0) == 1
    assert joint(m, "loop").type == "ball"


def test_colours_come_from_named_materials():
    m = urdf(
        "<material name='blue'><color rgba='0 0 1 .5'/></material>"
        + urdf_link("a", f"{INERTIAL}<visual>{BOX}<material name='blue'/></visual>")
    )
    assert m.links[0].visuals[0].material.diffuse == (0, 0, 1, 0.5)


TWO = urdf_link("a") + "\n" + urdf_link("b") + "\n"


@pytest.mark.parametrize(
    ("body", "line", "element", "reason"),
    [
        ("", 1, "", "needs a <link>"),
        ("<link/>", 2, "/link", "attribute 'name' is required"),
        (TWO + urdf_link("a"), 4, "/link[@name='a']", "already a <link> named 'a'"),
        (TWO, 3, "/link[@name='b']", "2 roots: a, b"),
        (
            TWO + urdf_joint("j", "a", "x"),
            4,
            "/joint[@name='j']/child",
            "child 'x' is not a link",
        ),
        (
            TWO + urdf_joint("j", "a", "b") + "\n" + urdf_joint("k", "b", "a"),
            1,
            "",
            "joint loop",
        ),
        (
            TWO + urdf_joint("j", "a", "b") + "\n" + urdf_joint("k", "a", "b"),
            5,
            "/joint[@name='k']",
            "child of two joints",
        ),
        (
            urdf_link("r") + TWO + urdf_joint("j", "a", "b") + "\n" + urdf_joint("k", "b", "a"),
            4,
            "/joint[@name='j']",
            "joint loop: a, b",
        ),
        (
            TWO + urdf_joint("j", "a", "b", "revolute"),
            4,
            "/joint[@name='j']",
            "a revolute joint needs a <limit>",
        ),
        (
            TWO + urdf_joint("j", "a", "b", "hinge"),
            4,
            "/joint[@name='j']",
            "unknown joint type 'hinge'",
        ),
        (
            urdf_link("a", INERTIAL.replace("mass value='1'", "mass value='-1'")),
            2,
            "/link[@name='a']/inertial/mass",
            "must not be negative",
        ),
    ],
)
def test_errors_name_file_line_and_element(body, line, element, reason):
    with pytest.raises(FormatError, match=reason) as caught:
        urdf(body)
    assert caught.value.file == "test.urdf"
    assert caught.value.line == line
    assert caught.value.element == f"robot[@name='r']{element}"


def limited(limits):
    """Return a joint with limits, and its child."""
    joint = f"<joint name='j' type='continuous'><parent link='a'/><child link='b'/><limit {limits}/></joint>"
    return urdf_link("b") + joint


@pytest.mark.parametrize(
    ("body", "reason"),
    [
        ("<gazebo reference='x'><mu1>1</mu1></gazebo>", "refers to 'x'"),
        ("<gazebo reference='a'><mu>1</mu></gazebo>", "<mu> in a <gazebo> is not supported"),
        ("<material name='m'><texture filename='no.png'/></material>", "texture 'no.png' is not"),
        (limited("effort='-1' velocity='1'"), "effort limit is below zero, -1: no limit"),
        (limited("effort='1' velocity='-2'"), "velocity limit is below zero, -2: no limit"),
    ],
)
def test_what_means_nothing_is_named_once(body, reason):
    with pytest.warns(FormatWarning, match=reason) as caught:
        urdf(urdf_link("a") + body)
    assert len(caught) == 1


lengths = st.floats(-2, 2)
angles = st.floats(-1.5, 1.5)
poses = st.builds(Pose, lengths, lengths, lengths, angles, angles, angles)
parts = st.lists(
    st.tuples(
        poses, st.builds(Inertial, st.floats(0.1, 10), poses, st.just(Inertia(1.0, 1.1, 1.2, 0.1)))
    ),
    min_size=1,
    max_size=4,
)


@settings(deadline=None, max_examples=50)
@given(parts, poses, st.lists(st.tuples(lengths, lengths, lengths), min_size=1, max_size=1))
def test_a_lumped_body_has_the_kinetic_energy_of_its_parts(pieces, rotation, spins):
    """For a rigid turn about the origin, energies of the parts and of the whole agree."""
    whole = combine(pieces, Pose.from_quaternion((0, 0, 0), rotation.quaternion))
    w = np.array(spins[0])

    def energy(pose, inertial):
        center = pose * inertial.pose
        turn = center.matrix()[:3, :3]
        v = np.cross(w, center.position)
        return inertial.mass * v @ v + w @ turn @ inertial.inertia.matrix() @ turn.T @ w

    assert energy(Pose(), whole) == pytest.approx(sum(energy(*piece) for piece in pieces), rel=1e-9)


def test_a_root_without_mass_takes_all_below_it_along():
    body = "<link name='a'/>" + urdf_link("b") + urdf_joint("j", "a", "b", "continuous")
    with pytest.warns(FormatWarning, match="link 'a' has no mass"):
        found = urdf(body + "<gazebo><plugin name='p' filename='f'/></gazebo>")
    assert found.links == ()
    assert [plugin.name for plugin in found.plugins] == ["p"]


def test_a_box_without_size_is_left_out_with_a_word():
    nothing = "<collision><geometry><box size='0 0.0 0'/></geometry></collision>"
    with pytest.warns(FormatWarning, match="a box without size is left out"):
        m = urdf(urdf_link("a", f"{INERTIAL}{nothing}<collision>{BOX}</collision>"))
    assert [each.geometry for each in m.links[0].collisions] == [Empty(), Box((1, 1, 1))]


@pytest.mark.parametrize("tag", ["collision", "visual"])
@pytest.mark.parametrize(
    ("shape", "reason"),
    [
        ("<geometry><blob/></geometry>", "unknown shape <blob>"),
        ("<geometry><bxo size='1 1 1'/></geometry>", "did you mean 'box'"),
        ("<geometry/>", "needs a <geometry> with a shape"),
        ("", "needs a <geometry> with a shape"),
        ("<geometry><box/></geometry>", "'size' is required"),
        ("<geometry><sphere radius='x'/></geometry>", "expected a number"),
        ("<geometry><cylinder radius='1'/></geometry>", "'length' is required"),
        ("<geometry><mesh/></geometry>", "'filename' is required"),
    ],
)
def test_a_part_whose_shape_cannot_be_read_is_left_out_as_by_urdfdom(tag, shape, reason):
    good = f"<{tag}>{BOX}</{tag}>"
    with pytest.warns(FormatWarning) as said:
        m = urdf(urdf_link("a", f"{INERTIAL}{good}<{tag}>{shape}</{tag}>"))
    told = [text for each in said if f"<{tag}> was left out" in (text := str(each.message))]
    assert len(told) == 1
    assert reason in told[0]
    assert "test.urdf:" in told[0]
    link = m.links[0]
    parts = link.collisions if tag == "collision" else link.visuals
    assert [each.geometry for each in parts] == [Box((1, 1, 1))]


@pytest.mark.parametrize("name", ["on", "lamp"])
@pytest.mark.parametrize("model_first", [True, False])
def test_a_model_within_a_robot_and_the_joint_that_holds_it(name, model_first):
    """The joint may be called as the model is."""
    lamp = "<gazebo><model name='lamp'><pose>1 0 0 0 0 0</pose><link name='body'/></model></gazebo>"
    on = f"<joint name='{name}' type='fixed'><parent>a</parent><child>lamp::body</child></joint>"
    parts = (lamp, f"<gazebo>{on}</gazebo>")
    m = urdf(urdf_link("a") + "".join(parts if model_first else reversed(parts)))
    assert [(inner.name, inner.pose) for inner in m.models] == [("lamp", Pose(1.0))]
    assert (joint(m, name).parent, joint(m, name).child) == ("a", "lamp::body")
