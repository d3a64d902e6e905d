"""Broken files of every kind end soon, in a result or in one of our errors."""

import random
import resource

import mutations
import pytest

GIGABYTE_IN_KB = 2**20


@pytest.mark.parametrize("name", mutations.SEEDS)
def test_a_whole_file_is_read(tmp_path, name):
    mutations.prepare(tmp_path)
    content, read = mutations.SEEDS[name]
    (tmp_path / name).write_bytes(mutations.as_bytes(content))
    read(tmp_path / name)


@pytest.mark.parametrize("name", mutations.SEEDS)
@pytest.mark.parametrize("count", [40, pytest.param(1500, marks=pytest.mark.slow)])
def test_a_broken_file_does_no_harm(tmp_path, name, count):
    mutations.prepare(tmp_path)
    chance = random.Random(name)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(count):
        data = mutations.mutated(mutations.as_bytes(mutations.SEEDS[name][0]), chance)
        wrong = mutations.fate(tmp_path, name, data)
        assert wrong is None, f"{wrong}\n{data[:2000]!r}"
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < GIGABYTE_IN_KB
