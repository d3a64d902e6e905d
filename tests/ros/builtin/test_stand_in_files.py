"""Launch files and settings of the packages that are built in."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import gazelle_ros.builtin
from gazelle.control import registry as registry_of_controllers
from gazelle_ros.builtin import registry
from gazelle_ros.builtin.joysticks.relay import JoystickRelay
from gazelle_ros.builtin.joysticks.teleop_twist import TeleopTwistJoy
from gazelle_ros.builtin.twist_mux import TwistMux
from gazelle_ros.builtin.velocity_smoother import SmootherSettings
from gazelle_ros.launch import load_launch
from gazelle_ros.launch.loader import declared_arguments

SHARE = Path(gazelle_ros.builtin.__file__).parent / "share"
LAUNCHES = sorted(SHARE.glob("*/launch/*.launch"))
JOYSTICKS = sorted(SHARE.glob("teleop_twist_joy/config/*.yaml"))


@pytest.mark.parametrize(
    "file", LAUNCHES, ids=lambda each: f"{each.parent.parent.name}/{each.name}"
)
def test_a_launch_file_starts_nodes_that_are_built_in(file):
    arguments = declared_arguments(file).arguments
    plan = load_launch(file, {"manager": "manager"} if "manager" in arguments else None)
    assert plan.nodes
    for node in plan.nodes:
        assert callable(registry.main_of(node.package, node.type))


@pytest.mark.parametrize("kind", ["linear", "planar", "aerial"])
def test_markers_have_settings_for_one_to_three_axes(kind):
    file = SHARE / "interactive_marker_twist_server" / "launch" / "interactive_markers.launch"
    plan = load_launch(file, {"config": kind})
    axes = {name.rpartition("/")[2] for name in plan.parameters if "/linear_scale/" in name}
    assert axes == set({"linear": "", "planar": "xy", "aerial": "xyz"}[kind])


def test_the_smoother_knows_its_settings():
    values = yaml.safe_load((SHARE / "yocs_velocity_smoother/param/standalone.yaml").read_text())
    assert SmootherSettings(**values).frequency == 20.0


def test_the_settings_of_a_joint_state_controller_name_one():
    values = yaml.safe_load(
        (SHARE / "joint_state_controller/joint_state_controller.yaml").read_text()
    )
    assert values["joint_state_controller"]["type"] in registry_of_controllers.types()


@pytest.mark.parametrize("file", JOYSTICKS, ids=lambda each: each.name.split(".")[0])
def test_a_joystick_has_buttons_and_axes_that_the_node_knows(file, make_node, caplog):
    node = make_node("teleop")
    values = yaml.safe_load(file.read_text())
    for name, value in values.items():
        node.set_param(f"~{name}", value)
    made = TeleopTwistJoy(node)
    assert (made._enable, made._turbo) == (values["enable_button"], values["enable_turbo_button"])
    assert "unknown" not in caplog.text


def test_the_multiplexer_begins_with_its_settings(make_node, caplog):
    node, relay = make_node("twist_mux"), make_node("relay")
    folder = SHARE / "twist_mux" / "config"
    for name in ("twist_mux_locks", "twist_mux_topics"):
        for key, value in yaml.safe_load((folder / f"{name}.yaml").read_text()).items():
            node.set_param(f"~{key}", value)
    for key, value in yaml.safe_load((folder / "joystick.yaml").read_text()).items():
        relay.set_param(f"~{key}", value)
    mux = TwistMux(node)
    assert [each.priority for each in mux.priorities.velocities] == [10, 100, 90, 100]
    assert mux.priorities.of_locks(1) == 0
    turbo = JoystickRelay(relay).turbo
    assert turbo._settings.first_step == 2
    assert turbo._settings.speed("linear_backward", 4) == 0.5
    assert "unknown" not in caplog.text
