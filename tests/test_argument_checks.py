"""Arguments that make no sense anywhere are refused before anything is computed."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import ArrayLike

from gazelle.argument_checks import checked
from gazelle.description import JointAxis, Pose, Vector3
from gazelle.errors import PlanningError
from gazelle.native.fair_lock import FairLock, locked
from gazelle.sensors import LaserScan


@checked(PlanningError)
def measure(
    length: float = 1.0,
    most: float = math.inf,
    *,
    at: Vector3 = (0.0, 0.0, 0.0),
    points: ArrayLike = (),
    name: str = "",
    seed: int = 0,
    **options: float,
):
    """Return a length."""
    return length + np.asarray(points, float).reshape(-1, 2).sum()


@checked(PlanningError)
@dataclass(frozen=True, slots=True)
class Span:
    """A span."""

    low: float
    high: float = 1.0

    def scaled(self, factor: float) -> float:
        return factor * (self.high - self.low)

    @classmethod
    def about(cls, middle: float) -> Span:
        return cls(middle - 1.0, middle + 1.0)


@dataclass(frozen=True)
class Plain:
    """A dataclass that checks nothing itself."""

    width: float = 1.0
    reach: float = math.inf


@checked(PlanningError)
def place(
    pose: Pose | None = None,
    *,
    poses: Sequence[Pose] = (),
    line: Sequence[tuple[float, float]] = (),
    color: tuple[float, float, float] = (0.0, 0.0, 0.0),
    plain: Plain | JointAxis | None = None,
):
    """Return a count."""
    return len(poses) + len(line)


@pytest.mark.parametrize(
    "wrong",
    [
        *({"length": value} for value in (math.nan, math.inf, -math.inf, 1e308, 10**400)),
        *({"length": value} for value in (Fraction(10**400), np.longdouble("1e400"))),
        *({"at": value} for value in ((0.0, math.nan, 0.0), (1.0, 2.0), (), 1.0, ("a",) * 3)),
        *({"points": value} for value in ([math.nan, 0.0], [[0.0], [1.0, 2.0]], [1j, 1j], "a")),
        *({"name": value} for value in ("\x00", "a\ud800")),
        *({"other": math.nan}, {"most": math.nan}, {"points": np.array([[math.inf, 0.0]])}),
    ],
)
def test_an_argument_that_cannot_be_is_named(wrong):
    with pytest.raises(PlanningError, match=f"'{next(iter(wrong))}' must be "):
        measure(**wrong)


@checked(PlanningError)
def read(file: str | Path, others: Sequence[str | Path] = ()):
    """Return a name."""
    return Path(file).name


@pytest.mark.parametrize("path", ["a" * 256, "a/" * 3000, Path("a" * 300), "\x00", "\ud800"])
def test_a_path_that_no_file_can_have_is_refused(path):
    with pytest.raises(PlanningError, match="'file' must be"):
        read(path)
    assert read("a/b") == "b"


@pytest.mark.parametrize(
    "wrong",
    [
        *({"pose": pose} for pose in (Pose(math.nan), Pose(0.0, -math.inf), Pose(yaw=math.nan))),
        *({"poses": [Pose(), pose]} for pose in (Pose(z=math.nan), Pose(1e308))),
        *({"line": value} for value in ([()], [(0.0,)], [(0.0, 1.0), (0.0, 1.0, 2.0)])),
        *({"color": value} for value in ((1.0, 1.0), (1.0,) * 4, 0.5)),
        *({"plain": Plain(math.nan)}, {"plain": Plain(-math.inf)}),
    ],
)
def test_what_is_inside_of_an_argument_is_checked(wrong):
    with pytest.raises(PlanningError, match=f"'{next(iter(wrong))}' must be "):
        place(**wrong)


def test_numbers_that_are_infinite_by_default_may_be():
    assert place(Pose(1.0), plain=Plain()) == 0
    assert place(poses=[Pose()], line=[(0.0, 1.0)], plain=JointAxis()) == 2


def test_arrays_of_shapes_that_do_not_fit_are_refused():
    with pytest.raises(PlanningError, match="measure cannot take these values"):
        measure(points=[1.0, 2.0, 3.0])


def test_what_can_be_is_taken_as_it_is():
    assert measure(2.0, math.inf, at=(1, 2, 3), points=[1.0, 2.0], name="a", seed=2**127) == 5.0
    assert measure(points=np.ones((2, 2)), other=3) == 5.0


def test_classes_check_what_they_are_made_of_and_their_methods_arguments():
    for make in (lambda: Span(math.nan), lambda: Span(0.0, high=math.inf)):
        with pytest.raises(PlanningError, match="must be a finite number up to"):
            make()
    with pytest.raises(PlanningError, match="'factor' must be"):
        Span(0.0).scaled(math.nan)
    with pytest.raises(PlanningError, match="'middle' must be"):
        Span.about(math.nan)
    assert Span.about(1.0) == Span(0.0, 2.0)
    assert Span(0.0).scaled(3.0) == 3.0


def test_measurements_may_hold_infinite_numbers():
    @checked(PlanningError)
    def take(scan: LaserScan) -> float:
        return scan.range_max

    scan = LaserScan(0, np.array([1.0, np.inf, -np.inf]), -1.0, 1.0, 1.0, 0.1, np.inf)
    assert take(scan) == np.inf


def test_methods_that_hold_a_lock_are_checked_too():
    @checked(PlanningError)
    class Kept:
        _lock = FairLock()

        @locked
        def double(self, value: float) -> float:
            """Return twice a value."""
            return 2.0 * value

    assert Kept().double(2.0) == 4.0
    with pytest.raises(PlanningError):
        Kept().double(math.nan)
