"""The Python code of controller_manager and controller_manager_msgs, as scripts import it."""

import pytest
from ros.builtin.manager_stand_in import INTERFACE, SERVICES, ManagerStandIn

from gazelle_ros import load_message, load_service


@pytest.fixture
def utils(node):
    from controller_manager_msgs import utils

    return utils


@pytest.fixture
def interface(node):
    from controller_manager import controller_manager_interface

    return controller_manager_interface


@pytest.fixture
def robot(make_node):
    node = make_node("robot")
    for name in ("left", "right"):
        node.set_param(f"/{name}/type", "kind/A")
    return node


def test_the_modules_have_their_messages_beside_them(node):
    from controller_manager_msgs import srv, utils
    from controller_manager_msgs.msg import ControllerState

    assert srv.SwitchController._md5sum == "b29a7abc673b2c54c14b54e50f8d06a5"
    assert ControllerState is load_message("controller_manager_msgs/ControllerState")
    assert set(utils.cm_services) == set(SERVICES)


def test_managers_are_found_by_all_of_their_services(utils, robot):
    whole = [ManagerStandIn(robot, name) for name in ("/b/c", "/a")]
    ManagerStandIn(robot, "/a/controller_manager2")
    part = ManagerStandIn(robot, "/part")
    part.servers[3].close()
    other = ManagerStandIn(robot, "/other")
    other.servers[3].close()
    load = load_service("controller_manager_msgs/LoadController")
    robot.serve("/other/unload_controller", load, lambda _: {"ok": True})
    found = ["/a", "/a/controller_manager2", "/b/c"]
    assert utils.get_controller_managers() == found
    assert utils.get_controller_managers("/a") == found[:2]
    assert utils.get_controller_managers("/nothing") == []
    # What was found before is not looked at again, even if it was wrong.
    assert utils.get_controller_managers(initial_guess=["/part", "/gone"]) == [*found, "/part"]
    assert not utils.is_controller_manager("/part")
    assert not utils.is_controller_manager("/other")
    assert utils.is_controller_manager("/a/")
    lister = utils.ControllerManagerLister("/b")
    assert lister() == lister() == ["/b/c"]
    for server in whole[0].servers:
        server.close()
    assert lister() == []


def test_a_lister_lists_what_is_loaded_and_comes_back_after_a_restart(utils, robot):
    manager = ManagerStandIn(robot)
    manager.states = {"left": "running", "right": "stopped"}
    lister = utils.ControllerLister()
    assert [each.name for each in lister()] == ["left", "right"]
    for server in manager.servers:
        server.close()
        server.drop_all()
    assert lister() == []
    ManagerStandIn(robot).states = {"left": "running"}
    assert [each.state for each in lister()] == ["running"]
    assert utils.ControllerLister("/nobody")() == []


def controllers():
    state = load_message("controller_manager_msgs/ControllerState")
    claim = load_message("controller_manager_msgs/HardwareInterfaceResources")
    return [
        state("arm", "running", "p/Arm", [claim("i::A", ["a", "b"])]),
        state("arm_2", "stopped", "p/Arm2", [claim("i::A", ["a"]), claim("i::B", ["c", "d"])]),
        state("state", "running", "q/State", []),
    ]


@pytest.mark.parametrize(
    ("name", "arguments", "found"),
    [
        ("name", ("arm",), [0]),
        ("name", ("arm", True), [0, 1]),
        ("name", ("none", True), []),
        ("type", ("p/Arm",), [0]),
        ("type", ("p/", True), [0, 1]),
        ("state", ("run",), []),
        ("state", ("run", True), [0, 2]),
        ("hardware_interface", ("i::B",), [1]),
        ("hardware_interface", ("i::", True), [0, 1]),
        ("hardware_interface", ("i::",), []),
        ("resources", (["a"],), [0, 1]),
        ("resources", (["a", "b"],), [0]),
        ("resources", (["a", "c"],), []),  # not through one interface
        ("resources", (["a", "c"], None, True), [0, 1]),
        ("resources", (["d", "c"], "i::B"), [1]),
        ("resources", (["a"], "i::B"), []),
        ("resources", (["x"],), []),
    ],
)
def test_controllers_are_chosen(utils, name, arguments, found):
    known = controllers()
    chosen = getattr(utils, f"filter_by_{name}")(known, *arguments)
    assert chosen == [known[index] for index in found]


@pytest.mark.parametrize("space", ["/", "", "/ns", "/ns/"])
def test_parameters_that_may_be_controllers_are_those_with_a_type(utils, robot, space):
    below = space.strip("/")
    prefix = f"/{below}" if below else ""
    robot.set_param(f"{prefix}/hip", {"type": "k/A", "joint": "h"})
    robot.set_param(f"{prefix}/none", {"type": {"deeper": "k/A"}})
    robot.set_param(f"{prefix}/type", {"none": "k/A"})
    assert set(utils.get_rosparam_controller_names(space)) - {"left", "right"} == {"hip"}


def test_the_interface_tells_what_came_of_it_and_says_so(interface, robot, capsys):
    manager = ManagerStandIn(robot)
    assert interface.load_controller("left")
    assert not interface.load_controller("left")
    assert interface.load_controller("right")
    assert interface.start_controllers(["left", "right"])
    assert interface.start_stop_controllers(stop_controllers=["left"])
    assert not interface.stop_controllers(["left", "right"])
    assert interface.start_stop_controllers(["left"], ["right"])
    assert not interface.unload_controller("left")
    interface.list_controllers()
    assert not interface.reload_libraries(False)
    assert interface.reload_libraries(True, restore=True)
    assert manager.states == {"left": "running", "right": "initialized"}
    assert interface.stop_controller("left")
    assert interface.start_controller("left")
    assert capsys.readouterr().out.splitlines() == [
        "Loaded 'left'",
        "Error when loading 'left'",
        "Loaded 'right'",
        "Started ['left', 'right'] successfully",
        "Stopped ['left'] successfully",
        "Error when starting [] and stopping ['left', 'right']",
        "Started ['left'] successfully",
        "Stopped ['right'] successfully",
        "Error when unloading 'left'",
        f"'left' - '{INTERFACE}' ( running )",
        f"'right' - '{INTERFACE}' ( stopped )",
        "Restore: False",
        "Failed to reload libraries. Do you still have controllers loaded?",
        "Restore: True",
        "Successfully reloaded libraries",
        "Controllers restored to original state",
        "Stopped ['left'] successfully",
        "Started ['left'] successfully",
    ]
