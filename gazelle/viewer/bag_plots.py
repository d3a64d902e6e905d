"""Plottable data of a bag: numbers of messages over time, and paths over a map."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gazelle.array_types import Floats
from gazelle.bridges.navigation.map_messages import grid_of_message
from gazelle.description import OccupancyMap
from gazelle.errors import RosError, did_you_mean
from gazelle.viewer.plots import Series
from gazelle_ros.bags import Bag

_POSES = {
    "geometry_msgs/PoseStamped": ("pose", "position"),
    "geometry_msgs/PoseWithCovarianceStamped": ("pose", "pose", "position"),
    "nav_msgs/Odometry": ("pose", "pose", "position"),
}
"""Path to the position in messages that have one."""


def bag_series(path: Path, fields: Sequence[str]) -> Series:
    """Return numbers of messages over the time since the bag begins [s].

    Args:
        path: The bag.
        fields: Each a topic and the path to a number in its messages, such as
            ``/odom/twist/twist/linear/x`` or ``/scan/ranges/0``.

    Raises:
        RosError: There is no such topic or field, or it is not a number.
    """
    with Bag(str(path)) as bag:
        topics = list(bag.get_type_and_topic_info().topics)
        start = bag.get_start_time()
        return {field: _numbers(bag, *_split(field, topics), start) for field in fields}


def bag_paths(path: Path, topics: Sequence[str] = ()) -> dict[str, Floats]:
    """Return the paths in topics of poses, x and y [m] by topic, shapes (n, 2).

    Args:
        path: The bag.
        topics: Of odometry or poses; all that there are if none are given.

    Raises:
        RosError: There is no such topic, or none at all.
    """
    with Bag(str(path)) as bag:
        found = bag.get_type_and_topic_info().topics
        known = [name for name, about in found.items() if about.msg_type in _POSES]
        for topic in topics:
            if topic not in known:
                hint = did_you_mean(topic, known)
                raise RosError(f"'{path.name}' has no places on '{topic}'", hint=hint)
        if not known:
            raise RosError(
                f"'{path.name}' has no odometry and no poses",
                hint="plot numbers of it: --field /TOPIC/FIELD",
            )
        tracks: dict[str, list[tuple[float, float]]] = {name: [] for name in topics or known}
        for entry in bag.read_messages(topics=list(tracks)):
            place = _at(entry.message, _POSES[found[entry.topic].msg_type])
            tracks[entry.topic].append((place.x, place.y))
    return {name: np.array(track) for name, track in tracks.items()}


def bag_map(path: Path) -> OccupancyMap | None:
    """Return the last map of a bag; None if it has none."""
    with Bag(str(path)) as bag:
        found = bag.get_type_and_topic_info().topics
        maps = [name for name, info in found.items() if info.msg_type == "nav_msgs/OccupancyGrid"]
        last = None
        for entry in bag.read_messages(topics=maps) if maps else ():
            last = entry.message
    return None if last is None else grid_of_message(last)


def _split(field: str, topics: Sequence[str]) -> tuple[str, tuple[str, ...]]:
    """Return the topic of a field, the longest match, and the path to the number."""
    fitting = [topic for topic in topics if field.startswith(f"{topic}/")]
    if not fitting:
        hint = did_you_mean(field, topics)
        raise RosError(f"no topic of the bag is the beginning of '{field}'", hint=hint)
    topic = max(fitting, key=len)
    return topic, tuple(field.removeprefix(f"{topic}/").split("/"))


def _numbers(bag: Bag, topic: str, path: tuple[str, ...], start: float) -> tuple[Floats, Floats]:
    times, values = [], []
    for entry in bag.read_messages(topics=[topic]):
        value = _at(entry.message, path)
        if not isinstance(value, bool | int | float | np.number):
            inside = ", ".join(getattr(value, "__slots__", ())) or type(value).__name__
            raise RosError(f"{topic}/{'/'.join(path)} is not a number", hint=f"it has: {inside}")
        times.append(entry.timestamp.to_sec() - start)
        values.append(float(value))
    return np.array(times), np.array(values)


def _at(message: Any, path: Sequence[str]) -> Any:
    """Return the value at the end of a path of names and indices."""
    for step in path:
        try:
            message = message[int(step)] if step.isdigit() else getattr(message, step)
        except (AttributeError, IndexError, TypeError) as error:
            known = getattr(message, "__slots__", ())
            raise RosError(f"there is no '{step}' in it", hint=did_you_mean(step, known)) from error
    return message
