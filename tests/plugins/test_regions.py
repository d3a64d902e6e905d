"""Regions that call a lift."""

import numpy as np
import pytest
from models import block, simulate

from gazelle.errors import PluginWarning, SimulationWarning

LIFT = """<model name="lift"><pose>5 0 0 0 0 0</pose><link name="car"><inertial><mass>500</mass>
</inertial></link><link name="door"><gravity>0</gravity><inertial><mass>5</mass></inertial></link>
<joint name="up" type="prismatic"><parent>world</parent><child>car</child><axis><xyz>0 0 1</xyz>
<limit><lower>0</lower><upper>9</upper></limit></axis></joint>
<joint name="side" type="prismatic"><parent>car</parent><child>door</child><axis><xyz>0 1 0</xyz>
<limit><lower>0</lower><upper>1</upper></limit></axis></joint>
<plugin name="p" filename="libElevatorPlugin.so"><lift_joint>lift::up</lift_joint>
<door_joint>lift::side</door_joint><topic>~/elevator</topic></plugin></model>"""
EVENTS = """<plugin name="e" filename="libSimEventsPlugin.so"><region><name>r</name><volume>
<min>1.5 -1 0</min><max>2.5 1 1</max></volume></region><event><name>a</name><type>{kind}</type>
<region>{region}</region><topic>~/elevator</topic><msg_data>1</msg_data></event></plugin>"""


@pytest.mark.long
def test_a_lift_comes_where_somebody_waits():
    with simulate(LIFT, block(), EVENTS.format(kind="occupied", region="r"), nworld=2) as sim:
        sim.run(seconds=0.5)
        sim.robots["cube"].set_pose((2.0, 0.0, 0.1), worlds=np.array([1]))
        sim.run(seconds=3.0)
        height = sim.robots["lift"].joints["up"].positions()[:, 0]
        assert height == pytest.approx([0.0, 3.0], abs=0.16)


def test_what_a_region_cannot_tell_is_said():
    with pytest.warns(SimulationWarning, match="'sim_state'"):
        simulate(EVENTS.format(kind="sim_state", region="r")).close()
    with pytest.raises(PluginWarning, match="no region 'q'"):
        simulate(EVENTS.format(kind="occupied", region="q"))
