"""Kernels do the same, to the bit, compiled and run by Python."""

from __future__ import annotations

import importlib
import os
import pkgutil
import subprocess
import sys
from collections import Counter
from pathlib import Path

import gymnasium
import numpy as np
import pytest

import gazelle.engines.planar
import gazelle.envs.planar
import gazelle.envs.turtlebot3
from gazelle.engines.native import Native, kernel
from gazelle.engines.native.interpreter import interpreted
from gazelle.engines.planar.crew import Crew
from gazelle.envs.planar.__main__ import compile_ahead as compile_tasks

PACKAGES = (gazelle.engines.planar, gazelle.envs.planar, gazelle.envs.turtlebot3)

# In each of so many calls of a kernel with as many arguments both ways are compared.
MOST = 2

LAWS = """
import sys
sys.path += sys.argv[1:]
from test_laws import bouncing
from gazelle.engines import make_engine
engine = make_engine("mujoco", bouncing(), 1, threads=1)
engine.set_model_motion("b1", (0.5, 0.2, 0.0), (0.0, 1.0, 2.0))
engine.step(400)
print(engine.snapshot()[-1].tobytes().hex())
"""
FLEET = """
from gazelle.engines.planar import Body, Drive, Fan, Fleet, Mount, Part, Scanner
bodies = [Body((Part.circle(0.0, 0.0, 0.1),), (0.5 * i, 0.0, 0.0), drive=Drive()) for i in range(3)]
fleet = Fleet(bodies, [Part.box(4.0, 4.0)])
fleet.step()
print(Scanner(fleet, Fan.spread(3.0, 9, 8.0), [Mount(0)]).scan().tobytes().hex())
"""


def kernels():
    """Names of all kernels that Python calls."""
    found = set()
    for package in PACKAGES:
        for _, name, _ in pkgutil.iter_modules(package.__path__):
            if name.startswith("kernels_"):
                module = importlib.import_module(f"{package.__name__}.{name}")
                source = open(module.__file__).read()  # noqa: SIM115, PTH123
                found |= {
                    f"{name}.{value.name}"
                    for value in vars(module).values()
                    if isinstance(value, Native) and f"@kernel\ndef {value.name}(" in source
                }
    return found


def copied(value, copies):
    """An argument, with arrays of its own, which share memory as the others do."""
    if isinstance(value, tuple):
        return tuple(copied(each, copies) for each in value)
    if not isinstance(value, np.ndarray):
        return value
    if value.size == 0:
        return value.copy()
    root = value
    while isinstance(root.base, np.ndarray):
        root = root.base
    memory = copies.setdefault(id(root), (root, root.copy()))[1]
    offset = value.ctypes.data - root.ctypes.data
    return np.ndarray(
        value.shape, value.dtype, memory.reshape(-1).view(np.uint8), offset, value.strides
    )


def same(one, other):
    """Whether two arguments or results have the same bits; what is no number has any."""
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(same, one, other))
    one, other = np.asarray(one), np.asarray(other)
    if other.dtype.kind != one.dtype.kind:  # whole on the way that was taken, real on others
        other = other.astype(one.dtype)
    nothing = one != one
    bits = np.ascontiguousarray(one).view(np.uint8), np.ascontiguousarray(other).view(np.uint8)
    if not nothing.any():
        return bool((bits[0] == bits[1]).all())
    return bool((nothing == (other != other)).all() and (one[~nothing] == other[~nothing]).all())


@pytest.fixture
def seen(monkeypatch):
    """Has every call of a kernel done both ways; the names of those that were called."""
    names, compiled = Counter(), Native.__call__

    def both(native, *values):
        name = f"{native.function.__module__.rpartition('.')[2]}.{native.name}"
        names[name] += 1
        if names[name] > MOST:
            return compiled(native, *values)
        if native.name == "measure_room":  # thousands of cells, of which some will do
            compiled(native, *values)
            values = (values[0][:2].copy(), *values[1:])
        mine = copied(values, {})
        given = compiled(native, *values)
        with np.errstate(all="ignore"):
            own = interpreted(native.function)(*mine)
        assert (given is None) == (own is None), name
        assert given is None or same(given, own), (name, given, own)
        for place, (one, other) in enumerate(zip(values, mine, strict=True)):
            assert same(one, other), (name, place)
        return given

    def in_turn(crew, work, count, least):
        """Share work with nobody, in as many parts: others would write what is compared."""
        parts = max(1, min(crew.size, count // least))
        ends = [count * part // parts for part in range(parts + 1)]
        return [work(ends[part], ends[part + 1], part) for part in range(parts)]

    monkeypatch.setattr(Native, "__call__", both)
    monkeypatch.setattr(Crew, "share", in_turn)
    return names


def test_every_kernel_does_the_same_both_ways(seen):
    compile_tasks()
    env = gymnasium.make("gazelle/TurtleBot3Stage4-v0", engine="planar")
    env.reset(seed=0)
    for action in range(3):
        env.step(action)
    env.close()
    assert kernels() <= set(seen)


@pytest.mark.parametrize("code", [LAWS, FLEET])
def test_a_variable_of_the_environment_has_kernels_interpreted(code, tmp_path):
    printed = []
    for interpret, compiled in (("0", True), ("1", False)):
        environment = {**os.environ, "GAZELLE_INTERPRET_KERNELS": interpret}
        environment["GAZELLE_CACHE_DIR"] = str(tmp_path / interpret)
        folders = [str(Path(__file__).parents[1]), str(Path(__file__).parents[2])]
        done = subprocess.run(
            [sys.executable, "-c", code, *folders], env=environment, check=True,
            capture_output=True, text=True,
        )  # fmt: skip
        printed.append(done.stdout)
        assert (tmp_path / interpret).exists() == compiled
    assert printed[0] == printed[1] != ""


def reaches(values, first, last):
    total = 0.0
    for k in range(first, last):
        total += values[k]
    values[last] = total
    return values[first:last].size


def trips(a):
    b = a + 1
    return [b]


@pytest.mark.parametrize(("first", "last"), [(-1, 1), (0, 4), (0, 3)])
def test_the_interpreter_refuses_indices_that_arrays_do_not_have(first, last):
    run = interpreted(reaches)
    assert run(np.ones(3), 0, 2) == 2
    with pytest.raises(IndexError, match="of an axis of 3"):
        run(np.ones(3), first, last)


def test_the_interpreter_keeps_lines_for_debuggers():
    with pytest.raises(TypeError) as caught:
        interpreted(reaches)(np.ones(3), 0, None)
    lines = [place.lineno for place in caught.traceback if str(place.path) == __file__]
    assert lines[-1] == reaches.__code__.co_firstlineno + 1  # the third, as they begin at 0


def test_what_is_marked_is_compiled_unless_the_variable_says_otherwise(monkeypatch):
    assert isinstance(kernel(trips), Native)
    monkeypatch.setattr("gazelle.engines.native.decorators._INTERPRET", True)
    assert kernel(trips)(1) == [2]
