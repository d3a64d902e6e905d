"""Links whose inertia is next to nothing, or that of no body, are simulated, with one warning."""

import numpy as np
import pytest

from gazelle import Simulation, formats
from gazelle.errors import EngineWarning, FormatWarning

URDF = """<robot name='rov'><link name='base'><inertial><mass value='10'/>
<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>{}</robot>"""
PART = """<link name='p{0}'><inertial><mass value='{1}'/><inertia ixx='{2}' iyy='{3}' izz='{4}'
ixy='0' ixz='0' iyz='0'/></inertial></link><joint name='j{0}' type='continuous'>
<parent link='base'/><child link='p{0}'/><origin xyz='{0} 0 0'/><axis xyz='0 0 1'/></joint>"""


def rov(*parts):
    inner = "".join(PART.format(n, *numbers) for n, numbers in enumerate(parts))
    return formats.load_string(URDF.format(inner), name="rov.urdf")


def test_thrusters_with_next_to_no_inertia_turn():
    model = rov(*[(0.001, 3.3e-16, 3.3e-16, 5e-16)] * 8)
    with pytest.warns(EngineWarning) as caught:
        sim = Simulation(model)
    with sim:
        sim.run(2.0)
        assert np.isfinite(sim.robots["rov"].position).all()
    said = [str(each.message) for each in caught]
    assert len(said) == 1
    assert "and 3 more have a moment of inertia below 1e-12 kg m²" in said[0]
    assert said[0].startswith("rov.urdf:")


@pytest.mark.parametrize(
    "numbers",
    [
        (0.08, 0.002, 0, 0),
        (1, 0, 0, 0),
        (1, 0, 1, 1),
        (0.5, -1, 2, 1),
        (1e-5, 0, 0, 0),
    ],
)
@pytest.mark.filterwarnings("ignore::gazelle.errors.EngineWarning")
def test_an_inertia_of_no_body_runs(numbers):
    with pytest.warns(FormatWarning, match="was taken"):
        model = rov(numbers)
    with Simulation(model) as sim:
        sim.run(2.0)
        assert np.isfinite(sim.robots["rov"].position).all()
        assert sim.robots["rov"].pose.z == pytest.approx(-9.81 * 2.0, rel=0.1)
