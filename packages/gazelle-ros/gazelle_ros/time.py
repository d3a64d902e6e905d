"""ROS 1 time values: seconds and nanoseconds, exact, with the arithmetic of genpy.

The semantics are those of the public genpy 0.6 API (``genpy.Time``, ``genpy.Duration``).
"""

from __future__ import annotations

import numbers
from typing import Any, ClassVar, Self, overload

from gazelle_ros.errors import NoTimeError

_NSEC = 1_000_000_000
Number = Any
"""An int or a float, also one of numpy's."""


def _canonical(secs: int, nsecs: int) -> tuple[int, int]:
    """Return seconds and nanoseconds in the form ``0 <= nsecs < 1e9``."""
    carry, nsecs = divmod(nsecs, _NSEC)
    return secs + carry, nsecs


def _split(seconds: float) -> tuple[int, int]:
    """Return whole seconds and the nanoseconds left over, both rounded towards zero."""
    try:
        secs = int(seconds)
    except (OverflowError, ValueError) as error:
        raise NoTimeError(
            f"a time in seconds must be a finite number, not {seconds!r:.60}"
        ) from error
    return secs, int((seconds - secs) * _NSEC)


class TVal:
    """A number of seconds and nanoseconds; the base of `Time` and `Duration`.

    Args:
        secs: Seconds [s]; a float is split, and then ``nsecs`` must be 0.
        nsecs: Nanoseconds [ns]; whole seconds in it are carried over.

    Raises:
        ValueError: Seconds as a float and nanoseconds were both given.
        NoTimeError: Seconds are not finite.
    """

    __slots__ = ["secs", "nsecs"]  # noqa: RUF023  # the order of the fields
    _slot_types: ClassVar[list[str]] = ["int32", "int32"]

    secs: int
    nsecs: int

    def __init__(self, secs: Number = 0, nsecs: Number = 0) -> None:
        if type(secs) is int or isinstance(secs, numbers.Integral):
            whole, rest = int(secs), int(nsecs)
        else:
            if nsecs != 0:
                raise ValueError("if secs is a float, nsecs cannot be set")
            whole, rest = _split(secs)
        self.secs, self.nsecs = _canonical(whole, rest)

    @classmethod
    def from_sec(cls, float_secs: float) -> Self:
        """Return the value of a number of seconds [s].

        Raises:
            NoTimeError: They are not finite.
            TypeError: They are negative, and it is a point in time.
        """
        return cls(*_split(float_secs))

    def is_zero(self) -> bool:
        """Return whether seconds and nanoseconds are both 0."""
        return self.secs == 0 and self.nsecs == 0

    def set(self, secs: int, nsecs: int) -> None:
        """Set seconds and nanoseconds as they are."""
        self.secs = secs
        self.nsecs = nsecs

    def canon(self) -> None:
        """Convert the fields to the form ``0 <= nsecs < 1e9``."""
        self.secs, self.nsecs = _canonical(self.secs, self.nsecs)

    def to_sec(self) -> float:
        """Return the value in seconds [s]."""
        return float(self.secs) + float(self.nsecs) / 1e9

    def to_nsec(self) -> int:
        """Return the value in nanoseconds [ns], exact."""
        return self.secs * _NSEC + self.nsecs

    def __getstate__(self) -> list[int]:
        return [self.secs, self.nsecs]

    def __setstate__(self, state: list[int]) -> None:
        self.secs, self.nsecs = state

    def __hash__(self) -> int:
        return hash((self.secs, self.nsecs))

    def __str__(self) -> str:
        return str(self.to_nsec())

    def __repr__(self) -> str:
        return f"genpy.{self._kind().__name__}[{self.to_nsec()}]"

    def __bool__(self) -> bool:
        return self.secs != 0 or self.nsecs != 0

    @classmethod
    def _kind(cls) -> type[TVal]:
        """Return the type that this value can be compared with."""
        return TVal

    def _difference(self, other: object) -> int | None:
        return self.to_nsec() - other.to_nsec() if isinstance(other, self._kind()) else None

    def __lt__(self, other: object) -> bool:
        difference = self._difference(other)
        return NotImplemented if difference is None else difference < 0

    def __le__(self, other: object) -> bool:
        difference = self._difference(other)
        return NotImplemented if difference is None else difference <= 0

    def __gt__(self, other: object) -> bool:
        difference = self._difference(other)
        return NotImplemented if difference is None else difference > 0

    def __ge__(self, other: object) -> bool:
        difference = self._difference(other)
        return NotImplemented if difference is None else difference >= 0

    def __eq__(self, other: object) -> bool:
        return self._difference(other) == 0


class Time(TVal):
    """A point in time, counted from the epoch (or from the start of a simulation).

    Raises:
        TypeError: The time is negative.
    """

    __slots__ = ["secs", "nsecs"]  # noqa: RUF023  # callers fill the fields in this order

    def __init__(self, secs: Number = 0, nsecs: Number = 0) -> None:
        super().__init__(secs, nsecs)
        if self.secs < 0:
            raise TypeError("time values must be positive")

    @classmethod
    def _kind(cls) -> type[TVal]:
        return Time

    def to_time(self) -> float:
        """Return the time in seconds [s], as ``time.time()`` counts."""
        return self.to_sec()

    def __add__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    @overload
    def __sub__(self, other: Time) -> Duration: ...
    @overload
    def __sub__(self, other: Duration) -> Self: ...
    def __sub__(self, other: Time | Duration) -> Duration | Self:
        if isinstance(other, Time):
            return Duration(self.secs - other.secs, self.nsecs - other.nsecs)
        if isinstance(other, Duration):
            return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)
        return NotImplemented


class Duration(TVal):
    """A span of time, of either sign."""

    __slots__ = ["secs", "nsecs"]  # noqa: RUF023  # callers fill the fields in this order

    @classmethod
    def _kind(cls) -> type[TVal]:
        return Duration

    def __neg__(self) -> Self:
        return type(self)(-self.secs, -self.nsecs)

    def __abs__(self) -> Self:
        return self if self.secs >= 0 else -self

    def __add__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs + other.secs, self.nsecs + other.nsecs)

    __radd__ = __add__

    def __sub__(self, other: Duration) -> Self:
        if not isinstance(other, Duration):
            return NotImplemented
        return type(self)(self.secs - other.secs, self.nsecs - other.nsecs)

    def __mul__(self, factor: Number) -> Self:
        if isinstance(factor, numbers.Integral):
            return type(self)(self.secs * int(factor), self.nsecs * int(factor))
        if isinstance(factor, numbers.Real):
            return self.from_sec(self.to_sec() * float(factor))
        return NotImplemented

    __rmul__ = __mul__

    @overload
    def __truediv__(self, divisor: Duration) -> float: ...
    @overload
    def __truediv__(self, divisor: Number) -> Self: ...
    def __truediv__(self, divisor: Duration | Number) -> float | Self:
        if isinstance(divisor, Duration):
            return self.to_sec() / divisor.to_sec()
        if isinstance(divisor, numbers.Real):
            return self.from_sec(self.to_sec() / float(divisor))
        return NotImplemented

    @overload
    def __floordiv__(self, divisor: Duration) -> int: ...
    @overload
    def __floordiv__(self, divisor: Number) -> Self: ...
    def __floordiv__(self, divisor: Duration | Number) -> int | Self:
        if isinstance(divisor, Duration):
            return int(self.to_sec() // divisor.to_sec())
        if isinstance(divisor, numbers.Real):
            return self.from_sec(self.to_sec() // float(divisor))
        return NotImplemented

    def __mod__(self, divisor: Duration) -> Self:
        if not isinstance(divisor, Duration):
            return NotImplemented
        return self.from_sec(self.to_sec() % divisor.to_sec())

    def __divmod__(self, divisor: Duration) -> tuple[int, Self]:
        if not isinstance(divisor, Duration):
            return NotImplemented
        quotient, rest = divmod(self.to_sec(), divisor.to_sec())
        return int(quotient), self.from_sec(rest)
