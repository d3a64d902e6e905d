"""Messages of an estimate of pose, velocity and acceleration."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.conversions import set_point, set_pose, set_twist
from gazelle.description import Pose
from gazelle.navigation.estimation.kalman import Estimate
from gazelle.navigation.estimation.motion import ACCELERATION, ANGULAR, LINEAR, POSE, TWIST
from gazelle_ros.builtin.diagnostics import OK, WARN, diagnostic_status
from gazelle_ros.msgs import diagnostic_msgs, geometry_msgs, nav_msgs
from gazelle_ros.time import Time

_RATE_SLACK = 0.1


def base_pose(state: Floats) -> Pose:
    """Return the pose of a state, shape (15,)."""
    return Pose(*state[POSE].tolist())


def odometry_message(estimate: Estimate, frame: str, child: str) -> nav_msgs.msg.Odometry:
    """Return an estimate as odometry of a child frame in a frame."""
    message = nav_msgs.msg.Odometry()
    message.header.stamp, message.header.frame_id = Time(nsecs=estimate.stamp), frame
    message.child_frame_id = child
    pose, state = base_pose(estimate.state), estimate.state
    set_pose(message.pose.pose, pose.position, pose.quaternion)
    set_twist(message.twist.twist, state[LINEAR], state[ANGULAR])
    message.pose.covariance = estimate.covariance[POSE, POSE].ravel().tolist()
    message.twist.covariance = estimate.covariance[TWIST, TWIST].ravel().tolist()
    return message


def acceleration_message(
    estimate: Estimate, frame: str, turning: Floats, interval: float
) -> geometry_msgs.msg.AccelWithCovarianceStamped:
    """Return the accelerations of an estimate.

    Args:
        estimate: With linear accelerations.
        frame: In which they are given.
        turning: Angular acceleration, shape (3,) [rad/s^2].
        interval: Time over which it was differentiated [s].
    """
    message = geometry_msgs.msg.AccelWithCovarianceStamped()
    message.header.stamp, message.header.frame_id = Time(nsecs=estimate.stamp), frame
    set_point(message.accel.accel.linear, estimate.state[ACCELERATION])
    set_point(message.accel.accel.angular, turning)
    spread = np.zeros((6, 6))
    spread[:3, :3] = estimate.covariance[ACCELERATION, ACCELERATION]
    spread[3:, 3:] = 2.0 / interval**2 * estimate.covariance[ANGULAR, ANGULAR]
    message.accel.covariance = spread.ravel().tolist()
    return message


def diagnostics_message(
    name: str, now: int, warnings: Mapping[str, str], rate: float, target_rate: float
) -> diagnostic_msgs.msg.DiagnosticArray:
    """Return the diagnostics of a filter.

    Args:
        name: Of the node.
        now: [ns].
        warnings: Since the last diagnostics, by source.
        rate: Estimates per second.
        target_rate: The same by its parameter.
    """
    text = "; ".join(f"{key}: {each}" for key, each in warnings.items()) or "ok"
    slow = rate < (1.0 - _RATE_SLACK) * (target_rate - 2.0)
    rates = {"Actual frequency (Hz)": f"{rate:.3f}", "Target frequency (Hz)": f"{target_rate:g}"}
    found = "Frequency too low." if slow else "Desired frequency met"
    made = diagnostic_msgs.msg.DiagnosticArray(
        status=[
            diagnostic_status(
                f"{name}: Filter diagnostic updater", warnings, text, WARN if warnings else OK
            ),
            diagnostic_status(
                f"{name}: odometry/filtered topic status", rates, found, WARN if slow else OK
            ),
        ]
    )
    made.header.stamp = Time(nsecs=now)
    return made
