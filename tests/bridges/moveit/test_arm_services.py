"""The node ``fetch_moveit``: the four services that openai_ros' tasks of Fetch call, and their client."""

import math

import pytest
from bridges.moveit.commander_graph import commander_graph

from gazelle.clients import ArmCommander, ClientError
from gazelle.drop_in.moveit_client.arm_services import ArmServices
from gazelle_ros import Node, load_message, load_service
from gazelle_ros.builtin.registry import main_of

READY = (0.0, -0.8, 0.0, 1.2, 0.0, -0.4, 0.0)
SUMS = {
    "EeTraj": "28e4dd667b29bd35b516ba1d379b7529",
    "JointTraj": "3fc8a9e27b55b9b20a2c846f9e053a5c",
    "EePose": "f192399f711a48924df9a394d37edd67",
    "EeRpy": "cfb6f20560ab4d9cc1d682755cf3b5d4",
}


@pytest.fixture(scope="module")
def graph():
    patient = {"allowed_goal_duration_margin": 60.0}
    with (
        commander_graph(trajectory_execution=patient) as (client, _),
        Node("/fetch_moveit", master_uri=client.node.master_uri) as node,
    ):
        ArmServices(node)
        yield client


@pytest.fixture
def arm(graph):
    with ArmCommander(graph.node) as made:
        made.go_to_joints(READY)
        yield made


def call(graph, service, kind, **fields):
    found = load_service(f"fetch_train/{kind}")
    return graph.node.client(service, found).call(found._request_class(**fields), timeout=60)


@pytest.mark.parametrize("kind", SUMS)
def test_types_are_those_of_the_original(kind):
    assert load_service(f"fetch_train/{kind}")._md5sum == SUMS[kind]


def test_the_package_has_the_node():
    assert (
        main_of("fetch_train", "fetch_moveit").__module__
        == "gazelle.drop_in.moveit_client.arm_services"
    )


def test_it_moves_to_joints_and_says_where_it_is(graph, arm):
    wanted = (0.3, -0.6, 0.1, 1.0, 0.2, -0.3, 0.4)
    point = load_message("trajectory_msgs/JointTrajectoryPoint")(positions=[*wanted, 9.0])
    answer = call(graph, "/joint_traj_srv", "JointTraj", point=point)
    assert (answer.success, answer.message) == (True, "Everything went OK")
    robot = graph.group.context.robot
    found, state = arm.pose(), robot.zero()
    state[robot.group("arm").columns] = wanted
    pose = robot.pose(state, "gripper_link")
    assert found.position == pytest.approx(pose.position, abs=2e-3)
    assert found.quaternion == pytest.approx(pose.quaternion, abs=2e-3)
    assert arm.rpy() == pytest.approx(pose.rpy, abs=5e-3)


def test_pitch_and_yaw_are_exchanged_as_in_the_original(graph, arm):
    arm.go_to_joints((0.5, *READY[1:]))
    answer = call(graph, "/ee_rpy_srv", "EeRpy")
    assert answer.p == pytest.approx(0.5, abs=1e-2)  # the yaw
    assert answer.y == pytest.approx(sum((-0.8, 1.2, -0.4)), abs=1e-2)  # the pitch
    assert arm.rpy()[2] == answer.p


def test_it_moves_to_places_and_takes_only_w_of_the_orientation(graph, arm):
    x, y, z = arm.pose().position
    arm.go_to((x, y + 0.1, z + 0.05))
    assert arm.pose().position == pytest.approx((x, y + 0.1, z + 0.05), abs=1e-3)
    pose = load_message("geometry_msgs/Pose")()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    pose.orientation.x, pose.orientation.w = math.sqrt(0.5), math.sqrt(0.5)
    assert call(graph, "/ee_traj_srv", "EeTraj", pose=pose).success
    assert arm.rpy() == pytest.approx((0.0, 0.0, 0.0), abs=5e-3)


def test_what_cannot_be_is_said(graph, arm):
    before = arm.pose().position
    with pytest.raises(ClientError, match=r"ee_traj_srv: there is no plan: NO_IK_SOLUTION \(-31\)"):
        arm.go_to((9.0, 0.0, 0.0))
    with pytest.raises(ClientError, match="3 positions are given to 7 joints: shoulder_pan_joint"):
        arm.go_to_joints((0.0, 0.0, 0.0))
    with pytest.raises(ClientError, match="beyond the joints' limits"):
        arm.go_to_joints((9.0, *READY[1:]))
    assert arm.pose().position == pytest.approx(before)


def test_the_whole_orientation_may_be_taken(graph, arm):
    x, y, z = arm.pose().position
    pose = load_message("geometry_msgs/Pose")()
    pose.position.x, pose.position.y, pose.position.z = x, y, z
    pose.orientation.x, pose.orientation.w = math.sin(0.3), math.cos(0.3)
    graph.node.set_param("/turned/arm/use_orientation", True)
    with Node("/turned/arm", master_uri=graph.node.master_uri) as node:
        other = ArmServices(node)
        assert other._go_to_pose(load_service("fetch_train/EeTraj")._request_class(pose=pose))[
            "success"
        ]
    assert arm.rpy()[0] == pytest.approx(0.6, abs=5e-3)
