"""The page of a graph beside the real roscore, with a node of the real rospy."""

import pytest

pytest.importorskip("viser", reason="the extra 'web' is not installed")

from tests.ros import real
from tests.ros.graph import until
from tests.viewer.graph_page import graph_page

pytestmark = [pytest.mark.ros, pytest.mark.long, pytest.mark.slow, real.needs_ros]

ROBOT = """
from geometry_msgs.msg import PoseStamped, TransformStamped
from nav_msgs.msg import Path
from tf2_msgs.msg import TFMessage
rospy.init_node("real_robot")
tf = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
frame = TransformStamped(child_frame_id="base_link")
frame.header.frame_id = "map"; frame.transform.rotation.w = 1.0
tf.publish(TFMessage([frame]))
paths = rospy.Publisher("/plan", Path, queue_size=1, latch=True)
path = Path(); path.header.frame_id = "map"
for x in (0.0, 1.0, 3.0):
    pose = PoseStamped(); pose.pose.position.x = x; path.poses.append(pose)
paths.publish(path)
rospy.Subscriber("/move_base_simple/goal", PoseStamped, lambda goal: say("goal", goal.header.frame_id))
rospy.Service("/flip", SetBool, lambda asked: SetBoolResponse(asked.data, "flipped by rospy"))
say("ready"); rospy.spin()
"""


def test_a_real_node_is_seen_called_and_sent_to_a_goal():
    with real.master() as uri, real.RealNode(uri, ROBOT) as robot:
        robot.expect("ready")
        with graph_page(master_uri=uri) as graph:
            until(lambda: "/plan" in graph.view._displays.topics)
            until(lambda: graph.view._displays.topics["/plan"].drawing.part("path") is not None)
            publisher = graph.view._tools._publishers["2D Nav Goal"]
            until(lambda: publisher.num_connections == 1)
            graph.choose("Tool", "2D Nav Goal")
            graph.wait_text("and drag to where it")
            graph.drag((220, 280), (320, 280))
            robot.expect("goal map")
            graph.choose("Open panel", "Service caller")
            graph.fill("Filter", "/flip")
            graph.choose("Service", "/flip")
            until(lambda: graph.box("Request").input_value() == "data: False")
            graph.fill("Request", "data: true")
            graph.click("Call")
            graph.wait_text("flipped by rospy")
            graph.click("Close")
            graph.choose("Open panel", "Node graph")
            graph.choose("Show", "nodes and topics")
            graph.page.locator("svg", has_text="/real_robot").wait_for()
