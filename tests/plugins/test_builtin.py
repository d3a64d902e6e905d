"""Gazebo's own plugins that worlds use."""

import numpy as np
import pytest
from models import base, block, plugin, simulate

from gazelle.errors import PluginWarning
from gazelle.plugins.battery import LinearBattery


@pytest.mark.long
def test_a_random_velocity_begins_as_told_and_is_drawn_anew_in_each_world():
    tags = plugin(
        "libRandomVelocityPlugin.so",
        link="core",
        initial_velocity="0 0.5 0",
        velocity_factor="0.4",
        update_period="1",
        min_z="0",
        max_z="0",
    )
    with simulate(block(plugin=tags, gravity=False), ground=False, nworld=3) as sim:
        robot = sim.robots["cube"]
        sim.run(seconds=0.5)
        assert robot.motion().linear == pytest.approx(np.tile([0.0, 0.5, 0.0], (3, 1)), abs=1e-3)
        sim.run(seconds=1.0)
        drawn = robot.motion().linear.copy()
        assert (np.linalg.norm(drawn, axis=1) <= 0.4 + 1e-6).all()
        assert drawn[:, 2] == pytest.approx(0.0, abs=1e-6)
        assert not np.allclose(drawn[0], drawn[1])
        state = sim.snapshot()
        sim.run(seconds=1.0)
        expected = robot.motion().linear.copy()
        sim.restore(state)
        sim.run(seconds=1.0)
        assert robot.motion().linear == pytest.approx(expected)
        sim.reset()
        sim.run(seconds=0.1)
        assert robot.motion().linear[:, 1] == pytest.approx(0.5, abs=1e-3)


def test_an_initial_velocity_is_there_after_a_reset_too():
    tags = plugin("libInitialVelocityPlugin.so", linear="-1 0 2", angular="0 0 0.5")
    with simulate(block(plugin=tags, gravity=False), ground=False) as sim:
        for _ in range(2):
            sim.run(seconds=0.2)
            assert sim.robots["cube"].twist.linear == pytest.approx([-1.0, 0.0, 2.0], abs=1e-3)
            sim.reset()


ARM = """<model name="arm"><link name="base"><inertial><mass>1</mass></inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<link name="tip"><gravity>0</gravity><inertial><mass>1</mass><inertia><ixx>0.5</ixx><iyy>0.5</iyy>
<izz>0.5</izz></inertia></inertial></link><joint name="elbow" type="revolute">
<parent>base</parent><child>tip</child><axis><xyz>0 0 1</xyz></axis></joint>{plugin}</model>"""


def controlled(kind, target, gains="0 0 0"):
    inside = f"""<controller type="{kind}"><joint>elbow</joint><target>{target}</target>
    <pid_gains>{gains}</pid_gains></controller>"""
    tags = plugin("libJointControlPlugin.so").replace("</plugin>", f"{inside}</plugin>")
    return simulate(ARM.format(plugin=tags), ground=False)


def test_joints_are_held_at_positions_and_velocities_and_turned_by_forces():
    with controlled("position", 0.7, "50 0 10") as sim:
        sim.run(seconds=3.0)
        assert sim.robots["arm"].joints["elbow"].position == pytest.approx(0.7, abs=0.01)
    with controlled("velocity", 1.5, "5 0 0") as sim:
        sim.run(seconds=2.0)
        assert sim.robots["arm"].joints["elbow"].velocity == pytest.approx(1.5, abs=0.01)
        state = sim.snapshot()
        sim.run(seconds=0.2)
        expected = sim.robots["arm"].joints["elbow"].position
        sim.restore(state)
        sim.run(seconds=0.2)
        assert sim.robots["arm"].joints["elbow"].position == pytest.approx(expected, abs=1e-9)
    with controlled("force", 0.5) as sim:
        sim.run(seconds=1.0)
        assert sim.robots["arm"].joints["elbow"].velocity == pytest.approx(1.0, rel=0.01)


def test_a_controllers_joints_may_be_given_by_an_expression_or_with_their_model():
    for name in ("el.*w", "arm::elbow", "(.*)"):
        tags = plugin("libJointControlPlugin.so").replace(
            "</plugin>",
            f"""<controller type="position"><joint>{name}</joint><target>0.7</target>
            <pid_gains>50 0 10</pid_gains></controller></plugin>""",
        )
        with simulate(ARM.format(plugin=tags), ground=False) as sim:
            sim.run(seconds=3.0)
            assert sim.robots["arm"].joints["elbow"].position == pytest.approx(0.7, abs=0.01)


def test_an_unknown_controller_is_refused():
    with pytest.raises(PluginWarning, match="positoin"):
        controlled("positoin", 0.0)


def test_a_wing_lifts_by_its_coefficients():
    tags = plugin(
        "libLiftDragPlugin.so",
        link_name="core",
        a0="0.05",
        cla="4.0",
        cda="0.5",
        alpha_stall="1.0",
        area="0.1",
        air_density="1.2",
        forward="1 0 0",
        upward="0 0 1",
    )
    with simulate(block(plugin=tags, gravity=False), ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        robot.set_twist([[10.0, 0.0, 0.0], [0.0, 0.0, 0.0]], (0.0, 0.0, 0.0))
        sim.step()
        motion = robot.motion().linear
        pressure = 0.5 * 1.2 * 0.1 * 100.0
        assert motion[0, 2] == pytest.approx(pressure * 4.0 * 0.05 * 1e-3, rel=0.01)
        assert 10.0 - motion[0, 0] == pytest.approx(pressure * 0.5 * 0.05 * 1e-3, rel=0.01)
        assert motion[1] == pytest.approx(0.0)


def test_what_floats_rises_by_the_water_it_displaces():
    tags = plugin("libBuoyancyPlugin.so", fluid_density="200")
    with simulate(block(plugin=tags), ground=False) as sim:
        sim.run(seconds=0.1)
        # 8 litres of it weigh 1.6 kg, the cube 1 kg.
        assert sim.robots["cube"].twist.linear[2] == pytest.approx(0.6 * 9.8 * 0.1, rel=0.02)
    given = tags.replace("</plugin>", '<link name="core"><volume>0.005</volume></link></plugin>')
    with simulate(block(plugin=given), ground=False) as sim:
        sim.run(seconds=0.5)
        assert sim.robots["cube"].twist.linear[2] == pytest.approx(0.0, abs=1e-3)


def test_a_battery_runs_down():
    battery = plugin(
        "libLinearBatteryPlugin.so",
        battery_name="b",
        open_circuit_voltage_constant_coef="12",
        capacity="1",
        smooth_current_tau="0.1",
    )
    load = plugin("libLinearBatteryConsumerPlugin.so", battery_name="b", power_load="24")
    with simulate(block(plugin=battery + load)) as sim:
        (found,) = [e.plugin for e in sim.plugins if isinstance(e.plugin, LinearBattery)]
        sim.run(seconds=5.0)
        assert found.current[0] == pytest.approx(2.0, rel=0.01)
        assert found.charge[0] == pytest.approx(1.0 - 2.0 * 4.9 / 3600.0, rel=1e-4)
        sim.reset()
        assert found.charge[0] == 1.0


@pytest.mark.parametrize(
    "tags",
    [
        plugin("libDiffDrivePlugin.so", left_joint="joint0", right_joint="joint1", torque="20"),
        plugin(
            "libSkidSteerDrivePlugin.so",
            left_front="joint0",
            right_front="joint1",
            left_rear="joint2",
            right_rear="joint3",
            MaxForce="20",
        ),
    ],
)
def test_gazebos_own_drives_take_sizes_from_the_model(tags):
    with simulate(base(tags)) as sim:
        robot = sim.robots["base"]
        assert robot.inputs["cmd_vel"].topic == "/base/vel_cmd"
        robot.inputs["cmd_vel"].send(linear=0.3)
        sim.run(seconds=1.5)
        assert robot.joints["joint0"].velocity == pytest.approx(3.0, rel=0.05)
        robot.inputs["cmd_vel"].send(angular=1.0)
        sim.run(seconds=1.0)
        assert robot.joints["joint1"].velocity == pytest.approx(2.0, rel=0.15)
