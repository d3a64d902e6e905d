"""A simulated robot whose running trajectory controllers ``move_group`` finds by itself."""

import pytest
from bridges.control.robot_graph import robot_graph
from bridges.moveit.moveit_graph import message
from control.arms import JOINTS, arm_text

from gazelle.bridges.moveit.move_group import MoveGroupNode
from gazelle.planning import PlanOutcome
from gazelle_ros import Node, load_message
from gazelle_ros.actions import SimpleActionClient

SRDF = """<robot name="two_link_arm"><group name="arm">
  <joint name="shoulder"/><joint name="elbow"/></group></robot>"""


@pytest.mark.long
def test_a_simulated_arm_goes_where_it_is_told():
    with robot_graph(arm_text("Position")) as graph:
        graph.spawn("joints", "joint_state_controller/JointStateController", publish_rate=50)
        kind = "position_controllers/JointTrajectoryController"
        graph.spawn("arm_controller", kind, joints=JOINTS)
        graph.node.set_param("/arm/robot_description", arm_text("Position"))
        graph.node.set_param("/arm/robot_description_semantic", SRDF)
        patient = {
            "allowed_goal_duration_margin": 600.0
        }  # the simulation does not wait for messages
        graph.node.set_param("/arm/move_group/trajectory_execution", patient)
        with Node("move_group", namespace="/arm", master_uri=graph.node.master.uri) as node:
            group = MoveGroupNode(node)
            assert group.context.monitor.wait(60.0)
            client = SimpleActionClient(
                graph.node, "/arm/move_group", load_message("moveit_msgs/MoveGroupAction")
            )
            assert client.wait_for_server(60.0)
            goal = message("MoveGroupGoal")
            goal.request.group_name, goal.request.allowed_planning_time = "arm", 30.0
            goal.request.goal_constraints = [
                message("Constraints", joint_constraints=[
                    message("JointConstraint", joint_name=name, position=position,
                            tolerance_above=1e-3, tolerance_below=1e-3)
                    for name, position in (("shoulder", 0.4), ("elbow", -0.3))
                ])
            ]  # fmt: skip
            client.send_goal(goal)
            assert client.wait_for_result(600.0)
            assert client.get_result().error_code.val == PlanOutcome.SUCCESS
        robot = graph.sim.robots["two_link_arm"]
        assert robot.joints["shoulder"].position == pytest.approx(0.4, abs=0.01)
        assert robot.joints["elbow"].position == pytest.approx(-0.3, abs=0.01)
