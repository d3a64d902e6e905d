"""Failed episodes as a table, as JSON and as a picture."""

from __future__ import annotations

import csv
import json

import numpy as np
import pytest
from PIL import Image

from gazelle.cli.failures import save_failures
from gazelle.envs import FloorPlan
from gazelle.errors import TaskError
from gazelle.training import Actor, EpisodeRecord, Evaluation, SuccessRate, evaluate
from gazelle.viewer.failures import draw_failures

RED, INK = (206, 62, 52), (60, 60, 66)


@pytest.fixture(scope="module")
def found():
    """Return the failures of driving straight on."""
    bias = np.array([0.0, 0.0, 1.0, 0.0, 0.0], np.float32)
    straight = Actor((np.zeros((26, 5), np.float32),), (bias,), "tanh", "categorical")
    return evaluate(straight, task="TurtleBot3Stage1", engine="planar", episodes=60)


def test_the_table_has_a_row_for_each(found, tmp_path):
    save_failures(found, tmp_path / "failed.csv")
    rows = list(csv.DictReader((tmp_path / "failed.csv").open()))
    assert len(rows) == found.collision.count > 40
    for row in rows:
        assert row["outcome"] == "collision"
        start, end = (
            np.array([float(row[f"{name}_{axis}"]) for axis in "xy"])
            for name in ("start", "position")
        )
        heading = float(row["start_heading"])
        # Straight on: the end lies ahead of the start, and at a wall.
        ahead = np.arctan2(*(end - start)[::-1])
        if np.hypot(*(end - start)) > 0.3:
            assert abs(np.angle(np.exp(1j * (ahead - heading)))) < 0.05
        assert np.abs(end).max() > 1.6


def test_json_counts_them_goal_by_goal(found, tmp_path):
    save_failures(found, tmp_path / "failed.json")
    told = json.loads((tmp_path / "failed.json").read_text())
    assert len(told["failures"]) == sum(goal["failed"] for goal in told["goals"])
    assert sum(goal["tried"] for goal in told["goals"]) == told["episodes"] == 60
    counts = [goal["failed"] for goal in told["goals"]]
    assert counts == sorted(counts, reverse=True)


def test_nothing_failed_is_an_empty_table(tmp_path):
    save_failures(evaluation(()), tmp_path / "none.csv")
    assert (tmp_path / "none.csv").read_text().split() == ["outcome"]


def record(outcome, **info):
    ends = tuple(int(outcome == name) for name in ("collision", "time-out", "other"))
    return EpisodeRecord(outcome, 0, 7, -1.0, {"start_x": 0.0, "start_y": 0.0}, info, ends, 0, True)


def evaluation(records, plan=None):
    rate = SuccessRate(0, max(len(records), 1))
    return Evaluation(
        "test/T-v0", len(records), len(records), 0, rate, rate, rate, rate, 0.0, 0.0, 1.0, None,
        records, plan,
    )  # fmt: skip


def test_the_picture_shows_where_they_ended(tmp_path):
    """In a room of 4 m by 2 m, at (1.5, 0.5): to the right, and above the middle."""
    corners = [(-2, -1), (2, -1), (2, 1), (-2, 1)]
    walls = [(*a, *b) for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
    plan = FloorPlan(np.array(walls, float), np.array([[-1.0, 0.0, 0.3]]))
    failed = record("collision", position=(1.5, 0.5), goal=(1.5, 0.9))
    save_failures(evaluation((failed, failed), plan), tmp_path / "failed.png")
    picture = np.asarray(Image.open(tmp_path / "failed.png"))[75:]
    height, width, _ = picture.shape
    assert width == pytest.approx(2 * height, rel=0.15)
    dots = np.argwhere((np.abs(picture.astype(int) - RED) < 30).all(axis=2))
    middle = np.median(dots[dots[:, 1] > 0.7 * width], axis=0)
    assert middle[1] / width == pytest.approx(3.5 / 4.0, abs=0.04)
    assert middle[0] / height == pytest.approx(0.5 / 2.0, abs=0.12)
    pillar = np.argwhere((np.abs(picture.astype(int) - INK) < 20).all(axis=2))
    inside = np.abs(pillar / [height, width] - [0.5, 0.25]).max(axis=1) < 0.06
    assert inside.sum() > 500


def test_a_task_without_places_cannot_be_drawn():
    blind = EpisodeRecord("collision", 0, 7, -1.0, {}, {}, (1, 0, 0), 0, True)
    with pytest.raises(TaskError, match="neither position nor goal"):
        draw_failures(evaluation((blind,)))


@pytest.mark.parametrize(
    ("file", "complaint"),
    [("failed.txt", ".csv, .json, .png"), ("no/such/failed.csv", "no folder")],
)
def test_a_file_that_cannot_be_is_a_wrong_command_line(cli, file, complaint):
    code, _, err = cli("eval", "runs/x", "--failures", file)
    assert code == 2
    assert complaint in err
