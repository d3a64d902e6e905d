"""``<experimental:params>`` of includes, against what libsdformat makes of the same files."""

import re
import warnings

import libsdformat
import pytest
from plain_sdf import differences, table
from xml_samples import sdf

from gazelle import formats

CONFIG = "<model><sdf version='1.9'>model.sdf</sdf></model>"
CAMERA = """<model name='cam'><pose>0 0 1 0 0 0</pose><link name='lens'><inertial><mass>2</mass></inertial>
<visual name='glass'><geometry><sphere><radius>0.1</radius></sphere></geometry></visual></link></model>"""
ROBOT = """<model name='robot'>
<link name='base'><inertial><mass>1</mass></inertial>
<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>
<visual name='v'><geometry><box><size>1 1 1</size></box></geometry>
<material><ambient>1 0 0 1</ambient><diffuse>1 0 0 1</diffuse></material></visual>
<sensor name='imu' type='imu'><update_rate>10</update_rate><always_on>1</always_on></sensor></link>
<link name='base_2'><visual name='v'><geometry><box><size>2 2 2</size></box></geometry></visual></link>
<link name='tip'><pose>1 0 0 0 0 0</pose></link>
<joint name='hinge' type='revolute'><parent>base</parent><child>tip</child><axis><xyz>0 0 1</xyz>
<limit><lower>-1</lower><upper>1</upper></limit></axis></joint>
<model name='sub'><pose>0 1 0 0 0 0</pose><link name='l'/></model>
<include><uri>cam</uri><pose>0 0 2 0 0 0</pose></include>
<include><uri>cam</uri><name>second</name></include>
<plugin name='p' filename='libnothing.so'><rate>5</rate></plugin>
</model>"""
BOX = "<geometry><box><size>1 2 3</size></box></geometry>"
BALL = "<geometry><sphere><radius>0.3</radius></sphere></geometry>"

DONE = {
    "a link is added": "<link element_id='' name='extra' action='add'><pose>5 0 0 0 0 0</pose></link>",
    "a part is added to a link": f"<visual element_id='base' name='w' action='add'>{BOX}</visual>",
    "a part is added in a nested model": f"<visual element_id='sub::l' name='w' action='add'>{BOX}</visual>",
    "a link is added to a nested model": "<link element_id='sub' name='m' action='add'/>",
    "a link is removed": "<link element_id='base_2' action='remove'/>",
    "a part is removed": "<collision element_id='base::c' action='remove'/>",
    "the longer of two names is meant": "<visual element_id='base_2::v' action='remove'/>",
    "values are removed": "<sensor element_id='base::imu' action='remove'><update_rate/></sensor>",
    "a part is replaced": f"<visual element_id='base::v' name='n' action='replace'>{BALL}</visual>",
    "a joint is replaced": "<joint element_id='hinge' name='hinge' type='fixed' action='replace'><parent>base</parent><child>tip</child></joint>",
    "values are modified": "<sensor element_id='base::imu' action='modify'><update_rate>50</update_rate></sensor>",
    "a name is modified": "<sensor element_id='base::imu' action='modify' name='imu2'/>",
    "a pose gets a frame": "<link element_id='tip' action='modify'><pose relative_to='base'/></link>",
    "a value gets its default": "<visual element_id='base::v' action='modify'><material><ambient/></material></visual>",
    "deep values are modified": "<joint element_id='hinge' action='modify'><axis><limit><upper>2</upper></limit></axis></joint>",
    "a mass is modified": "<link element_id='base' action='modify'><inertial><mass>7</mass></inertial></link>",
    "each part has its action": """<visual element_id='base::v'><geometry action='replace'><sphere><radius>0.3</radius>
        </sphere></geometry><material action='modify'><ambient>0 1 0 1</ambient></material>
        <transparency action='add'>0.5</transparency></visual>""",
    "parts of a part are removed": "<visual element_id='base::v'><material action='remove'><diffuse/></material></visual>",
    "named parts": f"""<link element_id='base'><collision name='c' action='remove'/>
        <visual name='v' action='modify'>{BALL.replace("sphere", "box").replace("radius", "size").replace("0.3", "3 2 1")}</visual></link>""",
    "a plugin is added twice": "<plugin element_id='' name='q' filename='libq.so' action='add'/>"
    * 2,
    "a nested model is placed anew": "<model element_id='sub'><pose action='modify'>9 9 9 0 0 0</pose></model>",
    "a nested model goes": "<model element_id='sub' action='remove'/>",
    "into an include": "<visual element_id='cam::lens::glass' action='remove'/>",
    "into an include with a name": "<link element_id='second::lens' action='modify'><inertial><mass>7</mass></inertial></link>",
    "a part is added to an include": "<link element_id='cam' name='cap' action='add'/>",
    "an include is placed anew": "<model element_id='cam'><pose action='modify'>9 9 9 0 0 0</pose></model>",
    "an include without a pose is placed anew": "<model element_id='second'><pose action='modify'>9 9 9 0 0 0</pose></model>",
    "an include goes": "<model element_id='second' action='remove'/>",
    "one after another": f"""<visual element_id='base' name='w' action='add'>{BOX}</visual>
        <visual element_id='base::w' action='modify'><geometry><box><size>3 2 1</size></box></geometry></visual>""",
}
LEFT = {
    "no element_id": ("<link name='x' action='add'/>", "no 'element_id'"),
    "no name after colons": ("<link element_id='base::' action='remove'/>", "after the last '::'"),
    "no such action": ("<link element_id='tip' action='remov'/>", "did you mean 'remove'"),
    "no such element": ("<link element_id='tpi' action='remove'/>", "did you mean 'tip'"),
    "another tag": ("<joint element_id='tip' action='remove'/>", "no <joint> 'tip'"),
    "added without a name": ("<link element_id='' action='add'/>", "needs a 'name'"),
    "added twice": ("<visual element_id='base' name='v' action='add'/>", "'base::v' already"),
    "nothing to add to": ("<visual element_id='tpi' name='v' action='add'/>", "no element 'tpi'"),
    "replaced without a name": (
        "<visual element_id='base::v'><box/></visual>",
        "an 'action' is needed",
    ),
    "a part that is not there": (
        "<link element_id='base'><gravity action='remove'/></link>",
        "no such <gravity>",
    ),
    "modified and not there": (
        "<link element_id='base' action='modify'><gravity>0</gravity></link>",
        "no such <gravity>",
    ),
    "no such attribute": (
        "<joint element_id='hinge' action='modify' tpe='fixed'/>",
        "did you mean 'type'",
    ),
    "into an include and not there": (
        "<link element_id='cam::lense' action='remove'/>",
        "did you mean 'lens'",
    ),
}


def written(folder, entries):
    """Return a world that includes the robot with parameters."""
    for name, model in (("robot", ROBOT), ("cam", CAMERA)):
        (folder / name).mkdir()
        (folder / name / "model.config").write_text(CONFIG)
        (folder / name / "model.sdf").write_text(sdf(model, "1.9"))
    file = folder / "test.world"
    params = f"<experimental:params>{entries}</experimental:params>"
    world = f"<world name='w'><include><uri>robot</uri>{params}</include></world>"
    file.write_text(sdf(world, "1.9"))
    return file


def oracle(file):
    return libsdformat.printed(file, roots=[file.parent])


def unlike(file):
    """Return the robot's differences between our text and libsdformat's."""
    libsdformat.needed()
    world = formats.load(file, paths=[file.parent])
    ours = table(formats.to_string(world, format="sdf"))
    return [
        line
        for line in differences(ours, table(oracle(file)))
        if "/model[robot]" in line and not re.search(r"@relative_to|/(lower|upper) =", line)
    ]


@pytest.mark.parametrize("entries", DONE.values(), ids=DONE)
def test_changes_are_those_of_libsdformat(tmp_path, entries):
    assert unlike(written(tmp_path, entries)) == []


@pytest.mark.parametrize(("entries", "said"), LEFT.values(), ids=LEFT)
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_what_cannot_be_done_is_told_with_its_line_and_left_out(tmp_path, entries, said):
    file = written(tmp_path, entries)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        world = formats.load(file, paths=[tmp_path])
    (warning,) = caught
    assert said in str(warning.message)
    assert str(warning.message).startswith(f"{file}:3: ")
    assert [problem.severity for problem in formats.check(file, paths=[tmp_path])][:1] == ["error"]
    assert len(world.models[0].links) == 3


@pytest.mark.parametrize("entries", [each for each, _ in LEFT.values()], ids=LEFT)
@pytest.mark.filterwarnings("ignore::gazelle.errors.FormatWarning")
def test_what_cannot_be_done_is_left_out_as_libsdformat_leaves_it_out(tmp_path, entries):
    assert unlike(written(tmp_path, entries)) == []


def test_a_urdf_is_changed_as_the_sdf_that_it_becomes(tmp_path):
    (tmp_path / "arm").mkdir()
    (tmp_path / "arm" / "model.config").write_text(CONFIG.replace("model.sdf", "arm.urdf"))
    inertial = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    (tmp_path / "arm" / "arm.urdf").write_text(
        f"""<robot name='arm'><link name='a'>{inertial}</link><link name='b'>{inertial}</link>
        <joint name='j' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint></robot>"""
    )
    file = tmp_path / "test.world"
    entries = "<link element_id='b' action='modify'><inertial><mass>3</mass></inertial></link>"
    params = f"<experimental:params>{entries}</experimental:params>"
    file.write_text(
        sdf(f"<world name='w'><include><uri>arm</uri>{params}</include></world>", "1.9")
    )
    model = formats.load(file, paths=[tmp_path]).models[0]
    assert [link.inertial.mass for link in model.links] == [1.0, 3.0]
    assert "b" in oracle(file)


INNER = "<link element_id='lens' action='modify'><inertial><mass>3</mass></inertial></link>"
OUTER = INNER.replace("lens", "cam::lens").replace("3", "4")


@pytest.mark.parametrize(("outer", "mass"), [("", 3.0), (OUTER, 4.0)])
def test_parameters_of_includes_in_includes_come_first_the_inner_then_the_outer(
    tmp_path, outer, mass
):
    file = written(tmp_path, outer)
    (tmp_path / "robot" / "model.sdf").write_text(
        sdf(
            f"<model name='robot'><link name='l'/><include><uri>cam</uri><experimental:params>{INNER}"
            "</experimental:params></include></model>",
            "1.9",
        )
    )
    model = formats.load(file, paths=[tmp_path]).models[0]
    assert model.models[0].links[0].inertial.mass == mass
    assert unlike(file) == []
