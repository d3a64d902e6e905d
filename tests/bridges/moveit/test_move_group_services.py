"""The services of ``move_group``: kinematics, validity, plans and straight ways."""

import math

import arms
import numpy as np
import pytest
from bridges.moveit.moveit_graph import message, moveit_graph

from gazelle.bridges.conversions import pose_message, pose_of_message
from gazelle.bridges.moveit.frames import stamped_message
from gazelle.description import Box, Pose
from gazelle.errors import PlanningError, PlanningWarning
from gazelle.kinematics import InverseKinematics
from gazelle.planning import PlanOutcome
from gazelle_ros import Master, Node, load_message, load_service
from gazelle_ros.builtin.registry import main_of
from gazelle_ros.time import Duration

MESSAGES = {
    "MoveGroupActionGoal": "b7138704cefd43a8dd9758d697350b85",
    "MoveGroupActionResult": "7f1341e9f8cc6a2ed67dc4bd2603cf59",
    "MoveGroupActionFeedback": "12232ef97486c7962f264c105aae2958",
    "ExecuteTrajectoryActionGoal": "36f350977c67bc94e8cd408452bad0f0",
    "ExecuteTrajectoryActionResult": "2a052ef9772722c8338e057a61e60639",
    "PickupActionGoal": "83bb430d120a16fadf2ea3aad239f1d1",
    "PlaceActionGoal": "3f3419319ea8d2af4e18a600962d0cf5",
    "PlanningScene": "acfc50bcfd6c7b978066bfa7c786002c",
    "DisplayTrajectory": "41936b74e168ba754279ae683ce3f121",
    "CollisionObject": "dbba710596087da521c07564160dfccb",
    "AttachedCollisionObject": "30199ef516f64c8bc1edb1084ce4584e",
    "RobotState": "968156f4aa4cb4018f1f2293eebcea8f",
    "RobotTrajectory": "dfa9556423d709a3729bcef664bddf67",
    "MotionPlanRequest": "83f3d7b1d47a538f7659e0de9dae7980",
    "MotionPlanResponse": "a70717537b7bfcf24e0dbd4d2ab1fd34",
    "Constraints": "cfd22a10c51e0dc2b28d98772d2b55d5",
    "PlanningOptions": "3134e041c806c7c2ff59948db4d57835",
    "PositionIKRequest": "cb7c3615ee4d29d023dfdc5950af0504",
    "AllowedCollisionMatrix": "aedce13587eef0d79165a075659c1879",
    "MoveItErrorCodes": "d6cfe51b76ea17850d7116c666a7d0f1",
}
SERVICES = {
    "GetMotionPlan": "110dffa73f82b9b8644f525e7fbd9fc4",
    "GetCartesianPath": "c54b9430d97ea6816e0f7c7ffd3779b8",
    "GetPositionIK": "efb729a4de517c3ff2c8a1e540017b30",
    "GetPositionFK": "640cee2210976d68ab32b7aac3c1858e",
    "GetStateValidity": "06ea62db671e4dbf878eaca241db51ad",
    "GetPlanningScene": "65cf69d3e7a0342e16374024d4eeef65",
    "ApplyPlanningScene": "d4d1599e0b6f71a6a8a10cb34780619c",
    "QueryPlannerInterfaces": "5876081117e7cad85cc165e937798753",
    "GetPlannerParams": "1b56b530c1107c60f0c9173e631d7bf5",
    "SetPlannerParams": "14bebee5d4d53a2df94b7f146d3eb2ff",
}
TIP = "gripper_link"


@pytest.mark.parametrize("name", MESSAGES)
def test_messages_are_those_of_moveit(name):
    assert load_message(f"moveit_msgs/{name}")._md5sum == MESSAGES[name]


@pytest.mark.parametrize("name", SERVICES)
def test_services_are_those_of_moveit(name):
    assert load_service(f"moveit_msgs/{name}")._md5sum == SERVICES[name]


@pytest.fixture(scope="module")
def fetch():
    with moveit_graph() as client:
        yield client


@pytest.fixture(autouse=True)
def _clean(request):
    if "fetch" in request.fixturenames:
        client = request.getfixturevalue("fetch")
        with client.group.context.lock:
            client.group.context.scene.clear()


def robot_state(**positions):
    state = message("RobotState", is_diff=True)
    state.joint_state.name, state.joint_state.position = [*positions], [*positions.values()]
    return state


def tip_pose(client, link=TIP):
    context = client.group.context
    with context.lock:
        return context.robot.pose(context.current(), link)


def ik(client, pose, frame="base_link", **fields):
    asked = message("PositionIKRequest", group_name="arm", **fields)
    asked.pose_stamped = stamped_message(pose, frame, 0)
    return client.call("compute_ik", "GetPositionIK", ik_request=asked)


def values(state):
    return dict(zip(state.joint_state.name, state.joint_state.position, strict=True))


def test_forward_kinematics_are_those_of_the_model(fetch):
    names = [TIP, "base_link", "elbow_flex_link"]
    found = fetch.call("compute_fk", "GetPositionFK", fk_link_names=names)
    assert found.error_code.val == PlanOutcome.SUCCESS
    assert found.fk_link_names == names
    for name, each in zip(names, found.pose_stamped, strict=True):
        assert each.header.frame_id == "base_link"
        assert pose_of_message(each.pose).is_close(tip_pose(fetch, name))


def test_forward_kinematics_in_another_frame_and_state(fetch):
    header = load_message("std_msgs/Header")(frame_id="torso_lift_link")
    turned = robot_state(shoulder_pan_joint=0.5)
    found = fetch.call("compute_fk", "GetPositionFK", header=header, fk_link_names=[TIP],
                       robot_state=turned)  # fmt: skip
    robot = fetch.group.context.robot
    state = fetch.group.context.monitor.current()
    state[robot.column("shoulder_pan_joint")] = 0.5
    wanted = robot.pose(state, "torso_lift_link").inverse() * robot.pose(state, TIP)
    assert pose_of_message(found.pose_stamped[0].pose).is_close(wanted)


@pytest.mark.parametrize(
    ("fields", "outcome"),
    [
        ({}, PlanOutcome.INVALID_LINK_NAME),
        ({"fk_link_names": ["nose"]}, PlanOutcome.INVALID_LINK_NAME),
        ({"fk_link_names": [TIP], "robot_state": robot_state(nose=1.0)},
         PlanOutcome.INVALID_ROBOT_STATE),
        ({"fk_link_names": [TIP], "robot_state": robot_state(elbow_flex_joint=math.nan)},
         PlanOutcome.INVALID_ROBOT_STATE),
    ],
)  # fmt: skip
def test_forward_kinematics_say_what_is_wrong(fetch, fields, outcome):
    assert fetch.call("compute_fk", "GetPositionFK", **fields).error_code.val == outcome


def test_inverse_kinematics_bring_the_tip_there(fetch):
    wanted = tip_pose(fetch) * Pose(0.05, 0.1, -0.05, yaw=0.2)
    found = ik(fetch, wanted, avoid_collisions=True)
    assert found.error_code.val == PlanOutcome.SUCCESS
    robot = fetch.group.context.robot
    state = np.array([values(found.solution)[name] for name in robot.names])
    assert robot.pose(state, TIP).is_close(wanted, position=1e-4, angle=1e-4)
    # The same in a frame of the robot's and in that of its fixed virtual joint.
    torso = tip_pose(fetch, "torso_lift_link")
    assert ik(fetch, torso.inverse() * wanted, "torso_lift_link").error_code.val == 1
    assert ik(fetch, wanted, "odom").error_code.val == 1


def test_inverse_kinematics_say_what_is_wrong(fetch):
    here = tip_pose(fetch)
    assert ik(fetch, Pose(5.0)).error_code.val == PlanOutcome.NO_IK_SOLUTION
    assert ik(fetch, here, "moon").error_code.val == PlanOutcome.FRAME_TRANSFORM_FAILURE
    assert ik(fetch, here, ik_link_name="nose").error_code.val == PlanOutcome.NO_IK_SOLUTION
    asked = message("PositionIKRequest", group_name="leg")
    found = fetch.call("compute_ik", "GetPositionIK", ik_request=asked)
    assert found.error_code.val == PlanOutcome.INVALID_GROUP_NAME


def test_inverse_kinematics_avoid_what_stands_there(fetch):
    here = tip_pose(fetch)
    fetch.group.context.scene.add("post", Box((0.3, 0.3, 0.3)), here)
    assert ik(fetch, here).error_code.val == PlanOutcome.SUCCESS
    found = ik(fetch, here, avoid_collisions=True)
    assert found.error_code.val == PlanOutcome.NO_IK_SOLUTION


def test_states_are_judged(fetch):
    def judged(**fields):
        return fetch.call("check_state_validity", "GetStateValidity", group_name="arm", **fields)

    assert judged().valid
    near = message("JointConstraint", joint_name="elbow_flex_joint", position=1.2,
                   tolerance_above=0.01, tolerance_below=0.01)  # fmt: skip
    assert judged(constraints=message("Constraints", joint_constraints=[near])).valid
    near.position = 0.0
    found = judged(constraints=message("Constraints", joint_constraints=[near]))
    assert not found.valid
    assert [each.result for each in found.constraint_result] == [False]
    fetch.group.context.scene.add("post", Box((0.3, 0.3, 0.3)), tip_pose(fetch))
    found = judged()
    assert not found.valid
    touching = {(each.contact_body_1, each.body_type_1) for each in found.contacts}
    touching |= {(each.contact_body_2, each.body_type_2) for each in found.contacts}
    assert {("post", 1), (TIP, 0)} <= touching
    assert all(each.depth > 0.0 for each in found.contacts)
    assert not judged(robot_state=robot_state(nose=1.0)).valid


def test_constraints_have_distances(fetch):
    """As MoveIt measures them: from the position, from the region's middle, angles added up; times the weight."""
    here = tip_pose(fetch)
    joint = message(
        "JointConstraint",
        joint_name="elbow_flex_joint",
        position=1.0,
        tolerance_above=0.3,
        weight=0.5,
    )
    goal = pose_goal(here * Pose(0.03, 0.04, 0.0, yaw=0.2))
    goal.joint_constraints = [joint]
    found = fetch.call(
        "check_state_validity", "GetStateValidity", group_name="arm", constraints=goal
    )
    assert [each.result for each in found.constraint_result] == [True, False, False]
    distances = [each.distance for each in found.constraint_result]
    assert distances == pytest.approx([0.5 * 0.2, 0.05, 0.2], abs=1e-6)


def test_a_region_may_have_several_shapes(fetch):
    """Any of them will do, for states and for goals."""
    here, far = tip_pose(fetch), Pose(5.0)
    goal = pose_goal(here)
    region = goal.position_constraints[0].constraint_region
    sphere, place = region.primitives[0], region.primitive_poses[0]
    box = load_message("shape_msgs/SolidPrimitive")(type=1, dimensions=[0.2, 0.2, 0.2])
    judged = []
    for shapes, centres in (
        ([box, sphere], [pose_message(far), place]),
        ([sphere, box], [pose_message(far), pose_message(far)]),
    ):
        region.primitives, region.primitive_poses = shapes, centres
        answer = fetch.call(
            "check_state_validity", "GetStateValidity", group_name="arm", constraints=goal
        )
        judged.append(
            (answer.constraint_result[0].result, round(answer.constraint_result[0].distance, 6))
        )
    assert judged[0] == (True, 0.0)
    assert judged[1][0] is False
    assert judged[1][1] == pytest.approx(math.dist(here.position, far.position), abs=1e-5)
    there = here * Pose(0.0, 0.1, 0.0)
    region.primitives = [sphere, sphere]
    region.primitive_poses = [pose_message(far), pose_message(Pose(*there.position))]
    goal.orientation_constraints = pose_goal(there).orientation_constraints
    found = plan(fetch, goal)
    assert found.error_code.val == PlanOutcome.SUCCESS
    region.primitive_poses = [pose_message(far), pose_message(far)]
    assert plan(fetch, goal).error_code.val == PlanOutcome.NO_IK_SOLUTION


def test_inverse_kinematics_end_in_time(fetch):
    """Where all solutions are refused, it gives up when the time is over."""
    here = tip_pose(fetch)
    with fetch.group.context.lock:
        fetch.group.context.scene.add("post", Box((0.3, 0.3, 0.3)), here)
    solver = InverseKinematics(fetch.group.context.robot, fetch.group.context.robot.group("arm"))
    asked = []
    state = fetch.group.context.monitor.current()
    assert (
        solver.solve(here, state, valid=lambda found: bool(asked.append(found)), timeout=0.0)
        is None
    )
    assert len(asked) == 1
    timeout = Duration(nsecs=1)
    found = ik(fetch, here, avoid_collisions=True, timeout=timeout)
    assert found.error_code.val == PlanOutcome.NO_IK_SOLUTION


def holding(pose, operation=0, name="stick", link=TIP, size=(0.3, 0.02, 0.02)):
    """Return a state of a request with an object attached to a link."""
    state = message("RobotState", is_diff=True)
    thing = message("CollisionObject", id=name, operation=operation, pose=pose_message(pose))
    thing.header.frame_id = link
    if operation == 0:
        thing.primitives = [
            load_message("shape_msgs/SolidPrimitive")(type=1, dimensions=list(size))
        ]
        thing.primitive_poses = [pose_message(Pose())]
    touched = ["l_gripper_finger_link", "r_gripper_finger_link", "wrist_roll_link"]
    state.attached_collision_objects = [
        message("AttachedCollisionObject", link_name=link, object=thing, touch_links=touched)
    ]
    return state


def test_what_a_requests_state_holds_counts_for_that_request(fetch):
    scene = fetch.group.context.scene
    with fetch.group.context.lock:
        scene.add("post", Box((0.1, 0.1, 0.1)), tip_pose(fetch) * Pose(0.4))

    def judged(**fields):
        return fetch.call("check_state_validity", "GetStateValidity", group_name="arm", **fields)

    assert judged().valid
    found = judged(robot_state=holding(Pose(0.3)))
    assert not found.valid
    bodies = {(found.contacts[0].contact_body_1, found.contacts[0].body_type_1),
              (found.contacts[0].contact_body_2, found.contacts[0].body_type_2)}  # fmt: skip
    assert bodies == {("stick", 2), ("post", 1)}
    # It is where its frame says, at the state that the request is about.
    elsewhere = holding(Pose(0.3))
    elsewhere.joint_state.name, elsewhere.joint_state.position = ["shoulder_pan_joint"], [0.8]
    assert judged(robot_state=elsewhere).valid
    here = tip_pose(fetch)
    assert ik(fetch, here, avoid_collisions=True).error_code.val == PlanOutcome.SUCCESS
    reaching = ik(fetch, here, avoid_collisions=True, robot_state=holding(Pose(0.3)))
    assert reaching.error_code.val == PlanOutcome.NO_IK_SOLUTION
    assert ik(fetch, here, robot_state=holding(Pose(0.3))).error_code.val == PlanOutcome.SUCCESS
    # Nothing of it stays.
    assert scene.attached == {}
    assert judged().valid


def test_plans_begin_with_what_the_start_holds(fetch):
    """The way is free for the arm alone, and not for what it holds."""
    goal, here = joint_goal(shoulder_pan_joint=0.5), tip_pose(fetch)
    free = plan(fetch, goal)
    assert free.error_code.val == PlanOutcome.SUCCESS
    robot = fetch.group.context.robot
    state = robot.zero() + fetch.group.context.monitor.current()
    state[robot.column("shoulder_pan_joint")] = 0.5
    there = robot.pose(state, TIP) * Pose(0.4)
    with fetch.group.context.lock:
        fetch.group.context.scene.add("post", Box((0.1, 0.1, 0.1)), there)
    assert plan(fetch, goal).error_code.val == PlanOutcome.SUCCESS
    held = plan(fetch, goal, start_state=holding(Pose(0.3)))
    assert held.error_code.val == PlanOutcome.GOAL_IN_COLLISION
    assert plan(fetch, goal).error_code.val == PlanOutcome.SUCCESS
    wrong = plan(fetch, goal, start_state=holding(Pose(0.3), link="nose"))
    assert wrong.error_code.val == PlanOutcome.INVALID_ROBOT_STATE
    missing = plan(fetch, goal, start_state=holding(Pose(), operation=1, name="nothing"))
    assert missing.error_code.val == PlanOutcome.INVALID_ROBOT_STATE
    along = here * Pose(0.05)
    with fetch.group.context.lock:
        fetch.group.context.scene.add("post", Box((0.1, 0.1, 0.1)), along * Pose(0.45))
    assert straight(fetch, along).fraction == pytest.approx(1.0)
    assert straight(fetch, along, start_state=holding(Pose(0.3))).fraction < 0.9


def joint_goal(**positions):
    return message("Constraints", joint_constraints=[
        message("JointConstraint", joint_name=name, position=position, tolerance_above=1e-3,
                tolerance_below=1e-3, weight=1.0)
        for name, position in positions.items()
    ])  # fmt: skip


def pose_goal(pose, frame="base_link"):
    sphere = load_message("shape_msgs/SolidPrimitive")(type=2, dimensions=[0.001])
    place = message("PositionConstraint", link_name=TIP)
    place.header.frame_id = frame
    place.constraint_region.primitives = [sphere]
    place.constraint_region.primitive_poses = [pose_message(Pose(*pose.position))]
    turn = message("OrientationConstraint", link_name=TIP, absolute_x_axis_tolerance=0.01,
                   absolute_y_axis_tolerance=0.01, absolute_z_axis_tolerance=0.01)  # fmt: skip
    turn.header.frame_id, turn.orientation = frame, pose_message(pose).orientation
    return message("Constraints", position_constraints=[place], orientation_constraints=[turn])


def plan(client, *goals, **fields):
    request = message("MotionPlanRequest", group_name="arm", goal_constraints=[*goals],
                      allowed_planning_time=30.0, **fields)  # fmt: skip
    return client.call(
        "plan_kinematic_path", "GetMotionPlan", motion_plan_request=request
    ).motion_plan_response


def test_plans_go_to_joints(fetch):
    found = plan(fetch, joint_goal(shoulder_pan_joint=0.8, elbow_flex_joint=0.9))
    assert found.error_code.val == PlanOutcome.SUCCESS
    assert found.group_name == "arm"
    joints = found.trajectory.joint_trajectory
    assert joints.header.frame_id == "base_link"
    last = dict(zip(joints.joint_names, joints.points[-1].positions, strict=True))
    assert last["shoulder_pan_joint"] == pytest.approx(0.8, abs=1e-3)
    assert last["elbow_flex_joint"] == pytest.approx(0.9, abs=1e-3)
    times = [each.time_from_start.to_sec() for each in joints.points]
    assert times == sorted(times)
    assert times[0] == 0.0
    assert values(found.trajectory_start)["elbow_flex_joint"] == pytest.approx(1.2)
    # Half as fast takes longer; a start of one's own is taken.
    slow = plan(fetch, joint_goal(shoulder_pan_joint=0.8), max_velocity_scaling_factor=0.2,
                start_state=robot_state(elbow_flex_joint=1.0)).trajectory  # fmt: skip
    points = slow.joint_trajectory.points
    assert points[-1].time_from_start.to_sec() > times[-1]
    first = dict(zip(slow.joint_trajectory.joint_names, points[0].positions, strict=True))
    assert first["elbow_flex_joint"] == pytest.approx(1.0)


def test_plans_go_to_poses_around_things(fetch):
    wanted = tip_pose(fetch) * Pose(0.0, 0.35, 0.1)
    fetch.group.context.scene.add("post", Box((0.04, 0.04, 0.3)), tip_pose(fetch) * Pose(0, 0.16))
    found = plan(fetch, pose_goal(wanted))
    assert found.error_code.val == PlanOutcome.SUCCESS
    joints = found.trajectory.joint_trajectory
    context = fetch.group.context
    for point in joints.points:
        state = context.monitor.current()
        state[context.robot.columns(joints.joint_names)] = point.positions
        assert not context.scene.in_collision(state)
    assert context.robot.pose(state, TIP).is_close(wanted, position=2e-3, angle=0.02)


def test_of_several_goals_one_is_enough(fetch):
    found = plan(fetch, pose_goal(Pose(9.0)), joint_goal(shoulder_pan_joint=0.3))
    assert found.error_code.val == PlanOutcome.SUCCESS


def test_plans_say_what_is_wrong(fetch):
    assert plan(fetch).error_code.val == PlanOutcome.INVALID_GOAL_CONSTRAINTS
    assert plan(fetch, joint_goal(nose=1.0)).error_code.val == PlanOutcome.INVALID_GOAL_CONSTRAINTS
    assert plan(fetch, pose_goal(Pose(9.0))).error_code.val == PlanOutcome.NO_IK_SOLUTION
    lost = plan(fetch, pose_goal(tip_pose(fetch), "moon"))
    assert lost.error_code.val == PlanOutcome.FRAME_TRANSFORM_FAILURE
    blind = message("Constraints", visibility_constraints=[message("VisibilityConstraint")])
    assert plan(fetch, blind).error_code.val == PlanOutcome.INVALID_GOAL_CONSTRAINTS
    fetch.group.context.scene.add("post", Box((0.3, 0.3, 0.3)), tip_pose(fetch))
    found = plan(fetch, joint_goal(shoulder_pan_joint=0.8))
    assert found.error_code.val == PlanOutcome.START_STATE_IN_COLLISION
    assert not found.trajectory.joint_trajectory.points


def straight(client, *poses, max_step=0.01, **fields):
    return client.call(
        "compute_cartesian_path", "GetCartesianPath", group_name="arm", max_step=max_step,
        waypoints=[pose_message(each) for each in poses], avoid_collisions=True, **fields,
    )  # fmt: skip


def test_straight_ways_are_followed_as_far_as_they_go(fetch):
    here = tip_pose(fetch)
    found = straight(fetch, here * Pose(0.05), here * Pose(0.05, 0.05))
    assert found.error_code.val == PlanOutcome.SUCCESS
    assert found.fraction == pytest.approx(1.0)
    assert len(found.solution.joint_trajectory.points) > 2
    far = straight(fetch, here * Pose(3.0))
    assert far.error_code.val == PlanOutcome.SUCCESS
    assert 0.0 < far.fraction < 0.5
    fetch.group.context.scene.add("wall", Box((0.02, 1.0, 1.0)), here * Pose(0.1))
    assert straight(fetch, here * Pose(0.2)).fraction < 0.9


def test_straight_ways_say_what_is_wrong(fetch):
    here = tip_pose(fetch)
    assert straight(fetch, here, max_step=0.0).error_code.val == PlanOutcome.FAILURE
    lost = load_message("std_msgs/Header")(frame_id="moon")
    found = straight(fetch, here, header=lost)
    assert found.error_code.val == PlanOutcome.FRAME_TRANSFORM_FAILURE
    found = fetch.call("compute_cartesian_path", "GetCartesianPath", group_name="leg")
    assert found.error_code.val == PlanOutcome.INVALID_GROUP_NAME


def test_planners_are_those_of_the_parameters():
    own = {
        "planner_configs": {"Swift": {"type": "geometric::RRTConnect"}},
        "arm": {"planner_configs": ["Swift"], "default_planner_config": "Swift"},
    }
    with moveit_graph(**own) as client:
        (found,) = client.call(
            "query_planner_interface", "QueryPlannerInterfaces"
        ).planner_interfaces
        assert (found.name, found.pipeline_id) == ("OMPL", "ompl")
        assert {"arm", "arm[Swift]", "gripper"} <= set(found.planner_ids)
        settings = client.group.planning.settings
        assert settings.planner("Swift", "arm") == "RRTConnect"
        assert settings.planner("arm[Swift]", "arm") == "RRTConnect"
        assert settings.planner("PRMkConfigDefault", "arm") == "PRM"
        with pytest.warns(PlanningWarning, match="Swuft"):
            assert settings.planner("Swuft", "arm") == "RRTConnect"


def test_limits_are_those_of_the_parameters(fetch):
    robot = fetch.group.context.robot
    bounds = robot.variables[robot.column("shoulder_pan_joint")].bounds
    assert bounds.acceleration == 6.0


def test_without_a_description_it_says_so():
    from gazelle.bridges.moveit.move_group import MoveGroupNode

    with Master(port=0, rosout=False) as master, Node("/move_group", master_uri=master.uri) as node:
        with pytest.raises(PlanningError, match="robot_description"):
            MoveGroupNode(node)
        node.set_param("/robot_description", (arms.DATA / "fetch_arm.urdf").read_text())
        with pytest.raises(PlanningError, match="robot_description_semantic"):
            MoveGroupNode(node)


def test_launch_files_find_the_node():
    from gazelle.bridges.moveit.move_group import main

    assert main_of("moveit_ros_move_group", "move_group") is main
