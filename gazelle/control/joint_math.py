"""Steps of the control of one joint, which laws put together in one loop.

Compiled modules take what ``joint_math.pxd`` says; this is the same for Python that runs sources.
"""

from __future__ import annotations

import math


def clamp(value: float, low: float, high: float) -> float:
    """Return a value within an interval; of an empty one the upper end."""
    return min(max(value, low), high)


def pid_output(
    error: float, whole: float, rate: float, p: float, i: float, d: float, least: float, most: float
) -> float:
    """Return the output of a PID for an error, its integral and its rate.

    Args:
        error: Desired less actual value.
        whole: Its integral.
        rate: Its derivative.
        p: Gain of the error.
        i: Gain of the integral.
        d: Gain of the rate.
        least: Lower bound of the integral's term.
        most: Upper bound.
    """
    return p * error + clamp(i * whole, least, most) + d * rate


def effort_within(
    effort: float, position: float, velocity: float, lower: float, upper: float, fastest: float,
    strongest: float,
) -> float:  # fmt: skip
    """Return the effort within hard limits; beyond a limit only effort that leads back."""
    low = 0.0 if velocity < -fastest or position < lower else -strongest
    high = 0.0 if velocity > fastest or position > upper else strongest
    return clamp(effort, low, high)


def finite(value: float) -> float:
    """Return an effort, or 0 for what would end the world."""
    return value if math.isfinite(value) else 0.0
