#!/usr/bin/env python3
# ruff: noqa: UP031  it is written as people write such scripts
"""Puts the robot from place to place, by the service and by the topic."""

import math

import rospy
from gazebo_msgs.msg import ModelState, ModelStates
from gazebo_msgs.srv import GetModelState, SetModelState
from tf.transformations import euler_from_quaternion, quaternion_from_euler

PLACES = [(0.5, 0.5, 0.0), (-0.5, 0.5, math.pi / 2), (-0.5, -0.5, math.pi), (0.5, -0.5, -1.0)]


class Teleporter:
    def __init__(self, model):
        self.model = model
        self.states = None
        rospy.Subscriber("/gazebo/model_states", ModelStates, self.on_states, queue_size=1)
        self.topic = rospy.Publisher("/gazebo/set_model_state", ModelState, queue_size=1)
        rospy.wait_for_service("/gazebo/set_model_state")
        self.set_state = rospy.ServiceProxy("/gazebo/set_model_state", SetModelState)
        self.get_state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)

    def on_states(self, msg):
        self.states = msg

    def told(self):
        if self.states is None:
            return None
        index = self.states.name.index(self.model)
        return "%.1f" % self.states.pose[index].position.x

    def state(self, x, y, yaw):
        state = ModelState()
        state.model_name = self.model
        state.reference_frame = "world"
        state.pose.position.x = x
        state.pose.position.y = y
        q = quaternion_from_euler(0.0, 0.0, yaw)
        state.pose.orientation.x, state.pose.orientation.y = q[0], q[1]
        state.pose.orientation.z, state.pose.orientation.w = q[2], q[3]
        return state

    def where(self):
        pose = self.get_state(self.model, "").pose
        q = pose.orientation
        yaw = euler_from_quaternion([q.x, q.y, q.z, q.w])[2]
        return "%.1f %.1f %.1f" % (pose.position.x, pose.position.y, abs(yaw))

    def run(self):
        for place in PLACES:
            answer = self.set_state(self.state(*place))
            print(answer.success, answer.status_message, self.where())
        while self.topic.get_num_connections() == 0 and not rospy.is_shutdown():
            rospy.sleep(0.05)
        self.topic.publish(self.state(0.8, 0.0, 0.0))
        while not self.where().startswith("0.8 "):
            rospy.sleep(0.02)
        print("topic", self.where().split()[0])
        print(self.set_state(ModelState(model_name="ghost")).status_message)
        odd = self.state(0, 0, 0)
        odd.reference_frame = "nowhere"
        print(self.set_state(odd).status_message)
        while self.told() != "0.8":  # what came last may be from before
            rospy.sleep(0.02)
        print(self.told())


if __name__ == "__main__":
    rospy.init_node("teleport")
    Teleporter(rospy.get_param("~model", "r1")).run()
