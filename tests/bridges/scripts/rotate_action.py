#!/usr/bin/env python
# ruff: noqa: UP004  it is written as people write such scripts
"""An action server that turns the robot, and its client: done, fed back, preempted."""

import actionlib
import rospy
from actionlib.msg import TestAction, TestFeedback, TestGoal, TestResult
from geometry_msgs.msg import Twist


class Rotate(object):
    def __init__(self, name):
        self.pub = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.server = actionlib.SimpleActionServer(name, TestAction, self.execute, False)
        self.server.start()

    def execute(self, goal):
        rate = rospy.Rate(10)
        twist = Twist()
        twist.angular.z = 0.5
        for i in range(goal.goal):
            if self.server.is_preempt_requested():
                self.server.set_preempted()
                break
            self.server.publish_feedback(TestFeedback(i))
            self.pub.publish(twist)
            rate.sleep()
        else:
            self.server.set_succeeded(TestResult(42))
        self.pub.publish(Twist())


rospy.init_node("rotate")
server = Rotate(rospy.get_name())
client = actionlib.SimpleActionClient("rotate", TestAction)
print(client.wait_for_server(rospy.Duration(5)))
fed = []
client.send_goal(TestGoal(5), feedback_cb=lambda f: fed.append(f.feedback))
print(
    client.wait_for_result(rospy.Duration(5)), client.get_state(), client.get_result().result, fed
)
client.send_goal(TestGoal(50))
rospy.sleep(0.5)
client.cancel_goal()
print(client.wait_for_result(rospy.Duration(5)), client.get_state())
rospy.signal_shutdown("done")
