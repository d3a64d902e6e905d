"""Systems of kernel modules, also another package's, are updated in order on all threads."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from extensions import LIMITED_API
from setuptools.command.build_ext import get_abi3_suffix

from gazelle import native
from gazelle.native.loop import SystemLoop
from gazelle.native.system import System

HERE = Path(__file__).parent
BUILD = """
from setuptools import Extension, setup
from Cython.Build import cythonize
setup(name="mixing", ext_modules=cythonize(Extension("mixing", ["mixing.py"],
    define_macros={macros!r}, py_limited_api=True,
    extra_compile_args=["-O0", "-g0"]), language_level=3, include_path=[{root!r}],
    compiler_directives={{"cdivision": True}}),
    script_args=["build_ext", "--inplace", "-q"])
"""


def built(folder, macros):
    """Return the kernel module beside this file, compiled as Gazelle is."""
    source = HERE / "mixing.py"
    if native.BUILD != "python":
        if not any(map(shutil.which, ("cc", "gcc", "clang", "cl"))):
            pytest.skip("no C compiler")
        shutil.copy(source, folder)
        text = BUILD.format(root=str(Path(native.__file__).parents[2]), macros=macros)
        subprocess.run([sys.executable, "-c", text], cwd=folder, check=True, capture_output=True)
        source = folder / f"mixing{get_abi3_suffix()}"
    spec = importlib.util.spec_from_file_location("mixing", source)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def mixing(tmp_path_factory):
    return built(tmp_path_factory.mktemp("mixing"), [("Py_LIMITED_API", LIMITED_API)])


class Threads:
    """A pool as loops want it."""

    def __init__(self, size):
        self.size = size

    def call(self, work, parts):
        with ThreadPoolExecutor(parts) as pool:
            return list(pool.map(work, range(parts)))


PARTS = [  # rows, rate [Hz], divisible, reads its own
    (3, 0.0, True, False),
    (1, 1e6, True, False),
    (4, 4e5, False, True),
    (2, 1e9 / 3_000, True, False),
]


def played(mixing, nworld, pool, ends, threads=0):
    """Return all systems' numbers after runs to some times."""
    arrays = [
        np.arange(nworld * rows, dtype=np.ulonglong) + 17 * i for i, (rows, *_) in enumerate(PARTS)
    ]
    still = [array.copy() for array in arrays]
    systems = [
        mixing.Mix(mine, mine if own else other, 1, rows, rate, divisible)
        for mine, other, (rows, rate, divisible, own) in zip(arrays, still, PARTS, strict=True)
    ]
    schedule = SystemLoop(systems, nworld, 1_000, pool)
    for end in ends:
        schedule.run(end, threads)
    return arrays, schedule


def expected(nworld, end):
    """Return the same by Python, world after world, step after step."""
    found = []
    for i, (rows, rate, _, own) in enumerate(PARTS):
        numbers = [row + 17 * i for row in range(nworld * rows)]
        still, due = list(numbers), 0
        for time in range(0, end, 1_000):
            if due > time:
                continue
            while rate and due <= time:
                due += round(1e9 / rate)
            for row in range(nworld * rows):
                other = row // rows * rows + (row + 1) % rows
                mixed = numbers[row] ^ (numbers if own else still)[other] ^ time
                numbers[row] = (mixed * 1103515245 + 12345) % 2**31
        found.append(numbers)
    return found


@pytest.mark.parametrize("nworld", [1, 2, 5, 64])
@pytest.mark.parametrize("size", [None, 1, 2, 3])
def test_what_comes_out_does_not_depend_on_threads(mixing, nworld, size):
    pool = None if size is None else Threads(size)
    arrays, schedule = played(mixing, nworld, pool, [20_000, 20_500, 49_001])
    assert [array.tolist() for array in arrays] == expected(nworld, 50_000)
    assert schedule.time == 50_000


def test_fewer_threads_than_there_are_do_the_same(mixing):
    arrays, _ = played(mixing, 7, Threads(4), [30_000], threads=2)
    assert [array.tolist() for array in arrays] == expected(7, 30_000)


def test_a_system_is_due_again_after_its_period(mixing):
    _, schedule = played(mixing, 1, None, [5_000])
    assert [each.due for each in schedule.systems] == [0, 5_000, 5_000, 6_000]


def test_systems_are_changed_between_runs_only_by_python(mixing):
    arrays, schedule = played(mixing, 3, None, [5_000])
    before = [array.copy() for array in arrays]
    schedule.run(5_000)
    assert all((a == b).all() for a, b in zip(arrays, before, strict=True))


@pytest.mark.parametrize("bad", [{"nworld": 0}, {"step": 0}])
def test_a_loop_of_nothing_is_refused(bad):
    with pytest.raises(ValueError, match="worlds and steps"):
        SystemLoop([], **({"nworld": 1, "step": 1} | bad))


@pytest.mark.parametrize("bad", [{"rows": 0}, {"rate": -1.0}])
def test_a_system_of_nothing_is_refused(bad):
    with pytest.raises(ValueError, match="rows"):
        System(**bad)


def test_only_systems_are_looped_over():
    with pytest.raises(TypeError):
        SystemLoop([object()], 1, 1)


RUN = "import sys; from gazelle import native; from gazelle.native.loop import SystemLoop; {}"


def outcome(build, code="print(native.BUILD, sys.modules[SystemLoop.__module__].__file__)"):
    environment = os.environ | {"GAZELLE_NATIVE": build}
    return subprocess.run(
        [sys.executable, "-c", RUN.format(code)],
        env=environment,
        check=False,
        capture_output=True,
        text=True,
    )


@pytest.mark.parametrize("build", ["baseline", "python"])
def test_a_build_is_forced_by_name(build):
    name, file = outcome(build).stdout.split()
    assert name == build
    assert Path(file).suffix == ".py" if build == "python" else f"_{build}" in file


def test_the_fastest_build_that_runs_here_is_chosen():
    assert outcome("").stdout.split()[0] in ("baseline", "avx2")


def test_an_unknown_build_is_refused_by_name():
    assert "GAZELLE_NATIVE must be one of baseline, avx2" in outcome("fastest").stderr


@pytest.mark.long
@pytest.mark.skipif(native.BUILD == "python", reason="Python runs the sources")
def test_a_system_without_the_stable_abi_is_refused(tmp_path):
    kind = built(tmp_path, []).Mix
    words = np.zeros(1, np.uint64)
    with pytest.raises(TypeError, match="Mix is compiled without Py_LIMITED_API"):
        kind(words, words, 0, 1, 0.0, True)
