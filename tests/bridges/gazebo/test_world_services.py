"""Pause, reset, physics and Gazelle's own services over ROS."""

import time

import pytest
from ros.graph import until

from gazelle_ros import load_message, load_service


def empty(graph, name):
    return graph.client.call(name, "std_srvs/Empty")


def test_no_step_is_made_once_pausing_is_answered(running):
    until(lambda: running.sim.time > 0.01)
    empty(running, "pause_physics")
    stopped = running.sim.time
    time.sleep(0.1)
    assert running.sim.time == stopped
    empty(running, "unpause_physics")
    until(lambda: running.sim.time > stopped)


def test_a_paused_world_is_stepped_and_answers_when_it_is_there(graph):
    empty(graph, "pause_physics")
    before = graph.sim.time
    answer = graph.client.call("/gazelle/step", "gazelle_msgs/Step", steps=25)
    assert answer.success
    assert answer.time.to_sec() == pytest.approx(before + 0.025)
    assert graph.sim.time == pytest.approx(before + 0.025)
    empty(graph, "unpause_physics")
    assert not graph.client.call("/gazelle/step", "gazelle_msgs/Step", steps=1).success


def test_time_goes_back_at_a_reset_of_the_simulation_only(graph):
    graph.sim.step(100)
    empty(graph, "reset_world")
    assert graph.sim.time == pytest.approx(0.1)
    empty(graph, "reset_simulation")
    assert graph.sim.time == 0.0


def test_the_physics_is_read_and_changed(graph):
    got = graph.client.call("get_physics_properties", "GetPhysicsProperties")
    assert (got.time_step, got.max_update_rate, got.gravity.z) == pytest.approx(
        (0.001, 1000.0, -9.8)
    )
    assert (got.ode_config.sor_pgs_iters, got.ode_config.sor_pgs_w) == (150, 1.4)
    got.gravity.z = -1.62
    answer = graph.client.call(
        "set_physics_properties",
        "SetPhysicsProperties",
        time_step=0.002,
        max_update_rate=0.0,
        gravity=got.gravity,
        ode_config=got.ode_config,
    )
    assert (answer.success, answer.status_message) == (True, "physics engine updated")
    assert graph.sim.physics.time_step == 0.002
    assert graph.sim.physics.gravity == (0.0, 0.0, -1.62)
    assert graph.sim.physics.update_rate == 0.0


def test_a_time_step_that_cannot_be_changes_nothing(graph):
    answer = graph.client.call("set_physics_properties", "SetPhysicsProperties", time_step=-1.0)
    assert not answer.success
    assert graph.sim.physics.time_step == 0.001


def test_the_world_lists_its_models(graph):
    got = graph.client.call("get_world_properties", "GetWorldProperties")
    assert {"r1", "ground_plane"} <= set(got.model_names)
    assert got.status_message == "GetWorldProperties: got properties"


def test_a_snapshot_is_restored(graph):
    state = graph.client.call("/gazelle/snapshot", "gazelle_msgs/Snapshot").state
    before = graph.sim.state_hash()
    graph.sim.robots["r1"].inputs["cmd_vel"].send(0.2)
    graph.sim.step(500)
    assert graph.sim.state_hash() != before
    assert graph.client.call("/gazelle/restore", "gazelle_msgs/Restore", state=state).success
    assert graph.sim.state_hash() == before
    answer = graph.client.call("/gazelle/restore", "gazelle_msgs/Restore", state=b"nonsense")
    assert not answer.success


def test_the_real_time_factor_is_a_number_or_max(graph):
    def ask(text):
        return graph.client.call(
            "/gazelle/set_real_time_factor", "gazelle_msgs/SetRealTimeFactor", real_time_factor=text
        ).success

    assert ask("2.5")
    assert graph.sim.physics.update_rate == pytest.approx(2500.0)
    for unlimited in ("max", "inf"):
        assert ask("1")
        assert ask(unlimited)
        assert graph.sim.physics.update_rate == 0.0
    for no_factor in ("fast", "-1", "0", "nan", ""):
        assert not ask(no_factor)


def test_the_same_seed_gives_the_same_noise(graph):
    scans = []
    for seed in (7, 8, 7):
        graph.client.call("/gazelle/seed", "gazelle_msgs/Seed", seed=seed)
        scans.append(graph.sim.robots["r1"].sensors["lds_lfcd_sensor"].read().ranges.tolist())
    assert scans[0] == scans[2] != scans[1]


def test_rqt_reconfigure_sees_and_changes_the_physics(graph):
    config = graph.client.node.wait_for_message(
        "/gazebo/parameter_updates", load_message("dynamic_reconfigure/Config"), timeout=60.0
    )
    assert {each.name: each.value for each in config.doubles}["time_step"] == 0.001
    described = graph.client.node.wait_for_message(
        "/gazebo/parameter_descriptions",
        load_message("dynamic_reconfigure/ConfigDescription"),
        timeout=60.0,
    )
    assert len(described.groups[0].parameters) == 15
    request = load_service("dynamic_reconfigure/Reconfigure")._request_class()
    parameter = load_message("dynamic_reconfigure/DoubleParameter")
    request.config.doubles.append(parameter("gravity_z", -200.0))
    answer = graph.client.node.client(
        "/gazebo/set_parameters", load_service("dynamic_reconfigure/Reconfigure")
    ).call(request)
    assert {each.name: each.value for each in answer.config.doubles}["gravity_z"] == -100.0
    assert graph.sim.physics.gravity[2] == -100.0
