"""Ctrl-C during training: at once when pressed again, and soon also within a long update."""

from __future__ import annotations

import math
import os
import signal
import time

import pytest
import torch

from gazelle.training import resume, train
from gazelle.training.callback import TrainingCallback
from gazelle.training.learners.ppo import FastPPO
from gazelle.training.periodic import PeriodicEvaluation
from tests.training.interrupting import StopAt, weights


@pytest.mark.long
def test_second_interrupt_stops_at_once_and_leaves_the_handler_alone(tmp_path, tiny, monkeypatch):
    monkeypatch.setattr("gazelle.training.callback._TIMEOUT_S", 60.0)

    class Impatient(StopAt):
        def update(self, done, summary):
            pressed = done >= self.steps
            super().update(done, summary)
            if pressed:
                time.sleep(2.0)  # signals that come together are one
                os.kill(os.getpid(), signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        train("test/Corridor-v0", recipe=tiny, out=tmp_path, progress=Impatient(300))
    assert signal.getsignal(signal.SIGINT) is before


@pytest.mark.parametrize("phase", ["step", "update", "evaluation"])
def test_a_stop_does_not_wait_for_a_long_update(tmp_path, tiny, monkeypatch, phase):
    """It counts what was saved before, and the resumed run ends as one without the break."""
    monkeypatch.setattr("gazelle.training.callback._TIMEOUT_S", 0.1)
    monkeypatch.setattr("gazelle.training.callback._LONG_S", 0.0)
    monkeypatch.setattr("gazelle.training.callback._SAVING_SHARE", math.inf)
    given = {"recipe": tiny, "seed": 3, "eval_every": 512}
    whole = train("test/Corridor-v0", out=tmp_path / "whole", **given)
    owner, name = {
        "step": (TrainingCallback, "_on_step"),
        "update": (FastPPO, "train"),
        "evaluation": (PeriodicEvaluation, "check"),
    }[phase]
    made = getattr(owner, name)
    slow = []

    def stuck(self, *given, **named):
        count = getattr(self, "num_timesteps", 512)
        if count >= 512 and not slow:
            slow.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(60.0)
        return made(self, *given, **named)

    monkeypatch.setattr(owner, name, stuck)
    first = train("test/Corridor-v0", out=tmp_path / "broken", **given)
    assert time.monotonic() - slow[0] < 30.0
    assert first.interrupted
    assert (
        first.steps
        == int(first.run.newest_checkpoint().name)
        == (512 if phase == "evaluation" else 384)
    )
    second = resume(first.run.folder)
    assert second.steps == whole.steps
    expected, found = weights(whole), weights(second)
    assert all(torch.equal(expected[key], found[key]) for key in expected)
    rows = [(each.run.folder / "evaluations.csv").read_text() for each in (whole, second)]
    assert rows[0] == rows[1]
