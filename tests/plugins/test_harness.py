"""Harnesses: what hangs, is wound up and down, and is let go."""

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle import formats
from gazelle.errors import PluginWarning
from gazelle.simulation.values import Number

GRAVITY = 9.8
STRENGTH, DAMPING = 400.0, 10.0
PID = f"""<p>{STRENGTH}</p><cmd_max>10000</cmd_max>"""
JOINT = """<joint name="rope" type="prismatic"><pose>0 0 0.5 0 0 0</pose><parent>world</parent>
<child>core</child><axis><xyz>0 0 1</xyz><dynamics><damping>{damping}</damping></dynamics><limit>
<lower>-2</lower><upper>3</upper><effort>10000</effort></limit></axis></joint>"""
WINCH = f"""<winch><joint>rope</joint><pos_pid>{PID}<cmd_min>-10000</cmd_min></pos_pid>
<vel_pid>{PID}<cmd_min>0</cmd_min></vel_pid></winch><detach>rope</detach>"""


ROPE = JOINT.format(damping=DAMPING)


def harness(joint=ROPE, rest=WINCH, **tags):
    text = plugin("libgazebo_ros_harness.so", **tags)
    return block(plugin=text.replace("</plugin>", f"{joint}{rest}</plugin>"))


@pytest.mark.long
def test_a_model_hangs_where_the_winch_bears_its_weight():
    with simulate(harness(), nworld=2) as sim:
        robot = sim.robots["cube"]
        ports = robot.inputs["harness_velocity"], robot.inputs["harness_detach"]
        assert [p.topic for p in ports] == ["/cube/harness/velocity", "/cube/harness/detach"]
        sim.run(seconds=6.0)
        # The controller of the place is a spring: it gives by the weight over its stiffness.
        assert robot.position[:, 2] == pytest.approx(0.5 - GRAVITY / STRENGTH, abs=2e-3)
        assert robot.position[:, :2] == pytest.approx(0.0, abs=1e-3)


@pytest.mark.long
def test_a_winch_pays_out_at_its_speed_and_stops_where_it_is():
    with simulate(harness(), nworld=2) as sim:
        robot = sim.robots["cube"]
        sim.run(seconds=1.0)
        robot.inputs["harness_velocity"].send(Number(0.5), np.array([1]))
        sim.run(seconds=1.0)
        start = robot.position[:, 2].copy()
        sim.run(seconds=1.0)
        # Its weight and the friction of the rope slow it by their force over the gain.
        slower = (GRAVITY + DAMPING * 0.5) / (STRENGTH + DAMPING)
        assert robot.position[1, 2] - start[1] == pytest.approx(0.5 - slower, abs=0.01)
        assert robot.position[0, 2] == pytest.approx(start[0], abs=5e-3)
        robot.inputs["harness_velocity"].send(Number(0.0))
        stopped = robot.position[1, 2]
        sim.run(seconds=3.0)
        assert robot.position[1, 2] == pytest.approx(stopped - GRAVITY / STRENGTH, abs=0.01)


@pytest.mark.long
def test_what_is_let_go_falls_in_its_world_and_hangs_again_after_a_reset():
    with simulate(harness(), nworld=2) as sim:
        robot = sim.robots["cube"]
        sim.run(seconds=0.5)
        state = sim.snapshot()
        robot.inputs["harness_detach"].send(False)
        robot.inputs["harness_detach"].send(True, np.array([1]))
        sim.run(seconds=1.0)
        assert robot.position[1, 2] == pytest.approx(0.1, abs=0.01)
        assert robot.position[0, 2] > 0.4
        robot.set_pose((0.0, 2.0, 0.1), worlds=np.array([1]))
        sim.run(seconds=0.1)
        assert robot.position[1, 1] == pytest.approx(2.0, abs=1e-3)
        sim.restore(state)
        sim.run(seconds=1.0)
        assert robot.position[:, 2] == pytest.approx(0.48, abs=0.02)
        robot.inputs["harness_detach"].send(True)
        sim.run(seconds=0.5)
        sim.reset()
        sim.run(seconds=1.0)
        assert robot.position[:, 2] == pytest.approx(0.48, abs=0.02)


def test_a_harness_goes_with_its_model():
    with simulate(harness()) as sim:
        sim.delete("cube")
        assert [model.name for model in sim.world.models] == ["ground_plane"]
        sim.step(3)


def test_without_a_winch_it_only_holds():
    joint = JOINT.format(damping=0).replace("prismatic", "ball")
    with simulate(harness(joint, "")) as sim:
        robot = sim.robots["cube"]
        robot.links["core"].apply_wrench((1.0, 0.0, 0.0), duration=0.1)
        sim.run(seconds=1.0)
        hook = robot.position[0] + np.array([0.0, 0.0, 0.5])
        assert robot.position[0, 2] > 0.48
        assert hook[2] == pytest.approx(1.0, abs=0.02)


def test_wrong_harnesses_are_refused():
    with pytest.raises(PluginWarning, match="<joint>"):
        simulate(harness(""))
    with pytest.raises(PluginWarning, match="must be attached to the world"):
        simulate(harness(JOINT.format(damping=1).replace("world", "core")))
    wrong = harness(rest=WINCH.replace("<detach>rope", "<detach>robe"))
    with simulate() as sim:
        for _ in range(2):  # nothing is left of it
            with pytest.raises(PluginWarning, match="no joint 'robe'"):
                sim.spawn(formats.load_model_string(f'<sdf version="1.6">{wrong}</sdf>'))
        assert [model.name for model in sim.world.models] == ["ground_plane"]
