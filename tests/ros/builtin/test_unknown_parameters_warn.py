"""Nodes and nodelets that are built in warn of private parameters that they do not have."""

from __future__ import annotations

import pytest

from gazelle_ros.builtin import registry
from gazelle_ros.builtin.diagnostic_aggregator import DiagnosticAggregator
from gazelle_ros.builtin.nodelets.manager import NodeletManager
from gazelle_ros.builtin.twist_mux import TwistMux
from gazelle_ros.robot.state_publisher import RobotStatePublisher

LIMITS = dict.fromkeys(("speed_lim_v", "speed_lim_w", "accel_lim_v", "accel_lim_w"), 1.0)
MUX = {"yaml_cfg_data": "{subscribers: [{name: a, topic: b, timeout: 0.1, priority: 1}]}"}
NEEDED = {
    "cmd_vel_mux/CmdVelMuxNodelet": MUX,
    "yocs_cmd_vel_mux/CmdVelMuxNodelet": MUX,
    "yocs_velocity_smoother/VelocitySmootherNodelet": LIMITS,
    "laser_filters/scan_to_scan_filter_chain": {"scan_filter_chain": []},
}
NODES = {
    "aggregator_node": DiagnosticAggregator,
    "nodelet manager": NodeletManager,
    "twist_mux": TwistMux,
    "robot_state_publisher": lambda node: RobotStatePublisher(node, {}),
}


@pytest.mark.parametrize("name", [*registry.nodelets(), *NODES])
def test_a_parameter_that_is_not_known_is_warned_of(name, make_node, caplog):
    node = make_node("made")
    for key, value in {**NEEDED.get(name, {}), "not_one_of_them": 1}.items():
        node.set_param(f"~{key}", value)
    (NODES.get(name) or registry.nodelet(name))(node)
    assert "/made/not_one_of_them is an unknown parameter" in caplog.text


@pytest.mark.parametrize("name", [*registry.nodelets(), *NODES])
def test_without_parameters_nothing_is_unknown(name, make_node, caplog):
    node = make_node("made")
    for key, value in NEEDED.get(name, {}).items():
        node.set_param(f"~{key}", value)
    (NODES.get(name) or registry.nodelet(name))(node)
    assert "unknown parameter" not in caplog.text
