"""Goals: sent, worked on, given up, preempted, and what each side sees of them."""

import threading
import time
from types import SimpleNamespace

import pytest
from ros.graph import until

import gazelle_ros.actions.client as client_module
from gazelle_ros.actions import (
    ActionClient,
    ActionException,
    ActionServer,
    CommState,
    GoalStatus,
    SimpleActionClient,
    SimpleActionServer,
)
from gazelle_ros.actions.states import TRANSITIONS, name_of
from gazelle_ros.messages import load_message

TEST = load_message("actionlib/TestAction")
GOAL = load_message("actionlib/TestGoal")
RESULT = load_message("actionlib/TestResult")
FEEDBACK = load_message("actionlib/TestFeedback")
LONG = 1000
"""A goal that is worked on until the test says so, or until it is given up."""


@pytest.fixture
def simple(make_node):
    """Yield a simple client and server; goals above 0 succeed, others abort."""
    states, go = [], threading.Event()

    def execute(goal):
        server.publish_feedback(FEEDBACK(goal.goal))
        deadline = time.monotonic() + (120.0 if goal.goal == LONG else 0.1)
        while time.monotonic() < deadline and not go.is_set():
            if server.is_preempt_requested():
                states.append("preempted")
                server.set_preempted(RESULT(-1), "pre")
                return
            time.sleep(0.01)
        done = server.set_succeeded if goal.goal > 0 else server.set_aborted
        done(RESULT(goal.goal), "text")

    server = SimpleActionServer(make_node("server"), "/act", TEST, execute)
    client = SimpleActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    yield client, go, states
    server.stop()


def test_a_goal_succeeds_and_brings_its_result(simple):
    client, go, _ = simple
    seen = []
    client.send_goal(
        GOAL(LONG),
        done_cb=lambda state, result: seen.append((state, result.result)),
        active_cb=lambda: seen.append("active"),
        feedback_cb=lambda feedback: seen.append(feedback.feedback),
    )
    until(lambda: len(seen) == 2)
    assert set(seen) == {"active", LONG}
    go.set()
    assert client.wait_for_result(60.0)
    assert client.get_state() == GoalStatus.SUCCEEDED
    assert client.get_result().result == LONG
    assert client.get_goal_status_text() == "text"
    until(lambda: len(seen) == 3)
    assert seen[-1] == (GoalStatus.SUCCEEDED, LONG)


def test_a_goal_is_aborted(simple):
    client, _, _ = simple
    assert client.send_goal_and_wait(GOAL(-3), 60.0) == GoalStatus.ABORTED


def test_a_goal_is_given_up_on_request(simple):
    client, _, _ = simple
    client.send_goal(GOAL(LONG))
    until(lambda: client.get_state() == GoalStatus.ACTIVE)
    client.cancel_goal()
    assert client.wait_for_result(60.0)
    assert client.get_state() == GoalStatus.PREEMPTED


def test_a_goal_that_takes_too_long_is_given_up(simple):
    client, _, _ = simple
    ended = client.send_goal_and_wait(GOAL(LONG), 0.05, 60.0)
    # Recalled if it began only then.
    assert ended in {GoalStatus.PREEMPTED, GoalStatus.RECALLED}


def test_a_new_goal_takes_the_place_of_the_old(simple):
    client, _, states = simple
    client.send_goal(GOAL(LONG))
    until(lambda: client.get_state() == GoalStatus.ACTIVE)
    client.send_goal(GOAL(6))
    assert client.wait_for_result(60.0)
    assert client.get_result().result == 6
    assert states == ["preempted"]


def test_a_callback_that_fails_aborts_the_goal(make_node, caplog):
    def broken(goal):
        raise ValueError("a bug of mine")

    server = SimpleActionServer(make_node("server"), "/act", TEST, broken)
    client = SimpleActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    assert client.send_goal_and_wait(GOAL(1), 60.0) == GoalStatus.ABORTED
    assert "a bug of mine" in client.get_goal_status_text()
    server.stop()


def test_a_callback_that_forgets_the_goal_aborts_it(make_node):
    server = SimpleActionServer(make_node("server"), "/act", TEST, lambda goal: None)
    client = SimpleActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    assert client.send_goal_and_wait(GOAL(1), 60.0) == GoalStatus.ABORTED
    assert client.get_goal_status_text() == "No terminal state was set."
    server.stop()


def test_goals_can_be_taken_by_hand(make_node):
    came = threading.Event()
    server = SimpleActionServer(make_node("server"), "/act", TEST, auto_start=False)
    server.register_goal_callback(came.set)
    server.start()
    client = SimpleActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    client.send_goal(GOAL(4))
    assert came.wait(60.0)
    assert server.is_new_goal_available()
    assert server.accept_new_goal().goal == 4
    assert server.is_active()
    server.set_succeeded(RESULT(4))
    assert client.wait_for_result(60.0)
    assert not server.is_active()


def test_a_server_by_hand_is_told_that_its_goal_shall_end(make_node):
    came, ended = threading.Event(), threading.Event()
    server = SimpleActionServer(make_node("server"), "/act", TEST, auto_start=False)
    server.register_goal_callback(came.set)
    server.register_preempt_callback(ended.set)
    server.start()
    client = SimpleActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    client.send_goal(GOAL(4))
    assert came.wait(60.0)
    server.accept_new_goal()
    assert not ended.is_set()
    client.cancel_goal()
    assert ended.wait(60.0)
    server.set_preempted(RESULT(-1))
    assert client.wait_for_result(60.0)
    assert client.get_state() == GoalStatus.PREEMPTED


@pytest.fixture
def full(make_node):
    """Return a client and a server whose goals wait for an outcome."""
    goals, cancels = [], []
    server = ActionServer(make_node("server"), "/act", TEST, goals.append, cancels.append)
    client = ActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    return client, server, goals, cancels


def test_the_states_of_a_goal_are_seen_in_order(full):
    client, _, goals, _ = full
    seen = []
    handle = client.send_goal(GOAL(1), lambda h: seen.append(h.get_comm_state()))
    until(lambda: goals)
    goals[0].set_accepted()
    until(lambda: handle.get_comm_state() == CommState.ACTIVE)
    goals[0].set_succeeded(RESULT(1), "well")
    until(lambda: seen[-1] == CommState.DONE)
    assert seen[-3:] == [CommState.ACTIVE, CommState.WAITING_FOR_RESULT, CommState.DONE]
    assert handle.get_terminal_state() == GoalStatus.SUCCEEDED
    assert handle.get_result().result == 1


def test_a_rejected_and_a_recalled_goal(full):
    client, _, goals, cancels = full
    handle = client.send_goal(GOAL(1))
    until(lambda: goals)
    assert goals[0].set_rejected(None, "no")
    until(lambda: handle.get_comm_state() == CommState.DONE)
    assert handle.get_terminal_state() == GoalStatus.REJECTED
    other = client.send_goal(GOAL(2))
    until(lambda: len(goals) == 2)
    other.cancel()
    until(lambda: cancels)
    assert cancels == [goals[1]]
    assert goals[1].set_canceled()
    until(lambda: other.get_comm_state() == CommState.DONE)
    assert other.get_terminal_state() == GoalStatus.RECALLED


def test_impossible_changes_of_state_are_refused_and_logged(full, caplog):
    client, _, goals, _ = full
    client.send_goal(GOAL(1))
    until(lambda: goals)
    assert not goals[0].set_succeeded()
    assert "must be in a preempting or active state" in caplog.text
    assert goals[0].set_accepted()
    assert not goals[0].set_rejected()


def test_all_goals_and_those_before_a_time_are_given_up(full):
    client, _, goals, cancels = full
    handles = [client.send_goal(GOAL(number)) for number in range(3)]
    until(lambda: len(goals) == 3)
    stamps = sorted(goal.get_goal_id().stamp for goal in goals)
    client.cancel_goals_at_and_before_time(stamps[1])
    until(lambda: len(cancels) == 2)
    client.cancel_all_goals()
    until(lambda: len(cancels) == 3)
    assert len(handles) == 3


def test_a_cancel_request_may_come_before_its_goal(full, make_node):
    client, server, goals, _ = full
    goal_id = load_message("actionlib_msgs/GoalID")(id="later")

    def state():
        return [each.status.status for each in server.status_list]

    client._cancel.publish(goal_id)
    until(lambda: state() == [GoalStatus.RECALLING])
    client._goal.publish(client.types.action_goal(goal_id=goal_id, goal=GOAL(1)))
    until(lambda: state() == [GoalStatus.RECALLED])
    assert goals == []


@pytest.mark.parametrize("spoken_of", [False, True])
def test_a_list_from_before_a_goal_does_not_lose_it(monkeypatch, spoken_of):
    now = [0.0]
    monkeypatch.setattr(client_module, "time", SimpleNamespace(monotonic=lambda: now[0]))
    machine = client_module.GoalMachine(None, None, None, None)
    status = load_message("actionlib_msgs/GoalStatus")(status=GoalStatus.PENDING)
    if spoken_of:
        machine.update_status(status)
    machine.transition_to(CommState.WAITING_FOR_CANCEL_ACK)
    machine.update_status(None)
    assert (machine.state == CommState.DONE) is spoken_of
    now[0] = 60.0
    machine.update_status(None)
    assert machine.state == CommState.DONE
    assert machine.latest_status.status == GoalStatus.LOST


def test_finished_goals_leave_the_list(make_node):
    node = make_node("server")
    node.set_param("/act/status_list_timeout", 0.2)
    node.set_param("/act/status_frequency", 50.0)
    goals, lists = [], []
    ActionServer(node, "/act", TEST, goals.append)
    watcher = make_node("watcher")
    statuses = load_message("actionlib_msgs/GoalStatusArray")
    watcher.subscribe("/act/status", statuses, lambda m: lists.append(len(m.status_list)))
    client = ActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    client.send_goal(GOAL(1))
    until(lambda: goals)
    goals[0].set_accepted()
    goals[0].set_succeeded()
    until(lambda: 1 in lists)
    until(lambda: lists[-1] == 0)


def test_a_server_that_is_not_there_is_not_waited_for_long(make_node):
    client = SimpleActionClient(make_node("client"), "/nobody", TEST)
    assert not client.wait_for_server(0.2)
    assert client.get_state() == GoalStatus.LOST


def test_a_class_that_is_no_action_is_refused(make_node):
    with pytest.raises(ActionException, match="not an action spec"):
        SimpleActionClient(make_node("client"), "/act", GOAL)


def test_every_way_through_the_states_ends():
    for state, answers in TRANSITIONS.items():
        assert name_of(CommState, state) != "No such state"
        for steps in answers.values():
            assert set(steps) <= set(TRANSITIONS)
            assert state not in steps


def test_a_client_that_comes_gets_the_status_at_once(make_node):
    node = make_node("server")
    node.set_param("/act/status_frequency", 0.01)
    server = ActionServer(node, "/act", TEST)
    client = ActionClient(make_node("client"), "/act", TEST)
    begin = time.monotonic()
    assert client.wait_for_server(60.0)
    assert time.monotonic() - begin < 60.0, "the next one comes after 100 s"
    server.stop()


def goal_on(client, taken, number):
    """Send a goal, and return both handles once it is accepted."""
    handle = client.send_goal(GOAL(number))
    until(lambda: taken and taken[-1].get_goal().goal == number)
    taken[-1].set_accepted()
    until(lambda: handle.get_comm_state() == CommState.ACTIVE)
    return handle, taken[-1]


def done(handle):
    until(lambda: handle.get_comm_state() == CommState.DONE)
    return handle.get_goal_status()


@pytest.mark.parametrize("over", [True, False])
def test_a_server_in_the_place_of_another_gets_all_goals(make_node, over):
    """The first has results to send yet; a goal that did not end is lost to its client only."""
    node, taken, new = make_node("server"), [], []
    first = ActionServer(node, "/act", TEST, taken.append)
    client = ActionClient(make_node("client"), "/act", TEST)
    assert client.wait_for_server(60.0)
    before, old = goal_on(client, taken, 1)
    first.refuse()
    if over:
        old.set_succeeded(RESULT(1))
        assert done(before) == GoalStatus.SUCCEEDED
    second = ActionServer(node, "/act", TEST, new.append)
    until(lambda: client.connected)
    after, goal = goal_on(client, new, 2)
    if not over:
        assert done(before) == GoalStatus.LOST
        assert old.set_succeeded(RESULT(1))
    first.stop()
    goal.set_succeeded(RESULT(2))
    assert done(after) == GoalStatus.SUCCEEDED
    assert [len(taken), len(new)] == [1, 1]
    second.stop()
