"""Asks and commands what the tool rqt_joint_trajectory_controller does, in that order; no windows."""

import math
import sys
import time
import xml.dom.minidom

import rospy
import rosservice
from control_msgs.msg import JointTrajectoryControllerState
from controller_manager_msgs.srv import ListControllers
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

try:
    from controller_manager_msgs.utils import (
        ControllerLister,
        ControllerManagerLister,
        filter_by_state,
        filter_by_type,
    )

    def managers():
        return ControllerManagerLister()()

    def following(space):
        found = ControllerLister(space)()
        found = filter_by_type(found, "JointTrajectoryController", match_substring=True)
        return filter_by_state(found, "running")

except ImportError:  # Debian has no such module; these are its questions

    def managers():
        end = "/list_controllers"
        names = [name for name in rosservice.get_service_list() if name.endswith(end)]
        kind = "controller_manager_msgs/ListControllers"
        return [name[: -len(end)] for name in names if rosservice.get_service_type(name) == kind]

    def following(space):
        ask = rospy.ServiceProxy(space + "/list_controllers", ListControllers, persistent=True)
        return [
            each
            for each in ask().controller
            if "JointTrajectoryController" in each.type and each.state == "running"
        ]


def limits():
    """Return (least, most, speed) of each joint that has limits."""
    found = {}
    text = rospy.get_param("robot_description")
    for joint in xml.dom.minidom.parseString(text).getElementsByTagName("joint"):
        limit = joint.getElementsByTagName("limit")
        if limit:
            round_and_round = joint.getAttribute("type") == "continuous"
            least, most = (
                (-math.pi, math.pi)
                if round_and_round
                else (float(limit[0].getAttribute(word)) for word in ("lower", "upper"))
            )
            speed = float(limit[0].getAttribute("velocity"))
            found[joint.getAttribute("name")] = (least, most, speed)
    return found


def wait(true):
    end = time.time() + 120
    while not true():
        if time.time() > end:
            raise SystemExit("it did not come true")
        time.sleep(0.01)


rospy.init_node("sliders")
print("managers", *managers())
space = managers()[0]
controller = following(space)[0]
names = controller.claimed_resources[0].resources
print(controller.name, controller.type, *names)
known = limits()
print(*(f"{name} {known[name][0]:.3g} {known[name][1]:.3g} {known[name][2]:.3g}" for name in names))

where = {}
place = space.rsplit("/", 1)[0] + "/" + controller.name
listener = rospy.Subscriber(
    place + "/state",
    JointTrajectoryControllerState,
    lambda message: where.update(zip(message.joint_names, message.actual.positions, strict=True)),
    queue_size=1,
)
publisher = rospy.Publisher(place + "/command", JointTrajectory, queue_size=1)
wait(lambda: set(where) == set(names) and publisher.get_num_connections())

# A slider was moved: its position goes out ten times a second, at half the speed.
wanted = dict.fromkeys(names, 0.3)


def send():
    trajectory = JointTrajectory(joint_names=names)
    trajectory.header.stamp = rospy.Time.now()
    point = JointTrajectoryPoint(positions=[wanted[name] for name in names])
    seconds = [max(abs(wanted[n] - where[n]) / known[n][2], 0.5) for n in names]
    point.time_from_start = rospy.Duration(max(seconds) / 0.5)
    trajectory.points.append(point)
    publisher.publish(trajectory)
    time.sleep(0.1)
    return all(abs(wanted[name] - where[name]) < 0.02 for name in names)


wait(send)
print("there")
# Another controller is chosen: the tool leaves these topics.
listener.unregister()
publisher.unregister()
sys.stdout.flush()
