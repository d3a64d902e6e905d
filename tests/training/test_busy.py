"""Measurement of a training's duration and of the load beside it in benchmarks."""

from __future__ import annotations

import importlib.util
import os
import sys
import time
from pathlib import Path

import pytest

FILE = Path(__file__).parents[2] / "benchmarks" / "_busy.py"
NEEDS_STAT = pytest.mark.skipif(not Path("/proc/stat").exists(), reason="the system does not tell")


@pytest.fixture
def busy(monkeypatch):
    spec = importlib.util.spec_from_file_location("gazelle_busy", FILE)
    module = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, spec.name, module)
    spec.loader.exec_module(module)
    return module


def test_what_a_process_works_itself_is_its_own_and_a_pause_is_not(busy):
    watch = busy.StopWatch()
    before = time.process_time()
    while time.process_time() < before + 0.3:
        pass
    time.sleep(0.2)
    spent = watch.read()
    assert 0.3 <= spent.processor < 0.45
    assert spent.wall >= 0.5
    assert spent.processors == len(os.sched_getaffinity(0))


@NEEDS_STAT
def test_others_are_what_the_machine_did_beyond_that(busy, monkeypatch):
    """Ten seconds of all processors in two, of which two are our own."""
    watch = busy.StopWatch(wall=0.0, own=0.0, machine=100.0)
    monkeypatch.setattr(busy, "busy_seconds", lambda: 110.0)
    monkeypatch.setattr(busy.time, "perf_counter", lambda: 4.0)
    monkeypatch.setattr(busy.time, "process_time", lambda: 2.0)
    spent = watch.read()
    assert spent.others == 2.0
    assert "(others kept 2.0 busy), 2 s of processors" in str(spent)


@NEEDS_STAT
def test_the_systems_own_count_grows_with_work(busy):
    before, own = busy.busy_seconds(), time.process_time()
    while time.process_time() < own + 0.3:
        pass
    assert busy.busy_seconds() - before >= 0.25


def test_where_nothing_tells_others_are_not_known(busy, monkeypatch, tmp_path):
    monkeypatch.setattr(busy, "_STAT", tmp_path / "stat")
    spent = busy.StopWatch().read()
    assert spent.others is None
    assert "others" not in str(spent)
