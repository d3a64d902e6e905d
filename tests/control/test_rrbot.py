"""RRBot's joints answer a step as its equations of motion say."""

from __future__ import annotations

import math

import numpy as np
import pytest
import xacro
import yaml
from lxml import etree
from scipy.integrate import solve_ivp

import gazelle
from gazelle import assets, formats
from gazelle.control.values import JointTarget
from gazelle.description import Physics, World

# Of gazebo_ros_demos: mass [kg] and moment [kg m2] of a beam, its centre of mass and the next
# axis from its own axis [m], damping [N m s].
MASS, MOMENT, CENTRE, NEXT, DAMPING = 1.0, (0.1**2 + 1.0) / 12, 0.45, 0.9, 0.7
GRAVITY = 9.8  # a world's, without a word of its own
P, D = 100.0, 10.0
PERIOD = 0.001
JOINTS = ("joint1", "joint2")


def rrbot(stiff=False, physics_step=PERIOD):
    """Return RRBot in an empty world, with the controllers of its package running.

    Args:
        stiff: The second joint is welded.
        physics_step: [s]; the controllers look every millisecond all the same.
    """
    urdf = etree.fromstring(xacro.process_file(str(assets.robot("rrbot"))).toxml().encode())
    if stiff:
        urdf.find("joint[@name='joint2']").set("type", "fixed")
        urdf.remove(urdf.find("transmission[@name='tran2']"))
    plugin = urdf.find("gazebo/plugin[@filename='libgazebo_ros_control.so']")
    etree.SubElement(plugin, "controlPeriod").text = str(PERIOD)
    profile = Physics("default", max_step_size=physics_step)
    sim = gazelle.Simulation(World("w", physics=(profile,)))
    robot = sim.spawn(formats.load_model_string(etree.tostring(urdf, encoding="unicode")))
    file = assets.root() / "rrbot_control" / "config" / "rrbot_control.yaml"
    controllers = yaml.safe_load(file.read_text(encoding="utf-8"))["rrbot"]
    for name, parameters in controllers.items():
        if parameters.get("joint", "joint1") in robot.joints:
            robot.controllers.load(name, parameters)
            robot.controllers.start(name)
    sim.run(2 * PERIOD)
    return sim, robot


def answer(sim, robot, targets, seconds):
    """Return times after the step and positions of the joints, one row a period."""
    for name, target in targets.items():
        command = robot.controllers[f"{name}_position_controller"].inputs["command"]
        command.send(JointTarget(target))
    start, found = sim.time, []
    for _ in range(round(seconds / PERIOD)):
        sim.run(PERIOD)
        found.append([sim.time - start, *(robot.joints[name].position for name in targets)])
    time, *positions = np.array(found).T
    return time, np.array(positions)


def features(time, position, final):
    """Return the time from 10 % to 90 % of the final value, and the relative overshoot."""
    part = position / final
    rising = slice(0, part.argmax())
    low, high = (np.interp(level, part[rising], time[rising]) for level in (0.1, 0.9))
    return high - low, part.max() - 1.0


def test_with_the_elbow_stiff_a_step_is_that_of_the_closed_form():
    """J x'' + (d + c) x' + (p - m g l) x = d r' + p r, near the top; the kick of d r' is d r / J."""
    sim, robot = rrbot(stiff=True)
    step = 0.02
    time, (found,) = answer(sim, robot, {"joint1": step}, 3.0)
    inertia = 2 * MOMENT + MASS * (CENTRE**2 + (NEXT + CENTRE) ** 2)
    spring = P - MASS * GRAVITY * (CENTRE + NEXT + CENTRE)
    fall = (D + DAMPING) / (2 * inertia)
    turn = math.sqrt(spring / inertia - fall**2)
    final = P * step / spring
    sine = (D * step / inertia - fall * final) / turn
    wanted = final - np.exp(-fall * time) * (
        final * np.cos(turn * time) - sine * np.sin(turn * time)
    )
    rise, overshoot = features(time, found, final)
    rise_wanted, overshoot_wanted = features(time, wanted, final)
    assert rise == pytest.approx(rise_wanted, rel=0.02)
    assert overshoot == pytest.approx(overshoot_wanted, rel=0.02)
    assert np.abs(found - wanted).max() < 0.01 * final


def mass_matrix(q):
    """Return the mass matrix of two beams, in joint angles."""
    coupling = MASS * NEXT * CENTRE * math.cos(q[1])
    own = MOMENT + MASS * CENTRE**2
    return np.array(
        [[2 * own + MASS * NEXT**2 + 2 * coupling, own + coupling], [own + coupling, own]]
    )


def rates(_time, state, torque):
    """Return rates of angles and speeds of an upside-down double pendulum (Lagrange)."""
    q, v = state[:2], state[2:]
    swirl = MASS * NEXT * CENTRE * math.sin(q[1])
    outer = MASS * GRAVITY * CENTRE * math.sin(q[0] + q[1])
    inner = MASS * GRAVITY * (CENTRE + NEXT) * math.sin(q[0])
    own = [swirl * v[1] * (2 * v[0] + v[1]) + inner + outer, -swirl * v[0] ** 2 + outer]
    return np.concatenate([v, np.linalg.solve(mass_matrix(q), torque - DAMPING * v + own)])


def sampled(targets, seconds):
    """Return angles after every period, under PD laws with a period of a millisecond."""
    state, before, found = np.zeros(4), np.zeros(2), []
    for _ in range(round(seconds / PERIOD)):
        error = targets - state[:2]
        torque = P * error + D * (error - before) / PERIOD
        before = error
        state = solve_ivp(rates, (0.0, PERIOD), state, "RK45", args=(torque,), rtol=1e-7).y[:, -1]
        found.append(state[:2])
    return np.array(found).T


@pytest.mark.parametrize(
    ("step", "physics_step"),
    [
        ((0.3, 0.0), 1e-3),
        ((0.1, 0.1), 1e-3),
        ((-0.5, -0.5), 1e-3),
        # Blows that throw the elbow at 30 rad/s and more: steps of 1 ms are too coarse for them.
        ((0.0, 0.5), 1e-4),
        ((0.8, -0.6), 1e-4),
        ((-0.4, 1.2), 1e-4),
    ],
)
def test_both_joints_move_as_the_equations_of_two_beams_say(step, physics_step):
    sim, robot = rrbot(physics_step=physics_step)
    time, found = answer(sim, robot, dict(zip(JOINTS, step, strict=True)), 0.8)
    wanted = sampled(np.array(step), 0.8)
    assert np.abs(found - wanted)[:, time > 0.05].max() < 0.01 * np.abs(step).max()
    for moved in np.flatnonzero(step):
        rise, overshoot = features(time, found[moved], step[moved])
        rise_wanted, overshoot_wanted = features(time, wanted[moved], step[moved])
        assert rise == pytest.approx(rise_wanted, rel=0.02)
        assert overshoot == pytest.approx(overshoot_wanted, rel=0.02)
