"""Wrong values given to trainings and evaluations are errors of Gazelle's."""

from __future__ import annotations

import math

import numpy as np
import public_samples
import pytest

from gazelle.errors import Error, TaskError
from gazelle.training import (
    GoalReward,
    OffPolicySettings,
    PPOSettings,
    SuccessRate,
    evaluate,
    export_policy,
    load_policy,
    predicted_range,
    resume,
    train,
    wilson_interval,
)

LONG = "a" * 10_000


@pytest.mark.parametrize(
    "call",
    [
        lambda: wilson_interval(math.inf, 10.0),
        lambda: wilson_interval(-1.0, 10.0),
        lambda: wilson_interval(11.0, 10.0),
        lambda: wilson_interval(1.0, 1e308),
        lambda: wilson_interval(1.0, 10**400),
        lambda: wilson_interval(1.0, 10.0, math.nan),
        lambda: wilson_interval(1.0, 10.0, 0.0),
        lambda: predicted_range([SuccessRate(1, 2)] * 2, math.nan),
        lambda: predicted_range([SuccessRate(1, 2)] * 2, 0.0),
        lambda: GoalReward(collision=math.nan),
        lambda: PPOSettings(gae_lambda=math.inf),
        lambda: OffPolicySettings(tau=math.nan),
        lambda: train("CartPoleStayUp", imports=[LONG]),
        lambda: train("CartPoleStayUp", imports=["\ud800"]),
        lambda: train("CartPoleStayUp", out=LONG),
    ],
)
def test_values_that_cannot_be(call):
    with pytest.raises(TaskError):
        call()


@pytest.mark.parametrize("path", [LONG, "\x00", "\ud800", "", "no/such", "/"])
@pytest.mark.parametrize("call", [evaluate, export_policy, load_policy, resume])
def test_paths_of_no_run(call, path):
    with pytest.raises(Error):
        call(path)


@pytest.mark.parametrize(
    "obs", [np.zeros(0), np.zeros((3, 5)), np.zeros((1, 2, 3)), np.float64(0.0)]
)
@pytest.mark.parametrize("call", ["act", "outputs"])
def test_observations_of_another_size(call, obs):
    with pytest.raises(TaskError):
        getattr(public_samples.policy(), call)(obs)
