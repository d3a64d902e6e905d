"""Random values of every kind that ports publish."""

import numpy as np
from control_samples import CONTROL_MAKERS
from picture_samples import PICTURE_MAKERS

from gazelle.engines import Contacts, Motion, Placement
from gazelle.navigation.values import Path
from gazelle.sensors import ImuReading, LaserScan
from gazelle.simulation import JointStates, Odometry, Transform, Transforms, WrenchValue
from gazelle.simulation.values import (
    AltimeterValue,
    BumperValue,
    ChannelPoints,
    CliffValue,
    Fix,
    Flags,
    KobukiCore,
    LaserPoints,
    MagneticValue,
    PointValue,
    RangeValue,
    SonarValue,
    Touches,
    TruePose,
    UnsureImu,
    VectorValue,
)

FRAMES = ("odom", "/map", "base_link")


def _frame(rng):
    return str(rng.choice(FRAMES))


def _turns(rng, *shape):
    turns = rng.normal(size=(*shape, 4))
    return turns / np.linalg.norm(turns, axis=-1, keepdims=True)


def _six(rng):
    return tuple(rng.uniform(0.0, 2.0, 6).tolist())


def _odometry(kind):
    def make(rng, nworld, stamp):
        vectors = rng.normal(size=(3, nworld, 3))
        return kind(
            stamp,
            _frame(rng),
            _frame(rng),
            vectors[0],
            _turns(rng, nworld),
            vectors[1],
            vectors[2],
            _six(rng),
            _six(rng),
        )

    return make


def joint_states(rng, nworld, stamp):
    count = int(rng.integers(0, 4))
    values = rng.normal(size=(3, nworld, count))
    measured = values[1] if rng.random() < 0.5 else np.zeros((nworld, 0))
    names = tuple(f"joint{i}" for i in range(count))
    effort = values[2] if rng.random() < 0.5 else None
    return JointStates(stamp, names, values[0], measured, effort)


def transforms(rng, nworld, stamp):
    made = (
        Transform(_frame(rng), _frame(rng), rng.normal(size=(nworld, 3)), _turns(rng, nworld))
        for _ in range(rng.integers(0, 4))
    )
    return Transforms(stamp, tuple(made))


def scan(rng, nworld, stamp):
    ranges = rng.uniform(0.1, 9.0, (nworld, int(rng.integers(1, 9))))
    ranges[rng.random(ranges.shape) < 0.2] = np.inf
    return LaserScan(stamp, ranges, *rng.normal(size=3).tolist(), 0.1, 9.0)


def imu(rng, nworld, stamp):
    vectors = rng.normal(size=(2, nworld, 3))
    return ImuReading(stamp, _turns(rng, nworld), vectors[0], vectors[1], float(rng.random()))


def wrench(rng, nworld, stamp):
    return WrenchValue(stamp, *rng.normal(size=(2, nworld, 3)))


def touches(rng, nworld, stamp):
    def one():
        count = int(rng.integers(0, 5))
        names = (tuple(f"a::l::{rng.integers(2)}" for _ in range(count)) for _ in range(2))
        vectors = rng.normal(size=(4, count, 3))
        return Contacts(*names, vectors[0], vectors[1], rng.normal(size=count), *vectors[2:])

    return Touches(stamp, tuple(one() for _ in range(nworld)))


def _range(kind):
    def make(rng, nworld, stamp):
        limits = rng.uniform(0.1, 2.0, 3).tolist()
        return kind(stamp, rng.uniform(0.0, 9.0, nworld), *limits, bool(rng.random() < 0.5))

    return make


def path(rng, nworld, stamp):
    poses = (rng.normal(size=(int(rng.integers(0, 5)), 3)) for _ in range(nworld))
    return Path(stamp, _frame(rng), tuple(poses))


def _points(kind):
    def make(rng, nworld, stamp):
        rays = int(rng.integers(0, 7))
        return kind(
            stamp,
            rng.normal(size=(nworld, rays, 3)),
            rng.random(rays),
            rng.integers(0, 16, rays),
            rng.random((nworld, rays)) < 0.7,
        )

    return make


def unsure_imu(rng, nworld, stamp):
    return UnsureImu(imu(rng, nworld, stamp), *rng.random((3, 3)))


def fix(rng, nworld, stamp):
    places = rng.uniform(-80.0, 80.0, (3, nworld))
    status, service = int(rng.integers(-1, 3)), int(rng.integers(0, 16))
    return Fix(stamp, *places, rng.random(3), status, service)


def _vector(kind):
    return lambda rng, nworld, stamp: kind(stamp, rng.normal(size=(nworld, 3)))


def altimeter(rng, nworld, stamp):
    values = rng.uniform(0.0, 1000.0, (2, nworld))
    return AltimeterValue(stamp, values[0], values[1], 1013.25)


def cliff(rng, nworld, _stamp):
    return CliffValue(
        int(rng.integers(3)), rng.random(nworld) < 0.5, rng.uniform(0.0, 65535.0, nworld)
    )


def bumper(rng, nworld, _stamp):
    return BumperValue(int(rng.integers(3)), rng.random(nworld) < 0.5)


def kobuki_core(rng, nworld, stamp):
    pressed, deep = rng.random((2, nworld, 3)) < 0.5
    floor, angles = rng.uniform(0.0, 65535.0, (nworld, 3)), rng.uniform(-500.0, 500.0, (nworld, 2))
    return KobukiCore(stamp, pressed, deep, floor, angles)


def placement(rng, nworld, _stamp):
    return Placement(rng.normal(size=(nworld, 3)), _turns(rng, nworld))


def motion(rng, nworld, _stamp):
    return Motion(*rng.normal(size=(2, nworld, 3)))


MAKERS = {
    **CONTROL_MAKERS,
    **PICTURE_MAKERS,
    Odometry: _odometry(Odometry),
    TruePose: _odometry(TruePose),
    Placement: placement,
    Motion: motion,
    JointStates: joint_states,
    Transforms: transforms,
    LaserScan: scan,
    ImuReading: imu,
    WrenchValue: wrench,
    Touches: touches,
    RangeValue: _range(RangeValue),
    SonarValue: _range(SonarValue),
    Path: path,
    Flags: lambda rng, nworld, _stamp: Flags(rng.random(nworld) < 0.5),
    LaserPoints: _points(LaserPoints),
    ChannelPoints: _points(ChannelPoints),
    UnsureImu: unsure_imu,
    Fix: fix,
    VectorValue: _vector(VectorValue),
    MagneticValue: _vector(MagneticValue),
    PointValue: _vector(PointValue),
    AltimeterValue: altimeter,
    CliffValue: cliff,
    BumperValue: bumper,
    KobukiCore: kobuki_core,
    bool: lambda rng, _nworld, _stamp: bool(rng.random() < 0.5),
    int: lambda rng, _nworld, _stamp: int(rng.integers(-(2**31), 2**31)),
    float: lambda rng, _nworld, _stamp: float(rng.normal()),
    str: lambda rng, _nworld, _stamp: str(rng.choice(["", "up", "höher"])),
}
"""By kind: a function of random numbers, the number of worlds and a stamp [ns]."""
