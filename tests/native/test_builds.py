"""Every build of compiled modules gives the same bits, and so does Python that runs sources."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import gazelle
from gazelle import native
from gazelle.engines.mujoco.laws.layouts import Offsets

LAWS = Path(gazelle.__file__).parent / "engines/mujoco/laws"

IN_SPACE = """
import gazelle
for world, seconds in (("turtlebot3_world", 0.3), ("shapes", 0.3)):
    with gazelle.Simulation(world, seed=0) as sim:
        robot = sim.spawn("turtlebot3_burger", name="r", pose=gazelle.Pose(x=-0.6, y=0.5))
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.5)
        sim.run(seconds=seconds)
        print(sim.state_hash())
"""


def result(build, code):
    environment = os.environ | {"GAZELLE_NATIVE": build}
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", code],
        env=environment,
        check=True,
        capture_output=True,
        text=True,
    )
    return done.stdout


@pytest.mark.parametrize("build", ["avx2", "python"])
def test_worlds_in_space_do_not_depend_on_the_build(build):
    if build == "avx2" and native.BUILD != "avx2":
        pytest.skip("this processor has no AVX2")
    assert result(build, IN_SPACE) == result("baseline", IN_SPACE)


def test_compiled_laws_know_every_place_in_mujocos_structs():
    named = re.findall(r"\b(\w+)\b", (LAWS / "places.pxd").read_text().split("size_t", 1)[1])
    assert set(named) - {"size_t", "cdef", "Places", "AT"} == set(Offsets._fields)


@pytest.mark.parametrize("path", sorted(Path(gazelle.__file__).parent.rglob("*.pxd")), ids=str)
def test_constants_of_compiled_modules_are_those_of_python(path):
    """An ``enum`` in a .pxd says the same as its module."""
    text = path.with_suffix(".py").read_text(encoding="utf-8")
    said = dict(
        re.findall(r"^    (\w+) = (-?[\d.e+-]+)(?:  #.*)?$", path.read_text(), re.MULTILINE)
    )
    values = {name: literal(text, name) for name in said}
    assert {name: float(value) for name, value in said.items()} == values


@pytest.mark.skipif(shutil.which("objdump") is None, reason="needs binutils")
def test_no_build_multiplies_and_adds_at_once():
    """A processor that has such instructions would round differently from one that has not."""
    homes = Path(gazelle.__file__).parent
    modules = [*homes.rglob("_avx2/*.so"), *homes.rglob("_baseline/*.so")]
    assert modules
    done = subprocess.run(["objdump", "-d", *modules], check=True, capture_output=True, text=True)
    assert "sd" in done.stdout
    assert not re.search(r"\tv?f(n?m(add|sub)|mla|mls)", done.stdout)


def literal(text, name):
    """What a module binds a name to at its head, also as one of many or where it is not compiled."""
    for names, values in re.findall(
        r"^ *([A-Z_0-9, ]+?)(?:: \w+)? = ([\d., e+-]+)", text, re.MULTILINE
    ):
        each = [part.strip() for part in names.split(",")]
        if name in each:
            return float(values.split(",")[each.index(name)])
    return None
