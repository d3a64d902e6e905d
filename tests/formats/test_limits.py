"""Limits of descriptions: each is one error that names it, within seconds."""

import pytest

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
