"""The node ``scan_to_scan_filter_chain``: filters of scans one after another."""

from __future__ import annotations

import threading
from collections.abc import Collection, Mapping, Sequence
from dataclasses import fields
from typing import Any

from gazelle_ros.base.errors import Error, RosError, did_you_mean
from gazelle_ros.base.parameter_values import fields_of, value_of, warn_of_unknown
from gazelle_ros.builtin.arguments import run_node
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.builtin.scans.conversion import StampedWork
from gazelle_ros.builtin.scans.filters import by_angle, by_neighbours, by_place, by_value, over_time
from gazelle_ros.builtin.scans.filters.beams import BeamScan, ScanFilter, beam_scan, with_motions
from gazelle_ros.builtin.tuned_settings import TunedSettings
from gazelle_ros.msgs import sensor_msgs
from gazelle_ros.node import Node

KINDS: dict[str, Any] = {
    kind.__name__: kind
    for kind in (
        by_angle.LaserScanAngularBoundsFilter,
        by_angle.LaserScanAngularBoundsFilterInPlace,
        by_angle.LaserScanMaskFilter,
        by_angle.LaserScanSectorFilter,
        by_neighbours.LaserScanSpeckleFilter,
        by_neighbours.ScanShadowsFilter,
        by_place.LaserScanBoxFilter,
        by_place.LaserScanFootprintFilter,
        by_place.LaserScanPolygonFilter,
        by_value.InterpolationFilter,
        by_value.LaserScanIntensityFilter,
        by_value.LaserScanRangeFilter,
        over_time.LaserArrayFilter,
        over_time.LaserMedianFilter,
    )
}
"""Filters by the names of laser_filters."""
_CHAINS = ("scan_filter_chain", "filter_chain")
_PARAMETERS = ("tf_message_filter_target_frame", "tf_message_filter_tolerance")
_QUEUE, _OUTPUT_QUEUE = 50, 1000


def scan_filter(where: str, entry: Any) -> ScanFilter:
    """Return a filter from its parameters.

    Args:
        where: Name of the parameter, for messages.
        entry: ``type``, ``name`` and ``params``.

    Raises:
        RosError: There is no such filter, or a parameter is missing or wrong.
    """
    if not isinstance(entry, Mapping) or not isinstance(entry.get("name"), str):
        raise RosError(f"{where} has name, type and params; it is {entry!r:.60}")
    type_ = str(entry.get("type", ""))
    kind = KINDS.get(type_.removeprefix("laser_filters/"))
    if kind is None:
        known = [f"laser_filters/{each}" for each in KINDS]
        raise RosError(f"{where} has the unknown type '{type_}'", hint=did_you_mean(type_, known))
    values = entry.get("params") or {}
    if not isinstance(values, Mapping):
        raise RosError(
            f"params of {where} must be a mapping of names to values, not {values!r:.60}"
        )
    known = [each.name for each in fields(kind) if each.init]
    warn_of_unknown(f"{where}/params", values, known)
    for name in getattr(kind, "required", ()):
        if name not in values:
            raise RosError(f"{where} ({type_}) has no '{name}'")
    try:
        made: ScanFilter = kind(**fields_of(kind, values))
    except Error as error:
        raise RosError(f"{where}: {error.message}", hint=error.hint) from None
    return made


def scan_filters(where: str, listed: Any) -> list[ScanFilter]:
    """Return filters from a list of their parameters.

    Args:
        where: Name of the parameter, for messages.
        listed: The list.

    Raises:
        RosError: It is none, or a filter is unknown or wrong.
    """
    if not isinstance(listed, list):
        raise RosError(f"{where} is not set to a list of filters")
    return [scan_filter(f"{where}[{number}]", each) for number, each in enumerate(listed)]


def frames_of(filters: Collection[ScanFilter]) -> set[str]:
    """Return the frames that filters need transforms to."""
    return {getattr(each, "frame", "") for each in filters} - {""}


class ScanFilterChain(StampedWork[BeamScan]):
    """Scans of ``scan``, filtered, on ``scan_filtered``.

    Args:
        node: On the graph, with the parameter ``~scan_filter_chain``.

    Raises:
        RosError: A filter is unknown or wrong.
    """

    def __init__(self, node: Node) -> None:
        values = private_values(node)
        name = next((each for each in _CHAINS if each in values), None)
        listed = values.get(name or "")
        where = node.resolve(f"~{name or _CHAINS[0]}")
        warn_of_unknown(node.resolve("~"), values, (*_CHAINS, *_PARAMETERS))
        self.filters = scan_filters(where, listed)
        self._wanted = value_of(values, _PARAMETERS[0], "")
        super().__init__(node, self._frames())
        self._lock = threading.Lock()
        self._tune(node, [each["name"] for each in values[name or ""]], where)
        scan = sensor_msgs.msg.LaserScan
        self._output = node.advertise("scan_filtered", scan, _OUTPUT_QUEUE)
        node.subscribe("scan", scan, self.queue.add, _QUEUE)

    def find(self, message: Any) -> BeamScan:
        """Return a scan with its motions to the frames of the filters.

        Raises:
            TransformException: One is not known.
        """
        return with_motions(beam_scan(message), self.tree, self._frames())

    def use(self, message: Any, transformed: BeamScan) -> None:  # noqa: ARG002  transformed holds the scan
        """Publish a scan, filtered.

        Raises:
            ValueError: It cannot be filtered.
        """
        with self._lock:
            filters = list(self.filters)
        for each in filters:
            transformed = each.apply(transformed)
        self._output.publish(transformed.message())

    def _frames(self) -> Collection[str]:
        """Return the frames that transforms are needed to."""
        return {self._wanted, *frames_of(self.filters)} - {""}

    def _tune(self, node: Node, names: Sequence[str], where: str) -> None:
        """Serve dynamic_reconfigure for each filter that it can change."""
        for number, (name, each) in enumerate(zip(names, self.filters, strict=True)):
            if name in names[:number]:
                raise RosError(f"{where} has two filters '{name}'")
            if any("tuned" in item.metadata for item in fields(each)):  # type: ignore[arg-type]  # a dataclass

                def change(made: ScanFilter, number: int = number) -> None:
                    with self._lock:
                        self.filters[number] = made

                TunedSettings(node, each, change, f"~{name}")


def main(arguments: Sequence[str]) -> int:
    """Pass scans through the filters until shutdown; returns the exit code."""
    return run_node(arguments, "scan_to_scan_filter_chain", ScanFilterChain)
