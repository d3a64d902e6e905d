"""``moveit_commander``, and the modules that MoveIt's own one stands on, against ``move_group``."""

import importlib
import math

import numpy as np
import pytest
from bridges.moveit.commander_graph import ARM, TORSO, commander_graph
from ros.graph import until

from gazelle.description import Pose
from gazelle.drop_in.moveit_client.session import packed, session, unpacked
from gazelle_ros import load_message
from gazelle_ros.messages import DeserializationError

TIP = "gripper_link"
READY = [0.0, -0.8, 0.0, 1.2, 0.0, -0.4, 0.0]


@pytest.fixture(scope="module")
def graph():
    with commander_graph() as found:
        yield found


@pytest.fixture(scope="module")
def moveit(graph):
    return graph[1]


@pytest.fixture(scope="module")
def robot(moveit):
    return moveit.RobotCommander()


@pytest.fixture
def arm(robot):
    group = robot.get_group("arm")
    group.clear_pose_targets()
    group.clear_path_constraints()
    group.set_start_state_to_current_state()
    group.set_max_velocity_scaling_factor(1.0)
    group.set_max_acceleration_scaling_factor(1.0)
    group.set_planning_time(30.0)
    return group


@pytest.fixture
def scene(moveit):
    found = moveit.PlanningSceneInterface()
    yield found
    found.clear()


def stamped(x, y, z, frame="base_link"):
    made = load_message("geometry_msgs/PoseStamped")()
    made.header.frame_id, made.pose.orientation.w = frame, 1.0
    made.pose.position.x, made.pose.position.y, made.pose.position.z = x, y, z
    return made


# -- names ---------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("_moveit_move_group_interface", "MoveGroupInterface"),
        ("_moveit_robot_interface", "RobotInterface"),
        ("_moveit_planning_scene_interface", "PlanningSceneInterface"),
        ("_moveit_roscpp_initializer", "roscpp_init"),
        ("_moveit_roscpp_initializer", "roscpp_shutdown"),
    ],
)
@pytest.mark.usefixtures("graph")
def test_what_is_cpp_in_moveit_can_be_imported(module, name):
    package = importlib.import_module("moveit_ros_planning_interface")
    found = importlib.import_module(f"moveit_ros_planning_interface.{module}")
    assert getattr(package, module) is found
    assert callable(getattr(found, name))


def test_names_of_the_robot(robot):
    assert robot.get_planning_frame() == robot.get_root_link() == "base_link"
    assert set(robot.get_group_names()) >= {"arm", "arm_with_torso", "gripper"}
    assert robot.get_active_joint_names("arm") == [*ARM]
    assert robot.get_joint_names("arm")[-1] == "gripper_axis"  # fixed, and there all the same
    assert robot.get_link_names("arm")[-1] == TIP
    assert robot.get_joint_names()[0] == robot._names.root_joint
    assert robot.get_default_owner_group("elbow_flex_joint") == "arm"
    assert robot.get_default_owner_group("no_joint") is None
    assert robot.has_group("arm")
    assert not robot.has_group("leg")


def test_parts_of_the_robot_are_attributes(moveit, robot):
    assert robot.arm is robot.get_group("arm")
    elbow = robot.elbow_flex_joint
    assert elbow.variable_count() == 1
    assert elbow.bounds() == [elbow.min_bound(), elbow.max_bound()]
    assert elbow.value() == pytest.approx(1.2)
    assert robot.upperarm_roll_joint.bounds() == [-math.pi, math.pi]  # endless
    assert robot.gripper_link.pose().header.frame_id == "base_link"
    with pytest.raises(AttributeError, match="no attribute, group, joint or link"):
        _ = robot.elbow_flex_jont
    for ask in (robot.get_group, robot.get_joint, robot.get_link):
        with pytest.raises(moveit.MoveItCommanderException, match=r"no .* is called 'leg'"):
            ask("leg")
    with pytest.raises(moveit.MoveItCommanderException, match="no group is called 'leg'"):
        robot.get_joint_names("leg")


def test_a_group_that_is_not_there(moveit):
    with pytest.raises(RuntimeError, match="Group 'leg' was not found"):
        moveit.MoveGroupCommander("leg")
    with pytest.raises(RuntimeError, match="Unable to construct robot model"):
        moveit.RobotCommander("no_description")
    with pytest.raises(RuntimeError, match="'move_group' within allotted time"):
        moveit.MoveGroupCommander("arm", ns="elsewhere", wait_for_servers=0.2)


# -- states --------------------------------------------------------------------------------


def test_where_it_is(robot, arm):
    assert arm.get_current_joint_values() == pytest.approx(READY)
    state = robot.get_current_state()
    assert arm.get_current_state() == state
    assert state.joint_state.header.frame_id == "base_link"
    where = dict(zip(state.joint_state.name, state.joint_state.position, strict=True))
    assert where["elbow_flex_joint"] == pytest.approx(1.2)
    assert robot.get_current_variable_values() == pytest.approx(where)
    pose = arm.get_current_pose().pose
    link = robot.get_link(TIP).pose().pose
    assert pose == link
    turn = Pose.from_quaternion((0, 0, 0), tuple(getattr(pose.orientation, c) for c in "xyzw"))
    assert arm.get_current_rpy() == pytest.approx(turn.rpy)
    assert arm.get_current_pose("shoulder_pan_link").pose.position.z != pose.position.z


def test_bounds_are_enforced(arm):
    state = arm.get_current_state()
    state.joint_state.name = ["shoulder_pan_joint", "wrist_roll_joint"]
    state.joint_state.position = [1000.0, 7.0]
    made = arm.enforce_bounds(state).joint_state
    found = dict(zip(made.name, made.position, strict=True))
    assert found["shoulder_pan_joint"] == pytest.approx(1.6056)
    assert found["wrist_roll_joint"] == pytest.approx(7.0 - 2.0 * math.pi)
    with pytest.raises(DeserializationError):
        arm.enforce_bounds(load_message("moveit_msgs/RobotState")())


@pytest.mark.parametrize("point", [None, [0.1, -0.2, 0.3]])
def test_the_jacobian_is_the_change_of_the_pose(graph, arm, point):
    model = graph[0].group.context.robot
    values = np.array([0.3, -0.5, 0.4, 1.0, -0.6, 0.7, 0.2])
    found = arm.get_jacobian_matrix(values.tolist(), point)
    state, columns, step = np.zeros(len(model.variables)), model.columns(ARM), 1e-6
    base = model.forward(model.complete(state), "torso_lift_link")

    def place(positions):
        state[columns] = positions
        pose = np.linalg.inv(base) @ model.forward(model.complete(state), TIP)
        return pose[:3, :3] @ np.array(point or [0.0] * 3) + pose[:3, 3]

    for number in range(7):
        change = np.eye(7)[number] * step
        slope = (place(values + change) - place(values - change)) / (2.0 * step)
        np.testing.assert_allclose(found[:3, number], slope, atol=1e-7)


# -- goals ---------------------------------------------------------------------------------


def test_joint_targets(moveit, arm):
    assert arm.get_variable_count() == 7
    arm.set_joint_value_target([0.1] * 7)
    assert arm.get_joint_value_target() == [0.1] * 7
    arm.set_joint_value_target(np.zeros(7))
    arm.set_joint_value_target({"elbow_flex_joint": 0.5})
    arm.set_joint_value_target("wrist_roll_joint", 0.25)
    assert arm.get_joint_value_target() == [0, 0, 0, 0.5, 0, 0, 0.25]
    joints = load_message("sensor_msgs/JointState")(name=["elbow_flex_joint"], position=[0.7])
    arm.set_joint_value_target(joints)
    assert arm.get_joint_value_target()[3] == 0.7
    refused = moveit.MoveItCommanderException
    for wrong in ([0.1] * 6, [9.0] + [0.0] * 6, {"no_joint": 1.0}, {TORSO: 0.1}):
        with pytest.raises(refused, match="beyond its limits"):
            arm.set_joint_value_target(wrong)
    joints.position = []
    with pytest.raises(refused, match="beyond"):
        arm.set_joint_value_target(joints)
    with pytest.raises(refused, match="which value for the joint"):
        arm.set_joint_value_target("elbow_flex_joint")
    with pytest.raises(refused, match="or one argument alone"):
        arm.set_joint_value_target([0.1] * 7, 1)
    with pytest.raises(refused, match="expected joint values"):
        arm.set_joint_value_target(3.0)


def test_a_joint_target_of_a_pose_is_a_solution_of_inverse_kinematics(moveit, arm):
    pose = arm.get_current_pose()
    pose.pose.position.z += 0.03
    arm.set_joint_value_target(pose)
    request = arm.construct_motion_plan_request()
    (goal,) = request.goal_constraints
    assert [each.joint_name for each in goal.joint_constraints] == [*ARM]
    assert not goal.position_constraints
    for extra in ((TIP, True), (True,)):
        with pytest.raises(moveit.MoveItCommanderException, match="no joint values near"):
            arm.set_joint_value_target(pose.pose, *extra)
    pose.pose.position.z += 5.0
    with pytest.raises(
        moveit.MoveItCommanderException, match="finds no joint values for that pose"
    ):
        arm.set_joint_value_target(pose)


def test_pose_targets_become_constraints(moveit, arm):
    arm.set_goal_tolerance(0.01)
    arm.set_goal_orientation_tolerance(0.02)
    assert arm.get_goal_tolerance() == (0.01, 0.01, 0.02)
    arm.set_pose_target([0.5, 0.1, 0.9, 0.0, 0.0, math.pi / 2])
    (goal,) = arm.construct_motion_plan_request().goal_constraints
    (place,), (turn,) = goal.position_constraints, goal.orientation_constraints
    assert place.link_name == turn.link_name == TIP
    assert place.header.frame_id == "base_link"
    assert place.constraint_region.primitives[0].dimensions == (0.01,)
    assert place.constraint_region.primitive_poses[0].position.x == 0.5
    assert turn.orientation.z == pytest.approx(math.sqrt(0.5))
    assert turn.absolute_y_axis_tolerance == 0.02
    arm.set_pose_target(stamped(0.6, 0.0, 0.8, "torso_lift_link"), "wrist_flex_link")
    (goal,) = arm.construct_motion_plan_request().goal_constraints
    frames = {each.link_name: each.header.frame_id for each in goal.position_constraints}
    assert frames == {TIP: "base_link", "wrist_flex_link": "torso_lift_link"}
    assert arm.get_pose_reference_frame() == "base_link"
    arm.clear_pose_target("wrist_flex_link")
    arm.set_pose_targets([[0.5, 0, 0.9, 0, 0, 0, 1], stamped(0.6, 0, 0.9).pose])
    assert len(arm.construct_motion_plan_request().goal_constraints) == 2
    arm.set_position_target([0.6, 0.1, 0.7])
    arm.set_rpy_target([0.0, 0.5, 0.0])
    (goal,) = arm.construct_motion_plan_request().goal_constraints
    assert not goal.position_constraints
    assert goal.orientation_constraints[0].orientation.y == pytest.approx(math.sin(0.25))
    for wrong in (
        lambda: arm.set_pose_target([0.5, 0.1, 0.9]),
        lambda: arm.set_pose_targets([]),
        lambda: arm.set_rpy_target([0.1]),
        lambda: arm.set_orientation_target([0, 0, 1]),
        lambda: arm.shift_pose_target(6, 0.1),
    ):
        with pytest.raises(moveit.MoveItCommanderException):
            wrong()
    arm.set_goal_tolerance(1e-4)


def test_settings_go_into_requests(moveit, arm):
    arm.set_planner_id("RRTConnect")
    arm.set_num_planning_attempts(3)
    arm.set_workspace([-1, -2, 1, 2])
    arm.limit_max_cartesian_link_speed(0.2, TIP)
    arm.set_max_velocity_scaling_factor(0.5)
    request = arm.construct_motion_plan_request()
    assert (request.planner_id, request.num_planning_attempts) == ("RRTConnect", 3)
    assert (request.workspace_parameters.min_corner.y, request.max_cartesian_speed) == (-2, 0.2)
    assert request.max_velocity_scaling_factor == 0.5
    arm.set_planning_pipeline_id("other")
    assert arm.get_planner_id() == ""
    arm.set_planning_pipeline_id("")
    arm.clear_max_cartesian_link_speed()
    arm.set_workspace([])
    arm.set_num_planning_attempts(1)
    for wrong in (
        lambda: arm.set_max_velocity_scaling_factor(0.0),
        lambda: arm.set_max_acceleration_scaling_factor(1.5),
        lambda: arm.limit_max_cartesian_link_speed(0.0),
        lambda: arm.set_workspace([1, 2]),
        lambda: arm.set_named_target("nowhere"),
        lambda: arm.set_path_constraints("of a database"),
    ):
        with pytest.raises(moveit.MoveItCommanderException):
            wrong()


def test_defaults_are_moveits(graph, moveit):
    group = moveit.MoveGroupCommander("arm_with_torso")
    request = group.construct_motion_plan_request()
    assert request.max_velocity_scaling_factor == request.max_acceleration_scaling_factor == 0.1
    assert (group.get_planning_time(), request.num_planning_attempts) == (5.0, 1)
    assert group.get_goal_tolerance() == (1e-4, 1e-4, 1e-3)
    graph[0].node.set_param("/robot_description_kinematics/gripper/goal_joint_tolerance", 0.5)
    assert moveit.MoveGroupCommander("gripper").get_goal_joint_tolerance() == 0.5


# -- plans and motions ---------------------------------------------------------------------


def test_it_plans_executes_and_comes_back(arm):
    before = arm.get_current_joint_values()
    arm.remember_joint_values("before")
    goal = {"shoulder_pan_joint": 0.4}
    arm.set_joint_value_target(before)
    arm.set_joint_value_target(goal)
    success, plan, seconds, error = arm.plan()
    assert success
    assert error.val == 1
    assert seconds > 0.0
    assert arm.execute(plan)
    assert arm.get_current_joint_values()[0] == pytest.approx(0.4, abs=1e-3)
    assert not arm.execute(plan)  # it begins somewhere else
    assert arm.go("before")
    assert arm.get_current_joint_values() == pytest.approx(before, abs=1e-3)
    assert arm.execute((success, plan, seconds, error))  # as scripts for Melodic say it
    assert arm.go(before)
    assert arm.plan("before")[0]
    assert arm.execute(arm.plan(before)[1].joint_trajectory)
    arm.set_named_target("tuck")
    assert arm.get_named_target_values("tuck")["elbow_flex_joint"] == pytest.approx(1.72)
    assert "tuck" in arm.get_named_targets()
    arm.forget_joint_values("before")
    assert not arm.get_remembered_joint_values()


def test_what_cannot_be_is_false(arm):
    arm.set_pose_target([9.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    success, plan, _, error = arm.plan()
    assert not success
    assert error.val == -31  # no solution of inverse kinematics
    assert not plan.joint_trajectory.points
    assert not arm.go()


def test_it_goes_to_poses(arm):
    before = arm.get_current_joint_values()
    arm.shift_pose_target(2, 0.05)
    wanted = arm.get_current_pose().pose.position.z + 0.05
    assert arm.go(wait=True)
    assert arm.get_current_pose().pose.position.z == pytest.approx(wanted, abs=1e-3)
    assert arm.go(before)
    pose = arm.get_current_pose().pose
    pose.position.y += 0.05
    assert arm.go(pose)
    assert arm.go(before)


def test_a_plan_may_begin_elsewhere(arm):
    state = arm.get_current_state()
    state.joint_state.position = list(state.joint_state.position)
    state.joint_state.position[state.joint_state.name.index("elbow_flex_joint")] = 0.9
    arm.set_start_state(state)
    success, plan, _, _ = arm.plan(READY)
    assert success
    assert plan.joint_trajectory.points[0].positions[3] == pytest.approx(0.9)


def test_groups_with_joints_that_follow_others(graph, robot):
    hand = robot.get_group("gripper")
    count = hand.get_variable_count()
    assert hand.go([0.03] * count)
    assert hand.get_current_joint_values() == pytest.approx([0.03] * count, abs=2e-3)


def test_straight_ways(arm):
    here = arm.get_current_pose().pose
    up = arm.get_current_pose().pose
    up.position.z += 0.06
    path, fraction = arm.compute_cartesian_path([here, up], 0.01, 0.0)
    assert fraction == 1.0
    assert len(path.joint_trajectory.points) > 5
    assert path.joint_trajectory.joint_names == [*ARM]
    newer, _ = arm.compute_cartesian_path([here, up], 0.01, True)
    assert len(newer.joint_trajectory.points) == len(path.joint_trajectory.points)
    up.position.z += 5.0
    assert arm.compute_cartesian_path([up], 0.01, 0.0)[1] < 0.5
    state = arm.get_current_state()
    for algorithm in (
        "iterative_time_parameterization",
        "iterative_spline_parameterization",
        "time_optimal_trajectory_generation",
    ):
        slow = arm.retime_trajectory(state, path, 0.1, 0.1, algorithm).joint_trajectory.points
        fast = arm.retime_trajectory(state, path, algorithm=algorithm).joint_trajectory.points
        assert slow[-1].time_from_start > fast[-1].time_from_start
        assert slow[-1].positions == pytest.approx(path.joint_trajectory.points[-1].positions)
    assert not arm.retime_trajectory(state, path, algorithm="").joint_trajectory.points


# -- scene ---------------------------------------------------------------------------------


def test_things_come_and_go(scene, tmp_path):
    scene.add_box("box", stamped(1.0, 0.0, 0.5), (0.1, 0.2, 0.3))
    scene.add_sphere("ball", stamped(1.0, 1.0, 0.5), 0.1)
    scene.add_cylinder("can", stamped(1.0, -1.0, 0.5), 0.2, 0.05)
    scene.add_cone("cone", stamped(-1.0, -1.0, 0.5), 0.2, 0.05)
    scene.add_plane("floor", stamped(0.0, 0.0, -1.0))
    file = tmp_path / "tetrahedron.stl"
    file.write_text(_STL)
    scene.add_mesh("mesh", stamped(-1.0, 0.0, 0.5), str(file), (2, 2, 2))
    names = {"box", "ball", "can", "cone", "floor", "mesh"}
    assert {*scene.get_known_object_names()} == names
    assert scene.get_known_object_names(True) == []
    assert scene.get_known_object_names_in_roi(0.5, -0.5, 0, 1.5, 0.5, 1) == ["box"]
    assert scene.get_object_poses(["ball"])["ball"].position.y == 1.0
    things = scene.get_objects()
    assert {*things} == names
    assert things["box"].primitives[0].dimensions == (0.1, 0.2, 0.3)
    assert max(point.x for point in things["mesh"].meshes[0].vertices) == pytest.approx(2.0)
    scene.remove_world_object("box")
    assert {*scene.get_objects(["ball", "box"])} == {"ball"}
    scene.remove_world_object()
    assert scene.get_known_object_names() == []


def test_things_are_held_and_left(moveit, scene, arm):
    with pytest.raises(moveit.MoveItCommanderException, match="cannot read the mesh"):
        scene.add_mesh("mesh", stamped(0, 0, 0), "no such file.stl")
    scene.attach_box(TIP, "tool", stamped(0.1, 0.0, 0.0, TIP), (0.02,) * 3, touch_links=[TIP])
    scene.add_sphere("ball", stamped(0.15, 0.0, 0.0, TIP), 0.01)
    scene.attach_object("ball", TIP)
    held = scene.get_attached_objects()
    assert {name: each.link_name for name, each in held.items()} == {"tool": TIP, "ball": TIP}
    assert {*scene.get_attached_objects(["ball"])} == {"ball"}
    scene.remove_attached_object(TIP, "ball")
    assert scene.get_known_object_names() == ["ball"]
    assert arm.attach_object("ball")  # published, not asked for
    until(lambda: "ball" in scene.get_attached_objects(), 60.0)
    assert arm.detach_object(TIP)
    until(lambda: not scene.get_attached_objects(), 60.0)


def test_rules_of_collisions(scene):
    part = 128
    matrix = scene.get_planning_scene(part).allowed_collision_matrix
    assert "ball" not in matrix.default_entry_names
    matrix.set_allowed("ball")
    matrix.set_allowed("ball", matrix.entry_names[0])
    change = load_message("moveit_msgs/PlanningScene")(is_diff=True)
    change.robot_state.is_diff = True
    change.allowed_collision_matrix = matrix
    assert scene.apply_planning_scene(change)
    found = scene.get_planning_scene(part).allowed_collision_matrix
    assert "ball" in found.default_entry_names
    first, second = found.entry_names.index("ball"), found.entry_names.index(matrix.entry_names[0])
    assert found.entry_values[first].enabled[second]
    found.set_default("ball", False)
    assert not found.default_entry_values[found.default_entry_names.index("ball")]


def test_markers(robot):
    assert len(robot.get_robot_markers().markers) >= 8
    some = robot.get_robot_markers({"elbow_flex_joint": 0.0}, [TIP, "elbow_flex_link"]).markers
    assert {each.ns for each in some} <= {TIP, "elbow_flex_link"}
    assert {each.ns for each in robot.get_robot_markers("arm").markers} <= {
        *robot.get_link_names("arm")
    }
    assert robot.get_robot_markers(robot.get_current_state()).markers


def test_conversions(moveit):
    conversions = importlib.import_module("moveit_commander.conversions")
    pose = conversions.list_to_pose([1, 2, 3, 0, 0, math.pi])
    assert conversions.pose_to_list(pose) == pytest.approx([1, 2, 3, 0, 0, 1, 0])
    made = conversions.list_to_transform([1, 2, 3, 0, 0, 0, 1])
    assert conversions.transform_to_list(made) == [1, 2, 3, 0, 0, 0, 1]
    with pytest.raises(
        moveit.MoveItCommanderException, match="three angles or a quaternion, not 1"
    ):
        conversions.list_to_pose([1])
    copy = load_message("geometry_msgs/Pose")()
    conversions.msg_from_string(copy, conversions.msg_to_string(pose))
    assert copy == pose
    assert unpacked(load_message("geometry_msgs/Pose"), packed(pose)) == pose


def test_a_script_without_rospy_has_a_node_of_its_own(moveit, monkeypatch):
    shared = session.node()
    monkeypatch.setattr("gazelle.drop_in.moveit_client.session.process.node", None)
    moveit.roscpp_initialize(["script", "__name:=mine", "a:=b"])
    own = session.node()
    assert own is not shared
    assert own.name.startswith("/move_group_commander_wrappers")
    moveit.roscpp_shutdown()
    assert own.closed


_STL = """solid t
facet normal 0 0 -1
outer loop
vertex 0 0 0
vertex 0 1 0
vertex 1 0 0
endloop
endfacet
facet normal 0 -1 0
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 0 1
endloop
endfacet
facet normal -1 0 0
outer loop
vertex 0 0 0
vertex 0 0 1
vertex 0 1 0
endloop
endfacet
facet normal 1 1 1
outer loop
vertex 1 0 0
vertex 0 1 0
vertex 0 0 1
endloop
endfacet
endsolid t
"""
