"""Vessels: what carries, resists and drives them, against formulas."""

from __future__ import annotations

import math

import numpy as np
import pytest
from models import plugin, simulate

import gazelle_ros as ros
from gazelle.bridges import plugin_conversions  # noqa: F401  it teaches the messages
from gazelle.bridges.conversions import decoder_of
from gazelle.plugins.usv_thrust import ThrustCurve
from gazelle.simulation.values import DriveCommand, Number

DYNAMICS = {
    "bodyName": "hull",
    "waterLevel": 0.0,
    "waterDensity": 997.8,
    "xDotU": 0.0,
    "yDotV": 0.0,
    "nDotR": 0.0,
    "xU": 51.3,
    "xUU": 72.4,
    "yV": 40.0,
    "zW": 500.0,
    "kP": 50.0,
    "mQ": 50.0,
    "nR": 400.0,
    "boatWidth": 2.4,
    "boatLength": 4.9,
    "length_n": 2,
}
THRUST = {"bodyName": "hull", "boatWidth": 2.4, "boatLength": 4.9, "thrustOffsetZ": -0.04}
LINK = """<link name="{name}"><pose>{pose}</pose><inertial><mass>{mass}</mass><inertia><ixx>120</ixx>
<iyy>393</iyy><izz>446</izz></inertia></inertial></link>"""


def vessel(dynamics=None, thrust="", links="", height=-0.08, **options):
    tags = "" if dynamics is None else plugin("libusv_gazebo_dynamics_plugin.so", **dynamics)
    text = f"""<model name="boat"><pose>0 0 {height} 0 0 0</pose>
    {LINK.format(name="hull", pose="0 0 0 0 0 0", mass=180)}{links}{tags}{thrust}</model>"""
    sim = simulate(text, ground=False, time_step=0.01, **options)
    return sim, sim.robots["boat"]


def pair(**tags):
    return plugin("libusv_gazebo_thrust_plugin.so", **{**THRUST, **tags})


def sunk(mass):
    """Return how deep half circles of two hulls sink under a mass [m], by halving."""
    radius, low, high = 0.213, 0.0, 0.213
    for _ in range(60):
        depth = 0.5 * (low + high)
        off = radius - depth
        area = radius**2 * math.acos(off / radius) - off * math.sqrt(radius**2 - off**2)
        low, high = (depth, high) if 2 * area * 4.9 * 997.8 * 9.815 < mass * 9.8 else (low, depth)
    return low


def test_it_floats_where_its_hulls_displace_its_weight():
    sim, robot = vessel(DYNAMICS)
    with sim:
        sim.run(2.0)
        assert robot.pose.z == pytest.approx(-sunk(180.0), abs=2e-3)


def test_it_rights_itself():
    sim, robot = vessel({**DYNAMICS, "kP": 500.0, "mQ": 1500.0})
    with sim:
        robot.set_pose((0.0, 0.0, -0.08), (0.03, 0.03, 0.0, 1.0))
        sim.run(2.5)
        assert np.abs(robot.placement().quaternion[0, :2]).max() < 0.003


def test_water_never_draws_it_down():
    sim, robot = vessel({**DYNAMICS, "zW": 0.0}, height=2.0)
    with sim:
        sim.run(0.5)
        assert robot.motion().linear[0, 2] == pytest.approx(-9.8 * 0.5, rel=0.01)


def test_it_is_held_back_in_proportion_and_by_the_square():
    sim, robot = vessel(DYNAMICS)
    with sim:
        robot.set_twist((2.0, 1.0, 0.0), (0.0, 0.0, 0.5))
        sim.step()
        linear, turning = robot.motion().linear[0], robot.motion().angular[0, 2]
        assert linear[0] == pytest.approx(2.0 - 0.01 * (51.3 + 72.4 * 2.0) * 2.0 / 180.0, abs=1e-4)
        assert linear[1] == pytest.approx(1.0 - 0.01 * 40.0 / 180.0, abs=1e-4)
        assert turning == pytest.approx(0.5 - 0.01 * 400.0 * 0.5 / 446.0, abs=1e-4)


def test_added_mass_makes_it_slower():
    def speed(added):
        tags = {**DYNAMICS, "xU": 0.0, "xUU": 0.0, "xDotU": added}
        sim, robot = vessel(tags, pair(maxForceFwd=90.0, cmdTimeout=0.0))
        with sim:
            robot.inputs["cmd_drive"].send(DriveCommand(1.0, 1.0))
            sim.run(1.0)
            return robot.motion().linear[0, 0]

    assert speed(0.0) == pytest.approx(1.0, rel=1e-3)
    assert speed(60.0) == pytest.approx(180.0 / 240.0, rel=0.02)


def test_full_ahead_it_reaches_the_speed_at_which_drag_is_thrust():
    sim, robot = vessel(DYNAMICS, pair(mappingType=1, maxForceFwd=250.0, cmdTimeout=0.0))
    with sim:
        robot.inputs["cmd_drive"].send(DriveCommand(1.0, 1.0))
        sim.run(4.0)
        thrust = 2.0 * ThrustCurve(logistic=True, most_command=1, ahead=250, astern=100).force(
            np.ones(1)
        )
        wanted = (-51.3 + math.sqrt(51.3**2 + 4.0 * 72.4 * thrust[0])) / (2.0 * 72.4)
        assert robot.motion().linear[0, 0] == pytest.approx(wanted, rel=0.01)


def test_the_curves_are_the_published_ones():
    linear = ThrustCurve(logistic=False, most_command=2.0, ahead=250.0, astern=100.0)
    given = np.array([-3.0, -1.0, 0.0, 1.0, 3.0])
    assert linear.force(given).tolist() == [-100.0, -50.0, 0.0, 125.0, 250.0]
    curve = ThrustCurve(logistic=True, most_command=1.0, ahead=250.0, astern=100.0)
    ahead = 0.01 + 59.81 / (0.56 + math.exp(-5.0 * (0.5 - 0.28))) ** (1.0 / 0.38)
    astern = -199.13 + 199.04 / (0.99 + math.exp(-8.84 * (-0.5 + 0.57))) ** (1.0 / 5.34)
    got = curve.force(np.array([0.5, -0.5, 0.0, -1.0]))
    assert got.tolist() == pytest.approx([ahead, astern, 0.0, -100.0])


def test_unequal_propellers_turn_it_by_its_width():
    sim, robot = vessel(None, pair(maxForceFwd=100.0), height=0.0)
    with sim:
        sim.physics.gravity = (0.0, 0.0, 0.0)
        robot.inputs["cmd_drive"].send(DriveCommand(-0.5, 0.5))
        sim.step(10)
        assert robot.motion().angular[0, 2] == pytest.approx(0.1 * 100.0 * 2.4 / 446.0, rel=1e-3)
        assert robot.motion().linear[0, 0] == pytest.approx(0.0, abs=1e-9)


def test_commands_run_out():
    sim, robot = vessel(None, pair(cmdTimeout=0.5), height=0.0, nworld=2)
    with sim:
        sim.physics.gravity = (0.0, 0.0, 0.0)
        robot.inputs["cmd_drive"].send(DriveCommand(1.0, 1.0), np.array([1]))
        sim.run(2.0)
        speed = robot.motion().linear[:, 0]
        assert speed[0] == 0.0
        assert speed[1] == pytest.approx(0.51 * 200.0 / 180.0, rel=0.03)


def test_propellers_of_their_own_push_along_their_links():
    thrusters = "".join(
        f"<thruster><linkName>{name}</linkName><cmdTopic>{name}_cmd</cmdTopic></thruster>"
        for name in ("port", "starboard")
    )
    links = "".join(
        LINK.format(name=name, pose=f"-2 {y} 0 0 0 0", mass=10)
        + f"""<joint name="{name}_joint" type="fixed"><parent>hull</parent><child>{name}</child>
        </joint>"""
        for name, y in (("port", 1.0), ("starboard", -1.0))
    )
    text = f"""<plugin name="p" filename="libusv_gazebo_thrust_plugin.so">{thrusters}</plugin>"""
    sim, robot = vessel(None, text, links, height=0.0)
    with sim:
        sim.physics.gravity = (0.0, 0.0, 0.0)
        assert robot.inputs["port_cmd"].topic == "/port_cmd"
        robot.inputs["starboard_cmd"].send(Number(1.0))
        sim.run(0.2)
        assert robot.motion().linear[0, 0] > 0.1
        assert robot.motion().angular[0, 2] > 0.01


def test_commands_are_the_messages_of_openai_ros():
    decoder = decoder_of(DriveCommand)
    message = ros.load_message(decoder.message)
    assert (decoder.message, message.__slots__) == ("usv_msgs/UsvDrive", ["left", "right"])
    assert decoder.read(message(left=0.25, right=-1.0)) == DriveCommand(0.25, -1.0)


def test_a_snapshot_goes_on_alike():
    sim, robot = vessel(DYNAMICS, pair())
    with sim:
        robot.inputs["cmd_drive"].send(DriveCommand(1.0, 0.5))
        sim.run(0.3)
        kept = sim.snapshot()
        sim.run(0.5)
        after = robot.placement().position
        sim.restore(kept)
        sim.run(0.5)
        np.testing.assert_array_equal(robot.placement().position, after)
