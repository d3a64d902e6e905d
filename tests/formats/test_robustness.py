"""Whatever a file holds, loading it ends soon, in a result or in one of our errors."""

import contextlib
import random
import warnings

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from xml_samples import INERTIAL, robot, sdf, urdf_joint, urdf_link

from gazelle import Error, formats

SDF = sdf(
    "<world name='w'><physics type='ode'><max_step_size>.001</max_step_size></physics>"
    "<include><uri>model://sun</uri><pose>0 0 1 0 0 0</pose></include>"
    "<model name='m'><pose>1 2 3 0 0 0</pose><link name='a'><inertial><mass>1</mass>"
    "<inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>"
    "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>"
    "<sensor name='s' type='ray'><ray><range><min>0</min><max>5</max></range></ray></sensor>"
    "</link><link name='b'><pose relative_to='a'>0 0 1 0 0 0</pose></link>"
    "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
    "<limit><lower>-1</lower><upper>1</upper></limit></axis></joint></model>"
    "<state world_name='w'><model name='m'><pose>0 0 0 0 0 0</pose></model></state></world>"
)
URDF = robot(
    urdf_link("a")
    + urdf_link("b", f"{INERTIAL}<visual><geometry><box size='1 1 1'/></geometry></visual>")
    + urdf_link("c")
    + urdf_joint("j", "a", "b")
    + urdf_joint("k", "b", "c", "revolute", "<limit lower='0' upper='1' effort='1' velocity='1'/>")
    + "<gazebo reference='b'><mu1>1</mu1><sensor name='s' type='imu'/></gazebo>"
)
XACRO = URDF.replace(
    "<robot name='r'>",
    "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>"
    "<xacro:macro name='m' params='x'><link name='${x}'/></xacro:macro>",
)
EVIL = ["nan", "inf", "-1", "0", "1e308", "-1e308", "", " ", "a", "1 2", "${1/0}", "\u00e9", "::"]


def survives(text):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        with contextlib.suppress(Error):
            formats.load_string(text)


@settings(max_examples=150, deadline=5000, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from([SDF, URDF, XACRO]), st.integers(0, 2**32), st.integers(1, 8))
def test_flipped_bytes(text, seed, count):
    data = bytearray(text.encode())
    chance = random.Random(seed)
    for _ in range(count):
        data[chance.randrange(len(data))] = chance.randrange(256)
    survives(bytes(data))


@pytest.mark.long
@settings(max_examples=300, deadline=5000, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from([SDF, URDF, XACRO]), st.integers(0, 2**32), st.sampled_from(EVIL))
def test_values_replaced(text, seed, value):
    chance = random.Random(seed)
    marks = [i for i, c in enumerate(text) if c in ">'"]
    start = chance.choice(marks) + 1
    ends = [i for i in range(start, len(text)) if text[i] in "<'"]
    survives(text[:start] + value + text[ends[0] :] if ends else text[:start])


@settings(max_examples=100, deadline=5000, suppress_health_check=[HealthCheck.too_slow])
@given(st.sampled_from([SDF, URDF, XACRO]), st.data())
def test_pieces_moved(text, data):
    parts = text.replace("><", ">\0<").split("\0")
    order = data.draw(st.permutations(range(len(parts))))
    kept = data.draw(st.integers(0, len(parts)))
    survives("".join(parts[i] for i in sorted(order[:kept]) + order[kept:]))


@pytest.mark.parametrize(
    "text",
    [
        sdf("<model name='m'>" * 300 + "</model>" * 300),
        sdf("<model name='m'>" * 200 + "<link name='l'/>" + "</model>" * 200),
        robot(
            "".join(urdf_link(f"l{i}") for i in range(1500))
            + "".join(urdf_joint(f"j{i}", f"l{i}", f"l{i + 1}") for i in range(1499))
        ),
        sdf(
            "<model name='m'>"
            + "".join(
                f"<link name='l{i}'><pose relative_to='l{i + 1}'/></link>" for i in range(3000)
            )
            + "<link name='l3000'/></model>"
        ),
        sdf(
            "<model name='m'><link name='a'/>"
            + "".join(f"<frame name='f{i}' attached_to='f{i + 1}'/>" for i in range(3000))
            + "<frame name='f3000' attached_to='a'/></model>"
        ),
        (
            "<robot name='r' xmlns:xacro='x'><xacro:macro name='m' params=''><xacro:m/></xacro:macro>"
            "<xacro:m/></robot>"
        ),
        (
            "<robot name='r' xmlns:xacro='x'><xacro:property name='a' value='${a}'/>"
            "<link name='${a}'/></robot>"
        ),
    ],
    ids=["deep", "deep models", "long arm", "long poses", "long frames", "macros", "property"],
)
def test_depth_does_no_harm(text):
    survives(text)
