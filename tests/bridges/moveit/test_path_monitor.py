"""Obstacles that appear during a motion stop it, and it is replanned where the goal allows that."""

from bridges.moveit.moveit_graph import message
from bridges.moveit.test_move_group_actions import action, goal_of, robot, send
from bridges.moveit.test_move_group_scene import apply, box
from ros.graph import until

from gazelle.planning import PlanOutcome

__all__ = ["robot"]
TIP = "gripper_link"
PAN = "shoulder_pan_joint"


def in_the_way(client, angle):
    """Return the pose of the hand with the arm turned."""
    context = client.group.context
    with context.lock:
        state = context.current()
        state[context.robot.column(PAN)] = angle
        return context.robot.pose(state, TIP)


def begin(robot, goal):
    """Start a goal whose controllers do not end by themselves."""
    robot.how = "linger"
    client = action(robot, "move_group", "MoveGroup")
    client.send_goal(goal)
    assert robot.began.wait(60.0)
    return client


def test_what_comes_into_the_way_stops_a_motion(robot):
    client = begin(robot, goal_of(**{PAN: 1.0}))
    assert apply(robot.client, box(pose=in_the_way(robot.client, 0.5), size=(0.1, 0.1, 0.1)))
    assert client.wait_for_result(60.0)
    code = client.get_result().error_code.val
    assert code == PlanOutcome.MOTION_PLAN_INVALIDATED_BY_ENVIRONMENT_CHANGE
    assert "moved into the path" in client.get_goal_status_text()


def test_what_is_passed_or_beside_the_way_does_not(robot):
    client = begin(robot, goal_of(**{PAN: 1.0}))
    beside, behind = in_the_way(robot.client, -0.6), in_the_way(robot.client, 0.1)
    context = robot.client.group.context
    robot.client.stand(**{PAN: 0.7})
    assert apply(robot.client, box("beside", pose=beside, size=(0.1, 0.1, 0.1)))
    assert apply(robot.client, box("behind", pose=behind, size=(0.1, 0.1, 0.1)))
    assert not context.scene.contacts()
    assert not client.wait_for_result(0.3)
    client.cancel_goal()
    assert client.wait_for_result(60.0)
    assert client.get_result().error_code.val == PlanOutcome.PREEMPTED


def test_it_is_planned_anew_around_it(robot, caplog):
    goal = goal_of(**{PAN: 1.0})
    goal.planning_options.replan, goal.planning_options.replan_attempts = True, 2
    client = begin(robot, goal)
    robot.how = "arrive"  # from the next one on
    pose = in_the_way(robot.client, 0.5)
    assert apply(robot.client, box(pose=pose, size=(0.1, 0.1, 0.1)))
    # The first controller still lingers until it is preempted.
    assert client.wait_for_result(60.0)
    assert client.get_result().error_code.val == PlanOutcome.SUCCESS
    assert len(robot.goals) == 2
    assert "replanning" in caplog.text
    assert len(robot.goals[1][1].trajectory.points) > len(robot.goals[0][1].trajectory.points)
    until(lambda: abs(robot.client.group.context.monitor.current()[
        robot.client.group.context.robot.column(PAN)] - 1.0) < 0.01, 60.0)  # fmt: skip


def test_a_goal_that_cannot_be_is_not_planned_anew(robot, caplog):
    goal = goal_of(**{PAN: 1.0})
    goal.planning_options.replan = True
    goal.planning_options.planning_scene_diff = message("PlanningScene", is_diff=True)
    wall = box(pose=in_the_way(robot.client, 1.0), size=(0.1, 0.1, 0.1))
    goal.planning_options.planning_scene_diff.world.collision_objects = [wall]
    result, _ = send(robot, goal)
    assert (
        result.error_code.val == PlanOutcome.GOAL_IN_COLLISION
    )  # which planning anew does not mend
    assert robot.goals == []
