"""SRDF: groups, postures, end effectors and pairs that may touch."""

import pytest
from xml_samples import robot, urdf, urdf_joint, urdf_link

from gazelle import FormatError, formats
from gazelle.description import DisabledCollision, EndEffector, VirtualJoint
from gazelle.errors import FormatWarning
from gazelle.formats import load_srdf, load_srdf_string
from gazelle.kinematics import RobotModel

LIMIT = "<limit lower='-1' upper='1' effort='1' velocity='1'/>"
ARM = (
    "".join(urdf_link(name) for name in ("base", "upper", "lower", "hand", "finger", "thumb"))
    + urdf_joint("shoulder", "base", "upper", "revolute", LIMIT)
    + urdf_joint("elbow", "upper", "lower", "revolute", LIMIT)
    + urdf_joint("wrist", "lower", "hand")
    + urdf_joint("grip", "hand", "finger", "prismatic", LIMIT)
    + urdf_joint("pinch", "hand", "thumb", "prismatic", LIMIT)
)
GROUPS = (
    "<group name='arm'><chain base_link='base' tip_link='hand'/></group>"
    "<group name='hand'><link name='hand'/><link name='finger'/><joint name='pinch'/></group>"
    "<group name='all'><group name='hand'/><group name='arm'/></group>"
)


def names(text, group):
    model = RobotModel(urdf(ARM), load_srdf_string(robot(text)))
    return [joint.name for joint in model.joints_of(group)]


def test_everything_is_read():
    found = load_srdf_string(
        robot(
            GROUPS + "<group_state name='home' group='arm'><joint name='shoulder' value='0.5'/>"
            "<joint name='elbow' value='1 2'/></group_state>"
            "<end_effector name='e' parent_link='hand' group='hand' parent_group='arm'/>"
            "<virtual_joint name='v' type='planar' parent_frame='odom' child_link='base'/>"
            "<passive_joint name='pinch'/>"
            "<disable_collisions link1='base' link2='upper' reason='Adjacent'/>"
            "<disable_default_collisions link='hand'/>"
            "<enable_collisions link1='hand' link2='base'/>"
            "<link_sphere_approximation link='hand'><sphere center='0 1 2' radius='.5'/>"
            "</link_sphere_approximation>"
            "<joint_property joint_name='v' property_name='motion_model' value='diff_drive'/>"
        )
    )
    assert found.robot == "r"
    assert [group.name for group in found.groups] == ["arm", "hand", "all"]
    assert found.state("arm", "home").joints == {"shoulder": (0.5,), "elbow": (1.0, 2.0)}
    assert found.end_effectors == (EndEffector("e", "hand", "hand", "arm"),)
    assert found.virtual_joints == (VirtualJoint("v", "planar", "odom", "base"),)
    assert found.passive_joints == ("pinch",)
    assert found.disabled_collisions == (DisabledCollision("base", "upper", "Adjacent"),)
    assert found.enabled_collisions == (DisabledCollision("hand", "base"),)
    assert found.unchecked_links == ("hand",)
    assert found.spheres == {"hand": (((0.0, 1.0, 2.0), 0.5),)}
    assert found.joint_properties == {"v": {"motion_model": "diff_drive"}}


def test_groups_give_the_joints_that_move_from_the_root_outwards():
    assert names(GROUPS, "arm") == ["shoulder", "elbow"]
    assert names(GROUPS, "hand") == ["grip", "pinch"]
    assert names(GROUPS, "all") == ["shoulder", "elbow", "grip", "pinch"]


def test_a_chain_may_lead_across_the_root():
    text = "<group name='g'><chain base_link='thumb' tip_link='finger'/></group>"
    assert names(text, "g") == ["grip", "pinch"]


def test_virtual_joints_belong_to_no_model():
    text = (
        "<virtual_joint name='v' type='fixed' parent_frame='w' child_link='base'/>"
        "<group name='g'><joint name='v'/><joint name='elbow'/></group>"
    )
    assert names(text, "g") == ["elbow"]


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<group name='g'><link name='hnad'/></group>", "link 'hnad'.*did you mean 'hand'"),
        ("<group name='g'><joint name='elbov'/></group>", "joint 'elbov'.*did you mean 'elbow'"),
        ("<group name='g'><chain base_link='base' tip_link='x'/></group>", "link 'x'"),
    ],
)
def test_groups_that_lead_nowhere(body, message):
    with pytest.raises(FormatError, match=message):
        names(body, "g")


@pytest.mark.parametrize(
    ("body", "message"),
    [
        ("<group/>", "attribute 'name' is required"),
        ("<group name='g'/><group name='g'/>", "already a <group> named 'g'"),
        ("<group name='g'><group name='h'/></group>", "no group 'h'"),
        ("<group name='g'><group name='g'/></group>", "'g' is part of itself"),
        (
            "<group name='a'><group name='b'/></group><group name='b'><group name='a'/></group>",
            "is part of itself",
        ),
        ("<group_state name='s' group='arn'/><group name='arm'/>", "did you mean 'arm'"),
        (
            (
                "<group name='a'/><group_state name='s' group='a'>"
                "<joint name='j' value='x'/></group_state>"
            ),
            "expected a number",
        ),
        ("<end_effector name='e' group='g' parent_link='l'/>", "no group 'g'"),
        (
            "<virtual_joint name='v' type='float' parent_frame='w' child_link='b'/>",
            "did you mean 'floating'",
        ),
        ("<disable_collisions link1='a'/>", "'link2' is required"),
        ("<link_sphere_approximation link='a'><sphere/></link_sphere_approximation>", "'radius'"),
    ],
)
def test_errors_name_the_line(body, message):
    with pytest.raises(FormatError, match=message) as caught:
        load_srdf_string(robot(body), name="r.srdf")
    assert (caught.value.file, caught.value.line) == ("r.srdf", 2)


def test_groups_that_are_part_of_others_many_times_count_once():
    twice = "<group name='g{0}'><group name='g{1}'/><group name='g{1}'/></group>"
    nested = "".join(twice.format(n, n + 1) for n in range(60))
    text = f"{nested}<group name='g60'><joint name='elbow'/></group>"
    assert names(text, "g0") == ["elbow"]


def test_unknown_elements_are_named():
    with pytest.warns(FormatWarning, match="<grup>.*did you mean 'group'"):
        load_srdf_string(robot("<grup name='g'/>"))


def test_unknown_names_list_those_that_are_there():
    found = load_srdf_string(robot(GROUPS))
    with pytest.raises(FormatError, match="did you mean 'arm'"):
        found.group("arn")
    with pytest.raises(FormatError, match="there are none"):
        found.state("arm", "home")


def test_other_roots_are_refused():
    with pytest.raises(FormatError, match="expected <robot>"):
        load_srdf_string("<sdf/>")


def test_xacro_is_expanded(tmp_path):
    file = tmp_path / "r.srdf.xacro"
    file.write_text(
        "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'><xacro:arg name='p' default='a'/>"
        "<group name='$(arg p)arm'><joint name='j'/></group></robot>"
    )
    assert load_srdf(file, xacro_args={"p": "b"}).groups[0].name == "barm"


@pytest.mark.corpus
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_panda(corpus):
    folder = corpus / "moveit__moveit_resources"
    semantics = load_srdf(folder / "panda_moveit_config/config/panda.srdf")
    model = formats.load_model(
        folder / "panda_description/urdf/panda_arm_hand.urdf.xacro", paths=[corpus]
    )
    arm_model = RobotModel(model, semantics)
    arm = [joint.name for joint in arm_model.joints_of("panda_arm")]
    assert arm == [f"panda_joint{i}" for i in range(1, 8)]
    hand = [joint.name for joint in arm_model.joints_of("hand")]
    assert hand == ["panda_finger_joint1", "panda_finger_joint2"]
    both = [joint.name for joint in arm_model.joints_of("panda_arm_hand")]
    assert both == arm + hand
    assert set(semantics.state("panda_arm", "ready").joints) == set(arm)
    assert len(semantics.disabled_collisions) == 34


@pytest.mark.corpus
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_ur5(corpus):
    folder = corpus / "ros-industrial__universal_robot"
    semantics = load_srdf(folder / "ur5_moveit_config/config/ur5.srdf")
    model = formats.load_model(folder / "ur_description/urdf/ur5.xacro", paths=[corpus])
    assert len(RobotModel(model, semantics).joints_of("manipulator")) == 6
