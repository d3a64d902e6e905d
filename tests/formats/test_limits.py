"""Limits of descriptions: each is one error that names it, within seconds."""

import time

import pytest
from xml_samples import robot, sdf, urdf_joint, urdf_link

from gazelle import Simulation, formats
from gazelle.engines.mujoco.compiler import free_bodies
from gazelle.errors import EngineError, FormatError

CHAIN = "".join(
    f"<xacro:property name='p{n}' value='{f'${{p{n - 1}}}' * 10}'/>"
    if n
    else "<xacro:property name='p0' value='x'/>"
    for n in range(12)
)
POINTS = "".join(f"<point>{n} {n % 2}</point>" for n in range(10_001))
MODEL = "<model name='m{}'><link name='l'><inertial><mass>1</mass></inertial></link></model>"


def test_properties_that_repeat_each_other_are_refused(tmp_path):
    file = tmp_path / "a.urdf.xacro"
    file.write_text(f"<robot name='r' xmlns:xacro='x'>{CHAIN}<link name='${{p11}}'/></robot>")
    with pytest.raises(FormatError, match="more than 4,000,000 characters"):
        formats.load(file)


def test_a_tree_of_includes_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr("gazelle.formats.reading.MAX_FILES", 500)
    for place in range(20):
        inner = "".join(
            f"<include><name>{name}</name><uri>m{place + 1}.sdf</uri></include>" for name in "ab"
        )
        text = f"<sdf version='1.9'><model name='m'><link name='l'/>{inner}</model></sdf>"
        (tmp_path / f"m{place}.sdf").write_text(text)
    (tmp_path / "m20.sdf").write_text(
        "<sdf version='1.9'><model name='m'><link name='l'/></model></sdf>"
    )
    with pytest.raises(FormatError, match="more than 500 files are included"):
        formats.load(tmp_path / "m0.sdf")


def test_a_polyline_of_too_many_points_is_refused():
    shape = f"<geometry><polyline><height>1</height>{POINTS}</polyline></geometry>"
    with pytest.raises(FormatError, match="at most 10,000 points"):
        formats.load_string(
            f"<sdf version='1.6'><world name='w'><model name='m'><static>1</static><link name='l'>"
            f"<collision name='c'>{shape}</collision></link></model></world></sdf>"
        )


def test_a_world_of_too_many_things_that_move_is_refused(monkeypatch):
    monkeypatch.setattr(free_bodies, "MAX_COORDINATES", 50)
    models = "".join(MODEL.format(n) for n in range(9))
    world = formats.load_string(f"<sdf version='1.6'><world name='w'>{models}</world></sdf>")
    with pytest.raises(EngineError, match="54 coordinates of motion, more than the limit of 50"):
        Simulation(world)


@pytest.mark.parametrize(
    ("name", "value", "joints", "said"),
    [
        ("MAX_CHAIN", 5, [(n, n + 1) for n in range(7)], "link 'm::l5' hangs on 5 others"),
        ("MAX_MOVING", 6, [(0, n) for n in range(1, 8)], "8 links that move, more than"),
        ("MAX_SOLIDS", 6, [(0, n) for n in range(1, 8)], "8 links that collide, more than"),
    ],
)
def test_a_model_of_too_many_parts_is_refused(monkeypatch, name, value, joints, said):
    monkeypatch.setattr(free_bodies, name, value)
    shape = (
        "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>"
    )
    links = "".join(f"<link name='l{n}'>{shape}</link>" for n in range(8))
    held = "".join(
        f"<joint name='j{a}{b}' type='revolute'><parent>l{a}</parent><child>l{b}</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>"
        for a, b in joints
    )
    world = formats.load_string(
        sdf(f"<world name='w'><model name='m'>{links}{held}</model></world>")
    )
    with pytest.raises(EngineError, match=said):
        Simulation(world)


@pytest.mark.parametrize("outer", ["m" * 3000, "m" * 1500, "<xacro>"])
def test_a_name_that_would_be_in_the_names_of_all_parts_is_refused(outer):
    if outer == "<xacro>":
        text = "<robot name='r' xmlns:xacro='x'><link name=\"${'m' * 3000}\"/></robot>"
    else:
        text = sdf(f"<model name='{outer}'><link name='{'l' * 1000}'/></model>")
    with pytest.raises(FormatError, match="has at most 2,000 characters") as caught:
        formats.load_string(text)
    assert len(str(caught.value)) < 2000


def test_the_place_of_an_element_is_short():
    nested = (
        "".join(f"<model name='m{n}{'x' * 15}'>" for n in range(99)) + "<link/>" + "</model>" * 99
    )
    with pytest.raises(FormatError) as caught:
        formats.load_string(sdf(nested))
    assert len(str(caught.value)) < 2000


def test_what_takes_the_square_of_a_number_elsewhere_takes_little_here():
    """Cases of 1,000 parts; with a search for each part they would take 16 s together."""
    number = 1000
    links = "".join(urdf_link(f"l{n}") for n in range(number))
    star = "".join(urdf_joint(f"j{n}", "l0", f"l{n}", "continuous") for n in range(1, number))
    ring = "".join(
        f"<joint name='j{n}' type='revolute'><parent>l{n}</parent><child>l{n ^ 1}</child>"
        "<axis><xyz>0 0 1</xyz></axis></joint>"
        for n in range(number)
    )
    lost = ring.replace("<parent>l", "<parent>x")
    bodies = "".join(f"<link name='l{n}'/>" for n in range(number))
    models = "".join(MODEL.format(n) for n in range(number))
    start = time.process_time()
    assert not [
        each for each in formats.check_string(robot(links + star)) if each.severity == "error"
    ]
    assert len(formats.check_string(sdf(f"<world name='w'>{models}</world>"))) == 0
    for joints in (ring, lost):
        formats.check_string(sdf(f"<model name='m'>{bodies}{joints}</model>"))
    assert time.process_time() - start < 5.0


def test_a_file_over_the_limit_is_not_read_a_second_time_for_mending(monkeypatch):
    monkeypatch.setattr("gazelle.formats.xml.MAX_XML_ELEMENTS", 10)
    monkeypatch.setattr("gazelle.formats.xml.well_formed", None)
    with pytest.raises(FormatError, match="limit of 10 elements") as caught:
        formats.load_string(sdf("<model name='m'>" + "<link name='l'/>" * 20 + "</model>"))
    assert caught.value.line == 3
    assert caught.value.hint


@pytest.mark.parametrize(
    "expression",
    [
        "9**9**9**9",
        "'a' * 10**10",
        "[list(range(99999)) for i in range(9999)]",
        "list(map(lambda x: [0] * 99999, range(99999)))",
        "p.format(1)",
        "p2.join(['a' * 99999] * 99999)",
        "[q29, q29]",
    ],
)
def test_a_xacro_expression_that_makes_much_is_refused(expression):
    doubled = "".join(
        f"<xacro:property name='q{n}' value='${{[q{n - 1}, q{n - 1}]}}'/>" for n in range(1, 30)
    )
    text = (
        "<robot name='r' xmlns:xacro='x'><xacro:property name='p' value='{:10000000000}'/>"
        f"<xacro:property name='p2' value='b'/><xacro:property name='q0' value='1'/>{doubled}"
        f'<link name="${{{expression}}}"/></robot>'
    )
    start = time.process_time()
    with pytest.raises(FormatError, match=r"the expressions? make|may be padded|takes too long"):
        formats.load_string(text)
    assert time.process_time() - start < 5.0
