"""Lumped links and sensors in named frames: as libsdformat has them."""

import math
import xml.etree.ElementTree as ET

import libsdformat
import numpy as np
import pytest
from xml_samples import INERTIAL, link, robot

from gazelle import formats
from gazelle.description import Pose
from gazelle.errors import FormatWarning

FIXED = "<joint name='f' type='fixed'><parent link='a'/><child link='b'/><origin {}/></joint>"
FREE = (
    f"<link name='c'>{INERTIAL}</link><joint name='k' type='continuous'><parent link='a'/>"
    "<child link='c'/><origin xyz='0 2 0' rpy='0 0 0.5'/></joint>"
)
MASSLESS = (
    "<inertial><origin xyz='0 0 1' rpy='0.1 0 0.5'/><mass value='{}'/>"
    "<inertia ixx='0.5' iyy='0.25' izz='0.125' ixy='0.01' ixz='0' iyz='0'/></inertial>"
)


def lumped(mass, origin="xyz='1 0 0' rpy='0 0 0.3'"):
    return robot(
        f"<link name='a'>{INERTIAL}</link><link name='b'>{MASSLESS.format(mass)}</link>"
        + FIXED.format(origin)
    )


@pytest.mark.parametrize("mass", [0, 0.5])
@pytest.mark.parametrize("origin", ["xyz='1 0 0' rpy='0 0 0.3'", "xyz='0 -1 2' rpy='1 0.2 0'"])
def test_a_lumped_link_gives_its_inertia_with_and_without_a_mass(mass, origin, tmp_path):
    file = tmp_path / "r.urdf"
    file.write_text(lumped(mass, origin))
    inertial = ET.fromstring(libsdformat.printed(file)).find("model/link/inertial")
    names = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")
    expected = [float(inertial.findtext(f"inertia/{name}")) for name in names]
    found = formats.load_model(file).links[0].inertial
    assert [getattr(found.inertia, name) for name in names] == pytest.approx(expected, abs=1e-9)
    assert found.mass == float(inertial.findtext("mass"))
    place = [float(number) for number in inertial.findtext("pose").split()]
    assert found.pose.position == pytest.approx(place[:3], abs=1e-9)


def test_a_body_without_any_mass_still_has_no_inertial():
    text = lumped(0).replace("<mass value='1'/>", "<mass value='0'/>")
    with pytest.warns(FormatWarning):
        assert formats.load_model_string(text).links[0].inertial is None


def test_a_sensor_in_a_named_frame():
    text = robot(
        f"<link name='a'>{INERTIAL}</link><link name='b'>{INERTIAL}</link>"
        + FIXED.format("xyz='1 0 0' rpy='0 0 0.3'")
        + FREE
        + "<gazebo reference='b'><sensor name='s' type='imu'>"
        "<pose relative_to='c'>0 0 1 0 0 0</pose></sensor></gazebo>"
        "<gazebo reference='c'><sensor name='t' type='imu'>"
        "<pose relative_to='a'>0 0 2 0 0 0</pose></sensor>"
        "<sensor name='u' type='imu'><pose relative_to='k'>0 0 3 0 0 0</pose></sensor></gazebo>"
    )
    found = formats.load_model_string(text)
    (sensor,) = link(found, "a").sensors
    assert sensor.pose.is_close(Pose(0, 2, 1, yaw=0.5))
    one, other = link(found, "c").sensors
    back = Pose(0, 2, 0, yaw=0.5).inverse() * Pose(z=2)
    np.testing.assert_allclose(one.pose.position, back.position, atol=1e-12)
    assert math.isclose(one.pose.yaw, -0.5)
    assert other.pose.is_close(Pose(z=3))


def test_a_sensor_in_a_frame_that_is_not_there_is_in_its_link():
    text = robot(
        f"<link name='a'>{INERTIAL}</link><gazebo reference='a'><sensor name='s' type='imu'>"
        "<pose relative_to='aa'>0 0 1 0 0 0</pose></sensor></gazebo>"
    )
    with pytest.warns(FormatWarning, match="there is no frame 'aa'.*did you mean 'a'"):
        found = formats.load_model_string(text)
    assert found.links[0].sensors[0].pose.position == (0, 0, 1)
