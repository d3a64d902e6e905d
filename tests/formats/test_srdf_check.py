"""``gazelle check`` reads an SRDF as one, and names what its URDF does not have."""

import json

import pytest
from xml_samples import INERTIAL

from gazelle import FormatError, formats
from gazelle.cli.main import main

URDF = (
    "<robot name='arm'>"
    + "".join(f"<link name='l{n}'>{INERTIAL}</link>" for n in range(4))
    + "".join(
        f"<joint name='j{n}' type='revolute'><parent link='l{n}'/><child link='l{n + 1}'/>"
        "<limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        for n in range(2)
    )
    + "<joint name='side' type='fixed'><parent link='l0'/><child link='l3'/></joint></robot>"
)
SRDF = """<robot name='arm'>
<group name='all'><chain base_link='l0' tip_link='l2'/></group>
<group name='some'><joint name='j0'/><link name='l2'/><joint name='stand'/></group>
<group_state name='home' group='all'><joint name='j0' value='0.5'/></group_state>
<end_effector name='hand' group='some' parent_link='l2'/>
<virtual_joint name='stand' type='fixed' parent_frame='world' child_link='l0'/>
<passive_joint name='j1'/>
<disable_collisions link1='l0' link2='l1' reason='Adjacent'/>
</robot>
"""


@pytest.fixture
def files(tmp_path):
    (tmp_path / "arm.urdf").write_text(URDF)

    def write(text):
        file = tmp_path / "arm.srdf"
        file.write_text(text)
        return file, tmp_path / "arm.urdf"

    return write


def test_a_good_one_has_no_problem(files):
    srdf, urdf = files(SRDF)
    assert formats.check(srdf) == []
    assert formats.check(srdf, urdf=urdf) == []


@pytest.mark.parametrize(
    ("old", "new", "line", "rule", "hint"),
    [
        ("<robot name='arm'", "<robot name='leg'", 1, "srdf-robot", "same name"),
        ("tip_link='l2'", "tip_link='l22'", 2, "srdf-link", "did you mean 'l2'?"),
        ("base_link='l0'", "base_link='l3'", 2, "srdf-chain", "between the root and the tip"),
        ("<joint name='j0'/>", "<joint name='jj0'/>", 3, "srdf-joint", "did you mean 'j0'?"),
        ("<link name='l2'/>", "<link name='x'/>", 3, "srdf-link", "there are: l0, l1, l2, l3"),
        ("value='0.5'", "value='1.5'", 4, "srdf-limits", "within the limits"),
        ("parent_link='l2'", "parent_link='tip'", 5, "srdf-link", "there are"),
        ("child_link='l0'", "child_link='base'", 6, "srdf-link", "there are"),
        ("<passive_joint name='j1'/>", "<passive_joint name='j9'/>", 7, "srdf-joint", "there are"),
        ("link2='l1'", "link2='l11'", 8, "srdf-link", "did you mean 'l1'?"),
    ],
)
def test_what_the_urdf_does_not_have_is_an_error(files, old, new, line, rule, hint):
    srdf, urdf = files(SRDF.replace(old, new, 1))
    (problem,) = formats.check(srdf, urdf=urdf)
    assert (problem.severity, problem.line, problem.rule) == ("error", line, rule)
    assert hint in problem.hint


def test_unknown_elements_and_broken_groups_are_found_without_a_urdf(files):
    srdf, _ = files(SRDF.replace("<passive_joint", "<pasive_joint"))
    (problem,) = formats.check(srdf)
    assert problem.hint == "did you mean 'passive_joint'?"
    srdf, _ = files(SRDF.replace("group='all'", "group='al'"))
    assert [each.severity for each in formats.check(srdf)] == ["error"]


def test_the_command_takes_both(files, capsys):
    srdf, urdf = files(SRDF.replace("link2='l1'", "link2='gone'"))
    assert main(["check", str(srdf)]) == 0
    capsys.readouterr()
    assert main(["check", "--json", "--urdf", str(urdf), str(srdf)]) == 1
    (row,) = json.loads(capsys.readouterr().out)
    assert row["rule"] == "srdf-link"


def test_loading_one_as_a_robot_says_what_it_is(files):
    srdf, _ = files(SRDF)
    with pytest.raises(FormatError, match=r"this is an SRDF.*load_srdf"):
        formats.load(srdf)
