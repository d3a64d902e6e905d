"""Filters of scans over the last few, beam by beam."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from gazelle_ros.base.array_types import Floats
from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.parameter_values import value_of
from gazelle_ros.builtin.scans.filters.beams import BeamScan


def _mean(rows: Floats) -> Floats:
    found: Floats = rows.mean(axis=0)
    return found


def _median(rows: Floats) -> Floats:
    """Return the median; the lower of the two in the middle of an even number."""
    found: Floats = np.sort(rows, axis=0)[(len(rows) - 1) // 2]
    return found


_KINDS: dict[str, Callable[[Floats], Floats]] = {
    f"MultiChannel{name}Filter{kind}": function
    for name, function in (("Mean", _mean), ("Median", _median))
    for kind in ("Float", "Double")
}


class ChannelFilter:
    """Mean or median of the last few arrays.

    Args:
        entry: ``type`` and ``params`` with ``number_of_observations``.

    Raises:
        Error: The type is unknown, or the number is missing.
    """

    def __init__(self, entry: Any) -> None:
        kind = str(entry.get("type", "")) if isinstance(entry, dict) else str(entry)
        name = kind.rpartition("/")[2]
        if name not in _KINDS:
            known = [f"filters/{each}" for each in _KINDS]
            raise RosError(
                f"there is no filter of channels '{kind}'", hint=did_you_mean(kind, known)
            )
        count = value_of(entry.get("params") or {}, "number_of_observations", 0)
        if count < 1:
            raise RosError(f"the number_of_observations of {kind} must be at least 1, not {count}")
        self._reduce = _KINDS[name]
        self._rows: deque[Floats] = deque(maxlen=count)

    def apply(self, row: Floats) -> Floats:
        """Return an array, filtered with those before it."""
        if self._rows and len(self._rows[0]) != len(row):
            self._rows.clear()
        self._rows.append(row)
        return self._reduce(np.array(self._rows))


def channel_filters(entries: Any) -> list[ChannelFilter]:
    """Return the filters of a chain.

    Raises:
        Error: It is malformed.
    """
    if not isinstance(entries, list):
        raise RosError(
            f"a chain of filters must be a list of name, type and params, not {entries!r:.60}"
        )
    return [ChannelFilter(each) for each in entries]


@dataclass(frozen=True, slots=True)
class LaserArrayFilter:
    """Filter of ranges and intensities over time, each by a chain."""

    range_filter_chain: list[Any] = field(default_factory=list)
    intensity_filter_chain: list[Any] = field(default_factory=list)
    chains: tuple[list[ChannelFilter], ...] = field(default=(), init=False, repr=False)

    def __post_init__(self) -> None:
        if not (self.range_filter_chain or self.intensity_filter_chain):
            raise RosError("LaserArrayFilter has no range_filter_chain or intensity_filter_chain")
        made = (
            channel_filters(self.range_filter_chain),
            channel_filters(self.intensity_filter_chain),
        )
        object.__setattr__(self, "chains", made)

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan, filtered with those before it."""
        return _filtered(scan, *self.chains)


@dataclass(frozen=True, slots=True)
class LaserMedianFilter:
    """Filter of ranges and intensities over time by the same chain."""

    required: ClassVar = ("internal_filter",)

    internal_filter: list[Any] = field(default_factory=list)
    chains: tuple[list[ChannelFilter], ...] = field(default=(), init=False, repr=False)

    def __post_init__(self) -> None:
        made = channel_filters(self.internal_filter), channel_filters(self.internal_filter)
        object.__setattr__(self, "chains", made)

    def apply(self, scan: BeamScan) -> BeamScan:
        """Return the scan, filtered with those before it."""
        return _filtered(scan, *self.chains)


def _filtered(
    scan: BeamScan, of_ranges: Sequence[ChannelFilter], of_intensities: Sequence[ChannelFilter]
) -> BeamScan:
    ranges, intensities = scan.ranges, scan.intensities
    for each in of_ranges:
        ranges = each.apply(ranges)
    for each in of_intensities:
        intensities = each.apply(intensities)
    return replace(scan, ranges=ranges, intensities=intensities)
