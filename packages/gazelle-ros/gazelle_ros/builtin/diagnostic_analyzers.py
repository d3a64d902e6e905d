"""Analyzers of diagnostic_aggregator: groups of statuses, and the level of each (http://wiki.ros.org/diagnostic_aggregator)."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from gazelle_ros.base.errors import RosError, did_you_mean
from gazelle_ros.base.parameter_values import value_of, warn_of_unknown
from gazelle_ros.builtin.diagnostics import ERROR, OK, diagnostic_status
from gazelle_ros.msgs import diagnostic_msgs

Status = diagnostic_msgs.msg.DiagnosticStatus
STALE: Final = 3
_WORDS: Final = ("OK", "Warning", "Error", "Stale")
_LISTS: Final = (
    "find_and_remove_prefix",
    "remove_prefix",
    "startswith",
    "contains",
    "expected",
    "regex",
    "name",
)
_OTHERS: Final = ("type", "path", "timeout", "num_items", "discard_stale")


@dataclass(slots=True)
class GenericAnalyzer:
    """A group of the statuses whose names match.

    Attributes:
        path: Of the group, such as ``/Power System``.
        lists: Prefixes, parts and names that match, by the name of their parameter.
        timeout: A status is stale after this time [s]; 0 for never.
        num_items: Number of statuses that there should be; -1 for any.
        discard_stale: Whether stale statuses are dropped.
        items: Last status of each name, and when it came [s]; None for an expected one that did not.
    """

    path: str
    lists: Mapping[str, Sequence[str]] = field(default_factory=dict)
    timeout: float = 5.0
    num_items: int = -1
    discard_stale: bool = False
    items: dict[str, tuple[Status, float] | None] = field(default_factory=dict)

    def matches(self, name: str) -> bool:
        """Return whether a status belongs to the group."""
        of = self.lists
        return (
            name in {*of.get("expected", ()), *of.get("name", ())}
            or name.startswith((*of.get("startswith", ()), *of.get("find_and_remove_prefix", ())))
            or any(part in name for part in of.get("contains", ()))
            or any(re.fullmatch(each, name) for each in of.get("regex", ()))
        )

    def take(self, status: Status, now: float) -> bool:
        """Take a status if it belongs to the group; returns whether it does."""
        if not self.matches(status.name):
            return False
        self.items[status.name] = status, now
        return True

    def report(self, now: float) -> list[Status]:
        """Return the group's own status, then those in it."""
        if self.discard_stale:
            self.items = {
                name: item for name, item in self.items.items() if item and not self._old(item, now)
            }
        found = [self._shown(name, item, now) for name, item in sorted(self.items.items())]
        head = summary(self.path, found)
        if self.num_items == 0 and not found:
            head.level, head.message = OK, "OK"
        elif self.num_items > 0 and self.num_items != len(found):
            head.level = max(head.level, ERROR)
            head.message = f"Expected {self.num_items}, found {len(found)}"
        return [head, *found]

    def _old(self, item: tuple[Status, float], now: float) -> bool:
        return self.timeout > 0.0 and now - item[1] > self.timeout

    def _shown(self, name: str, item: tuple[Status, float] | None, now: float) -> Status:
        short = name
        for chaff in (
            *self.lists.get("find_and_remove_prefix", ()),
            *self.lists.get("remove_prefix", ()),
        ):
            if short.startswith(chaff):
                short = short.removeprefix(chaff).removeprefix(":").lstrip()
                break
        full = f"{self.path}/{short.replace('/', ' ')}"
        if item is None:
            return diagnostic_status(full, {}, "Missing", STALE)
        status, _ = item
        level = STALE if self._old(item, now) else status.level
        return Status(level, full, status.message, status.hardware_id, status.values)


@dataclass(slots=True)
class AnalyzerGroup:
    """A group of groups.

    Attributes:
        path: Of the group; "" for the root, which has no status of its own.
        members: Its groups.
    """

    path: str
    members: list[AnalyzerGroup | GenericAnalyzer | IgnoredStatuses]

    def take(self, status: Status, now: float) -> bool:
        """Pass a status to all groups that it belongs to; returns whether there is any."""
        taken = [each.take(status, now) for each in self.members]
        return True in taken

    def report(self, now: float) -> list[Status]:
        """Return the group's own status, then those of its groups."""
        reports = [report for each in self.members if (report := each.report(now))]
        found = [status for report in reports for status in report]
        return [summary(self.path, [each[0] for each in reports]), *found] if self.path else found


@dataclass(slots=True)
class IgnoredStatuses:
    """Statuses that are not shown: those of an IgnoreAnalyzer or a DiscardAnalyzer.

    Attributes:
        matching: Those that a DiscardAnalyzer drops; None for an IgnoreAnalyzer, which takes none.
    """

    matching: GenericAnalyzer | None

    def take(self, status: Status, now: float) -> bool:
        """Return whether a status is dropped."""
        del now
        return self.matching is not None and self.matching.matches(status.name)

    def report(self, now: float) -> list[Status]:
        """Return nothing."""
        del now
        return []


def summary(path: str, parts: Sequence[Status]) -> Status:
    """Return the status of a group: the worst of its parts; stale ones are errors beside others."""
    levels = [each.level for each in parts]
    level = max(levels, default=OK)
    if level == STALE and min(levels) != STALE:
        level = ERROR
    names = {each.name.rpartition("/")[2]: each.message for each in parts}
    return diagnostic_status(path, names, _WORDS[min(level, STALE)], level)


def analyzers_of(where: str, values: Mapping[str, Any], path: str) -> AnalyzerGroup:
    """Return the analyzers of a parameter ``analyzers``.

    Args:
        where: Name of the parameter, for messages.
        values: Analyzers by name.
        path: Of the group that they are in.

    Raises:
        RosError: A type is unknown, or a value is of the wrong kind.
    """
    members = [
        _analyzer(f"{where}/{name}", name, each, path) for name, each in sorted(values.items())
    ]
    return AnalyzerGroup(path, members)


def _analyzer(
    where: str, name: str, values: Any, path: str
) -> AnalyzerGroup | GenericAnalyzer | IgnoredStatuses:
    if not isinstance(values, Mapping):
        raise RosError(f"{where} must be a namespace with 'type' and 'path', not {values!r:.60}")
    kind = str(values.get("type", "")).rpartition("/")[2]
    title = f"{path}/{str(value_of(values, 'path', name)).strip('/')}"
    if kind == "AnalyzerGroup":
        inner = values.get("analyzers", {})
        return analyzers_of(
            f"{where}/analyzers", inner if isinstance(inner, Mapping) else {}, title
        )
    if kind == "IgnoreAnalyzer":
        return IgnoredStatuses(None)
    if kind in {"GenericAnalyzer", "DiscardAnalyzer"}:
        found = _generic(where, values, title)
        return found if kind == "GenericAnalyzer" else IgnoredStatuses(found)
    known = ("GenericAnalyzer", "AnalyzerGroup", "IgnoreAnalyzer", "DiscardAnalyzer")
    raise RosError(f"{where}/type is no '{values.get('type')}'", hint=did_you_mean(kind, known))


def _generic(where: str, values: Mapping[str, Any], title: str) -> GenericAnalyzer:
    warn_of_unknown(where, values, (*_LISTS, *_OTHERS))
    lists = {name: _texts(f"{where}/{name}", values[name]) for name in _LISTS if name in values}
    if not any(name != "remove_prefix" for name in lists):
        raise RosError(f"{where} has none of {', '.join(_LISTS[2:])}: it would match nothing")
    return GenericAnalyzer(
        title,
        lists,
        float(value_of(values, "timeout", 5.0)),
        value_of(values, "num_items", -1),
        value_of(values, "discard_stale", False),
        dict.fromkeys(lists.get("expected", ())),
    )


def _texts(where: str, value: Any) -> list[str]:
    found = [value] if isinstance(value, str) else value
    if not isinstance(found, list) or not all(isinstance(each, str) for each in found):
        raise RosError(f"{where} must be a text or a list of texts, not {value!r:.60}")
    for each in found if where.endswith("/regex") else ():
        try:
            re.compile(each)
        except re.error as error:
            raise RosError(f"{where}: '{each}' is not a regular expression: {error}") from None
    return found
