"""Errors of environments that are used out of turn; each is also Gymnasium's error of its kind."""

from __future__ import annotations

import gymnasium as gym

from gazelle.errors import TaskError


class ResetNeededError(TaskError, gym.error.ResetNeeded):
    """An environment has to be reset before this."""


class ClosedEnvError(TaskError, gym.error.ClosedEnvironmentError):
    """An environment was closed before this."""


def check_open(what: str, *, closed: bool) -> None:
    """Raise ClosedEnvError if the environment is closed."""
    if closed:
        raise ClosedEnvError(f"{what} after close()", hint="make a new environment")


def check_ready(what: str, *, closed: bool, begun: bool) -> None:
    """Raise ClosedEnvError or ResetNeededError unless an episode continues."""
    check_open(what, closed=closed)
    if not begun:
        raise ResetNeededError(f"{what} before the first reset()", hint="call reset() first")
