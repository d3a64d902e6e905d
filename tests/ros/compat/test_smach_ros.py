"""smach_ros: actions, services and topics as states, and what viewers are told."""

import base64
import importlib
import pickle
import threading

import pytest
from graph import until

from gazelle_ros.messages import load_message


@pytest.fixture
def smach_ros(node):
    return importlib.import_module("smach_ros")


@pytest.fixture
def smach(smach_ros):
    return importlib.import_module("smach")


def alone(smach, state, **data):
    """Return the outcome of a state, and the userdata."""
    outcomes = state.get_registered_outcomes()
    sm = smach.StateMachine(outcomes=outcomes)
    for key, value in data.items():
        sm.userdata[key] = value
    with sm:
        smach.StateMachine.add("STATE", state)
    return sm.execute(), sm.userdata


@pytest.mark.parametrize(
    ("name", "digest"),
    [
        ("SmachContainerInitialStatusCmd", "45f8cf31fc29b829db77f23001f788d6"),
        ("SmachContainerStatus", "5ba2bb79ac19e3842d562a191f2a675b"),
        ("SmachContainerStructure", "3d3d1e0d0f99779ee9e58101a5dcf7ea"),
    ],
)
def test_messages_are_those_of_ros(name, digest):
    assert load_message(f"smach_msgs/{name}")._md5sum == digest


def test_a_service_is_a_state(node, smach, smach_ros):
    services = importlib.import_module("std_srvs.srv")
    node.Service("switch", services.SetBool, lambda asked: (asked.data, f"was {asked.data}"))

    @smach.cb_interface(outcomes=["off"], output_keys=["words"])
    def judge(ud, response):
        ud.words = response.message
        return None if response.success else "off"

    for data, expected in ((True, "succeeded"), (False, "off")):
        state = smach_ros.ServiceState(
            "switch",
            services.SetBool,
            request_slots=["data"],
            response_slots=["success"],
            response_cb=judge,
        )
        outcome, userdata = alone(smach, state, data=data)
        assert outcome == expected
        assert (userdata.success, userdata.words) == (data, f"was {data}")


@pytest.mark.long
def test_an_action_is_a_state(node, smach, smach_ros):
    actionlib = importlib.import_module("actionlib")
    tutorial = importlib.import_module("actionlib_tutorials.msg")
    begun = threading.Event()

    def work(goal):
        result = tutorial.FibonacciResult(sequence=[1] * goal.order)
        if goal.order < 0:
            begun.set()
            until(server.is_preempt_requested)
            server.set_preempted()
        elif goal.order > 3:
            server.set_aborted(result)
        else:
            server.set_succeeded(result)

    server = actionlib.SimpleActionServer("fibonacci", tutorial.FibonacciAction, work, False)
    server.start()

    def state(**options):
        return smach_ros.SimpleActionState("fibonacci", tutorial.FibonacciAction, **options)

    @smach.cb_interface(input_keys=["length"])
    def enlarge(ud, goal):
        goal.order = ud.length + 1

    outcome, userdata = alone(
        smach, state(goal_slots=["order"], result_slots=["sequence"]), order=2
    )
    assert (outcome, list(userdata.sequence)) == ("succeeded", [1, 1])
    outcome, userdata = alone(smach, state(goal_cb=enlarge, result_key="got"), length=3)
    assert (outcome, len(userdata.got.sequence)) == ("aborted", 4)
    late = state(goal=tutorial.FibonacciGoal(-1), exec_timeout=node.Duration(0.1))
    assert alone(smach, late)[0] == "aborted"
    begun.clear()
    waiting = state(goal=tutorial.FibonacciGoal(-1))
    ended = []
    thread = threading.Thread(target=lambda: ended.append(alone(smach, waiting)[0]))
    thread.start()
    assert begun.wait(60.0)
    waiting.request_preempt()
    thread.join(60.0)
    assert ended == ["preempted"]


@pytest.mark.long
def test_an_action_without_a_server_is_aborted(node, smach, smach_ros):
    tutorial = importlib.import_module("actionlib_tutorials.msg")
    state = smach_ros.SimpleActionState(
        "nobody", tutorial.FibonacciAction, server_wait_timeout=node.Duration(0.1)
    )
    assert alone(smach, state)[0] == "aborted"
    with pytest.raises(smach.InvalidStateError, match="nonsense"):
        smach_ros.SimpleActionState("nobody", tutorial.FibonacciAction, goal_slots=["nonsense"])


@pytest.mark.parametrize(("wanted", "outcome"), [(3, "valid"), (4, "invalid")])
def test_a_topic_is_watched(node, smach, smach_ros, wanted, outcome):
    kind = importlib.import_module("std_msgs.msg").Int32
    publisher = node.Publisher("number", kind, queue_size=1, latch=True)
    publisher.publish(3)
    state = smach_ros.MonitorState("number", kind, lambda ud, message: message.data == wanted, 1)
    assert alone(smach, state)[0] == outcome


def test_a_condition_is_asked_again(smach, smach_ros):
    answers = [False, False, True]
    state = smach_ros.ConditionState(lambda ud: answers.pop(0), max_checks=5)
    assert alone(smach, state)[0] == "true"
    assert alone(smach, smach_ros.ConditionState(lambda ud: False, max_checks=2))[0] == "false"


@pytest.mark.long
def test_viewers_are_told_what_a_machine_is_and_does(node, smach, smach_ros):
    messages = importlib.import_module("smach_msgs.msg")
    said = {"status": [], "structure": []}
    for kind, found in said.items():
        cls = getattr(messages, f"SmachContainer{kind.capitalize()}")
        node.Subscriber(f"/server/smach/container_{kind}", cls, found.append)
    sm = smach.StateMachine(outcomes=["done"])
    sm.userdata.speed, sm.userdata.lock = 0.5, threading.Lock()
    inner = smach.StateMachine(outcomes=["done"])
    with sm:
        smach.StateMachine.add("INNER", inner)
        with inner:
            smach.StateMachine.add("X", smach.CBState(lambda ud: "done", outcomes=["done"]))
    server = smach_ros.IntrospectionServer("/server", sm, "/ROOT")
    server.start()
    until(lambda: {each.path for each in said["structure"]} == {"/ROOT", "/ROOT/INNER"})
    until(lambda: {each.path for each in said["status"]} == {"/ROOT", "/ROOT/INNER"})
    root = next(each for each in said["structure"] if each.path == "/ROOT")
    assert list(root.children) == ["INNER"]
    assert list(zip(root.internal_outcomes, root.outcomes_from, strict=True)) == [("done", "INNER")]
    status = next(each for each in said["status"] if each.path == "/ROOT")
    assert list(status.initial_states) == ["INNER"]
    assert pickle.loads(base64.b64decode(status.local_data)) == {"speed": 0.5}
    assert sm.execute() == "done"
    until(lambda: any(each.info == "Termination" for each in said["status"]))
    server.stop()


def test_userdata_from_the_network_is_not_unpickled(node, smach, smach_ros):
    messages = importlib.import_module("smach_msgs.msg")
    sm = smach.StateMachine(outcomes=["done"])
    with sm:
        for label in ("A", "B"):
            smach.StateMachine.add(label, smach.CBState(lambda ud: "done", outcomes=["done"]))
    server = smach_ros.IntrospectionServer("/server", sm, "/ROOT")
    server.start()
    topic = "/server/smach/container_init"
    publisher = node.Publisher(topic, messages.SmachContainerInitialStatusCmd, queue_size=1)
    until(publisher.get_num_connections)
    data = base64.b64encode(pickle.dumps({"evil": 1}, 2)).decode()
    publisher.publish(messages.SmachContainerInitialStatusCmd("/ROOT", ["B"], data))
    until(lambda: sm.get_initial_states() == ["B"])
    assert "evil" not in sm.userdata
    server.stop()


def test_a_machine_is_asked_to_end_before_the_node_does(node, smach, smach_ros):
    class Machine:
        asked = looked = 0

        def request_preempt(self):
            self.asked += 1
            assert not node.is_shutdown()

        def is_running(self):
            self.looked += 1
            return self.looked < 3

    machine = Machine()
    smach_ros.set_preempt_handler(machine)
    node.signal_shutdown("test")
    assert (machine.asked, machine.looked) == (1, 3)
