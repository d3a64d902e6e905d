"""The modules that are C++ in MoveIt: what MoveIt's own ``moveit_commander`` asks of them, in bytes."""

import importlib

import pytest
from bridges.moveit.commander_graph import ARM, commander_graph
from bridges.moveit.moveit_graph import READY

from gazelle.drop_in.moveit_client.session import packed, unpacked
from gazelle_ros import load_message

TIP = "gripper_link"
PACKAGE = "moveit_ros_planning_interface"


@pytest.fixture(scope="module")
def made():
    with commander_graph():
        yield {
            kind: getattr(importlib.import_module(f"{PACKAGE}._moveit_{module}"), kind)
            for module, kind in (
                ("move_group_interface", "MoveGroupInterface"),
                ("planning_scene_interface", "PlanningSceneInterface"),
                ("robot_interface", "RobotInterface"),
            )
        }


@pytest.fixture(scope="module")
def group(made):
    return made["MoveGroupInterface"]("arm", "robot_description", "", 5.0)


@pytest.fixture(scope="module")
def robot(made):
    return made["RobotInterface"]("robot_description", "")


def message(kind, data):
    assert isinstance(data, bytes)
    return unpacked(load_message(kind), data)


def pose(x, y, z):
    found = load_message("geometry_msgs/Pose")()
    found.position.x, found.position.y, found.position.z, found.orientation.w = x, y, z, 1.0
    return found


def stamped(place, frame="base_link"):
    found = load_message("geometry_msgs/PoseStamped")(pose=place)
    found.header.frame_id = frame
    return found


def request(group):
    return message("moveit_msgs/MotionPlanRequest", group.construct_motion_plan_request())


def test_a_robot_is_told_in_lists_and_bytes(robot):
    assert robot.get_group_active_joint_names("arm") == [*ARM]
    assert robot.get_robot_root_link() == robot.get_planning_frame() == "base_link"
    assert len(robot.get_link_pose(TIP)) == 7
    state = robot.get_current_state()
    names = message("moveit_msgs/RobotState", state).joint_state.name
    assert set(ARM) <= set(names)
    kind = "visualization_msgs/MarkerArray"
    everything = message(kind, robot.get_robot_markers(state)).markers
    assert len(everything) == len(message(kind, robot.get_robot_markers()).markers)
    assert {each.ns for each in message(kind, robot.get_robot_markers([TIP])).markers} <= {TIP}
    assert message(kind, robot.get_group_markers("arm")).markers
    with pytest.raises(AttributeError, match=r"no method 'get_root_links'.*did you mean"):
        robot.get_root_links()


def test_setters_say_whether_they_could(group):
    assert group.set_joint_value_target([0.1] * 7)
    assert not group.set_joint_value_target([9.0] * 7)
    assert group.set_joint_value_target([0.1] * 7)  # those beyond limits are set all the same
    assert group.set_joint_value_target("elbow_flex_joint", 0.5)
    assert not group.set_joint_value_target({"no_joint": 1.0})
    joints = load_message("sensor_msgs/JointState")(name=["elbow_flex_joint"], position=[0.7])
    assert group.set_joint_value_target_from_joint_state_message(packed(joints))
    assert group.get_joint_value_target()[3] == 0.7
    assert group.set_named_target("tuck")
    assert not group.set_named_target("nowhere")
    assert group.set_pose_target([0.5, 0.1, 0.9, 0.0, 0.0, 0.0], TIP)
    assert not group.set_pose_target([0.5], TIP)
    assert group.set_pose_targets([[0.5, 0.1, 0.9, 0, 0, 0, 1], [0.6, 0, 0.9, 0, 0, 0]])
    assert len(request(group).goal_constraints) == 2
    assert group.set_position_target(0.5, 0.1, 0.9)
    assert group.set_rpy_target(0.0, 0.1, 0.2)
    assert group.set_orientation_target(0.0, 0.0, 0.0, 1.0)
    assert group.set_end_effector_link(TIP)
    assert not group.set_end_effector_link("")
    assert not group.set_path_constraints("of a database")


def test_joints_are_found_for_poses_of_bytes(group):
    x, y, z, *turn = group.get_current_pose("")
    place = pose(x, y, z + 0.02)
    place.orientation.x, place.orientation.y, place.orientation.z, place.orientation.w = turn
    assert group.set_joint_value_target_from_pose(packed(place), "", False)
    assert group.set_joint_value_target_from_pose_stamped(packed(stamped(place)), TIP, False)
    far = stamped(pose(9.0, 0.0, 0.0))
    assert not group.set_joint_value_target_from_pose_stamped(packed(far), "", False)


def test_settings_are_bytes_and_are_not_checked(group):
    group.set_max_velocity_scaling_factor(7.0)
    assert request(group).max_velocity_scaling_factor == 1.0
    group.set_max_acceleration_scaling_factor(-1.0)
    assert request(group).max_acceleration_scaling_factor == 0.1
    group.limit_max_cartesian_link_speed(0.0, "")
    group.set_workspace(-1.0, -2.0, 0.0, 1.0, 2.0, 0.0)
    assert request(group).workspace_parameters.min_corner.y == -2.0
    limits = load_message("moveit_msgs/Constraints")(name="upright")
    group.set_path_constraints_from_msg(packed(limits))
    assert message("moveit_msgs/Constraints", group.get_path_constraints()).name == "upright"
    group.clear_path_constraints()
    assert message("moveit_msgs/Constraints", group.get_path_constraints()).name == ""
    way = load_message("moveit_msgs/TrajectoryConstraints")(constraints=[limits])
    group.set_trajectory_constraints_from_msg(packed(way))
    kind = "moveit_msgs/TrajectoryConstraints"
    assert message(kind, group.get_trajectory_constraints()).constraints[0].name == "upright"
    group.clear_trajectory_constraints()
    assert message("moveit_msgs/PlannerInterfaceDescription", group.get_interface_description())


def test_what_is_set_is_what_it_was_then(made):
    """A message that is changed later changes nothing that was set, as none crosses by reference."""
    commander = importlib.import_module("moveit_commander").MoveGroupCommander("arm")
    state = commander.get_current_state()
    commander.set_start_state(state)
    limits = load_message("moveit_msgs/Constraints")(name="upright")
    commander.set_path_constraints(limits)
    state.is_diff, limits.name = True, "askew"
    commander.get_path_constraints().name = "skewed"
    found = commander.construct_motion_plan_request()
    assert not found.start_state.is_diff
    assert found.path_constraints.name == "upright"
    found.start_state.is_diff = True
    assert not commander.construct_motion_plan_request().start_state.is_diff


def test_states_and_bounds(group):
    state = message("moveit_msgs/RobotState", group.get_current_state())
    group.set_start_state(packed(state))
    assert list(request(group).start_state.joint_state.name) == list(state.joint_state.name)
    group.set_start_state_to_current_state()
    state.joint_state.name, state.joint_state.position = ["shoulder_pan_joint"], [1000.0]
    bounded = message("moveit_msgs/RobotState", group.enforce_bounds(packed(state)))
    assert 1000.0 not in bounded.joint_state.position
    assert group.enforce_bounds(packed(load_message("moveit_msgs/RobotState")())) == b""
    assert set(ARM) <= set(group.get_current_state_bounded())
    assert len(group.get_current_rpy("")) == 3
    assert len(group.get_random_pose(TIP)) == 7


@pytest.mark.long
def test_plans_and_motions_are_bytes(group):
    group.set_max_acceleration_scaling_factor(1.0)
    group.set_planning_time(30.0)
    group.set_joint_value_target(READY)  # stretched, as other tests may leave it, it is singular
    assert group.move()
    before = group.get_current_joint_values()
    group.set_joint_value_target({"shoulder_pan_joint": before[0] + 0.2})
    code, plan, seconds = group.plan()
    assert message("moveit_msgs/MoveItErrorCodes", code).val == 1
    assert seconds > 0.0
    path = message("moveit_msgs/RobotTrajectory", plan)
    slow = group.retime_trajectory(
        group.get_current_state(), plan, 0.1, 0.1, "time_optimal_trajectory_generation"
    )
    points = message("moveit_msgs/RobotTrajectory", slow).joint_trajectory.points
    assert points[-1].time_from_start > path.joint_trajectory.points[-1].time_from_start
    nothing = packed(load_message("moveit_msgs/RobotState")())
    assert group.retime_trajectory(nothing, plan, 1.0, 1.0, "") == b""
    assert group.execute(plan)
    here = group.get_current_pose("")
    limits = packed(load_message("moveit_msgs/Constraints")())
    up = [*here[:2], here[2] + 0.02, *here[3:]]
    for arguments in ((0.0, True, limits), (True, limits), (0.0, True)):
        way, fraction = group.compute_cartesian_path([here, up], 0.01, *arguments)
        assert fraction == 1.0
        assert message("moveit_msgs/RobotTrajectory", way).joint_trajectory.points
    group.set_joint_value_target(before)
    assert group.move()


@pytest.mark.long
def test_what_is_not_held_is_not_placed(group):
    location = load_message("moveit_msgs/PlaceLocation")(place_pose=stamped(pose(0.6, 0.0, 0.9)))
    assert group.pick("nothing", [packed(load_message("moveit_msgs/Grasp")())], True) != 1
    assert group.pick("nothing", True) != 1
    assert not group.place("nothing", packed(location), True)
    assert not group.place("nothing", [0.6, 0.0, 0.9, 0.0, 0.0, 0.0], True)
    assert not group.place("nothing", [0.6], True)
    assert not group.place_poses_list("nothing", [packed(location.place_pose)], True)
    assert not group.place_locations_list("nothing", [packed(location)], True)


def test_the_scene_is_bytes(made):
    scene = made["PlanningSceneInterface"]("")
    thing = load_message("moveit_msgs/CollisionObject")(id="ball", pose=pose(1.0, 2.0, 3.0))
    thing.header.frame_id = "base_link"
    shape = load_message("shape_msgs/SolidPrimitive")(type=2, dimensions=[0.1])
    thing.primitives = [shape]
    change = load_message("moveit_msgs/PlanningScene")(is_diff=True)
    change.robot_state.is_diff = True
    change.world.collision_objects = [thing]
    assert scene.apply_planning_scene(packed(change))
    place = message("geometry_msgs/Pose", scene.get_object_poses(["ball"])["ball"])
    assert place.position.y == 2.0
    found = message("moveit_msgs/CollisionObject", scene.get_objects()["ball"])
    assert found.primitives[0].dimensions == (0.1,)
    assert scene.get_attached_objects() == {}
    whole = message("moveit_msgs/PlanningScene", scene.get_planning_scene(1023))
    assert [each.id for each in whole.world.collision_objects] == ["ball"]
    assert scene.clear()
    assert scene.get_known_object_names() == []
