"""The services of a controller manager, by name, type and meaning those of ros_control."""

import logging
import threading

import pytest
from bridges.control.control_graph import KINDS, control_graph
from control.stand_in import Frictionless
from ros.graph import until

from gazelle.control import SwitchResult
from gazelle_ros import load_service

EFFORT = "effort_controllers/JointEffortController"
VELOCITY = "velocity_controllers/JointVelocityController"
GROUP = "effort_controllers/JointGroupEffortController"
BEST_EFFORT, STRICT = 1, 2


@pytest.fixture
def graph():
    with control_graph() as made:
        yield made


MD5 = {
    "list_controllers": "1341feb2e63fa791f855565d0da950d8",
    "list_controller_types": "c1d4cd11aefa9f97ba4aeb5b33987f4e",
    "load_controller": "647e5c54b8d6468952d8d31f1efe96c0",
    "unload_controller": "647e5c54b8d6468952d8d31f1efe96c0",
    "switch_controller": "b29a7abc673b2c54c14b54e50f8d06a5",
    "reload_controller_libraries": "40e8c411fd1797d2e2c486018f846040",
}


@pytest.mark.parametrize("namespace", ["", "/", "arm", "/left/arm/"])
def test_all_services_are_in_the_managers_namespace(namespace):
    with control_graph(namespace=namespace) as graph:
        for name, kind in KINDS.items():
            service = load_service(f"controller_manager_msgs/{kind}")
            assert service._md5sum == MD5[name]
            full = f"{graph.space}/controller_manager/{name}"
            assert graph.node.wait_for_service(full, timeout=30) is not False
        assert graph.load("hip_controller", EFFORT, joint="hip")
        assert graph.states == {"hip_controller": "initialized"}


def test_types_are_listed_with_their_base_class(graph):
    answer = graph.call("list_controller_types")
    assert {EFFORT, VELOCITY, GROUP} <= set(answer.types)
    assert answer.base_classes == ["controller_interface::ControllerBase"] * len(answer.types)


def test_a_controller_goes_through_its_states(graph):
    assert graph.load("hip", EFFORT, joint="hip")
    assert graph.states == {"hip": "initialized"}
    assert graph.switch(["hip"])
    assert graph.states == {"hip": "running"}
    assert not graph.call("unload_controller", name="hip")
    assert graph.switch(stop=["hip"])
    assert graph.states == {"hip": "stopped"}
    assert graph.call("unload_controller", name="hip")
    assert graph.states == {}


@pytest.mark.parametrize(
    ("name", "parameters", "said"),
    [
        ("none", None, "type was not specified"),
        ("plain", 3, "type was not specified"),
        ("typeless", {"joint": "hip"}, "type was not specified"),
        ("nested", {"type": {"deep": 1}}, "type was not specified"),
        ("unknown", {"type": "effort_controllers/Nonsense"}, "does not exist"),
        ("nowhere", {"type": EFFORT, "joint": "nose"}, "could not find resource 'nose'"),
        ("jointless", {"type": EFFORT}, "jointless/joint"),
        ("empty", {"type": GROUP, "joints": []}, "empty"),
        (
            "foreign",
            {"type": "position_controllers/JointPositionController", "joint": "hip"},
            "hardware_interface::PositionJointInterface",
        ),
        ("", None, ""),
    ],
)
def test_what_cannot_be_loaded_leaves_nothing_behind(graph, caplog, name, parameters, said):
    if parameters is not None:
        graph.node.set_param(f"/{name}", parameters)
    with caplog.at_level(logging.ERROR, "gazelle.control"):
        assert not graph.call("load_controller", name=name)
    assert said in caplog.text
    assert graph.states == {}


def test_a_name_is_loaded_once(graph):
    assert graph.load("hip", EFFORT, joint="hip")
    assert not graph.load("hip", EFFORT, joint="knee")
    assert not graph.call("unload_controller", name="knee")


def test_claims_are_listed_by_their_names_in_cpp(graph):
    assert graph.load("legs", GROUP, joints=["knee", "hip"])
    (found,) = graph.call("list_controllers").controller
    assert found.type == GROUP
    (claim,) = found.claimed_resources
    assert claim.hardware_interface == "hardware_interface::EffortJointInterface"
    assert claim.resources == ["hip", "knee"]


def test_controllers_are_listed_in_the_order_of_loading(graph):
    for name in ("z", "a", "m"):
        assert graph.load(name, EFFORT, joint="hip")
    assert list(graph.states) == ["z", "a", "m"]


@pytest.mark.parametrize(
    ("start", "stop", "strict", "best"),
    [
        (["hip"], [], True, True),
        ([], [], True, True),
        (["none"], [], False, True),
        ([], ["none"], False, True),
        (["wheel"], [], False, True),  # it runs
        ([], ["hip"], False, True),  # it does not
        (["hip", "none"], [], False, True),
        (["hip", "twin"], [], False, False),  # one joint
        (["wheel"], ["wheel"], False, False),
    ],
)
def test_strictness_decides_on_what_cannot_be(graph, start, stop, strict, best):
    for strictness, good in ((STRICT, strict), (BEST_EFFORT, best)):
        assert graph.call("reload_controller_libraries", force_kill=True)
        assert graph.load("hip", EFFORT, joint="hip")
        assert graph.load("twin", EFFORT, joint="hip")
        graph.spawn("wheel", VELOCITY, joint="left")
        before = graph.states
        assert graph.switch(start, stop, strictness) is good
        if not good:
            assert graph.states == before


def test_controllers_change_places_at_once(graph):
    graph.spawn("one", EFFORT, joint="hip")
    assert graph.load("two", EFFORT, joint="hip")
    assert not graph.switch(["two"])
    assert graph.switch(["two"], ["one"])
    assert graph.states == {"one": "stopped", "two": "running"}


def test_a_switch_is_made_while_nothing_steps():
    with control_graph(run=False) as graph:
        graph.spawn("hip", EFFORT, joint="hip")
        assert graph.states == {"hip": "running"}


class Slow(Frictionless):
    """A robot that takes its time to switch."""

    def __init__(self):
        super().__init__({"Effort": ["hip"]})
        self.result = SwitchResult.ONGOING

    def switch_result(self, controller=None):
        return self.result


def test_a_switch_waits_for_the_robot():
    robot = Slow()
    with control_graph(robot) as graph:
        assert graph.load("hip", EFFORT, joint="hip")
        done = []
        thread = threading.Thread(target=lambda: done.append(graph.switch(["hip"])))
        thread.start()
        until(lambda: graph.manager.state_of("hip") == "waiting", 30)
        assert not done
        robot.result = SwitchResult.DONE
        thread.join(30)
        assert done == [True]
        assert graph.states == {"hip": "running"}


def test_a_switch_gives_up_after_its_timeout():
    with control_graph(Slow()) as graph:
        assert graph.load("hip", EFFORT, joint="hip")
        assert not graph.switch(["hip"], timeout=0.05)


def test_reloading_wants_nothing_loaded_or_force(graph):
    graph.spawn("hip", EFFORT, joint="hip")
    assert not graph.call("reload_controller_libraries", force_kill=False)
    assert graph.states == {"hip": "running"}
    assert graph.call("reload_controller_libraries", force_kill=True)
    assert graph.states == {}
    assert graph.call("reload_controller_libraries", force_kill=False)


def test_two_managers_live_side_by_side():
    with control_graph(namespace="/one") as one, control_graph(namespace="/two") as two:
        assert one.load("hip", EFFORT, joint="hip")
        assert two.states == {}


def test_commands_reach_a_joint_only_while_its_controller_is_loaded(graph):
    graph.spawn("hip", EFFORT, joint="hip")
    publisher, number = graph.talk("hip/command", "std_msgs/Float64")
    publisher.publish(number(2.0))
    joints = graph.manager.hardware.joints
    until(lambda: joints.effort[0, joints.resources.index("hip")] == 2.0, 30)
    assert graph.switch(stop=["hip"])
    assert graph.call("unload_controller", name="hip")
    until(lambda: publisher.num_connections == 0, 30)


def test_a_group_refuses_a_command_of_another_length(graph, caplog):
    graph.spawn("legs", GROUP, joints=["knee", "hip"])
    publisher, numbers = graph.talk("legs/command", "std_msgs/Float64MultiArray")
    publisher.publish(numbers(data=[1.0]))
    until(lambda: "does not match number of joints" in caplog.text, 30)
    publisher.publish(numbers(data=[1.0, 2.0]))
    effort = graph.manager.hardware.joints.effort
    until(lambda: effort[0, :2].tolist() == [2.0, 1.0], 30)


def test_services_end_with_the_loop():
    with control_graph() as graph:
        name = "/controller_manager/list_controllers"
        assert name in graph.node.master.system_state()[2]
        graph.loop.close()
        until(lambda: name not in graph.node.master.system_state()[2], 30)
