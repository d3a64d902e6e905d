"""Measurements in the order of their times, also when they come late."""

from __future__ import annotations

import heapq
import logging
from collections import deque

from gazelle.navigation.estimation.kalman import Estimate, KalmanFilter, Measurement

_LOG = logging.getLogger(__name__)


class FusionTimeline:
    """Queue of measurements, and the filter's past for those that come late.

    Args:
        kalman: Filter that processes them.
        sensor_timeout: Time without a measurement after which the filter predicts [ns].
        predict_to_now: Predict to the present after the last measurement.
        smooth: Go back for measurements that are older than the estimate.
        history: Time that the past is kept [ns].
    """

    def __init__(
        self,
        kalman: KalmanFilter,
        *,
        sensor_timeout: int,
        predict_to_now: bool = False,
        smooth: bool = False,
        history: int = 0,
    ) -> None:
        self._kalman = kalman
        self._timeout, self._predict_to_now = sensor_timeout, predict_to_now
        self._smooth, self._history = smooth, history
        self._queue: list[tuple[int, int, Measurement]] = []
        self._count = 0
        self._warned = False
        self._estimates: deque[Estimate] = deque()
        self._measurements: deque[Measurement] = deque()

    def add(self, measurement: Measurement) -> None:
        """Queue a measurement."""
        self._count += 1
        heapq.heappush(self._queue, (measurement.stamp, self._count, measurement))

    def clear(self) -> None:
        """Discard the queue and the past."""
        self._queue.clear()
        self._estimates.clear()
        self._measurements.clear()

    def discard_queue(self) -> None:
        """Discard measurements that were not processed yet."""
        self._queue.clear()

    def integrate(self, now: int) -> None:
        """Process all measurements up to a time [ns], and predict where there is none."""
        kalman = self._kalman
        processed = self._process(now)
        silent = not processed and now - kalman.estimate.stamp >= self._timeout
        due = self._predict_to_now or silent
        if kalman.initialised and due and now > kalman.estimate.stamp:
            kalman.predict(now)
        self._expire()

    def _process(self, now: int) -> bool:
        if not self._queue or self._queue[0][0] > now:
            return False
        kalman = self._kalman
        again = self._smooth and self._queue[0][0] < kalman.estimate.stamp
        latest = kalman.estimate.command
        if again:
            self._revert(self._queue[0][2])
        while self._queue and self._queue[0][0] <= now:
            measurement = heapq.heappop(self._queue)[2]
            if again and measurement.command is not None:
                kalman.command(measurement.command)
            kalman.process(measurement)
            if self._smooth:
                self._measurements.append(measurement)
                if not self._queue or self._queue[0][0] != measurement.stamp:
                    self._estimates.append(kalman.estimate)
        if again:
            kalman.command(latest)
        return True

    def _revert(self, late: Measurement) -> None:
        """Return to the last estimate before a measurement, and queue what came since."""
        estimate = None
        while self._estimates and self._estimates[-1].stamp >= late.stamp:
            estimate = self._estimates.pop()
        if self._estimates:
            estimate = self._estimates[-1]
        elif not self._warned:
            self._warned = True
            _LOG.warning(
                "a measurement of %s is older than what is kept: history_length is too short",
                late.source,
            )
        if estimate is None:
            return
        self._kalman.estimate = estimate
        while self._measurements and self._measurements[-1].stamp > estimate.stamp:
            self.add(self._measurements.pop())

    def _expire(self) -> None:
        oldest = self._kalman.estimate.stamp - self._history
        while self._estimates and self._estimates[0].stamp < oldest:
            self._estimates.popleft()
        while self._measurements and self._measurements[0].stamp < oldest:
            self._measurements.popleft()
