"""Poses come out resolved, whatever frame and version they were written in."""

import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from xml_samples import joint, link, model, world

from gazelle import FormatError, Pose

TURNED = "0 0 0 0 0 1.5707963267948966"


def text(pose):
    return " ".join(repr(v) for v in (*pose.position, *pose.rpy))


def test_links_are_in_the_model_frame_unless_they_say_otherwise():
    m = model(
        f"<link name='a'><pose>1 0 0 {TURNED[6:]}</pose></link>"
        "<link name='b'><pose relative_to='a'>1 0 0 0 0 0</pose></link>"
    )
    assert link(m, "b").pose.is_close(Pose(1, 1, 0, 0, 0, math.pi / 2))


def test_the_old_frame_attribute_means_relative_to():
    m = model(
        "<link name='a'><pose>1 0 0 0 0 0</pose></link>"
        "<link name='b'><pose frame='a'>1 0 0 0 0 0</pose></link>",
        "1.6",
    )
    assert link(m, "b").pose.is_close(Pose(2, 0, 0))


def test_an_empty_frame_is_none():
    assert (
        model("<link name='a'><pose frame=''>1 0 0 0 0 0</pose></link>", "1.6").links[0].pose.x == 1
    )


def test_frames_are_posed_in_the_link_they_move_with():
    m = model(
        "<link name='a'><pose>1 0 0 0 0 0</pose></link>"
        "<frame name='f' attached_to='a'><pose>0 1 0 0 0 0</pose></frame>"
        "<frame name='g' attached_to='f'><pose relative_to='__model__'>5 0 0 0 0 0</pose></frame>"
    )
    f, g = m.frames
    assert (f.attached_to, g.attached_to) == ("a", "a")
    assert f.pose.is_close(Pose(0, 1, 0))
    assert g.pose.is_close(Pose(4, 0, 0))


def test_parts_of_a_link_may_name_another_frame():
    m = model(
        "<link name='a'><pose>1 0 0 0 0 0</pose>"
        "<visual name='v'><pose relative_to='b'>0 0 1 0 0 0</pose></visual></link>"
        "<link name='b'><pose>0 2 0 0 0 0</pose></link>"
    )
    assert link(m, "a").visuals[0].pose.is_close(Pose(-1, 2, 1))


JOINT = (
    "<link name='a'/><link name='b'><pose>1 0 0 {turn}</pose></link>"
    "<joint name='j' type='revolute'><pose>0 0 0 {turn}</pose>"
    "<parent>a</parent><child>b</child><axis>{axis}</axis></joint>"
)


@pytest.mark.parametrize(
    ("version", "axis", "expected"),
    [
        ("1.4", "<xyz>1 0 0</xyz>", (-1, 0, 0)),
        ("1.5", "<xyz>1 0 0</xyz>", (1, 0, 0)),
        ("1.6", "<xyz>1 0 0</xyz><use_parent_model_frame>1</use_parent_model_frame>", (-1, 0, 0)),
        ("1.6", "<xyz>1 0 0</xyz><use_parent_model_frame>0</use_parent_model_frame>", (1, 0, 0)),
        ("1.7", "<xyz expressed_in='__model__'>1 0 0</xyz>", (-1, 0, 0)),
        ("1.7", "<xyz expressed_in='b'>1 0 0</xyz>", (0, -1, 0)),
        ("1.7", "<xyz>3 0 0</xyz>", (1, 0, 0)),
    ],
)
def test_the_axis_is_in_the_joint_frame_by_the_rule_of_its_version(version, axis, expected):
    m = model(JOINT.format(turn=TURNED[6:], axis=axis), version)
    assert joint(m, "j").axes[0].xyz == pytest.approx(expected, abs=1e-12)


def test_a_joint_posed_in_another_frame_is_turned_into_its_child():
    m = model(
        "<link name='a'><pose>1 0 0 0 0 0</pose></link><link name='b'><pose>3 0 0 0 0 0</pose></link>"
        "<joint name='j' type='fixed'><pose relative_to='a'>0 0 1 0 0 0</pose>"
        "<parent>a</parent><child>b</child></joint>"
    )
    assert joint(m, "j").pose.is_close(Pose(-2, 0, 1))


def test_a_joint_may_hold_frames_and_means_their_links():
    m = model(
        "<link name='a'/><link name='b'/><frame name='f' attached_to='b'>"
        "<pose>1 0 0 0 0 0</pose></frame>"
        "<joint name='j' type='fixed'><parent>a</parent><child>f</child></joint>"
    )
    assert joint(m, "j").child == "b"
    assert joint(m, "j").pose.is_close(Pose(1, 0, 0))


def test_nested_models_are_reached_by_scoped_names():
    m = model(
        "<link name='a'><pose relative_to='n::inner'>1 0 0 0 0 0</pose></link>"
        "<model name='n'><pose>0 0 5 0 0 0</pose>"
        "<link name='inner'><pose>0 1 0 0 0 0</pose></link></model>"
        "<joint name='j' type='fixed'><parent>a</parent><child>n::inner</child></joint>"
        "<joint name='k' type='fixed'><parent>a</parent><child>n</child></joint>"
    )
    assert link(m, "a").pose.is_close(Pose(1, 1, 5))
    assert joint(m, "j").child == "n::inner"
    assert joint(m, "k").child == "n::inner"
    assert joint(m, "k").pose.is_close(Pose(0, -1, 0))


def test_the_placement_frame_is_what_the_pose_places():
    m = model("<link name='a'><pose>0 0 1 0 0 0</pose></link>")
    assert m.pose.is_close(Pose())
    w = world(
        "<model name='m' placement_frame='a'><pose>0 0 5 0 0 0</pose>"
        "<link name='a'><pose>0 0 1 0 0 0</pose></link></model>",
        "1.8",
    )
    assert w.models[0].pose.is_close(Pose(0, 0, 4))
    assert w.models[0].placement_frame == "a"


def test_models_of_a_world_may_stand_relative_to_each_other():
    w = world(
        "<frame name='shelf'><pose>0 0 2 0 0 0</pose></frame>"
        "<model name='a'><pose relative_to='shelf'>1 0 0 0 0 0</pose><link name='l'/></model>"
        "<model name='b'><pose relative_to='a::l'>1 0 0 0 0 0</pose><link name='l'/></model>"
    )
    assert w.models[1].pose.is_close(Pose(2, 0, 2))


@pytest.mark.parametrize(
    ("pose", "expected"),
    [
        ("<pose degrees='true'>0 0 0 0 0 90</pose>", Pose(yaw=math.pi / 2)),
        ("<pose rotation_format='quat_xyzw'>1 0 0 0 0 1 1</pose>", Pose(1, yaw=math.pi / 2)),
        ("<pose/>", Pose()),
        ("<pose>1e0\n 2. .5 0 0 0</pose>", Pose(1, 2, 0.5)),
    ],
)
def test_poses_are_read_in_every_format(pose, expected):
    assert model(f"<link name='a'>{pose}</link>").links[0].pose.is_close(expected)


@pytest.mark.parametrize("number", ["inf", "nan", "x1", "--1"])
def test_poses_must_begin_with_a_finite_number(number):
    with pytest.raises(FormatError):
        model(f"<link name='a'><pose>{number} 0 0 0 0 0</pose></link>")


@pytest.mark.parametrize("number", ["inf", "nan", "1_0", "0x1", "1,0", "1f", ""])
def test_quaternions_must_be_seven_finite_numbers(number):
    with pytest.raises(FormatError):
        model(
            f"<link name='a'><pose rotation_format='quat_xyzw'>0 0 {number} 0 0 0 1</pose></link>"
        )
    with pytest.raises(FormatError):
        model(
            f"<link name='a'><pose rotation_format='quat_xyzw'>0 0 0 0 0 {number} 1</pose></link>"
        )


lengths = st.floats(-10, 10)
angles = st.floats(-1.5, 1.5)
poses = st.builds(Pose, lengths, lengths, lengths, angles, angles, angles)


@settings(max_examples=50, deadline=None)
@given(st.lists(poses, min_size=1, max_size=6), st.randoms(use_true_random=False))
def test_a_chain_of_frames_is_the_product_of_its_poses(chain, random):
    parts = [
        f"<link name='l{i}'><pose relative_to='{f'l{i - 1}' if i else ''}'>{text(pose)}</pose></link>"
        for i, pose in enumerate(chain)
    ]
    random.shuffle(parts)
    m = model("".join(parts))
    product = Pose()
    for i, pose in enumerate(chain):
        product = product * pose
        assert link(m, f"l{i}").pose.is_close(product, position=1e-7, angle=1e-6)


@pytest.mark.parametrize(
    ("attributes", "pose", "reason"),
    [
        ("rotation_format='quat_wxyz'", "0 0 0 1 0 0 0", "unknown rotation_format 'quat_wxyz'"),
        ("rotation_format='rpy'", "0 0 0 1 0 0", "unknown rotation_format 'rpy'"),
        ("rotation_format='quat_xyzw' degrees='true'", "0 0 0 0 0 0 1", "cannot be in degrees"),
    ],
)
def test_other_rotation_formats_are_errors_as_in_libsdformat(attributes, pose, reason):
    with pytest.raises(FormatError, match=reason):
        model(f"<link name='a'><pose {attributes}>{pose}</pose></link>", version="1.9")
