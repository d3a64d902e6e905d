"""Links whose inertia is next to nothing, or that of no body, are simulated, with one warning."""

import mujoco
import numpy as np
import pytest

from gazelle import Simulation, formats
from gazelle.engines.mujoco.compiler.mjcf import to_mjcf
from gazelle.errors import EngineWarning, FormatWarning

URDF = """<robot name='rov'><link name='base'><inertial><mass value='10'/>
<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>{}</robot>"""
SDF = "<sdf version='1.6'><world name='w'>{}</world></sdf>"
INERTIA = """<inertial><mass>{}</mass><inertia><ixx>{}</ixx><iyy>{}</iyy><izz>{}</izz></inertia>
</inertial>"""
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
        sim.run(1.0)
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
        sim.run(1.0)
        assert np.isfinite(sim.robots["rov"].position).all()
        assert sim.robots["rov"].pose.z == pytest.approx(-4.9, rel=0.1)


@pytest.mark.parametrize("moments", [(0.002, 0.003, 0.9), (0.5, 0.001, 0.002), (1.0, 1.0, 2.5)])
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_an_inertia_that_breaks_the_triangle_inequality_is_simulated_as_written(moments):
    """As ODE does: each axis answers to a torque by its own moment, of loose bodies and on joints."""
    torque = 0.01
    text = INERTIA.format(1.0, *moments)
    for axis, moment in enumerate(moments):
        along = np.eye(3)[axis]
        words = " ".join(map(str, along))
        loose = f"<model name='m'><link name='l'><gravity>0</gravity>{text}</link></model>"
        with Simulation(formats.load_string(SDF.format(loose))) as sim:
            sim.robots["m"].links["l"].apply_wrench((0, 0, 0), torque * along, duration=0.1)
            sim.run(0.1)
            spun = sim.robots["m"].links["l"].motion().angular[0]
            assert spun == pytest.approx(torque * 0.1 / moment * along, rel=1e-3, abs=1e-9)
        held = f"""<model name='m'><link name='b'/><link name='l'><gravity>0</gravity>{text}</link>
        <joint name='f' type='fixed'><parent>world</parent><child>b</child></joint>
        <joint name='j' type='revolute'><parent>b</parent><child>l</child><axis><xyz>{words}</xyz>
        </axis></joint></model>"""
        with Simulation(formats.load_string(SDF.format(held))) as sim:
            sim.robots["m"].joints["j"].effort = torque
            sim.run(0.1)
            turned = sim.robots["m"].joints["j"].velocity
            assert turned == pytest.approx(torque * 0.1 / moment, rel=1e-3)


@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_mjcf_of_such_an_inertia_can_be_read_by_mujoco():
    text = INERTIA.format(1.0, 0.1, 0.1, 1.0)
    world = formats.load_string(SDF.format(f"<model name='m'><link name='l'>{text}</link></model>"))
    model = mujoco.MjModel.from_xml_string(to_mjcf(world))
    moments = sorted(model.body_inertia[1])
    assert moments == pytest.approx([0.5, 0.5, 1.0], rel=1e-6)
