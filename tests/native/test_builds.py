"""Every build of compiled modules gives the same bits, and so does Python that runs sources."""

from __future__ import annotations

import importlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import gazelle
from gazelle import native
from gazelle.engines.mujoco.contact_laws.struct_layout import Offsets
from gazelle.native import processor

ROOT = Path(gazelle.__file__).parent
LAWS = ROOT / "engines/mujoco/contact_laws"

IN_SPACE = """
import gazelle
for world, seconds in (("turtlebot3_world", 0.3), ("shapes", 0.3)):
    with gazelle.Simulation(world, seed=0) as sim:
        robot = sim.spawn("turtlebot3_burger", name="r", pose=gazelle.Pose(x=-0.6, y=0.5))
        robot.inputs["cmd_vel"].send(linear=0.2, angular=0.5)
        sim.run(seconds=seconds)
        print(sim.state_hash())
"""

IN_PLANE = """
import hashlib
import gazelle
with gazelle.Simulation("turtlebot3_stage_4", engine="planar", seed=0) as sim:
    robot = sim.spawn("turtlebot3_burger", name="r", pose=gazelle.Pose(x=-0.7, y=0.1, yaw=0.3))
    robot.inputs["cmd_vel"].send(linear=0.2, angular=0.5)
    for _ in range(3):
        sim.run(seconds=0.2)
        ranges = robot.sensors["lds_lfcd_sensor"].read().ranges
        print(sim.state_hash(), hashlib.sha256(ranges.tobytes()).hexdigest())
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


@pytest.mark.skipif(sys.platform != "linux" or native.BUILD == "python", reason="asks Linux")
def test_avx2_is_found_where_linux_sees_it():
    flags = re.search(r"^flags\s*:(.*)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    assert processor.has_avx2() == bool(flags and "avx2" in flags[1].split())


@pytest.mark.long
@pytest.mark.parametrize("code", [IN_SPACE, IN_PLANE], ids=["space", "plane"])
@pytest.mark.parametrize("build", ["avx2", "python"])
def test_worlds_do_not_depend_on_the_build(build, code):
    if build == "avx2" and native.BUILD != "avx2":
        pytest.skip("this processor has no AVX2")
    assert result(build, code) == result("baseline", code)


def test_compiled_laws_know_every_place_in_mujocos_structs():
    named = re.findall(
        r"\b(\w+)\b", (LAWS / "struct_offsets.pxd").read_text().split("size_t", 1)[1]
    )
    assert set(named) - {"size_t", "cdef", "Places", "AT"} == set(Offsets._fields)


@pytest.mark.parametrize("path", sorted(ROOT.rglob("*.pxd")), ids=str)
def test_constants_of_compiled_modules_are_those_of_python(path):
    """An ``enum`` in a .pxd says the same as its module."""
    text = path.with_suffix(".py").read_text(encoding="utf-8")
    said = dict(
        re.findall(r"^    (\w+) = (-?[\d.e+-]+)(?:  #.*)?$", path.read_text(), re.MULTILINE)
    )
    if "\nimport cython\n" in text:
        values = {name: literal(text, name) for name in said}
    else:
        dotted = path.relative_to(ROOT.parent).with_suffix("").parts
        module = importlib.import_module(".".join(dotted))
        values = {name: float(getattr(module, name)) for name in said}
    assert {name: float(value) for name, value in said.items()} == values


@pytest.mark.long
@pytest.mark.skipif(shutil.which("objdump") is None, reason="needs binutils")
def test_no_build_multiplies_and_adds_at_once():
    """A processor that has such instructions would round differently from one that has not."""
    modules = [*ROOT.rglob("_avx2/*.so"), *ROOT.rglob("_baseline/*.so")]
    assert modules
    done = subprocess.run(["objdump", "-d", *modules], check=True, capture_output=True, text=True)
    assert "sd" in done.stdout
    assert not re.search(r"\tv?f(n?m(add|sub)|mla|mls)", done.stdout)


def literal(text, name):
    """Return a module's value of a name, also as one of many or where it is not compiled."""
    for names, values in re.findall(
        r"^ *([A-Z_0-9, ]+?)(?:: \w+)? = ([\d., e+-]+)", text, re.MULTILINE
    ):
        each = [part.strip() for part in names.split(",")]
        if name in each:
            return float(values.split(",")[each.index(name)])
    return None
