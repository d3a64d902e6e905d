"""A progress that interrupts trainings, and what came out of them."""

from __future__ import annotations

import os
import signal

import torch

from gazelle.training.progress import NoProgress


class StopAt(NoProgress):
    """Presses Ctrl-C after some steps."""

    def __init__(self, steps):
        self.steps = steps
        self.said = []

    def update(self, done, summary):
        if done >= self.steps:
            self.steps = float("inf")
            os.kill(os.getpid(), signal.SIGINT)

    def say(self, text):
        self.said.append(text)


def weights(result):
    file = result.run.newest_checkpoint() / "learner.pt"
    return torch.load(file, weights_only=True)["modules"]["policy"]
