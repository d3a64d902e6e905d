"""Wheels that slip in proportion to the force on them."""

import numpy as np
import pytest
from models import base, plugin, simulate

from gazelle.errors import PluginWarning

MASS, GRAVITY, RADIUS, FORCE = 6.0, 9.8, 0.1, 2.0
CARRIED = MASS * GRAVITY / 4.0
SPEEDS = np.array([5.0, 10.0])
LATERAL, LONGITUDINAL = (
    f"slip_compliance_unitless_{direction}" for direction in ("lateral", "longitudinal")
)


def wheels(lateral=0.0, longitudinal=0.0, force=CARRIED, count=4, **tags):
    each = "".join(
        f"""<wheel link_name="wheel{i}"><slip_compliance_lateral>{lateral}
        </slip_compliance_lateral><slip_compliance_longitudinal>{longitudinal}
        </slip_compliance_longitudinal><wheel_normal_force>{force}</wheel_normal_force></wheel>"""
        for i in range(count)
    )
    return plugin("libgazebo_ros_wheel_slip.so", **tags).replace("</plugin>", f"{each}</plugin>")


def driving(model):
    """Return two worlds in which a base drives at two speeds, whatever pushes it."""
    sim = simulate(model, nworld=2)
    for i in range(4):
        sim.engine.add_motor(f"base::joint{i}", 50.0)
        sim.engine.joints[f"base::joint{i}"].set_motor_velocity(SPEEDS)
    sim.run(seconds=0.5)
    return sim


def expected(compliance):
    """Return v = compliance * |w r| * F / N, the force shared by four wheels."""
    return compliance * SPEEDS * RADIUS * (FORCE / 4.0) / CARRIED


def along_and_aside(robot):
    """Return velocities along the robot's heading and to its left, shape (2,) each."""
    motion, yaw = robot.motion().linear, robot.yaw
    ahead = motion[:, 0] * np.cos(yaw) + motion[:, 1] * np.sin(yaw)
    return ahead, motion[:, 1] * np.cos(yaw) - motion[:, 0] * np.sin(yaw)


@pytest.mark.long
@pytest.mark.parametrize("compliance", [0.0, 0.2, 1.0])
def test_a_wheel_that_is_pulled_along_its_axle_slips_by_the_force(compliance):
    with driving(base(wheels(lateral=compliance))) as sim:
        robot = sim.robots["base"]
        robot.links["body"].apply_wrench((0.0, FORCE, 0.0))
        sim.run(seconds=1.0)
        ahead, aside = along_and_aside(robot)
        assert aside == pytest.approx(expected(compliance), abs=3e-4)
        assert ahead == pytest.approx(SPEEDS * RADIUS, abs=1e-3)


@pytest.mark.long
def test_a_wheel_that_is_braked_slips_along_its_way():
    with driving(base(wheels(longitudinal=1.0))) as sim:
        robot = sim.robots["base"]
        robot.links["body"].apply_wrench((-FORCE, 0.0, 0.0))
        sim.run(seconds=1.0)
        ahead, aside = along_and_aside(robot)
        assert ahead == pytest.approx(SPEEDS * RADIUS - expected(1.0), abs=1e-3)
        assert aside == pytest.approx(0.0, abs=1e-4)


@pytest.mark.long
def test_slip_ends_where_friction_does_and_wheels_that_stand_do_not_slip():
    with simulate(base(wheels(lateral=1.0), mu=0.3)) as sim:
        robot = sim.robots["base"]
        robot.links["body"].apply_wrench((0.0, 0.2 * MASS * GRAVITY, 0.0))
        sim.run(seconds=1.0)
        assert abs(robot.position[0, 1]) < 2e-3
        robot.links["body"].clear_wrenches()
        robot.links["body"].apply_wrench((0.0, 0.5 * MASS * GRAVITY, 0.0))
        sim.run(seconds=0.5)
        slid = robot.position[0, 1]
        sim.run(seconds=0.5)
        # Sliding, at a rate of 0.2 g.
        assert robot.position[0, 1] - slid == pytest.approx(0.1 * GRAVITY * 0.75, rel=0.1)


@pytest.mark.long
def test_compliances_are_tuned_while_it_runs():
    with driving(base(wheels(robotNamespace="front"))) as sim:
        robot = sim.robots["base"]
        (tuning,) = robot.tunings.values()
        assert tuning.topic == "/base/front"
        assert tuning.values == {LATERAL: -1.0, LONGITUDINAL: -1.0}
        robot.links["body"].apply_wrench((0.0, FORCE, 0.0))
        assert tuning.send(**{LATERAL: 0.5, LONGITUDINAL: -3.0}) == {
            LATERAL: 0.5,
            LONGITUDINAL: -1.0,
        }
        sim.run(seconds=1.0)
        assert along_and_aside(robot)[1] == pytest.approx(expected(0.5), abs=3e-4)
        state = sim.snapshot()
        tuning.send(**{LATERAL: 0.0})
        sim.run(seconds=0.5)
        assert along_and_aside(robot)[1] == pytest.approx(0.0, abs=3e-4)
        sim.restore(state)
        sim.run(seconds=0.5)
        assert along_and_aside(robot)[1] == pytest.approx(expected(0.5), abs=3e-4)


@pytest.mark.long
def test_slipping_wheels_go_and_come_with_their_model():
    with driving(base(wheels(lateral=1.0))) as sim:
        sim.delete("base")
        sim.step(2)
        assert sim.engine.parameter("gravity", "")[0, 2] == -GRAVITY


def test_wheels_that_cannot_slip_are_refused():
    with pytest.raises(PluginWarning, match="wheel_normal_force"):
        simulate(base(wheels(force=0)))
    with pytest.raises(PluginWarning, match="<wheel>"):
        simulate(base(wheels(count=0)))
    with pytest.raises(PluginWarning, match="must not be negative"):
        simulate(base(wheels(lateral=-1)))
    with pytest.raises(PluginWarning, match="one parent joint"):
        simulate(base(wheels(count=1).replace("wheel0", "body")))
    box = base(wheels(count=1)).replace(
        "<cylinder><radius>0.1</radius>\n            <length>0.04</length></cylinder>",
        "<box><size>1 1 1</size></box>",
    )
    with pytest.raises(PluginWarning, match="wheel_radius"):
        simulate(box)
