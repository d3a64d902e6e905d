"""Python calls that write: without room each is one error that names the file, and nothing is lost.

The limit of file sizes stands for a full disk: it needs no mount.
"""

from __future__ import annotations

import contextlib
import logging
from types import SimpleNamespace

import numpy as np
import pytest

import gazelle
from gazelle.errors import Error
from gazelle.formats import piece_cache
from gazelle.ros.messages import load_message
from gazelle.simulation import Replay

resource = pytest.importorskip("resource")

MOST = 2000
"""Room for each file [bytes]."""
WORDS = load_message("std_msgs/String")


@contextlib.contextmanager
def little_room(most=MOST):
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (most, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@pytest.fixture
def sim():
    with gazelle.Simulation("empty", threads=1) as made:
        yield made


def record(file, sim, count=100):
    with sim.record(file):
        for _ in range(count):
            sim.robots["ground_plane"].set_pose((0.0, 0.0, 0.0))
            sim.step()


def write_bag(file, _sim):
    from gazelle.ros.bags import Bag

    with Bag(str(file), "w", chunk_threshold=100) as bag:
        for number in range(100):
            bag.write("/words", WORDS(data=f"{number} " * 50))


def save_model(file, _sim):
    from gazelle import formats

    formats.save(formats.load_model("turtlebot3_burger"), file)


def save_actor(file, _sim):
    from gazelle.training.actor import Actor
    from gazelle.training.policy_files import replacing

    weight, bias = np.zeros((26, 50), np.float32), np.zeros(50, np.float32)
    with replacing(file) as draft:
        Actor((weight,), (bias,), "tanh", "greedy").save(draft)


def log_interventions(file, _sim):
    from gazelle.training.deploy.interventions import InterventionLog

    log = InterventionLog(file)
    try:
        for number in range(100):
            log.note("armed", float(number), reason="x" * 50)
    finally:
        log.note("disarmed", 1.0)  # the robot is stopped, whatever the log does
        log.close()


def whole_curves(file, _sim):
    from gazelle.training.callback import CurveTable

    table = CurveTable(file, 1 << 30)
    try:
        for number in range(100):
            table.write({"episodes/total": number}, {}, number)
    finally:
        table.close()


GROWING = [record, write_bag, log_interventions, whole_curves]
WHOLE = [save_model, save_actor]
SUFFIXES = {write_bag: ".bag", save_model: ".sdf", save_actor: ".npz", whole_curves: ".csv"}


@pytest.mark.parametrize("write", GROWING + WHOLE)
def test_no_room_is_one_error_with_the_path(write, sim, tmp_path):
    file = tmp_path / f"a{SUFFIXES.get(write, '.txt')}"
    with little_room(), pytest.raises((Error, OSError)) as raised:
        write(file, sim)
    assert str(file) in f"{raised.value} {getattr(raised.value, 'file', '')}"
    assert "File too large" in str(raised.value)
    left = [each.name for each in tmp_path.iterdir()]
    assert left in ([], [file.name] if write in GROWING else [])
    sim.step()


@pytest.mark.parametrize("write", [record, *WHOLE])
def test_what_was_there_stays_if_nothing_can_take_its_place(write, sim, tmp_path):
    file = tmp_path / f"a{SUFFIXES.get(write, '.txt')}"
    file.write_text("old")
    with little_room(10), pytest.raises((Error, OSError)):
        write(file, sim)
    assert file.read_text() == "old"
    assert [each.name for each in tmp_path.iterdir()] == [file.name]


def test_curves_are_kept_when_a_run_goes_on_without_room(tmp_path):
    file = tmp_path / "progress.csv"
    whole_curves(file, None)
    before = file.read_text()
    with little_room(100), pytest.raises(OSError, match="progress"):
        whole_curves(file, None)
    assert file.read_text() == before


def test_a_recording_can_be_replayed_up_to_the_last_whole_line(sim, tmp_path):
    file = tmp_path / "a.jsonl"
    with little_room(20_000), pytest.raises(Error, match="recording"):
        record(file, sim, count=10_000)
    with Replay(file) as replay:
        replay.run()


def test_a_world_that_breaks_down_is_reported_without_its_recording(tmp_path):
    with gazelle.Simulation(
        "shapes", threads=1, on_fault="reset", fault_dump=tmp_path / "a"
    ) as sim:
        from gazelle.simulation.divergence import FaultLog

        log = FaultLog("reset", tmp_path / "a.jsonl")
        error = SimpleNamespace(
            worlds=[0], before=sim._engine.snapshot(), steps=1, message="it diverged"
        )
        with little_room(100):
            text = log.note(sim, error, 0)
    assert "it diverged" in text
    assert "a.jsonl" in text
    assert "File too large" in text
    assert log.faults[0].dump is None
    assert list(tmp_path.iterdir()) == []


def test_a_cache_that_finds_no_room_stops_nothing(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    points = np.random.default_rng(0).random((200, 3))
    faces = np.arange(198).reshape(-1, 3)
    with little_room():
        piece_cache.store("a" * 64, ([(points, faces)], 0, 0.0, True))
    assert not [each for each in tmp_path.rglob("*") if each.is_file()]
    from gazelle.ros.builtin import on_path

    with little_room(10):
        assert on_path._made(on_path._files()) is None
    assert not [each for each in tmp_path.rglob("*") if each.is_file()]


def test_a_log_of_a_node_ends_with_one_line(tmp_path, capsys):
    from gazelle.ros.compat.rospy.logs import _LogFile

    handler = _LogFile(tmp_path / "node.log", encoding="utf-8", delay=True)
    logger = logging.getLogger("a log of a node")
    logger.addHandler(handler)
    with little_room():
        for number in range(100):
            logger.warning("%d %s", number, "x" * 100)
    handler.close()
    (line,) = capsys.readouterr().err.splitlines()
    assert "node.log" in line
    assert "File too large" in line
    assert (tmp_path / "node.log").stat().st_size > 0.5 * MOST


def test_the_files_of_a_new_task_are_all_there_or_none(cli, tmp_path):
    with little_room(1200):
        code, _, err = cli("new", "task", "Balance", "--out", tmp_path)
    assert code == 1
    assert "File too large" in err
    assert "hint: " in err
    assert list(tmp_path.iterdir()) == []
    assert cli("new", "task", "Balance", "--out", tmp_path)[0] == 0
