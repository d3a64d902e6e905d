"""Debian's real rospy and tools beside the Gazebo server."""

from __future__ import annotations

import json
import subprocess
import threading

import pytest
from odd_calls import ODD, kind_of
from real_messages import generate_real_classes
from ros.real import INSTALLED, PYTHON, environment

pytestmark = pytest.mark.ros

EVERY_SERVICE = """
import rospy, sys
from gazebo_msgs.srv import *
from gazebo_msgs.msg import *
from std_srvs.srv import Empty
from geometry_msgs.msg import *
rospy.init_node("real", anonymous=True)
BALL = '''<sdf version="1.6"><model name="x"><link name="core"><inertial><mass>2</mass></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>'''
LAMP = '''<sdf version="1.6"><light type="point" name="lamp"><pose>0 0 3 0 0 0</pose></light></sdf>'''
URDF = '''<?xml version="1.0"?><robot name="r"><link name="base"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link></robot>'''
def call(name, kind, *args, **kw):
    rospy.wait_for_service("/gazebo/" + name, 60.0)
    answer = rospy.ServiceProxy("/gazebo/" + name, kind)(*args, **kw)
    print(name, "|", getattr(answer, "success", ""), "|", getattr(answer, "status_message", ""), flush=True)
    return answer
pose = Pose(); pose.position.z = 2.0; pose.orientation.w = 1.0
call("pause_physics", Empty)
call("spawn_sdf_model", SpawnModel, "ball", BALL, "", pose, "world")
call("spawn_sdf_model", SpawnModel, "ball", BALL, "", pose, "world")
call("spawn_urdf_model", SpawnModel, "robot", URDF, "", pose, "")
call("spawn_sdf_model", SpawnModel, "lamp", LAMP, "", pose, "")
call("get_light_properties", GetLightProperties, "lamp")
call("set_light_properties", SetLightProperties, light_name="lamp")
call("delete_light", DeleteLight, "lamp")
call("get_model_properties", GetModelProperties, "ball")
assert call("get_model_state", GetModelState, "ball", "").pose.position.z == 2.0
call("get_model_state", GetModelState, "nobody", "")
call("get_world_properties", GetWorldProperties)
call("get_joint_properties", GetJointProperties, "wheel_left_joint")
call("get_joint_properties", GetJointProperties, "none")
assert call("get_link_properties", GetLinkProperties, "ball::core").mass == 2.0
call("get_link_state", GetLinkState, "ball::core", "world")
p = call("get_physics_properties", GetPhysicsProperties)
assert p.pause and p.ode_config.sor_pgs_iters == 150
call("set_physics_properties", SetPhysicsProperties, p.time_step, p.max_update_rate, p.gravity, p.ode_config)
call("set_link_properties", SetLinkProperties, "ball::core", Pose(), True, 3.0, 1.0, 0, 0, 1.0, 0, 1.0)
call("set_model_state", SetModelState, ModelState("ball", pose, Twist(), "world"))
call("set_model_configuration", SetModelConfiguration, "r1", "", ["wheel_left_joint"], [0.5])
call("set_joint_properties", SetJointProperties, "wheel_left_joint", ODEJointProperties(damping=[0.1]))
call("set_link_state", SetLinkState, LinkState("ball::core", pose, Twist(), "world"))
call("apply_body_wrench", ApplyBodyWrench, body_name="ball::core", duration=rospy.Duration(0.1))
call("apply_joint_effort", ApplyJointEffort, "wheel_left_joint", 0.01, rospy.Time(0), rospy.Duration(0.1))
call("clear_joint_forces", JointRequest, "wheel_left_joint")
call("clear_body_wrenches", BodyRequest, "ball::core")
call("unpause_physics", Empty)
states = rospy.wait_for_message("/gazebo/model_states", ModelStates, 60.0)
assert "ball" in states.name and len(states.pose) == len(states.twist) == len(states.name)
links = rospy.wait_for_message("/gazebo/link_states", LinkStates, 60.0)
assert "r1::base_footprint" in links.name
rospy.wait_for_message("/gazebo/performance_metrics", PerformanceMetrics, 60.0)
call("delete_model", DeleteModel, "ball")
call("delete_model", DeleteModel, "ball")
call("reset_simulation", Empty)
call("reset_world", Empty)
print("END", flush=True)
"""
ANSWERS = """
pause_physics |  |
spawn_sdf_model | True | SpawnModel: Successfully spawned entity
spawn_sdf_model | False | SpawnModel: Failure - entity already exists.
spawn_urdf_model | True | SpawnModel: Successfully spawned entity
spawn_sdf_model | True | SpawnModel: Successfully spawned entity
get_light_properties | True |
set_light_properties | True |
delete_light | True | DeleteLight: lamp successfully deleted
get_model_properties | True | GetModelProperties: got properties
get_model_state | True | GetModelState: got properties
get_model_state | False | GetModelState: model does not exist
get_world_properties | True | GetWorldProperties: got properties
get_joint_properties | True | GetJointProperties: got properties
get_joint_properties | False | GetJointProperties: joint not found
get_link_properties | True | GetLinkProperties: got properties
get_link_state | True | GetLinkState: got state
get_physics_properties | True | GetPhysicsProperties: got properties
set_physics_properties | True | physics engine updated
set_link_properties | True | SetLinkProperties: properties set
set_model_state | True | SetModelState: set model state done
set_model_configuration | True | SetModelConfiguration: success
set_joint_properties | True | SetJointProperties: properties set
set_link_state | True | SetLinkState: success
apply_body_wrench | True |
apply_joint_effort | True | ApplyJointEffort: effort set
clear_joint_forces |  |
clear_body_wrenches |  |
unpause_physics |  |
delete_model | True | DeleteModel: successfully deleted model
delete_model | False | DeleteModel: model does not exist
reset_simulation |  |
reset_world |  |
END
"""


ODD_CALLS = """
import json, math, rospy, sys
import gazebo_msgs.srv as services
from gazebo_msgs.msg import *
from geometry_msgs.msg import *
from std_srvs.srv import Empty
rospy.init_node("real", anonymous=True)
def call(name, kind, **fields):
    rospy.wait_for_service("/gazebo/" + name, 60.0)
    return rospy.ServiceProxy("/gazebo/" + name, getattr(services, kind))(**fields)
def say(answer): print(answer.success, "|", answer.status_message, flush=True)
for name, kind, fields in json.loads(sys.argv[1]):
    say(call(name, kind, **fields))
say(call("set_model_state", "SetModelState", model_state=ModelState(model_name="no")))
say(call("set_model_state", "SetModelState", model_state=ModelState(model_name="r1", reference_frame="no")))
say(call("set_link_state", "SetLinkState", link_state=LinkState(link_name="no")))
say(call("set_link_state", "SetLinkState", link_state=LinkState(link_name="r1::base_footprint", reference_frame="no")))
try:
    call("spawn_urdf_model", "SpawnModel", model_name="x", model_xml="<sdf/>")
except rospy.ServiceException as error:
    print("refused |", str(error).partition(": ")[0], flush=True)
POST = '''<sdf version="1.6"><model name="p"><link name="a"><inertial><mass>1</mass></inertial></link>
<link name="b"><inertial><mass>1</mass></inertial></link><joint name="weld" type="fixed">
<parent>a</parent><child>b</child></joint></model></sdf>'''
say(call("spawn_sdf_model", "SpawnModel", model_name="post", model_xml=POST))
weld = call("get_joint_properties", "GetJointProperties", joint_name="weld")
say(weld)
assert weld.type == 0 and not weld.damping and math.isnan(weld.position[0]) and weld.rate == (0.0,), weld
say(call("apply_joint_effort", "ApplyJointEffort", joint_name="weld", effort=1.0))
say(call("set_joint_properties", "SetJointProperties", joint_name="weld"))
"""
OWN_AND_TOPICS = """
import rospy
from gazelle_msgs.srv import *
from gazebo_msgs.msg import LinkState, ModelState
from gazebo_msgs.srv import GetModelState
from geometry_msgs.msg import Pose
from rosgraph_msgs.msg import Clock
from std_srvs.srv import Empty
rospy.init_node("real", anonymous=True)
def call(name, kind, **fields):
    rospy.wait_for_service(name, 60.0)
    return rospy.ServiceProxy(name, kind)(**fields)
def say(answer): print(answer.success, "|", answer.status_message, flush=True)
def x(): return call("/gazebo/get_model_state", GetModelState, model_name="r1").pose.position.x
assert rospy.wait_for_message("/clock", Clock, 60.0).clock.to_sec() > 0.0
say(call("/gazelle/step", Step, steps=1))
call("/gazebo/pause_physics", Empty)
before = call("/gazelle/step", Step, steps=0).time
stepped = call("/gazelle/step", Step, steps=25)
say(stepped)
assert abs((stepped.time - before).to_sec() - 0.025) < 1e-9
taken = call("/gazelle/snapshot", Snapshot)
say(taken)
for topic, kind, fields in (
    ("/gazebo/set_model_state", ModelState, {"model_name": "r1"}),
    ("/gazebo/set_link_state", LinkState, {"link_name": "r1::base_footprint"}),
):
    state = kind(**fields); state.pose.orientation.w = 1.0; state.pose.position.x = x() + 0.5
    said = rospy.Publisher(topic, kind, queue_size=1, latch=True); said.publish(state)
    for _ in range(6000):
        if abs(x() - state.pose.position.x) < 1e-6: break
        rospy.rostime.wallsleep(0.01)
    print(topic, abs(x() - state.pose.position.x) < 1e-6, flush=True)
    said.unregister()
say(call("/gazelle/restore", Restore, state=taken.state))
assert abs(x()) < 0.1, x()
say(call("/gazelle/restore", Restore, state=b"nonsense"))
say(call("/gazelle/set_real_time_factor", SetRealTimeFactor, real_time_factor="inf"))
say(call("/gazelle/set_real_time_factor", SetRealTimeFactor, real_time_factor="quick"))
say(call("/gazelle/seed", Seed, seed=5))
"""
OWN_ANSWERS = """
False | Step: the simulation is not paused
True | Step: steps made
True | Snapshot: taken
/gazebo/set_model_state True
/gazebo/set_link_state True
True | Restore: done
False | Restore: ...
True | SetRealTimeFactor: done
False | SetRealTimeFactor: expected a positive number or max, not 'quick'
True | Seed: the simulation is reset
"""
ODD_ENDS = """
False | SetModelState: model does not exist
False | SetModelState: specified reference frame entity does not exist
False | SetLinkState: link does not exist
False | SetLinkState: failed
refused | service [/gazebo/spawn_urdf_model] responded with an error
True | SpawnModel: Successfully spawned entity
True | GetJointProperties: got properties
True | ApplyJointEffort: effort set
True | SetJointProperties: properties set
"""


@pytest.fixture(scope="module")
def classes(tmp_path_factory):
    if not INSTALLED:
        pytest.skip("the real ROS 1 is not installed (Debian: ros-core python3-rospy)")
    packages = {"gazebo_msgs", "gazelle_msgs"}
    return generate_real_classes(packages, tmp_path_factory.mktemp("genpy"))


@pytest.fixture
def background(graph):
    """Yield the world running in real time beside the test."""
    thread = threading.Thread(target=graph.server.run)
    thread.start()
    yield graph
    graph.server.stop()
    thread.join()


def run(uri, classes, *command):
    finished = subprocess.run(
        command,
        env=environment(uri) | {"PYTHONPATH": str(classes)},
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert finished.returncode == 0, finished.stdout + finished.stderr
    return finished.stdout


@pytest.mark.long
def test_a_real_client_gets_gazebos_answers_from_every_service(background, classes):
    said = run(background.master.uri, classes, PYTHON, "-c", EVERY_SERVICE)
    lines = [line.rstrip() for line in said.strip().splitlines()]
    assert lines == ANSWERS.strip().splitlines()


@pytest.mark.long
def test_a_real_client_gets_gazebos_answers_to_what_cannot_be_done(background, classes):
    calls = json.dumps([(service, kind_of(service), fields) for service, fields, _ in ODD])
    said = run(background.master.uri, classes, PYTHON, "-c", ODD_CALLS, calls)
    expected = [f"False | {text}" for _, _, text in ODD] + ODD_ENDS.strip().splitlines()
    assert said.strip().splitlines() == expected


@pytest.mark.long
def test_a_real_client_uses_what_gazebo_does_not_have(background, classes):
    said = run(background.master.uri, classes, PYTHON, "-c", OWN_AND_TOPICS)
    lines = said.strip().splitlines()
    lines = [
        f"{head}: ..." if "False | Restore" in head else line
        for line in lines
        for head in [line.partition(": ")[0]]
    ]
    assert lines == OWN_ANSWERS.strip().splitlines()


@pytest.mark.long
def test_the_real_tools_see_the_types_of_services_and_topics(background, classes):
    uri = background.master.uri
    assert run(uri, classes, "rosservice", "type", "/gazebo/spawn_sdf_model").strip() == (
        "gazebo_msgs/SpawnModel"
    )
    called = run(uri, classes, "rosservice", "call", "/gazebo/get_world_properties")
    assert "r1" in called
    echoed = run(uri, classes, "rostopic", "echo", "-n1", "/gazebo/model_states/name")
    assert "r1" in echoed
