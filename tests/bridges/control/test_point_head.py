"""The node that points a head, beside a controller that does at once what it is told."""

import math
import threading

import numpy as np
import pytest
from ros.graph import until

from gazelle import formats
from gazelle.bridges.control.point_head import HeadPointer
from gazelle.kinematics import RobotModel
from gazelle.kinematics.pointing import Pointing
from gazelle_ros import Master, Node
from gazelle_ros.actions import SimpleActionClient
from gazelle_ros.actions.states import GoalStatus
from gazelle_ros.messages import load_message
from gazelle_ros.time import Time

MASS = """<inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"""
LINKS = "".join(f'<link name="{name}">{MASS}</link>' for name in ("base", "body", "pan", "tilt"))
URDF = f"""<robot name="head">{LINKS}<link name="eye"/>
<joint name="lift" type="prismatic"><parent link="base"/><child link="body"/><axis xyz="0 0 1"/>
<limit lower="0" upper="1" effort="1" velocity="1"/></joint>
<joint name="pan" type="revolute"><parent link="body"/><child link="pan"/><origin xyz="0.1 0 0.6"/>
<axis xyz="0 0 1"/><limit lower="-1.5" upper="1.5" effort="1" velocity="2"/></joint>
<joint name="tilt" type="revolute"><parent link="pan"/><child link="tilt"/><origin xyz="0.1 0 0.05"/>
<axis xyz="0 1 0"/><limit lower="-0.7" upper="1.4" effort="1" velocity="2"/></joint>
<joint name="eye" type="fixed"><parent link="tilt"/><child link="eye"/>
<origin xyz="0.05 0.02 0.03" rpy="-1.5708 0 -1.5708"/></joint></robot>"""


def head():
    return RobotModel(formats.load_model_string(URDF))


@pytest.mark.parametrize(("link", "axis"), [("tilt", (1, 0, 0)), ("eye", (0, 0, 2))])
@pytest.mark.parametrize("start", [(0.0, 0.0), (-1.4, 1.2)])
def test_the_axis_goes_through_the_place(link, axis, start):
    robot = head()
    pointing = Pointing(robot, ("pan", "tilt"), link, axis)
    assert pointing.base == "body"
    for place in np.random.default_rng(0).uniform((0.8, -1.5, 0.2), (3.0, 1.5, 1.2), (20, 3)):
        found, left = pointing.solve(place, start)
        assert left < 1e-6
        state = robot.zero()
        state[robot.columns(["pan", "tilt"])] = found
        matrix = robot.forward(state, link)
        line = matrix[:3, :3] @ np.array(axis) / np.linalg.norm(axis)
        away = place - matrix[:3, 3]
        assert away / np.linalg.norm(away) == pytest.approx(line, abs=1e-6)


def test_beyond_the_limits_it_goes_as_far_as_they_let_it():
    found, left = Pointing(head(), ("pan", "tilt"), "tilt").solve((-0.1, 3.0, 0.65), (0.0, 0.0))
    assert found[0] == pytest.approx(1.5)
    assert 0.0 < left < 0.2


class InstantController:
    """Says where a head is, which is where it was last told to be; ``stuck`` it never moves."""

    def __init__(self, node, *, stuck=False):
        self.positions, self.stuck = np.array([0.3, 0.1]), stuck
        self.told = []
        self._node, self._now, self._stop = node, 0.0, threading.Event()
        self._kind = load_message("control_msgs/JointTrajectoryControllerState")
        self._point = load_message("trajectory_msgs/JointTrajectoryPoint")
        self._state = node.advertise("/head_controller/state", self._kind, queue_size=1)
        node.subscribe(
            "/head_controller/command", load_message("trajectory_msgs/JointTrajectory"), self._take
        )
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()

    def _take(self, message):
        self.told.append(message)
        if not self.stuck:
            self.positions = np.array(message.points[-1].positions)

    def _run(self):
        while not self._stop.wait(0.005):
            self._now += 0.1
            message = self._kind(joint_names=["pan", "tilt"])
            message.header.stamp = Time.from_sec(self._now)
            message.actual = self._point(positions=self.positions.tolist())
            self._state.publish(message)

    def close(self):
        self._stop.set()
        self._thread.join()


@pytest.fixture
def graph():
    with Master(port=0, rosout=False) as master, Node("other", master_uri=master.uri) as node:
        node.set_param("/robot_description", URDF)
        node.set_param("/head_controller/point_head/tilt_link", "tilt")
        yield master, node


def ask(master, node, place, frame="world", **fields):
    """Point the head to a place; return the state of the goal, and the log."""
    kind = load_message("control_msgs/PointHeadGoal")
    goal = kind(**fields)
    goal.target.header.frame_id = frame
    goal.target.point.x, goal.target.point.y, goal.target.point.z = place
    frames = load_message("tf2_msgs/TFMessage")
    stamped = load_message("geometry_msgs/TransformStamped")(child_frame_id="body")
    stamped.header.frame_id = "world"
    stamped.transform.translation.x, stamped.transform.rotation.w = 5.0, 1.0
    publisher = node.advertise("/tf_static", frames, latch=True)
    publisher.publish(frames(transforms=[stamped]))
    with Node("point_head", namespace="/head_controller", master_uri=master.uri) as pointing:
        pointer = HeadPointer(pointing)
        until(lambda: frame != "world" or pointer._tree.has("world"))
        spec = load_message("control_msgs/PointHeadAction")
        client = SimpleActionClient(node, "/head_controller/point_head", spec)
        assert client.wait_for_server(30.0)
        client.send_goal(goal)
        assert client.wait_for_result(30.0)
        return client.get_state(), client.get_goal_status_text()


def test_a_goal_moves_the_head_and_ends_when_it_points_there(graph):
    master, node = graph
    controller = InstantController(node)
    try:
        state, _ = ask(master, node, (7.0, 1.0, 0.5), max_velocity=0.5)
    finally:
        controller.close()
    assert state == GoalStatus.SUCCEEDED
    (message,) = controller.told
    pan, _ = message.points[0].positions
    assert pan == pytest.approx(math.atan2(1.0, 1.9), abs=0.02)
    turned = np.abs(np.array(message.points[0].positions) - (0.3, 0.1)).max()
    assert message.points[0].time_from_start.to_sec() == pytest.approx(turned / 0.5, abs=1e-6)


@pytest.mark.parametrize(
    ("place", "frame", "stuck", "why"),
    [
        ((7.0, 1.0, 0.5), "nowhere", False, "frame 'nowhere' is not known"),
        ((4.0, 0.0, 0.5), "world", False, "rad off the target: its joints' limits"),
        ((7.0, 1.0, 0.5), "world", True, "rad off the target: its controller"),
    ],
)
def test_a_goal_that_cannot_be_reached_says_why(graph, place, frame, stuck, why):
    master, node = graph
    controller = InstantController(node, stuck=stuck)
    try:
        state, text = ask(master, node, place, frame)
    finally:
        controller.close()
    assert state == GoalStatus.ABORTED
    assert why in text
