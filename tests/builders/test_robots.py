"""Additions to a robot's text mean the same as additions to its model."""

from dataclasses import replace

import pytest

from gazelle.builders import (
    BuildError,
    add_joint_properties,
    add_link_properties,
    add_plugin,
    add_sensor,
    add_transmission,
    add_transmissions,
    camera,
    imu,
    keep_fixed_joint,
    plugin,
)
from gazelle.formats import load_model_string

INERTIAL = (
    '<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/>'
    "</inertial>"
)
SHAPE = '<geometry><box size="1 1 1"/></geometry>'
LINK = (
    '<link name="{}">' + INERTIAL + f"<collision>{SHAPE}</collision><visual>{SHAPE}"
    '<material name="m"><color rgba="1 0 0 1"/></material></visual></link>'
)
JOINT = (
    '<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/><origin xyz="0 0 1"/>'
    '<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="2" velocity="3"/>{}</joint>'
)
TEXT = f"""<?xml version="1.0"?>
<robot name="arm">
  <!-- kept, with a </robot> in it -->
  {LINK.format("base")}
  {LINK.format("upper")}
  {LINK.format("lower")}
  <link name="mast"/>
  {JOINT.format("shoulder", "revolute", "base", "upper", "")}
  {JOINT.format("elbow", "prismatic", "upper", "lower", "")}
  <joint name="pole" type="fixed"><parent link="lower"/><child link="mast"/>
    <origin xyz="0 0 0.5" rpy="0 0 1"/></joint>
</robot>
<!-- the end -->
"""

CHANGES = {
    "friction": lambda r: add_link_properties(r, "upper", mu1=0.3, mu2=0.4, fdir1=(1.0, 0.0, 0.0)),
    "contact": lambda r: add_link_properties(
        r, "upper", kp=1e6, kd=10.0, max_vel=0.1, min_depth=0.001, max_contacts=4, laser_retro=7.0
    ),
    "look": lambda r: add_link_properties(r, "upper", material="Gazebo/Blue"),
    "motion": lambda r: add_link_properties(
        r, "lower", gravity=False, self_collide=True, damping=0.1
    ),
    "joint": lambda r: add_joint_properties(
        r,
        "shoulder",
        provide_feedback=True,
        implicit_spring_damper=True,
        stop_cfm=0.1,
        stop_erp=0.3,
        fudge_factor=0.5,
        spring_stiffness=2.0,
        spring_reference=0.25,
    ),
    "transmission": lambda r: add_transmission(r, "elbow", reduction=50.0),
    "transmissions": add_transmissions,
    "sensor": lambda r: add_sensor(r, "lower", imu(rate_noise=0.1)),
    "sensor of a lumped link": lambda r: add_sensor(r, "mast", camera()),
    "plugin": lambda r: add_plugin(r, plugin("control", "libgazebo_ros_control.so", ns="/arm")),
    "two": lambda r: add_link_properties(add_link_properties(r, "base", mu1=0.1), "base", mu1=0.2),
}


@pytest.mark.parametrize("name", CHANGES)
def test_text_and_model_change_alike(name):
    change = CHANGES[name]
    plain = load_model_string(TEXT)
    written = load_model_string(change(TEXT))
    assert written == change(plain)
    assert written != plain


def test_the_rest_of_the_text_stays():
    changed = add_transmissions(TEXT)
    start = TEXT.index("</robot>\n<!-- the end")
    assert changed.startswith(TEXT[:start])
    assert changed.endswith(TEXT[start:])


def test_transmissions_drive_what_moves_by_itself():
    follower = JOINT.format("finger", "prismatic", "lower", "tip", '<mimic joint="elbow"/>')
    text = TEXT.replace("</robot>\n<!-- the end", f"{LINK.format('tip')}{follower}</robot>\n<!--")
    once = add_transmissions(add_transmission(text, "elbow", name="mine"))
    model = load_model_string(once)
    assert [t.name for t in model.transmissions] == ["mine", "shoulder_transmission"]
    assert add_transmissions(model) == model
    assert add_transmissions(once) == once


def test_a_fixed_joint_can_be_kept():
    text = TEXT.replace('<link name="mast"/>', LINK.format("mast"))
    assert "mast" not in [link.name for link in load_model_string(text).links]
    kept = load_model_string(keep_fixed_joint(text, "pole"))
    assert "mast" in [link.name for link in kept.links]
    assert [j.type for j in kept.joints if j.name == "pole"] == ["fixed"]


def test_xacro_text_is_left_to_its_macros():
    text = TEXT.replace("<robot ", '<robot xmlns:xacro="http://www.ros.org/wiki/xacro" ')
    assert 'reference="from_a_macro"' in add_link_properties(text, "from_a_macro", mu1=1.0)
    with pytest.raises(BuildError, match="expanded"):
        add_transmissions(text)


MODEL = load_model_string(TEXT)


@pytest.mark.parametrize("robot", [TEXT, MODEL], ids=["text", "model"])
def test_wrong_names_get_a_hint(robot):
    with pytest.raises(BuildError, match="did you mean 'upper'"):
        add_link_properties(robot, "uper", mu1=1.0)
    with pytest.raises(BuildError, match="did you mean 'elbow'"):
        add_joint_properties(robot, "elbo", stop_cfm=0.1)
    with pytest.raises(BuildError, match="did you mean 'lower'"):
        add_sensor(robot, "lowr", imu())
    with pytest.raises(BuildError, match="did you mean 'elbow'"):
        add_transmission(robot, "elbo")
    with pytest.raises(BuildError, match="no property"):
        add_link_properties(robot, "upper")
    with pytest.raises(BuildError, match="must not be zero"):
        add_transmission(robot, "elbow", reduction=0.0)
    with pytest.raises(BuildError, match="already"):
        add_transmission(add_transmission(robot, "elbow"), "elbow")


def test_what_is_no_urdf_is_refused():
    with pytest.raises(BuildError, match="not its name"):
        add_transmission("robot.urdf", "elbow")
    with pytest.raises(BuildError, match="expected a <robot>"):
        add_plugin("<sdf/>", plugin("a", "b"))
    with pytest.raises(BuildError, match="no </robot>"):
        add_plugin("<robot name='r'/>", plugin("a", "b"))


def test_names_of_models_are_checked():
    with pytest.raises(BuildError, match="a frame of link 'lower'"):
        add_link_properties(MODEL, "mast", mu1=1.0)
    with pytest.raises(BuildError, match="already"):
        add_sensor(add_sensor(MODEL, "base", imu()), "base", imu())
    assert replace(MODEL) == MODEL
