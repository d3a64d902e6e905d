"""Plugins for touch, boxes and transporters."""

import numpy as np
import pytest
from models import block, plugin, simulate

from gazelle.errors import PluginWarning, SimulationError, SimulationWarning

SENSOR = """<sensor name="skin" type="contact"><contact><collision>hull</collision></contact>
</sensor>"""
TABLE = """<model name="table"><static>1</static><pose>0 0 0.1 0 0 0</pose><link name="l">
<collision name="c"><geometry><box><size>1 1 0.2</size></box></geometry></collision></link></model>"""
TOUCH = plugin(
    "libTouchPlugin.so", sensor="skin", target="table", time="0.3", namespace="t", enabled="true"
)


def test_a_touch_is_told_once_it_has_lasted():
    with simulate(block(SENSOR, TOUCH), TABLE, ground=False, nworld=2) as sim:
        robot = sim.robots["cube"]
        output, enable = robot.outputs["t touched"], robot.inputs["t enable"]
        assert (output.topic, enable.topic) == ("/t/touched", "/t/enable")
        told = []
        output.subscribe(lambda value: told.append((sim.time, value.values.tolist())))
        robot.set_pose((0.0, 0.0, 0.301), worlds=np.array([1]))
        sim.run(seconds=0.45)
        (first,) = told
        assert first[0] == pytest.approx(0.32, abs=0.05)
        assert first[1] == [False, True]
        state = sim.snapshot()
        sim.run(seconds=0.5)
        assert [values for _, values in told[1:]] == [[True, True]]
        sim.restore(state)
        sim.run(seconds=0.5)
        assert [values for _, values in told[2:]] == [[True, True]]
        sim.run(seconds=0.5)
        assert len(told) == 3
        enable.send(True, np.array([0]))
        sim.run(seconds=0.5)
        assert told[3][1] == [True, True]


def test_who_touches_something_else_too_is_not_counted():
    beside = TABLE.replace("table", "stool").replace("<pose>0 0", "<pose>0.6 0")
    narrow = TABLE.replace("1 1 0.2", "0.2 1 0.2")
    with simulate(
        block(SENSOR, TOUCH).replace("0.2 0.2 0.2", "1 0.2 0.2"), narrow, beside, ground=False
    ) as sim:
        told = []
        sim.robots["cube"].outputs["t touched"].subscribe(told.append)
        sim.run(seconds=1.0)
        assert told == []


def test_wrong_touches_are_refused():
    with pytest.raises(PluginWarning, match="<sensor>"):
        simulate(block(plugin=plugin("libTouchPlugin.so", target="a", time="1", namespace="n")))
    ray = """<sensor name="skin" type="ray"><ray><scan><horizontal><samples>1</samples>
    </horizontal></scan><range><min>0.1</min><max>1</max></range></ray></sensor>"""
    with pytest.raises(PluginWarning, match="not a contact sensor"):
        simulate(block(ray, TOUCH))


def contain(entity, pose="0 0 0 0 0 0", **tags):
    text = plugin("libContainPlugin.so", entity=entity, namespace="/n", pose=pose, **tags)
    box = "<geometry><box><size>1 2 0.2</size></box></geometry>"
    return text.replace("</plugin>", f"{box}</plugin>")


def test_a_box_tells_who_comes_and_goes():
    with simulate(block(), contain("cube::core", "0 0 0.1 0 0 1.5707963"), nworld=2) as sim:
        output = sim.ports.outputs["/n contain"]
        assert output.topic == "/n/contain"
        told = []
        output.subscribe(lambda value: told.append(value.values.tolist()))
        sim.run(seconds=0.1)
        assert told == [[False, False]]
        sim.run(seconds=0.5)
        assert told[1:] == [[True, True]]
        # The box is turned: 0.7 m off are within it along x, and beside it along y.
        sim.robots["cube"].set_pose((0.7, 0.0, 0.1), worlds=np.array([0]))
        sim.robots["cube"].set_pose((0.0, 0.7, 0.1), worlds=np.array([1]))
        sim.step(2)
        assert told[2:] == [[True, False]]
        sim.ports.inputs["/n enable"].send(False)
        sim.robots["cube"].set_pose((5.0, 0.0, 0.1))
        sim.step(2)
        assert len(told) == 3


def test_a_box_may_move_and_what_is_not_there_is_in_none():
    moving = contain("cube", "0 0 0.2 0 0 0").replace("<pose>", '<pose frame="table">')
    with simulate(block(), TABLE, moving) as sim:
        sim.run(seconds=0.6)
        assert sim.ports.outputs["/n contain"].last.values.all()
        sim.robots["table"].set_pose((3.0, 0.0, 0.1))
        assert not sim.ports.outputs["/n contain"].last.values.any()
    with simulate(contain("nobody")) as sim:
        assert not sim.ports.outputs["/n contain"].last.values.any()
    with pytest.raises(PluginWarning, match="<box>"):
        simulate(plugin("libContainPlugin.so", entity="a", namespace="n"))


PAD = """<pad name="{name}"><destination>{to}</destination><activation>{how}</activation><outgoing>
<min>{x} -0.5 0</min><max>{y} 0.5 1</max></outgoing><incoming><pose>{at} 0 0.2 0 0 1</pose>
</incoming></pad>"""


def pads(to="b"):
    first = PAD.format(name="a", to=to, how="manual", x=-0.5, y=0.5, at=2)
    second = PAD.format(name="b", to="a", how="auto", x=4.5, y=5.5, at=3)
    text = plugin("libTransporterPlugin.so", activation_topic="~/beam")
    return text.replace("</plugin>", f"{first}{second}</plugin>")


def test_pads_put_models_elsewhere_at_once_or_when_called():
    with simulate(block(), pads(), nworld=2) as sim:
        cube, call = sim.robots["cube"], sim.ports.inputs["~/beam"]
        assert call.topic == "/beam"
        sim.run(seconds=0.5)
        assert cube.position[:, 0] == pytest.approx(0.0, abs=1e-3)
        call.send("a", np.array([1]))
        sim.step(1)
        assert cube.position[:, 0] == pytest.approx([0.0, 3.0], abs=1e-3)
        assert cube.yaw[1] == pytest.approx(1.0, abs=1e-6)
        cube.set_pose((5.0, 0.0, 0.1), worlds=np.array([0]))
        sim.step(1)
        assert cube.position[0, 0] == pytest.approx(2.0, abs=1e-3)
        with pytest.raises(SimulationError, match="no pad 'c'"):
            call.send("c")


def test_pads_lead_somewhere():
    with pytest.raises(PluginWarning, match="no pad 'c'"):
        simulate(pads("c"))


ARM = """<model name="arm"><link name="l"><pose>0.5 0 1 0 0 0</pose><inertial><mass>2</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
<joint name="j" type="revolute"><parent>world</parent><child>l</child><pose>-0.5 0 0 0 0 0</pose>
<axis><xyz>0 1 0</xyz></axis></joint>{plugin}</model>"""


def test_compensated_joints_bear_the_weight():
    weightless = plugin("libGravityCompensationPlugin.so", uri="model://arm")
    with simulate(ARM.format(plugin=weightless), ground=False) as sim:
        sim.run(seconds=1.0)
        assert sim.robots["arm"].joints["j"].position == pytest.approx(0.0, abs=1e-9)
    with pytest.warns(SimulationWarning, match="not fixed"):
        simulate(block(plugin=weightless))


@pytest.mark.parametrize(
    ("filename", "text"),
    [
        ("libKeysToCmdVelPlugin.so", "keys"),
        ("libFlashLightPlugin.so", "lights"),
        ("libMudPlugin.so", "mud"),
        ("libPressurePlugin.so", "published"),
        ("libJointTrajectoryPlugin.so", "motion"),
        ("libVariableGearboxPlugin.so", "ratio"),
        ("libRubblePlugin.so", "left out"),
    ],
)
def test_what_is_not_simulated_says_so_once_of_models_and_worlds(filename, text):
    with pytest.warns(SimulationWarning, match=text) as told:
        simulate(block(plugin=plugin(filename))).close()
    assert len([w for w in told if w.category is SimulationWarning]) == 1
    with pytest.warns(SimulationWarning, match=text):
        simulate(plugin(filename)).close()
