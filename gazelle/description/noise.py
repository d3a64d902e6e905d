"""Noise of a sensor channel, as SDF describes it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from gazelle.description.nan_refusal import refuses_nan

NoiseType = Literal["none", "gaussian", "gaussian_quantized"]


@refuses_nan
@dataclass(frozen=True, slots=True)
class Noise:
    """Additive noise, in the unit of the channel it is on.

    Attributes:
        type: ``gaussian_quantized`` rounds the result to a multiple of ``precision``.
        mean: Mean of the white noise.
        stddev: Standard deviation of the white noise.
        bias_mean: Mean of the constant bias, drawn once a run.
        bias_stddev: Standard deviation of that draw.
        dynamic_bias_stddev: Standard deviation of a slowly drifting bias.
        dynamic_bias_correlation_time: Time constant of its drift [s].
        precision: Step of a quantised output.
    """

    type: NoiseType = "none"
    mean: float = 0.0
    stddev: float = 0.0
    bias_mean: float = 0.0
    bias_stddev: float = 0.0
    dynamic_bias_stddev: float = 0.0
    dynamic_bias_correlation_time: float = 0.0
    precision: float = 0.0
