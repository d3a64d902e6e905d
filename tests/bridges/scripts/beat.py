#!/usr/bin/env python3
"""Parameters, rates, timers and logs on simulated time."""

import rospy
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64


class Beat:
    def __init__(self):
        self.rate_hz = rospy.get_param("~rate", 20.0)
        self.pub = rospy.Publisher("~beat", Float64, queue_size=10, latch=True)
        self.ticks = []
        self.timer = rospy.Timer(rospy.Duration(0.1), self.tick)
        rospy.on_shutdown(lambda: print("bye"))

    def tick(self, event):
        self.ticks.append(event.current_real)

    def run(self):
        rate = rospy.Rate(self.rate_hz)
        start = rospy.Time.now()
        for i in range(20):
            self.pub.publish(i / self.rate_hz)
            rate.sleep()
        passed = (rospy.Time.now() - start).to_sec()
        print("a second", 0.9 < passed < 1.3)
        print("ticks", 7 <= len(self.ticks) <= 13)
        self.timer.shutdown()


if __name__ == "__main__":
    rospy.init_node("beat")
    rospy.set_param("~gains", {"p": 1.5, "i": 0.0, "names": ["left", "right"]})
    print(rospy.get_param("/use_sim_time"), rospy.get_param("~gains/p"), rospy.has_param("~d"))
    print(sorted(rospy.get_param("beat/gains")), rospy.search_param("gains"))
    print(rospy.get_name(), rospy.get_namespace(), rospy.resolve_name("~beat"))
    while rospy.Time.now().is_zero():
        pass
    joints = rospy.wait_for_message("joint_states", JointState, timeout=60.0)
    print(joints.name, len(joints.position))
    Beat().run()
    print(sorted(t for t, _ in rospy.get_published_topics("/beat")))
    rospy.delete_param("~gains")
    rospy.loginfo("done at %.1f", rospy.get_time())
    rospy.signal_shutdown("done")
