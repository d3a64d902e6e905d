"""The actions of ``move_group``: plans that are executed by controllers, and how that ends."""

import contextlib
import threading
from types import SimpleNamespace

import pytest
from bridges.moveit.moveit_graph import message, moveit_graph
from ros.graph import until

from gazelle.bridges.conversions import pose_message
from gazelle.bridges.moveit.controller_list import controllers_of
from gazelle.planning import PlanOutcome
from gazelle_ros import load_message
from gazelle_ros.actions import GoalStatus, SimpleActionClient, SimpleActionServer

ARM = (
    "shoulder_pan_joint",
    "shoulder_lift_joint",
    "upperarm_roll_joint",
    "elbow_flex_joint",
    "forearm_roll_joint",
    "wrist_flex_joint",
    "wrist_roll_joint",
)
FINGER = "r_gripper_finger_joint"
CONTROLLERS = [
    {"name": "torso_controller", "action_ns": "follow_joint_trajectory", "default": True,
     "type": "FollowJointTrajectory", "joints": ["torso_lift_joint"]},
    {"name": "arm_controller", "action_ns": "follow_joint_trajectory", "default": True,
     "type": "FollowJointTrajectory", "joints": [*ARM]},
    {"name": "gripper_controller", "action_ns": "gripper_action", "type": "GripperCommand",
     "joints": ["r_gripper_finger_joint", "l_gripper_finger_joint"], "max_effort": 7.0},
]  # fmt: skip


class Robot:
    """Controllers that are there at once, or do as ``how`` says."""

    def __init__(self, client):
        self.client, self.how, self.where = client, "arrive", {}
        self.goals, self.began = [], threading.Event()
        self.moving = threading.Lock()  # else the older of two positions may be published last
        self.servers = []
        for name in ("torso_controller", "arm_controller"):
            self.serve(f"{name}/follow_joint_trajectory", "FollowJointTrajectory")
        self.serve("gripper_controller/gripper_action", "GripperCommand")

    def serve(self, name, kind):
        def work(goal):
            self.goals.append((name, goal))
            self.began.set()
            server, how = servers[0], self.how
            if how == "fail":
                server.set_aborted(None, "a fuse is blown")
                return
            while how == "linger" and not (server.is_preempt_requested() or server.node.closed):
                threading.Event().wait(0.005)
            if how == "linger":
                if not server.node.closed:
                    server.set_preempted()
                return
            if kind == "FollowJointTrajectory":
                last = goal.trajectory.points[-1].positions
                with self.moving:
                    self.where |= dict(zip(goal.trajectory.joint_names, last, strict=True))
                    self.client.stand(**self.where)
            server.set_succeeded()

        action = load_message(f"control_msgs/{kind}Action")
        servers = [SimpleActionServer(self.client.node, name, action, work)]
        self.servers += servers


@pytest.fixture
def robot():
    patient = {"allowed_goal_duration_margin": 60.0}
    with moveit_graph(controller_list=CONTROLLERS, trajectory_execution=patient) as client:
        made = Robot(client)
        with contextlib.ExitStack() as stack:
            for server in made.servers:
                stack.callback(server.stop)
            yield made


def action(robot, name, kind):
    client = SimpleActionClient(robot.client.node, name, load_message(f"moveit_msgs/{kind}Action"))
    assert client.wait_for_server(60.0)
    return client


def goal_of(group="arm", *, plan_only=False, start=None, **positions):
    constraints = message("Constraints", joint_constraints=[
        message("JointConstraint", joint_name=name, position=position, tolerance_above=1e-3,
                tolerance_below=1e-3) for name, position in positions.items()
    ])  # fmt: skip
    request = message("MotionPlanRequest", group_name=group, goal_constraints=[constraints],
                      allowed_planning_time=30.0)  # fmt: skip
    if start:
        request.start_state.joint_state.name = [*start]
        request.start_state.joint_state.position = [*start.values()]
    options = message("PlanningOptions", plan_only=plan_only)
    return message("MoveGroupGoal", request=request, planning_options=options)


def send(robot, goal):
    """Return the result of a goal of ``move_group``, and the state it ended in."""
    client = action(robot, "move_group", "MoveGroup")
    client.send_goal(goal)
    assert client.wait_for_result(60.0)
    return client.get_result(), client.get_state()


def positions_of(trajectory, number=-1):
    joints = trajectory.joint_trajectory
    return dict(zip(joints.joint_names, joints.points[number].positions, strict=True))


@pytest.mark.long
def test_it_plans_and_moves(robot):
    shown, said = threading.Event(), []
    feedback = robot.client.node.subscribe(
        "move_group/feedback",
        load_message("moveit_msgs/MoveGroupActionFeedback"),
        lambda each: said.append(each.feedback.state),
    )
    until(lambda: feedback.num_connections, 60.0)
    robot.client.node.subscribe(
        "move_group/display_planned_path",
        load_message("moveit_msgs/DisplayTrajectory"),
        lambda _: shown.set(),
    )
    result, state = send(robot, goal_of(shoulder_pan_joint=0.6))
    assert state == GoalStatus.SUCCEEDED
    assert result.error_code.val == PlanOutcome.SUCCESS
    until(lambda: said == ["PLANNING", "MONITOR", "IDLE"], 60.0)
    assert positions_of(result.planned_trajectory)["shoulder_pan_joint"] == pytest.approx(
        0.6, abs=2e-3
    )
    assert result.executed_trajectory == result.planned_trajectory
    ((name, goal),) = robot.goals
    assert name == "arm_controller/follow_joint_trajectory"
    assert tuple(goal.trajectory.joint_names) == ARM
    assert len(goal.trajectory.points) == len(result.planned_trajectory.joint_trajectory.points)
    assert len(goal.trajectory.points[1].velocities) == len(ARM)
    assert shown.wait(60.0)
    # The next one begins where that one ended.
    again, _ = send(robot, goal_of(shoulder_pan_joint=0.2))
    assert positions_of(again.planned_trajectory, 0)["shoulder_pan_joint"] == pytest.approx(
        0.6, abs=2e-3
    )


def test_it_only_plans(robot):
    goal = goal_of(plan_only=True, start={"elbow_flex_joint": 0.9}, shoulder_pan_joint=0.6)
    result, state = send(robot, goal)
    assert state == GoalStatus.SUCCEEDED
    assert positions_of(result.planned_trajectory, 0)["elbow_flex_joint"] == pytest.approx(0.9)
    assert not robot.goals
    assert not result.executed_trajectory.joint_trajectory.points


def test_a_goal_may_change_the_scene_for_itself(robot):
    context = robot.client.group.context
    with context.lock:
        tip = context.robot.pose(context.current(), "gripper_link")
    goal = goal_of(plan_only=True, shoulder_pan_joint=0.6)
    thing = message("CollisionObject", id="post", pose=pose_message(tip))
    thing.primitives = [load_message("shape_msgs/SolidPrimitive")(type=2, dimensions=[0.2])]
    change = goal.planning_options.planning_scene_diff
    change.link_padding = [message("LinkPadding", link_name="gripper_link", padding=0.01)]
    change.world.collision_objects = [thing]
    result, _ = send(robot, goal)
    assert result.error_code.val == PlanOutcome.START_STATE_IN_COLLISION
    assert not context.scene.objects
    assert not any(context.scene.padding.values())
    thing.header.frame_id = "moon"
    assert send(robot, goal)[0].error_code.val == PlanOutcome.INVALID_OBJECT_NAME
    goal = goal_of(plan_only=True, shoulder_pan_joint=0.6)
    assert send(robot, goal)[0].error_code.val == PlanOutcome.SUCCESS


def test_several_controllers_share_a_motion(robot):
    result, _ = send(robot, goal_of("arm_with_torso", torso_lift_joint=0.1, elbow_flex_joint=1.0))
    assert result.error_code.val == PlanOutcome.SUCCESS
    parts = {name.partition("/")[0]: goal for name, goal in robot.goals}
    assert {*parts} == {"arm_controller", "torso_controller"}
    assert parts["torso_controller"].trajectory.joint_names == ["torso_lift_joint"]
    assert robot.where["torso_lift_joint"] == pytest.approx(0.1, abs=2e-3)


def test_grippers_close(robot):
    result, _ = send(robot, goal_of("gripper", **{FINGER: 0.03}))
    assert result.error_code.val == PlanOutcome.SUCCESS
    ((name, goal),) = robot.goals
    assert name == "gripper_controller/gripper_action"
    assert goal.command.position == pytest.approx(0.03, abs=2e-3)
    assert goal.command.max_effort == 7.0


def test_no_plan_is_no_motion(robot):
    result, state = send(robot, goal_of(elbow_flex_joint=9.0))
    assert state == GoalStatus.ABORTED
    assert result.error_code.val == PlanOutcome.INVALID_GOAL_CONSTRAINTS
    result, state = send(robot, goal_of("leg", elbow_flex_joint=1.0))
    assert result.error_code.val == PlanOutcome.INVALID_GROUP_NAME
    assert not robot.goals


def test_a_controller_that_fails_is_reported(robot):
    robot.how = "fail"
    result, state = send(robot, goal_of(shoulder_pan_joint=0.6))
    assert state == GoalStatus.ABORTED
    assert result.error_code.val == PlanOutcome.CONTROL_FAILED


@pytest.mark.parametrize("way", ["cancel", "stop"])
def test_motions_are_stopped(robot, way):
    robot.how = "linger"
    client = action(robot, "move_group", "MoveGroup")
    stops = robot.client.node.advertise(
        "trajectory_execution_event", load_message("std_msgs/String"), latch=True
    )
    client.send_goal(goal_of(shoulder_pan_joint=0.6))
    assert robot.began.wait(60.0)
    if way == "cancel":
        client.cancel_goal()
    else:
        stops.publish(load_message("std_msgs/String")(data="stop"))
    assert client.wait_for_result(60.0)
    assert client.get_result().error_code.val == PlanOutcome.PREEMPTED
    assert client.get_state() == GoalStatus.PREEMPTED


def execute(robot, trajectory):
    client = action(robot, "execute_trajectory", "ExecuteTrajectory")
    client.send_goal(message("ExecuteTrajectoryGoal", trajectory=trajectory))
    assert client.wait_for_result(60.0)
    return client.get_result().error_code.val


@pytest.mark.long
def test_trajectories_are_executed(robot):
    planned = send(robot, goal_of(plan_only=True, shoulder_pan_joint=0.6))[0].planned_trajectory
    assert execute(robot, planned) == PlanOutcome.SUCCESS
    assert execute(robot, message("RobotTrajectory")) == PlanOutcome.SUCCESS
    # It is somewhere else now.
    before = len(robot.goals)
    assert execute(robot, planned) == PlanOutcome.CONTROL_FAILED
    planned.joint_trajectory.joint_names[0] = "nose"
    assert execute(robot, planned) == PlanOutcome.CONTROL_FAILED
    assert len(robot.goals) == before


def test_what_takes_too_long_is_stopped(robot):
    planned = send(robot, goal_of(plan_only=True, shoulder_pan_joint=0.6))[0].planned_trajectory
    executor = robot.client.group.executor
    executor._scaling = executor._margin = 0.0
    robot.how = "linger"
    assert execute(robot, planned) == PlanOutcome.TIMED_OUT


def test_nothing_moves_that_may_not():
    with moveit_graph(controller_list=CONTROLLERS, allow_trajectory_execution=False) as client:
        made = Robot(client)
        result, _ = send(made, goal_of(shoulder_pan_joint=0.6))
        assert result.error_code.val == PlanOutcome.SUCCESS
        assert execute(made, result.planned_trajectory) == PlanOutcome.CONTROL_FAILED
        assert not made.goals


@pytest.mark.parametrize("kind", ["interpolate", "via points", "last point"])
def test_fake_controllers_only_say_where_joints_are(kind):
    own = {
        "controller_list": [
            {"name": "odd", "type": "Unheard", "joints": []},
            {"name": "fake_arm", "type": kind, "joints": [*ARM]},
        ],
        "initial": [{"group": "arm", "pose": "tuck"}, {"group": "leg", "pose": "up"}],
        "rate": 50,
    }
    with moveit_graph(**own) as client:
        seen = []
        client.node.subscribe(
            "move_group/fake_controller_joint_states",
            load_message("sensor_msgs/JointState"),
            lambda each: seen.append(dict(zip(each.name, each.position, strict=True))),
        )
        until(lambda: seen, 60.0)
        assert seen[0]["elbow_flex_joint"] == pytest.approx(1.72)
        robot = SimpleNamespace(client=client)
        result, _ = send(robot, goal_of(elbow_flex_joint=1.1))
        assert result.error_code.val == PlanOutcome.SUCCESS
        until(lambda: seen[-1]["elbow_flex_joint"] == pytest.approx(1.1, abs=2e-3), 60.0)
        path = [each["elbow_flex_joint"] for each in seen[1:]]
        if kind == "last point":
            assert len(path) == 1
        else:
            assert path[0] == pytest.approx(1.2)
            assert path == sorted(path, reverse=True)
            assert len(path) > 3


@pytest.mark.long
@pytest.mark.parametrize(
    "manager", ["moveit_fake_controller_manager/MoveItFakeControllerManager", ""]
)
def test_fake_controllers_need_no_type(manager):
    own = {
        "moveit_controller_manager": manager,
        "controller_list": [{"name": "arm", "joints": [*ARM]}],
    }
    with moveit_graph(**own) as client:
        found = controllers_of(client.group.context.node)
        assert [each.kind for each in found.values()] == (["interpolate"] if manager else [])
