"""The manager loads, switches and unloads as ros_control's does."""

from __future__ import annotations

import sys
import threading
import types as modules

import numpy as np
import pytest

from gazelle.control import (
    EFFORT,
    POSITION,
    VELOCITY,
    Controller,
    ControllerManager,
    RobotHardware,
    Strictness,
    SwitchResult,
    register,
)
from gazelle.control.values import JointTarget, JointTargets
from gazelle.errors import ControlError, ControlWarning
from tests.control.stand_in import Frictionless, spin

EFFORT_TYPE = "effort_controllers/JointEffortController"
CONFIG = {
    "a": {"type": EFFORT_TYPE, "joint": "one"},
    "b": {"type": "effort_controllers/JointGroupEffortController", "joints": ["one", "two"]},
    "c": {"type": EFFORT_TYPE, "joint": "two"},
    "v": {"type": "velocity_controllers/JointVelocityController", "joint": "one"},
    "untyped": {"joint": "one"},
    "unknown": {"type": "effort_controllers/JointEfortController", "joint": "one"},
    "no_joint": {"type": EFFORT_TYPE},
    "lost": {"type": EFFORT_TYPE, "joint": "oen"},
    "empty": {"type": "effort_controllers/JointGroupEffortController", "joints": []},
    "position": {"type": "position_controllers/JointPositionController", "joint": "one"},
}


def manager():
    return ControllerManager(Frictionless({"Effort": ["one", "two"], "Velocity": ["one"]}), CONFIG)


def states(m):
    return {each.controller.name: each.state for each in m.loaded}


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("untyped", "the type was not specified"),
        ("missing", "the type was not specified"),
        ("unknown", "does not exist; did you mean 'effort_controllers/JointEffortController'"),
        ("no_joint", "initializing controller 'no_joint' failed"),
        ("lost", "could not find resource 'oen' in 'hardware_interface::EffortJointInterface'"),
        ("empty", "'empty/joints' is empty"),
        ("position", "requires a hardware interface of type 'hardware_interface::PositionJoint"),
    ],
)
def test_what_cannot_be_loaded_leaves_nothing_behind(name, said):
    m = manager()
    with pytest.raises(ControlError, match=said):
        m.load(name)
    assert m.loaded == []


def test_a_name_is_loaded_once_and_unloaded_when_stopped():
    m = manager()
    m.load("a")
    with pytest.raises(ControlError, match="'a' was already loaded"):
        m.load("a")
    assert states(m) == {"a": "initialized"}
    m.start("a")
    with pytest.raises(ControlError, match="still running"):
        m.unload("a")
    m.stop("a")
    assert states(m) == {"a": "stopped"}
    m.unload("a")
    with pytest.raises(ControlError, match="no controller with this name exists"):
        m.unload("a")


def loaded(*names):
    m = manager()
    for name in names:
        m.load(name)
    return m


@pytest.mark.parametrize(
    ("start", "stop", "said"),
    [
        (["x"], [], "could not start controller with name 'x'"),
        ([], ["x"], "could not stop controller with name 'x'"),
        ([], ["c"], "since it is not running"),
        (["a"], [], "'a' is already running"),
        (["a"], ["a"], "both the list"),
        (["b"], [], r"resource conflict on \[one\], controllers = \[a, b\]"),
        (["v"], [], r"resource conflict on \[one\], controllers = \[a, v\]"),
        (["b", "c"], ["a"], r"conflict on \[two\]"),
    ],
)
def test_a_strict_switch_is_all_or_nothing(start, stop, said):
    m = loaded("a", "b", "c", "v")
    m.start("a")
    before = states(m)
    with pytest.raises(ControlError, match=said):
        m.switch(start, stop, Strictness.STRICT)
    assert states(m) == before


@pytest.mark.parametrize(
    ("start", "stop", "running"),
    [
        (["x", "c"], ["y"], {"a", "c"}),
        (["a"], [], {"a"}),
        (["c"], ["c"], {"a", "c"}),  # a stopped one in both lists just starts
        (["b"], ["a"], {"b"}),
        ([], [], {"a"}),
    ],
)
def test_best_effort_passes_over_what_cannot_be(start, stop, running):
    m = loaded("a", "b", "c")
    m.start("a")
    assert m.switch(start, stop, Strictness.BEST_EFFORT).done
    assert {name for name, state in states(m).items() if state == "running"} == running


def test_best_effort_too_refuses_conflicts_and_restarts():
    m = loaded("a", "b")
    m.start("a")
    for start, stop in ((["b"], []), (["a"], ["a"])):
        with pytest.raises(ControlError):
            m.switch(start, stop, Strictness.BEST_EFFORT)
    with pytest.warns(ControlWarning, match="strictness 0"):
        m.switch(["x"], [], 0)


def test_one_controller_that_claims_a_joint_twice_conflicts_with_itself():
    class Both(Controller):
        def init(self, parameters):
            self.claim(EFFORT, ["one"])
            self.claim(VELOCITY, ["one"])

    register("tests/Both", Both)
    m = loaded()
    m.load("both", {"type": "tests/Both"})
    with pytest.raises(ControlError, match=r"\[both, both\]"):
        m.start("both")


def test_reload_takes_all_away_only_by_force():
    m = loaded("a", "c")
    m.start("a")
    assert not m.reload()
    assert len(m.loaded) == 2
    assert m.reload(force_kill=True)
    assert m.loaded == []
    assert m.reload()


def test_claims_are_listed_by_interface_and_sorted():
    m = loaded("b")
    assert m.loaded[0].info.claimed == {EFFORT: ("one", "two")}


def test_a_class_is_found_in_a_package_of_its_name():
    module = modules.ModuleType("my_controllers")

    class Spring(Controller):
        interfaces = (EFFORT,)

        def init(self, parameters):
            self._joint = self.claim(EFFORT, parameters.names("joint"))
            self._stiffness = parameters.number("stiffness", 10.0)

        def update(self, time, period):
            self._joint.set_command(-self._stiffness * self._joint.position)

    module.Spring, module.Nothing = Spring, 3
    sys.modules["my_controllers"] = module
    try:
        m = loaded()
        m.hardware.joints.position[:, 0] = 1.0
        m.load("s", {"type": "my_controllers/Spring", "joint": "one", "stiffness": 4})
        m.start("s")
        spin(m)
        assert m.hardware.joints.effort[0, 0] == -4.0
        m.load("t", {"type": "my_controllers:Spring", "joint": "two"})
        with pytest.raises(ControlError, match="not a controller class"):
            m.load("u", {"type": "my_controllers/Nothing"})
    finally:
        del sys.modules["my_controllers"]


def test_one_that_fails_is_aborted_and_the_others_go_on():
    class Broken(Controller):
        def update(self, time, period):
            raise RuntimeError("no")

    register("tests/Broken", Broken)
    m = loaded("a")
    m.load("broken", {"type": "tests/Broken"})
    m.start("broken", "a")
    m["a"].inputs["command"].send(JointTarget(2.0))
    with pytest.warns(ControlWarning, match="'broken' failed and is aborted: no"):
        spin(m)
    spin(m)
    assert states(m) == {"a": "running", "broken": "aborted"}
    assert m.hardware.joints.effort[0, 0] == 2.0


class Slow(RobotHardware):
    """A robot that says itself when its joints have switched."""

    def __init__(self):
        super().__init__()
        self.register_joints(["one", "two"], {POSITION: ["one", "two"]})
        self.results = {}
        self.feasible = True

    def prepare_switch(self, start, stop):
        return self.feasible

    def switch_result(self, controller=None):
        if controller is not None:
            return self.results.get(controller.name, SwitchResult.DONE)
        for result in (SwitchResult.ERROR, SwitchResult.ONGOING):
            if result in self.results.values():
                return result
        return SwitchResult.DONE


def slow():
    kind = "position_controllers/JointPositionController"
    m = ControllerManager(
        Slow(), {"a": {"type": kind, "joint": "one"}, "b": {"type": kind, "joint": "two"}}
    )
    m.load("a")
    m.load("b")
    return m


@pytest.mark.parametrize("asap", [False, True])
def test_controllers_wait_until_the_robot_has_switched(asap):
    m = slow()
    m.hardware.results["b"] = SwitchResult.ONGOING
    switch = m.switch(["a", "b"], start_asap=asap)
    assert not switch.done
    assert states(m) == {"a": "running" if asap else "waiting", "b": "waiting"}
    with pytest.raises(ControlError, match="in progress"):
        m.switch([], [])
    with pytest.raises(ControlError, match="still running"):
        m.unload("b")
    m.hardware.results.clear()
    spin(m)
    assert switch.done
    assert states(m) == {"a": "running", "b": "running"}


@pytest.mark.parametrize("result", [SwitchResult.ERROR, SwitchResult.ONGOING])
def test_controllers_are_aborted_when_the_robot_cannot_switch(result):
    m = slow()
    m.hardware.results["b"] = result
    switch = m.switch(["a", "b"], start_asap=True, timeout=0.05)
    spin(m, 10)
    assert switch.done
    assert switch.failed == {"b"}
    assert states(m) == {"a": "running", "b": "aborted"}
    m.hardware.results.clear()
    m.start("b")  # from any state
    assert states(m) == {"a": "running", "b": "running"}


def test_a_robot_may_refuse():
    m = slow()
    m.hardware.feasible = False
    with pytest.raises(ControlError, match="unfeasible"):
        m.start("a")


def test_commands_are_for_the_worlds_that_they_are_sent_to():
    hardware = Frictionless({"Effort": ["one", "two"]}, nworld=3)
    m = ControllerManager(hardware, CONFIG)
    m.load("b")
    m.start("b")
    m["b"].inputs["command"].send(JointTargets([1.0, 2.0]), np.array([1]))
    m["b"].inputs["command"].send(JointTargets([[3.0, 4.0], [5.0, 6.0]]), np.array([0, 2]))
    spin(m)
    assert hardware.joints.effort.tolist() == [[3.0, 4.0], [1.0, 2.0], [5.0, 6.0]]
    with pytest.raises(ControlError, match=r"command of 'b' \(3\) does not match .* \(2\)"):
        m["b"].inputs["command"].send(JointTargets([1.0, 2.0, 3.0]))
    m.stop("b")
    spin(m)
    assert hardware.joints.effort[1, 1] == 2.0  # the last command stays


def test_watchers_see_what_comes_and_goes():
    m = loaded("a")
    seen = []
    end = m.watch(lambda c: seen.append(f"+{c.name}"), lambda c: seen.append(f"-{c.name}"))
    m.load("c")
    m.unload("a")
    end()
    m.unload("c")
    assert seen == ["+a", "+c", "-a"]


def test_many_threads_switch_while_another_updates():
    m = loaded("a", "c")
    stop, faults = threading.Event(), []

    def client(name):
        try:
            for _ in range(500):
                m.start(name)
                m.stop(name)
        except ControlError as error:
            faults.append(error)

    def loop():
        while not stop.is_set():
            m.call(lambda: spin(m))

    threads = [threading.Thread(target=client, args=(name,)) for name in ("a", "c")]
    looping = threading.Thread(target=loop)
    looping.start()
    for each in threads:
        each.start()
    for each in threads:
        each.join(60)
    stop.set()
    looping.join(60)
    assert faults == []
    assert states(m) == {"a": "stopped", "c": "stopped"}
