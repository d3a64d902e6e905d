#!/usr/bin/env python3
# ruff: noqa: UP031  it is written as people write such scripts
"""Changes gravity and the time step by dynamic_reconfigure and by the services."""

import rospy
from dynamic_reconfigure.client import Client
from gazebo_msgs.srv import GetPhysicsProperties, SetPhysicsProperties, SetPhysicsPropertiesRequest
from geometry_msgs.msg import Vector3

rospy.init_node("change_physics")
client = Client("/gazebo", timeout=60)
get = rospy.ServiceProxy("/gazebo/get_physics_properties", GetPhysicsProperties)
put = rospy.ServiceProxy("/gazebo/set_physics_properties", SetPhysicsProperties)

config = client.get_configuration(timeout=60)
print(sorted(key for key in config if key != "groups"))
print("%.3f %.1f" % (config["time_step"], config["gravity_z"]))
config = client.update_configuration({"gravity_z": -1.6, "sor_pgs_iters": 77})
print("%.1f %d" % (config["gravity_z"], config["sor_pgs_iters"]))
now = get()
print(now.success, now.status_message, "%.1f" % now.gravity.z, now.ode_config.sor_pgs_iters)

request = SetPhysicsPropertiesRequest()
request.time_step = 0.002
request.max_update_rate = 500.0
request.gravity = Vector3(0.0, 0.0, -9.8)
request.ode_config = now.ode_config
answer = put(request)
print(answer.success, answer.status_message)
now = get()
print("%.3f %.0f %.1f" % (now.time_step, now.max_update_rate, now.gravity.z), now.pause)
put(0.001, 1000.0, Vector3(z=-9.8), now.ode_config)
print("%.3f" % get().time_step)
