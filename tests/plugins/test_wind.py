"""The wind of a file, from its text to what it moves."""

import math
import warnings

import pytest

from gazelle.errors import SimulationWarning
from gazelle.formats import load_string
from gazelle.plugins.wind import Wind
from gazelle.simulation import Simulation, register

WORLD = """<sdf version="1.6"><world name="w"><gravity>0 0 0</gravity>
<wind><linear_velocity>2 0 0</linear_velocity></wind>
<plugin name="wind" filename="libWindPlugin.so">
  <force_approximation_scaling_factor>0.5</force_approximation_scaling_factor>{more}</plugin>
<model name="leaf"><enable_wind>true</enable_wind><link name="link"><inertial><mass>3</mass>
</inertial></link></model>
<model name="stone"><link name="link"><inertial><mass>3</mass></inertial></link></model>
</world></sdf>"""


@pytest.fixture(autouse=True)
def known():
    register("libWindPlugin.so", Wind)


def test_a_file_with_wind_blows_what_it_enables():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        sim = Simulation(load_string(WORLD.format(more="")))
    with sim:
        sim.run(seconds=1.0)
        expected = 2.0 * (1.0 - math.exp(-0.5))
        assert sim.robots["leaf"].twist.linear[0] == pytest.approx(expected, rel=1e-3)
        assert sim.robots["stone"].twist.linear[0] == 0.0


def test_gusts_are_said_to_be_left_out():
    more = "<horizontal><magnitude><time_for_rise>10</time_for_rise></magnitude></horizontal>"
    with pytest.warns(
        SimulationWarning, match=r"^string:\d+: the wind.*<horizontal> of WindPlugin.*is left out"
    ):
        Simulation(load_string(WORLD.format(more=more))).close()
