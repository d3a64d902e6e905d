"""Ports that wake sensors, events that tell of changes, plugins that fail."""

import numpy as np
import pytest

import gazelle
from gazelle.description import Parameters
from gazelle.errors import SimulationWarning
from gazelle.simulation import (
    BasePlugin,
    Input,
    Output,
    Service,
    absolute,
    namespace_of,
)
from gazelle.simulation.ports import Ports
from gazelle.simulation.scheduled_plugin import make_scheduled
from gazelle.simulation.state_lock import StateLock


@pytest.fixture
def sim():
    with gazelle.Simulation("turtlebot3_stage_1") as running:
        running.spawn("turtlebot3_burger", name="r1")
        yield running


def parameters(**tags):
    children = tuple(Parameters(tag, text) for tag, text in tags.items())
    return Parameters("plugin", children=children)


def test_names_that_begin_with_a_slash_are_full():
    assert absolute("r1", "/scan") == "/scan"
    assert absolute("/r1/", "scan") == "/r1/scan"
    assert absolute("", "a/b") == absolute("/", "a/b") == "/a/b"


def test_a_plugins_own_namespace_comes_before_that_of_the_spawn(sim):
    robot = sim.robots["r1"]
    assert namespace_of(robot, parameters(), "model") == "model"
    robot.namespace = "/spawned"
    assert namespace_of(robot, parameters(), "model") == "/spawned"
    assert namespace_of(robot, parameters(robotNamespace="own"), "model") == "own"


def test_the_topics_of_a_model_without_namespace_are_under_its_name(sim):
    robot = sim.robots["r1"]
    assert robot.inputs["cmd_vel"].topic == "/r1/cmd_vel"
    assert robot.outputs["odom"].topic == "/r1/odom"
    spawned = sim.spawn("turtlebot3_burger", name="r2", namespace="/")
    assert spawned.outputs["odom"].topic == "/odom"


def test_a_scan_that_is_listened_to_comes_at_the_sensors_rate_and_then_sleeps(sim):
    scans = []
    scan = sim.robots["r1"].outputs["scan"]
    end = scan.subscribe(scans.append)
    sim.run(seconds=1.0)
    assert len(scans) == 5
    assert scan.frame == "base_scan"
    end()
    sim.run(seconds=1.0)
    assert len(scans) == 5
    assert not sim.robots["r1"].sensors["lds_lfcd_sensor"].awake


def test_after_a_reset_the_last_value_is_the_one_of_the_reset(sim):
    robot = sim.robots["r1"]
    odometry = robot.outputs["odom"]
    odometry.subscribe(lambda _value: None)
    robot.inputs["cmd_vel"].send(linear=0.2)
    sim.run(seconds=1.0)
    assert odometry.last.position[0, 0] > 0.05
    sim.reset()
    assert abs(odometry.last.position[0, 0]) < 1e-9


def test_spawn_delete_and_reset_are_told(sim):
    told = []
    sim.events.spawned.subscribe(lambda robot: told.append(("spawned", robot.name)))
    sim.events.deleted.subscribe(lambda robot: told.append(("deleted", robot.name)))
    end = sim.events.reset.subscribe(lambda worlds, rewound: told.append((worlds, rewound)))
    sim.spawn("turtlebot3_burger", name="r2")
    sim.delete("r2")
    sim.reset()
    sim.reset(time=False)
    end()
    sim.reset()
    assert told == [("spawned", "r2"), ("deleted", "r2"), (None, True), (None, False)]


def test_a_plugin_that_fails_is_detached_and_named_and_the_rest_goes_on(sim):
    class Broken(BasePlugin):
        update_rate = 0.0
        calls = 0

        def on_update(self, time):
            self.calls += 1
            raise ValueError(f"no good at {time}")

    broken = Broken()
    sim.plugins.append(make_scheduled(broken, "wobbler", "r1"))
    with pytest.warns(SimulationWarning, match=r"'wobbler' of 'r1' failed.*no good.*\.py:\d+"):
        sim.run(seconds=0.1)
    assert broken.calls == 1
    assert sim.time == pytest.approx(0.1)


def test_inputs_and_services_hand_over_values_and_worlds():
    got, forgotten = [], []
    port = Input("/go", float, lambda value, worlds: got.append((value, worlds)))
    port.send(1.5)
    port.clear()
    careful = Input("/go", float, lambda value, worlds: None, forget=forgotten.append)
    careful.clear(np.array([1]))
    service = Service("/add", float, float, lambda request, worlds: request + 1.0)
    assert got == [(1.5, None)]
    assert forgotten[0].tolist() == [1]
    assert service.call(2.0) == 3.0


def test_an_output_that_nobody_wants_is_never_computed():
    computed = []
    output = Output("/x", float, lambda: computed.append(1) or 2.0)
    output.publish()
    assert not computed
    end = output.subscribe(lambda value: None)
    output.publish()
    end()
    assert len(computed) == 1


def test_ports_added_all_at_once_belong_to_the_simulation_too():
    lock = StateLock()
    ports = Ports(lock)
    ports.outputs["a"] = Output("/a", int, lambda: 1)
    ports.outputs.update({"a": Output("/b", int, lambda: 2)}, c=Output("/c", int, lambda: 3))
    assert {name: port.topic for name, port in ports.outputs.items()} == {
        "a": "/b",
        "a 2": "/a",
        "c": "/c",
    }
    before = lock.changes
    ports.outputs["c"].subscribe(lambda _: None)
    assert lock.changes == before + 1
