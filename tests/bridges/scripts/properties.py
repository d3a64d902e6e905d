#!/usr/bin/env python
# ruff: noqa: E741, F405  it is written as people write such scripts
"""Every service about links, joints, bodies and lights, with star imports."""

import rospy
from gazebo_msgs.msg import *  # noqa: F403
from gazebo_msgs.srv import *  # noqa: F403
from geometry_msgs.msg import *  # noqa: F403

rospy.init_node("properties")


def call(name, kind, *args, **keywords):
    rospy.wait_for_service("/gazebo/" + name, 60)
    return rospy.ServiceProxy("/gazebo/" + name, kind)(*args, **keywords)


w = call("get_world_properties", GetWorldProperties)
print(sorted(w.model_names), w.rendering_enabled, w.success, w.status_message)
m = call("get_model_properties", GetModelProperties, "r1")
print(repr(m.parent_model_name), repr(m.canonical_body_name), m.body_names, m.is_static)
for name in m.joint_names:
    j = call("get_joint_properties", GetJointProperties, name)
    print(name, j.type, j.damping, len(j.position), len(j.rate), j.status_message)
for name in m.body_names:
    p = call("get_link_properties", GetLinkProperties, "r1::" + name)
    print(name, p.gravity_mode, round(p.mass, 4), p.status_message)
    numbers = {key: getattr(p, key) for key in ("mass", "ixx", "ixy", "ixz", "iyy", "iyz", "izz")}
    mode = dict(link_name="r1::" + name, com=p.com, gravity_mode=True, **numbers)
    print(call("set_link_properties", SetLinkProperties, **mode).status_message)
config = ODEJointProperties()
config.damping, config.fmax, config.vel = [0.1], [1.0], [0.0]
print(call("set_joint_properties", SetJointProperties, "wheel_left_joint", config).success)
link = LinkState()
link.link_name = "r1::base_footprint"
link.pose = Pose(Point(0.5, -0.5, 0.0), Quaternion(0, 0, 0, 1))
print(call("set_link_state", SetLinkState, link))
l = call("get_link_state", GetLinkState, "r1::base_footprint", "world").link_state
print(l.link_name, round(l.pose.position.x, 1), l.reference_frame)
wrench = Wrench(Vector3(0, 0, 5), Vector3(0, 0, 0))
start, forever = rospy.Time(0), rospy.Duration(-1)
body = "r1::base_footprint"
done = call("apply_body_wrench", ApplyBodyWrench, body, "world", Point(), wrench, start, forever)
print(done.success, repr(done.status_message), call("clear_body_wrenches", BodyRequest, body))
effort = ("wheel_left_joint", 0.1, rospy.Time(), rospy.Duration(0.5))
print(call("apply_joint_effort", ApplyJointEffort, *effort).status_message)
print(repr(str(call("clear_joint_forces", JointRequest, joint_name="wheel_left_joint"))))
print(call("get_light_properties", GetLightProperties, "nolight").status_message)
print(call("delete_light", DeleteLight, "nolight").success)
