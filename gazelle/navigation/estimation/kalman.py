"""Kalman filter of a robot's pose, velocity and acceleration: the laws of ``robot_localization``."""

from __future__ import annotations

import dataclasses
import logging
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from gazelle.argument_checks import checked
from gazelle.array_types import Bools, Floats
from gazelle.engines.limits import NANOSECONDS
from gazelle.errors import Error
from gazelle.navigation.angles import wrapped_all
from gazelle.navigation.estimation.control import ControlModel, StampedCommand
from gazelle.navigation.estimation.motion import (
    ACCELERATION,
    ANGLES,
    ANGULAR,
    POSE,
    SIZE,
    TWIST,
)

PROCESS_NOISE = np.diag(
    (0.05, 0.05, 0.06, 0.03, 0.03, 0.06, 0.025, 0.025, 0.04, 0.01, 0.01, 0.02, 0.01, 0.01, 0.015)
)
"""Growth of the covariance per second, where no other is given."""
INITIAL_VARIANCE = 1e-9
_LEAST_VARIANCE = 1e-9
"""Of a measurement; below it the gain would be ill conditioned."""
_LONGEST_STEP_S = 1e5
_SHORT_STEP_S = 0.01
_LOG = logging.getLogger(__name__)


@dataclass(frozen=True, slots=True)
class Measurement:
    """Measured elements of the state.

    Attributes:
        source: Its name, for messages.
        stamp: [ns].
        values: Shape (15,).
        covariance: Shape (15, 15).
        used: Elements that are measured, shape (15,).
        threshold: Greatest Mahalanobis distance from the estimate at which it counts.
        command: Latest command when it came, for the case that it is processed again.
    """

    source: str
    stamp: int
    values: Floats
    covariance: Floats
    used: Bools
    threshold: float = np.inf
    command: StampedCommand | None = None

    def __post_init__(self) -> None:
        if not abs(self.threshold) >= 0.0:
            raise Error(
                f"the threshold of '{self.source}' must be a number, not {self.threshold!r:.60}"
            )


@dataclass(frozen=True, slots=True)
class Estimate:
    """State of a filter at a time.

    Attributes:
        state: Shape (15,).
        covariance: Shape (15, 15).
        stamp: [ns].
        command: Latest one.
    """

    state: Floats
    covariance: Floats
    stamp: int
    command: StampedCommand


class Prediction(Protocol):
    """Law by which an estimate moves on."""

    def predict(self, state: Floats, covariance: Floats, seconds: float) -> tuple[Floats, Floats]:
        """Return state and covariance after a time [s], without process noise."""


@checked(Error, after=True)
class KalmanFilter:
    """Estimate of 15 elements from measurements of some of them.

    What sensors measure are elements of the state themselves, and the unscented transform of a linear
    function is exact. So the extended and the unscented filter differ in their prediction alone.

    Args:
        prediction: Extended or unscented.
        process_noise: Growth of the covariance, shape (15, 15) [per s].
        initial_state: Shape (15,).
        initial_covariance: Shape (15, 15).
        control: Response to commands; None if they are not used.
        dynamic_noise: Scale the process noise of the pose by the square of the speed.

    Attributes:
        estimate: State, covariance and their time.
        initialised: Whether there was a measurement.
    """

    def __init__(
        self,
        prediction: Prediction,
        *,
        process_noise: Floats = PROCESS_NOISE,
        initial_state: Floats | None = None,
        initial_covariance: Floats | None = None,
        control: ControlModel | None = None,
        dynamic_noise: bool = False,
    ) -> None:
        self._prediction = prediction
        self._noise = process_noise
        state = np.zeros(SIZE) if initial_state is None else np.array(initial_state, float)
        covariance = INITIAL_VARIANCE * np.eye(SIZE)
        if initial_covariance is not None:
            covariance = np.array(initial_covariance, float)
        self._control = control
        self._dynamic_noise = dynamic_noise
        self._begin = Estimate(state, covariance, 0, StampedCommand())
        self.reset()

    def reset(self) -> None:
        """Return to the estimate before the first measurement."""
        self.estimate = self._begin
        self.initialised = False

    def command(self, command: StampedCommand) -> None:
        """Set the latest command."""
        self.estimate = dataclasses.replace(self.estimate, command=command)

    def process(self, measurement: Measurement) -> bool:
        """Move on to a measurement's time and correct by it; returns False if it was rejected.

        One that is older than the estimate corrects it without a prediction. The first one sets the
        elements that it measures.
        """
        index = _finite(measurement)
        if not self.initialised:
            self._initialise(measurement, index)
            return True
        if measurement.stamp > self.estimate.stamp:
            self.predict(measurement.stamp)
        return self._correct(measurement, index)

    def predict(self, stamp: int) -> None:
        """Move the estimate on to a time [ns]."""
        before = self.estimate
        seconds = (stamp - before.stamp) / NANOSECONDS
        if seconds > _LONGEST_STEP_S:
            seconds = _SHORT_STEP_S  # the clock began between the two
        state = self._controlled(before.state, stamp, seconds)
        state, covariance = self._prediction.predict(state, before.covariance, seconds)
        state[ANGLES] = wrapped_all(state[ANGLES])
        covariance = covariance + seconds * self._process_noise(state)
        self.estimate = Estimate(state, covariance, stamp, before.command)

    def _initialise(self, measurement: Measurement, index: NDArray[np.intp]) -> None:
        before = self.estimate
        state, covariance = before.state.copy(), before.covariance.copy()
        state[index] = measurement.values[index]
        covariance[np.ix_(index, index)] = _noise(measurement, index)
        self.estimate = Estimate(state, covariance, measurement.stamp, before.command)
        self.initialised = True

    def _controlled(self, state: Floats, stamp: int, seconds: float) -> Floats:
        """Return the state with the accelerations that commands cause."""
        if self._control is None:
            return state
        command = self.estimate.command
        late = abs(stamp - command.stamp) >= self._control.timeout * NANOSECONDS
        commanded = np.zeros(6) if late else command.velocities
        caused = self._control.acceleration(state, commanded)
        state = state.copy()
        state[ANGULAR] += seconds * caused[3:]
        state[ACCELERATION] = np.where(self._control.used[:3], caused[:3], state[ACCELERATION])
        return state

    def _process_noise(self, state: Floats) -> Floats:
        if not self._dynamic_noise:
            return self._noise
        noise = self._noise.copy()
        noise[POSE, POSE] *= float(state[TWIST] @ state[TWIST])
        return noise

    def _correct(self, measurement: Measurement, index: NDArray[np.intp]) -> bool:
        before = self.estimate
        if not len(index):
            return False
        innovation = measurement.values[index] - before.state[index]
        angles = (index >= ANGLES.start) & (index < ANGLES.stop)
        innovation[angles] = wrapped_all(innovation[angles])
        noise = _noise(measurement, index)
        across = before.covariance[:, index]
        try:
            inverse = np.linalg.inv(across[index] + noise)
        except np.linalg.LinAlgError:
            _LOG.warning("%s is ignored: its covariance is singular", measurement.source)
            return False
        if innovation @ inverse @ innovation >= measurement.threshold**2:
            return False
        gain = across @ inverse
        state = before.state + gain @ innovation
        state[ANGLES] = wrapped_all(state[ANGLES])
        # Joseph's form, (I - KH) P (I - KH)' + K R K', with the selection H applied by index.
        left = before.covariance - gain @ before.covariance[index]
        covariance = left - left[:, index] @ gain.T + gain @ noise @ gain.T
        self.estimate = Estimate(
            state, 0.5 * (covariance + covariance.T), before.stamp, before.command
        )
        return True


def _finite(measurement: Measurement) -> NDArray[np.intp]:
    """Return the indices of the elements that are used and finite."""
    return np.flatnonzero(measurement.used & np.isfinite(measurement.values))


def _noise(measurement: Measurement, index: NDArray[np.intp]) -> Floats:
    """Return the covariance of elements; a variance below zero counts as positive."""
    noise = measurement.covariance[np.ix_(index, index)]
    np.fill_diagonal(noise, np.maximum(np.abs(noise.diagonal()), _LEAST_VARIANCE))
    return noise
