"""What kept machine code goes by: all that it depends on."""

from __future__ import annotations

import linecache
from typing import Any

import llvmlite
import llvmlite.binding as llvm
import pytest

from gazelle.engines.native import library
from gazelle.engines.native.machine import machine

SOURCE = '''
"""A kernel, and all that it uses."""
import math
from typing import NamedTuple

from gazelle.engines.native import kernel, part
import gazelle.engines.native.kinds as module


class Record(NamedTuple):
    width: int = 3


RECORD, SHARE = Record(), 0.5


class Names:
    HEIGHT = 2


@part
def below(a):
    return a + 1.0


@part
def between(a):
    return below(a) * SHARE


@kernel
def above(a):
    """What it does."""
    return math.sqrt(between(a)) + RECORD.width + Names.HEIGHT + module.WIDTH
'''


@pytest.fixture
def digest(tmp_path):
    """Gives the digest of ``above`` in a source."""

    def make(text: str) -> str:
        path = tmp_path / "some_kernels.py"
        path.write_text(text)
        linecache.clearcache()
        module: dict[str, Any] = {"__name__": "some_kernels"}
        exec(compile(text, str(path), "exec"), module)
        return library.digest_of(module["above"])

    return make


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("sqrt(between(a))", "sqrt(between(a) + a)"),
        ("a + 1.0", "a + 2.0"),
        ("a + 1.0", "a - 1.0"),
        ("SHARE = Record(), 0.5", "SHARE = Record(), 0.25"),
        ("width: int = 3", "width: int = 4"),
        ("HEIGHT = 2", "HEIGHT = 3"),
        ("math.sqrt(b", "math.sin(b"),
        ("import math\n", "import numpy as math\n"),
        ("@part\ndef below", "@inner\ndef below"),
    ],
)
def test_a_kernel_goes_by_its_source_and_that_of_all_it_uses(digest, old, new):
    source = SOURCE.replace("kernel, part", "inner, kernel, part")
    assert old in source
    assert digest(source) != digest(source.replace(old, new))


def test_a_kernel_goes_by_values_in_modules(digest, monkeypatch):
    before = digest(SOURCE)
    monkeypatch.setattr("gazelle.engines.native.kinds.WIDTH", 65)
    assert digest(SOURCE) != before


def test_remarks_and_place_do_not_matter(digest):
    moved = SOURCE.replace("What it does", "Something else").replace("@kernel", "\n\n# A\n@kernel")
    assert digest(SOURCE) == digest(moved)


def test_a_kernel_goes_by_the_interpreter_and_the_compiler(digest, monkeypatch):
    before = digest(SOURCE)
    monkeypatch.setattr("sys.version", "4.0")
    library._compiler.cache_clear()
    try:
        assert digest(SOURCE) != before
    finally:
        monkeypatch.undo()
        library._compiler.cache_clear()
    assert digest(SOURCE) == before


def test_a_file_goes_by_the_processor_and_by_llvm(monkeypatch):
    name, before = machine().name, library._key("a kernel")
    features = llvm.get_host_cpu_features().flatten()
    for detail in (llvm.get_host_cpu_name(), features, llvmlite.__version__):
        assert detail in name
    monkeypatch.setattr(machine(), "name", name.replace(features, features + ",+more"))
    assert library._key("a kernel") != before
