"""Groups of an SRDF: joints, limits, ends, states."""

import arms
import numpy as np
import pytest

from gazelle.errors import FormatError, PlanningError
from gazelle.kinematics import JointBounds, RobotModel

GROUPS = """
  <group name="chain"><chain base_link="base" tip_link="tool"/></group>
  <group name="joints"><joint name="wrist"/><joint name="slide"/></group>
  <group name="links"><link name="b"/><link name="e"/></group>
  <group name="nested"><group name="joints"/><group name="links"/></group>
  <group name="both"><chain base_link="base" tip_link="tool"/><chain base_link="a" tip_link="e"/>
  </group>
  <group name="across"><chain base_link="e" tip_link="d"/></group>
  <group name="hand"><link name="tool"/></group>
  <group_state name="up" group="chain"><joint name="slide" value="0.1"/>
    <joint name="wrist" value="-1"/></group_state>
  <end_effector name="tcp" parent_link="d" group="hand" parent_group="joints"/>
"""


@pytest.mark.parametrize(
    ("group", "names"),
    [
        ("chain", ("slide", "turn", "wrist")),
        ("joints", ("slide", "wrist")),
        ("links", ("other", "turn")),
        ("nested", ("slide", "other", "turn", "wrist")),
        ("both", ("slide", "other", "turn", "wrist")),
        ("across", ("other", "turn", "wrist")),
        ("hand", ()),
    ],
)
def test_joints_go_from_the_root_outwards_without_those_that_follow(group, names):
    robot = arms.odd(GROUPS)
    found = robot.group(group)
    assert found.names == names
    assert [robot.names[column] for column in found.columns] == list(names)


def test_passive_joints_are_not_planned_for():
    robot = arms.odd(GROUPS + '<passive_joint name="wrist"/>')
    assert robot.group("chain").names == ("slide", "turn")


def test_ends():
    robot = arms.odd(GROUPS)
    assert robot.group("chain").tip == "tool"
    assert robot.group("chain").base == "base"
    assert robot.group("joints").tip == "d"  # where the end effector is mounted
    assert set(robot.group("both").tips) == {"tool", "e"}
    with pytest.raises(PlanningError, match="name the link: tool, e"):
        _ = robot.group("both").tip
    assert robot.group("chain").links == ("a", "b", "c", "d", "tool")


def test_limits_are_the_soft_ones():
    group = arms.odd(GROUPS).group("chain")
    assert group.lower.tolist() == [-0.5, -np.inf, -1.5]
    assert group.upper.tolist() == [0.4, np.inf, 0.9]
    assert group.max_velocity[0] == 0.7
    assert group.endless.tolist() == [False, True, False]


def test_limits_of_a_yaml_take_their_place():
    given = {
        "has_velocity_limits": True,
        "max_velocity": 2.0,
        "has_acceleration_limits": True,
        "max_acceleration": 3.0,
        "min_position": -1.0,
        "max_position": 1.0,
    }
    model = arms.odd().model
    bounds = JointBounds(upper=9.0, velocity=8.0).with_parameters(given)
    robot = RobotModel(model, limits={"wrist": bounds})
    assert robot.variables[robot.column("wrist")].bounds == JointBounds(-1.0, 1.0, 2.0, 3.0)
    freed = bounds.with_parameters({"has_acceleration_limits": False})
    assert freed.acceleration == np.inf
    with pytest.raises(PlanningError, match="did you mean 'max_velocity'"):
        bounds.with_parameters({"max_velocty": 1.0}, "wrist")
    with pytest.raises(PlanningError, match="a number"):
        bounds.with_parameters({"max_velocity": "fast"}, "wrist")


def test_named_states():
    group = arms.odd(GROUPS).group("chain")
    assert group.named("up") == {"slide": 0.1, "wrist": -1.0}
    assert group.positions(group.named("up"), [0.0, 7.0, 0.0]).tolist() == [0.1, 7.0, -1.0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"elbow": 1.0}, "has no joint 'elbow'"),
        ([1.0], "has 3 joints"),
        ([1.0, 2.0, np.nan], "'targets' must be numbers"),
    ],
)
def test_positions_that_cannot_be(given, words):
    group = arms.odd(GROUPS).group("chain")
    with pytest.raises(PlanningError, match=words):
        group.positions(given, np.zeros(3))


def test_endless_joints_go_the_shorter_way():
    group = arms.odd(GROUPS).group("chain")
    way = group.difference([0.0, 3.0, 0.5], [0.1, -3.0, -0.5])
    np.testing.assert_allclose(way, [0.1, 2 * np.pi - 6.0, -1.0])


def test_samples_are_within_limits_and_the_same_again():
    group = arms.arm("fetch").group("arm_with_torso")
    assert group.names[0] == "torso_lift_joint"
    drawn = group.sample(np.random.default_rng(3), 200)
    assert not [text for row in drawn for text in group.beyond(row)]
    assert (drawn == group.sample(np.random.default_rng(3), 200)).all()
    (text,) = group.beyond([0.5, *np.zeros(7)])
    assert "'torso_lift_joint' at 0.5000 is beyond its limits [0.0000, 0.3861]" in text


def test_a_group_that_names_what_is_not_there():
    robot = arms.odd('<group name="g"><joint name="wrst"/></group>')
    with pytest.raises(FormatError, match="wrst"):
        robot.group("g")


def test_which_links_move():
    robot = arms.odd(GROUPS)
    assert robot.moving(robot.columns(["wrist"])) == {"d", "tool"}
    assert robot.moving(robot.columns(["turn"])) == {"b", "c", "d", "tool"}
    assert robot.moving([]) == frozenset()
