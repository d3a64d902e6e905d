"""Python calls that write: without room each is one error that names the file, and nothing is lost.

The limit of file sizes stands for a full disk: it needs no mount.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from types import SimpleNamespace

import numpy as np
import pytest

import gazelle
from gazelle.errors import Error
from gazelle.geometry import piece_cache
from gazelle.simulation import Replay
from gazelle_ros.messages import load_message

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
    from gazelle_ros.bags import Bag

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


def rows_of_a_study(file, _sim):
    from gazelle.training.study import Study, _Table

    table = _Table(file, Study(function="a:run", vary={}, seeds=100))
    try:
        for number in range(100):
            table.add({"seed": number, "text": "x" * 100})
    finally:
        table.close()


def publish_rates(file, _sim):
    from gazelle.training.claims import read_claims

    read_claims().write(file)


def film(file, _sim):
    from gazelle.viewer.film_files import write_film

    pictures = np.random.default_rng(0).integers(0, 256, (3, 64, 64, 3), np.uint8)
    write_film(file, pictures, 10.0)


def remember_joints(file, _sim):
    from gazelle.drop_in.moveit_commander.interpreter import (
        MoveGroupCommandInterpreter,
    )

    group = SimpleNamespace(
        get_remembered_joint_values=lambda: {f"p{n}": [0.0] for n in range(999)}
    )
    interpreter = object.__new__(MoveGroupCommandInterpreter)  # a whole one needs a robot
    interpreter._groups = {"arm": group}
    _, text = interpreter.execute(f"save {file}")  # a warning, as of the original
    raise Error(text)


GROWING = [record, write_bag, log_interventions, whole_curves, rows_of_a_study]
WHOLE = [save_model, save_actor, publish_rates, film, remember_joints]
SUFFIXES = {
    write_bag: ".bag",
    save_model: ".sdf",
    save_actor: ".npz",
    whole_curves: ".csv",
    rows_of_a_study: ".csv",
    publish_rates: ".yaml",
    film: ".gif",
}


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


@pytest.mark.parametrize("write", [log_interventions, whole_curves, rows_of_a_study])
@pytest.mark.parametrize("most", [1500, 2000, 3001])
def test_what_grows_by_lines_has_no_half_of_one(write, most, sim, tmp_path):
    file = tmp_path / "a.csv"
    with little_room(most), pytest.raises((Error, OSError)):
        write(file, sim)
    text = file.read_text()
    assert text.endswith("\n")
    assert most - 300 < len(text) <= most


@pytest.mark.parametrize("most", [0, 10])
def test_a_study_without_room_for_a_row_leaves_no_empty_table(most, tmp_path):
    file = tmp_path / "a.csv"
    with little_room(most), pytest.raises(OSError, match="File too large"):
        rows_of_a_study(file, None)
    assert list(tmp_path.iterdir()) == []
    file.touch()
    with little_room(most), pytest.raises(OSError, match="File too large"):
        rows_of_a_study(file, None)
    assert file.read_bytes() == b"", "it was there before"


@pytest.mark.long
def test_a_run_without_room_leaves_no_folder(cli, tmp_path):
    with little_room(20):
        code, _, err = cli("train", "CartPoleStayUp", "--steps", 10, "--out", tmp_path)
    assert code == 1
    assert "cannot write the run" in err
    assert list(tmp_path.iterdir()) == []


def steps_of(table):
    for step in range(1000):
        table.write({"a/loss": 0.5, "b": step}, {"a/loss": None, "b": None}, step)


@pytest.mark.parametrize("most", [40, 1500, 2000, 3001])
def test_curves_for_tensorboard_are_written_by_whole_records(most, tmp_path, capfd):
    from gazelle.training.event_files import EventTable, _records

    before = threading.active_count()
    table = EventTable(tmp_path)
    (file,) = tmp_path.iterdir()
    with little_room(most), pytest.raises(OSError, match="File too large") as raised:
        steps_of(table)
    table.close()
    assert raised.value.filename == str(file)
    data = file.read_bytes()
    assert data == b"".join(record for record, _ in _records(data))
    assert most - 100 < len(data) <= most or most < 100
    assert (threading.active_count(), capfd.readouterr().err) == (before, "")


def test_tensorboard_reads_the_curves(tmp_path):
    reading = pytest.importorskip("tensorboard.backend.event_processing.event_accumulator")
    from gazelle.training.event_files import EventTable

    table = EventTable(tmp_path)
    for step in (5, 10):
        values = {"loss": np.float32(0.5 * step), "count": step, "note": "good", "hidden": 1.0}
        table.write(values, dict.fromkeys(values) | {"hidden": ("tensorboard",)}, step)
    table.close()
    found = reading.EventAccumulator(str(tmp_path)).Reload()
    assert found.Tags()["scalars"] == ["count", "loss"]
    assert [(each.step, each.value) for each in found.Scalars("loss")] == [(5, 2.5), (10, 5.0)]
    assert found.Tags()["tensors"] == ["note/text_summary"]


def test_evaluations_of_a_training_are_kept_by_whole_rows(tmp_path):
    from gazelle.training.periodic import PeriodicEvaluation

    share = SimpleNamespace(value=0.5)
    found = SimpleNamespace(
        success=share, collision=share, timeout=share, mean_return=1.0, mean_length=2.0
    )
    evaluations = PeriodicEvaluation(SimpleNamespace(folder=tmp_path))
    file = tmp_path / "evaluations.csv"
    with little_room(), pytest.raises(OSError, match="File too large") as raised:
        [evaluations._add_row(found, step, best=False) for step in range(1000)]
    assert raised.value.filename == str(file)
    assert file.read_text().endswith("2.0,0\n")
    evaluations.set_state({"evaluated_at": 3, "best": None}, 3)
    assert len(file.read_text().splitlines()) == 5


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
    from gazelle_ros.builtin import on_path

    with little_room(10):
        assert on_path._made(on_path._files()) is None
    assert not [each for each in tmp_path.rglob("*") if each.is_file()]


def test_a_log_of_a_node_ends_with_one_line(tmp_path, capsys):
    from gazelle_ros.compat.rospy.logs import _LogFile

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
