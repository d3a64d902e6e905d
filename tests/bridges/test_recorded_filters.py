"""robot_localization's recorded drives end where its own tests ask, by its own launch files.

``GAZELLE_ROBOTS`` names a folder with a checkout of robot_localization (branch noetic-devel). Its drives are
played as fast as they can be used; the third one is not kept in the checkouts that are at hand.
"""

from __future__ import annotations

import math
import os
from pathlib import Path

import pytest
from ros.graph import until

from gazelle.bridges.conversions import set_point, set_quaternion
from gazelle.bridges.navigation import localization_filter
from gazelle.description import Pose
from gazelle_ros import Master, Node, load_message
from gazelle_ros.bags import Bag
from gazelle_ros.clock import SECOND, SimulatedClock
from gazelle_ros.launch import load_launch
from gazelle_ros.launch.packages import Packages

pytestmark = [pytest.mark.slow, pytest.mark.timeout(900)]


def checkout():
    found = Path(os.environ.get("GAZELLE_ROBOTS", "")) / "robot_localization"
    if not (found / "test" / "test1.bag").is_file():
        pytest.skip("no checkout of robot_localization is at hand (set GAZELLE_ROBOTS)")
    return found


class Replay:
    """A filter that is fed from a bag, in the time of the bag."""

    def __init__(self, uri, kind, parameters, topics):
        self.clock = SimulatedClock()
        self.clock.set(1)
        node = Node("/filter", master_uri=uri, clock=self.clock)
        node.set_param("/filter", parameters)
        prediction = {"ekf": "_extended", "ukf": "_unscented"}[kind]
        made = localization_filter.LocalizationFilterNode(
            node, getattr(localization_filter, prediction)
        )
        self.filter, self.period = made, round(SECOND / float(parameters["frequency"]))
        self.user = Node("/player", master_uri=uri, clock=self.clock)
        self.outputs = {
            topic: self.user.advertise(topic, load_message(type_)) for topic, type_ in topics
        }
        until(lambda: all(each.num_connections for each in self.outputs.values()))

    def mount(self, arguments):
        """Place a frame by the arguments of static_transform_publisher."""
        *numbers, parent, child = arguments.split()
        x, y, z, yaw, pitch, roll = map(float, numbers)
        kind = load_message("tf2_msgs/TFMessage")
        self.links = self.user.advertise("/tf_static", kind, latch=True)
        link = load_message("geometry_msgs/TransformStamped")()
        link.header.frame_id, link.child_frame_id = parent, child
        pose = Pose(x=x, y=y, z=z, roll=roll, pitch=pitch, yaw=yaw)
        set_point(link.transform.translation, pose.position)
        set_quaternion(link.transform.rotation, pose.quaternion)
        self.links.publish(kind(transforms=[link]))
        until(lambda: self.filter.frames.tree.has(child))

    def play(self, messages):
        """Publish all messages, and estimate at the rate of the filter."""
        sent, due = 0, None
        for topic, message, stamp in messages:
            now = stamp.to_nsec()
            due = now + self.period if due is None else due
            while now >= due:
                self.clock.set(due)
                until(lambda count=sent: self.seen() == count)
                self.filter.cycle()
                due += self.period
            self.clock.set(now)
            self.outputs[topic].publish(message)
            sent += 1
        until(lambda: self.seen() == sent)
        self.clock.set(due)
        self.filter.cycle()

    def seen(self):
        return sum(each.seen for each in self.filter._sources)

    def close(self):
        self.filter._node.close()
        self.user.close()


@pytest.mark.parametrize("number", [1, 2])
@pytest.mark.parametrize("kind", ["ekf", "ukf"])
def test_a_recorded_drive_ends_where_the_original_test_asks(kind, number):
    folder = checkout()
    packages = Packages({**os.environ, "ROS_PACKAGE_PATH": str(folder)})
    name = f"test_{kind}_localization_node_bag{number}"
    plan = load_launch(folder / "test" / f"{name}.test", packages=packages)
    values = {name: each.value for name, each in plan.parameters.items()}
    own = f"/{name}_{kind}/"
    parameters = {
        key.removeprefix(own): each for key, each in values.items() if key.startswith(own)
    }
    asked = {
        key.rpartition("/")[2]: each
        for key, each in values.items()
        if key.startswith(f"/{name}_pose/")
    }
    frames = [each.arguments for each in plan.nodes if each.type == "static_transform_publisher"]
    with Master(port=0, rosout=False) as master, Bag(folder / "test" / f"test{number}.bag") as bag:
        wanted = [parameters[each].lstrip("/") for each in ("odom0", "imu0")]
        known = bag.get_type_and_topic_info().topics
        topics = [(f"/{each}", known[f"/{each}"].msg_type) for each in wanted]
        replay = Replay(master.uri, kind, parameters, topics)
        try:
            for each in frames:
                replay.mount(each)
            replay.play(bag.read_messages(topics=[topic for topic, _ in topics]))
            place = replay.filter.kalman.estimate.state[:3]
        finally:
            replay.close()
    goal = [asked[f"final_{axis}"] for axis in "xyz"]
    off = math.dist(place, goal)
    print(f"\n| {kind}, bag {number} | {asked['tolerance']:.2f} m | {off:.3f} m |")
    assert off < asked["tolerance"]
