"""From joints to transforms."""

import itertools
import math
import subprocess
import sys
import time

import pytest
from ros.graph import Background, until

from gazelle_ros.base.errors import RosError
from gazelle_ros.base.rotations import rotate
from gazelle_ros.builtin.registry import main_of
from gazelle_ros.messages import load_message
from gazelle_ros.robot import JointStatePublisher, RobotStatePublisher, read_joints
from gazelle_ros.time import Time
from gazelle_ros.tools.graph import GraphInspector
from gazelle_ros.tools.nodes import kill

ROBOT = """
<robot name="r">
  <link name="base"/><link name="arm"/><link name="slide"/><link name="finger"/><link name="tool"/>
  <joint name="lift" type="prismatic">
    <parent link="base"/><child link="slide"/><axis xyz="0 0 2"/>
    <origin xyz="1 0 0" rpy="0 1.5707963267948966 0"/>
    <limit lower="0.2" upper="0.6" effort="1" velocity="1"/>
  </joint>
  <joint name="turn" type="continuous">
    <parent link="slide"/><child link="arm"/><axis xyz="0 0 1"/>
  </joint>
  <joint name="copy" type="revolute">
    <parent link="arm"/><child link="finger"/><axis xyz="0 1 0"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/>
    <mimic joint="turn" multiplier="-2" offset="0.1"/>
  </joint>
  <joint name="bolt" type="fixed">
    <parent link="arm"/><child link="tool"/><origin xyz="0 0 3"/>
  </joint>
</robot>
"""


def test_joints_place_their_links():
    joints = read_joints(ROBOT)
    assert list(joints) == ["lift", "turn", "copy", "bolt"]
    place, turn = joints["lift"].placed(0.5)
    assert place == pytest.approx((1.5, 0.0, 0.0))
    assert rotate(turn, (0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0))
    _, turn = joints["turn"].placed(math.pi / 2)
    assert rotate(turn, (1.0, 0.0, 0.0)) == pytest.approx((0.0, 1.0, 0.0))
    assert joints["bolt"].placed(9.0)[0] == (0.0, 0.0, 3.0)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("<robot", "not XML"),
        ("<sdf/>", "not a <robot>"),
        ("<robot><joint name='j' type='odd'/></robot>", "unknown type"),
        (ROBOT.replace('xyz="0 0 3"', 'xyz="0 three"'), "not three finite numbers"),
        (ROBOT.replace('multiplier="-2"', 'multiplier="x"'), "not a finite number"),
        (ROBOT.replace('joint="turn"', 'joint="nobody"'), "which is not there"),
        (ROBOT.replace('"turn" type', '"lift" type'), "two joints"),
    ],
)
def test_a_bad_description_is_named(text, words):
    with pytest.raises(RosError, match=words):
        read_joints(text)


def test_states_become_transforms(make_node):
    node, watcher = make_node("rsp"), make_node("watcher")
    moving, fixed = [], []
    many = load_message("tf2_msgs/TFMessage")
    RobotStatePublisher(node, read_joints(ROBOT))
    watcher.subscribe("/tf", many, moving.append)
    watcher.subscribe("/tf_static", many, fixed.append)
    state = load_message("sensor_msgs/JointState")
    sender = watcher.advertise("/joint_states", state, queue_size=10)
    until(lambda: sender.num_connections and fixed)
    assert [t.child_frame_id for t in fixed[0].transforms] == ["tool"]
    until(lambda: node.publication("/tf").num_connections)
    for stamp in (100.0, 100.001, 100.5):
        message = state(name=["turn", "other"], position=[0.3, 1.0])
        message.header.stamp = Time.from_sec(stamp)
        sender.publish(message)
        time.sleep(0.05)
    until(lambda: len(moving) == 2)
    found = {t.child_frame_id: t.transform.rotation for t in moving[0].transforms}
    assert set(found) == {"arm", "finger"}
    assert found["arm"].z == pytest.approx(math.sin(0.15))
    assert found["finger"].y == pytest.approx(math.sin(-0.25))
    assert [m.transforms[0].header.stamp.to_sec() for m in moving] == [100.0, 100.5]


def test_fixed_joints_can_be_sent_again_and_again(make_node):
    node, watcher = make_node("rsp"), make_node("watcher")
    node.set_param("~use_tf_static", False)
    moving = []
    RobotStatePublisher(node, read_joints(ROBOT))
    watcher.subscribe("/tf", load_message("tf2_msgs/TFMessage"), moving.append)
    until(lambda: len(moving) > 3)
    assert moving[0].transforms[0].child_frame_id == "tool"


def test_the_nearest_tf_prefix_goes_before_all_links(make_node):
    node, watcher = make_node("rsp"), make_node("watcher")
    node.set_param("/tf_prefix", "all")
    node.set_param("~tf_prefix", "r1")
    fixed = []
    RobotStatePublisher(node, read_joints(ROBOT))
    watcher.subscribe("/tf_static", load_message("tf2_msgs/TFMessage"), fixed.append)
    until(lambda: fixed)
    names = [(t.header.frame_id, t.child_frame_id) for t in fixed[0].transforms]
    assert names == [("r1/arm", "r1/tool")]


def test_joints_nobody_measures_are_zero(make_node):
    node, watcher = make_node("jsp"), make_node("watcher")
    node.set_param("~source_list", ["/measured"])
    node.set_param("~rate", 50)
    got = []
    state = load_message("sensor_msgs/JointState")
    watcher.subscribe("/joint_states", state, got.append)
    JointStatePublisher(node, read_joints(ROBOT))
    until(lambda: got)
    assert got[0].name == ["lift", "turn", "copy"]
    assert got[0].position == pytest.approx((0.4, 0.0, 0.1))
    sender = watcher.advertise("/measured", state, queue_size=1)
    until(lambda: sender.num_connections)
    sender.publish(state(name=["turn"], position=[1.0], velocity=[0.5]))
    until(lambda: got[-1].position[1] == 1.0)
    assert got[-1].position[2] == pytest.approx(-1.9)
    assert got[-1].velocity == pytest.approx((0.0, 0.5, 0.0))


def published(make_node, robot=ROBOT, **parameters):
    """Return what the node publishes with some parameters, as a list that grows."""
    node, watcher = make_node("jsp"), make_node("watcher")
    for name, value in {"rate": 50, **parameters}.items():
        node.set_param(f"~{name}", value)
    got = []
    watcher.subscribe("/joint_states", load_message("sensor_msgs/JointState"), got.append)
    JointStatePublisher(node, read_joints(robot))
    until(lambda: got)
    return got


@pytest.mark.parametrize(("smallest", "lift"), [(True, 0.55), (False, 0.4)])
def test_limits_of_a_safety_controller_count_unless_they_are_not_to(make_node, smallest, lift):
    soft = '<safety_controller k_velocity="1" soft_lower_limit="0.5" soft_upper_limit="9"/>'
    robot = ROBOT.replace('<limit lower="0.2"', f'{soft}<limit lower="0.2"')
    got = published(make_node, robot, use_smallest_joint_limits=smallest)
    assert got[0].position[0] == pytest.approx(lift)


def test_joints_depend_on_others_by_parameters(make_node):
    dependents = {"turn": {"parent": "lift", "factor": 2.0, "offset": 0.5}}
    got = published(make_node, dependent_joints=dependents, zeros={"lift": 0.3})
    assert got[0].position == pytest.approx((0.3, 1.1, -2.1))


def test_mimic_tags_may_be_ignored(make_node):
    got = published(make_node, use_mimic_tags=False, zeros={"turn": 1.0})
    assert got[0].position == pytest.approx((0.4, 1.0, 0.0))


def test_joints_move_to_and_fro_by_a_delta(make_node):
    got = published(make_node, delta=0.1)
    until(lambda: len(got) >= 12)
    lifts, turns = ([each.position[place] for each in got[:12]] for place in (0, 1))
    steps = [b - a for a, b in itertools.pairwise(lifts)]
    assert {round(each, 9) for each in steps} == {0.1, 0.0, -0.1}
    assert (min(lifts), max(lifts)) == pytest.approx((0.2, 0.6))
    assert [b - a for a, b in itertools.pairwise(turns)] == pytest.approx([0.1] * 11)


@pytest.mark.parametrize(
    ("dependents", "words"),
    [
        ({"turn": {"factor": 2.0}}, "has no joint and its parent"),
        ({"turns": {"parent": "lift"}}, "has no joint and its parent"),
        ({"turn": {"parent": "copy"}}, "or follows it"),
    ],
)
def test_wrong_dependents_are_refused(make_node, dependents, words):
    node = make_node("jsp")
    node.set_param("~dependent_joints", dependents)
    with pytest.raises(RosError, match=words):
        JointStatePublisher(node, read_joints(ROBOT))


def test_the_node_with_sliders_takes_positions_and_names_the_page(
    master, make_node, monkeypatch, caplog
):
    monkeypatch.setenv("ROS_MASTER_URI", master.uri)
    watcher, state = make_node("watcher"), load_message("sensor_msgs/JointState")
    watcher.set_param("/robot_description", ROBOT)
    got = []
    watcher.subscribe("/joint_states", state, got.append)
    main = main_of("joint_state_publisher_gui", "joint_state_publisher_gui")
    running = Background(lambda _stop: main(["_rate:=50", "_zeros:={turn: 1.0}", "__name:=gui"]))
    until(lambda: got)
    assert got[0].position == pytest.approx((0.4, 1.0, -1.9))
    words = "the panel 'Joint sliders' of `gazelle view`, which publishes on /gui/sliders"
    until(lambda: words in caplog.text)
    sender = watcher.advertise("/gui/sliders", state)
    until(lambda: sender.num_connections)
    sender.publish(state(name=["lift"], position=[0.5]))
    until(lambda: got[-1].position[0] == 0.5)
    with GraphInspector("rosnode", master_uri=master.uri) as graph:
        assert kill(graph, ["/gui"]) == []
    running.end(stop=False)


def test_launch_files_find_both_nodes():
    assert callable(main_of("robot_state_publisher", "robot_state_publisher"))
    assert callable(main_of("joint_state_publisher", "joint_state_publisher"))


def test_a_publisher_of_states_starts_without_arrays():
    """It reads a description by itself: the readers of files take a third of a second to import."""
    code = "import gazelle_ros.builtin.robot, sys; sys.exit('numpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
