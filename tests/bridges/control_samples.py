"""Random values of every kind that controllers publish, and what their messages have to say."""

import numpy as np
import pytest

from gazelle.control.values import (
    FourWheelOdometry,
    ImuSample,
    JointControlState,
    JointSample,
    PidStatus,
    StampedTwist,
    StampedWrench,
    TrajectoryState,
)

FRAMES = ("odom", "/map", "base_link")


def _frame(rng):
    return str(rng.choice(FRAMES))


def _sample(rng, nworld, count):
    values = rng.normal(size=(3, nworld, count))
    return JointSample(values[0], values[1], values[2] if rng.random() < 0.5 else None)


def trajectory_state(rng, nworld, stamp):
    count = int(rng.integers(0, 4))
    samples = (_sample(rng, nworld, count) for _ in range(3))
    names = tuple(f"joint{i}" for i in range(count))
    return TrajectoryState(stamp, names, *samples, rng.uniform(0.0, 9.0, nworld))


def joint_state(rng, nworld, stamp):
    arrays = rng.normal(size=(5, nworld))
    gains = rng.normal(size=4).tolist()
    step = float(rng.random())
    return JointControlState(stamp, *arrays[:4], step, arrays[4], *gains, bool(rng.random() < 0.5))


def pid_status(rng, nworld, stamp):
    arrays = rng.normal(size=(9, nworld))
    bounds = rng.normal(size=2).tolist()
    return PidStatus(stamp, float(rng.random()), *arrays[:8], *bounds, arrays[8])


def twist(rng, nworld, stamp):
    return StampedTwist(stamp, _frame(rng), *rng.normal(size=(2, nworld, 3)))


def four_wheels(rng, nworld, stamp):
    return FourWheelOdometry(stamp, *rng.normal(size=(3, nworld)))


def imu(rng, nworld, stamp):
    covariances = (tuple(rng.random(9).tolist()) for _ in range(3))
    vectors = rng.normal(size=(2, nworld, 3))
    return ImuSample(stamp, _frame(rng), rng.normal(size=(nworld, 4)), *vectors, *covariances)


def wrench(rng, nworld, stamp):
    return StampedWrench(stamp, _frame(rng), *rng.normal(size=(2, nworld, 3)))


CONTROL_MAKERS = {
    FourWheelOdometry: four_wheels,
    ImuSample: imu,
    JointControlState: joint_state,
    PidStatus: pid_status,
    StampedTwist: twist,
    StampedWrench: wrench,
    TrajectoryState: trajectory_state,
}


def _xyz(message):
    return [message.x, message.y, message.z]


def says_trajectory(message, value, world, _view):
    assert message.joint_names == list(value.names)
    for field in ("desired", "actual", "error"):
        point, sample = getattr(message, field), getattr(value, field)
        assert list(point.positions) == list(sample.positions[world])
        assert list(point.velocities) == list(sample.velocities[world])
        wanted = [] if sample.accelerations is None else list(sample.accelerations[world])
        assert list(point.accelerations) == wanted
        assert point.effort == ()
        since = point.time_from_start.to_sec()
        assert since == pytest.approx(value.time_from_start[world], abs=1e-9)


def _says_numbers(*fields):
    def look(message, value, world, _view):
        for field in fields:
            found = getattr(value, field)
            assert getattr(message, field) == (found if np.isscalar(found) else found[world])

    return look


def says_joint(message, value, world, view):
    states = ("set_point", "process_value", "process_value_dot", "error", "command")
    _says_numbers(*states, "time_step", "p", "i", "d", "i_clamp", "antiwindup")(
        message, value, world, view
    )


def says_pid(message, value, world, view):
    shares = tuple(f"{name}_{what}" for name in "pid" for what in ("error", "term"))
    others = ("error", "error_dot", "i_max", "i_min", "output")
    _says_numbers(*shares, *others)(message, value, world, view)
    assert message.timestep.to_sec() == pytest.approx(value.time_step, abs=1e-9)


def says_twist(message, value, world, _view):
    assert _xyz(message.twist.linear) == list(value.linear[world])
    assert _xyz(message.twist.angular) == list(value.angular[world])


def says_four_wheels(message, value, world, _view):
    told = (message.data.front_steering_angle, message.data.rear_steering_angle, message.data.speed)
    wanted = (value.front_angle[world], value.rear_angle[world], value.speed[world])
    assert told == pytest.approx(wanted, rel=1e-6)


def says_imu(message, value, world, _view):
    turn = message.orientation
    assert [*_xyz(turn), turn.w] == list(value.quaternion[world])
    for part in ("angular_velocity", "linear_acceleration"):
        assert _xyz(getattr(message, part)) == list(getattr(value, part)[world])
    for part in ("orientation", "angular_velocity", "linear_acceleration"):
        name = f"{part}_covariance"
        assert tuple(getattr(message, name)) == getattr(value, name)


def says_wrench(message, value, world, _view):
    assert _xyz(message.wrench.force) == list(value.force[world])
    assert _xyz(message.wrench.torque) == list(value.torque[world])


CONTROL_SAYS = {
    FourWheelOdometry: says_four_wheels,
    ImuSample: says_imu,
    JointControlState: says_joint,
    PidStatus: says_pid,
    StampedTwist: says_twist,
    StampedWrench: says_wrench,
    TrajectoryState: says_trajectory,
}
