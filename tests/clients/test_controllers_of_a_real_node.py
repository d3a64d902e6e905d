"""The clients of controllers against Debian's real rospy and actionlib, in a manager's place."""

from __future__ import annotations

import json

import pytest
from ros.real import INSTALLED, RealNode

from gazelle.clients import ClientError, Controllers, JointCommander, TrajectoryClient
from gazelle_ros import Master, Node, load_message, load_service

pytestmark = pytest.mark.ros

CLASSES = """
import json, genpy.dynamic
TEXTS = json.loads(sys.argv[1])
def message(name):
    return genpy.dynamic.generate_dynamic(name, TEXTS[name])
def service(name):
    made = {}
    for part in ("Request", "Response"):
        made |= {part: message(f"controller_manager_msgs/{name}{part}")}
    fields = {f"_{part.lower()}_class": made[part][f"controller_manager_msgs/{name}{part}"] for part in made}
    fields |= {"_type": f"controller_manager_msgs/{name}", "_md5sum": TEXTS[name]}
    return type(name, (), fields), made["Response"]
"""
MANAGER = """
rospy.init_node("manager")
states, answers, types = {}, {}, {}
def serve(short, kind, act):
    made, answers[short] = service(kind)
    types[short] = made
    rospy.Service("/r1/controller_manager/" + short, made, lambda request: types[short]._response_class(**act(request)))
def listed(request):
    made = answers["list_controllers"]["controller_manager_msgs/ControllerState"]
    return {"controller": [made(name=k, state=v) for k, v in states.items()]}
def load(request):
    good = request.name in ("left", "right") and request.name not in states
    if good: states[request.name] = "initialized"
    return {"ok": good}
def unload(request):
    good = states.get(request.name, "running") != "running"
    if good: del states[request.name]
    return {"ok": good}
def switch(request):
    wanted = set(request.start_controllers) | set(request.stop_controllers)
    good = request.strictness == 1 or wanted <= set(states)
    if good:
        for new, names in (("stopped", request.stop_controllers), ("running", request.start_controllers)):
            states.update((name, new) for name in names if name in states)
    return {"ok": good}
serve("list_controllers", "ListControllers", listed)
serve("load_controller", "LoadController", load)
serve("unload_controller", "UnloadController", unload)
serve("switch_controller", "SwitchController", switch)
serve("list_controller_types", "ListControllerTypes", lambda request: {"types": ["a/B"], "base_classes": ["c"]})
say("ready")
rospy.spin()
"""
ROBOT = """
import actionlib
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray
kinds = message("control_msgs/FollowJointTrajectoryAction")
kind = lambda name: kinds["control_msgs/FollowJointTrajectory" + name]
rospy.init_node("robot")
where = {"one": 0.0, "two": 0.0}
tell = rospy.Publisher("/r1/joint_states", JointState, queue_size=1)
def command(message): where.update(zip(sorted(where), message.data))
rospy.Subscriber("/r1/group/command", Float64MultiArray, command)
def follow(goal):
    feedback = kind("Feedback")(joint_names=goal.trajectory.joint_names)
    feedback.actual.positions = feedback.error.positions = goal.trajectory.points[-1].positions
    feedback.desired.time_from_start = goal.trajectory.points[-1].time_from_start
    server.publish_feedback(feedback)
    if "three" in goal.trajectory.joint_names:
        return server.set_aborted(kind("Result")(error_code=-4, error_string="three is slow"), "too slow")
    while not rospy.has_param("/told"):  # the result goes another way, and may come first
        time.sleep(0.02)
    server.set_succeeded()
server = actionlib.SimpleActionServer("/r1/follower/follow_joint_trajectory", kind("Action"), follow, False)
server.start()
say("ready")
while not rospy.is_shutdown():
    tell.publish(JointState(name=list(where), position=list(where.values())))
    time.sleep(0.02)
"""
KINDS = ("ListControllers", "ListControllerTypes", "LoadController", "UnloadController")
ACTION = "control_msgs/FollowJointTrajectoryAction"


def texts():
    """Return definitions in full, and the check sums of services."""
    found = {ACTION: load_message(ACTION)._full_text}
    for name in (*KINDS, "SwitchController"):
        service = load_service(f"controller_manager_msgs/{name}")
        found[name] = service._md5sum
        for part in (service._request_class, service._response_class):
            found[part._type] = part._full_text
    return json.dumps(found)


@pytest.fixture
def node():
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    with (
        Master(port=0, rosout=False) as master,
        Node("client", master_uri=master.uri) as client,
    ):
        yield client


def test_a_real_nodes_controllers_are_loaded_switched_and_killed(node):
    with (
        RealNode(node.master_uri, CLASSES + MANAGER, texts()) as real,
        Controllers(node, "/r1", timeout=60.0) as controllers,
    ):
        real.expect("ready")
        controllers.spawn(["left", "right"])
        assert controllers.states() == {"left": "running", "right": "running"}
        controllers.reset("left")
        controllers.stop(["left", "nobody"], strict=False)
        assert controllers.states() == {"left": "stopped", "right": "running"}
        with pytest.raises(ClientError, match=r"'nobody'.*it is not loaded"):
            controllers.stop("nobody")
        node.set_param("/r1/other/type", "a/C")
        with pytest.raises(ClientError, match="there is no type 'a/C'; did you mean 'a/B'"):
            controllers.load("other")
        controllers.kill(["left", "right"])
        assert controllers.states() == {}


@pytest.mark.long
def test_a_real_nodes_joints_are_commanded(node):
    node.set_param("/r1/group", {"joints": ["one", "two"]})
    with (
        RealNode(node.master_uri, CLASSES + ROBOT, texts()) as real,
        JointCommander(node, "group", "/r1") as joints,
        TrajectoryClient(node, "follower", "/r1", 60.0) as follower,
    ):
        real.expect("ready")
        assert joints.move([1.0, 2.0], timeout=60.0) == {"one": 1.0, "two": 2.0}
        told = []

        def note(progress):
            told.append(progress)
            node.set_param("/told", True)

        outcome = follower.move({"one": 0.5, "two": 0.25}, 3.0, progress=note)
        assert outcome.succeeded
        assert told[-1].seconds == 3.0
        assert told[-1].actual == {"one": 0.5, "two": 0.25}
        with pytest.raises(ClientError, match=r"ABORTED \(-4\) three is slow"):
            follower.move({"three": 0.5}, 1.0)
