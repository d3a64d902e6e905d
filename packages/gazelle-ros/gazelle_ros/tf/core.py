"""A tree of frames that changes with time, and look-ups in it; the rules are tf2's.

Times are integer nanoseconds; 0 means the latest time that all frames on the way have.
Source of the rules: http://wiki.ros.org/tf2 and measurements on tf2 0.7.6.
"""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass

from gazelle_ros.base.rotations import (
    IDENTITY,
    ORIGIN,
    Quaternion,
    Vector,
    add,
    apply,
    conjugate,
    matrix,
    minus,
    multiply,
    product,
    quaternion,
    rotate,
)
from gazelle_ros.tf.cache import FrameCache, MovingCache, OutsideError, ParentTransform, StaticCache
from gazelle_ros.tf.errors import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from gazelle_ros.tf.faults import are_finite, name_fault, placement_fault

_LOG = logging.getLogger("gazelle.ros.tf")
_MAX_DEPTH = 1000
_FOREVER = 1 << 62
_QUIET_S = 10.0
DEFAULT_CACHE_NS = 10_000_000_000
"""Time that transforms are kept, by default [ns]."""


@dataclass(frozen=True, slots=True)
class StampedTransform:
    """Takes points from the source frame to the target frame: rotate, then translate.

    Attributes:
        stamp: Time it holds for [ns].
        translation: Of the source's origin in the target frame [m].
        rotation: (x, y, z, w).

    Raises:
        InvalidArgumentException: A number is not finite.
    """

    stamp: int
    translation: Vector = ORIGIN
    rotation: Quaternion = IDENTITY

    def __post_init__(self) -> None:
        if not are_finite(self.translation, self.rotation):
            raise InvalidArgumentException(
                "the numbers of a transform must be finite, not "
                f"{self.translation!r:.60} and {self.rotation!r:.60}"
            )


class FrameTree:
    """All frames, each with its transforms over time.

    Args:
        cache_ns: Time to keep placements [ns].
    """

    def __init__(self, cache_ns: int = DEFAULT_CACHE_NS) -> None:
        self.cache_ns = cache_ns
        self._caches: dict[str, FrameCache | None] = {}
        self._authorities: dict[str, str] = {}
        self._lock = threading.RLock()
        self._quiet_until: dict[tuple[str, str], float] = {}
        self._changed: list[Callable[[], None]] = []

    # Filling -----------------------------------------------------------------------------

    def place(
        self,
        parent: str,
        child: str,
        stamp: int,
        translation: Vector,
        rotation: Quaternion,
        *,
        authority: str = "",
        static: bool = False,
    ) -> bool:
        """Set the pose of a frame in its parent.

        Args:
            parent: Name of the parent; one slash in front is dropped, as of `child`.
            child: Name of the frame.
            stamp: Time [ns].
            translation: [m].
            rotation: (x, y, z, w).
            authority: The sender.
            static: Whether it holds at all times; the first placement of a frame decides.

        Returns:
            False if it was refused, such as NaN; the log says why.
        """
        parent, child = parent.removeprefix("/"), child.removeprefix("/")
        fault = placement_fault(parent, child, translation, rotation, authority)
        if fault:
            _LOG.error("%s", fault)
            return False
        with self._lock:
            cache = self._caches.get(child)
            if cache is None:
                cache = StaticCache() if static else MovingCache(self.cache_ns)
                self._caches[child] = cache
            if parent not in self._caches:
                self._caches[parent] = None
            refusal = cache.insert(stamp, ParentTransform(parent, translation, rotation))
            if not refusal:
                self._authorities[child] = authority
        if refusal:
            self._complain(refusal, child, stamp, authority)
            return False
        for callback in self._changed:
            callback()
        return True

    def _complain(self, refusal: str, child: str, stamp: int, authority: str) -> None:
        """Log a refusal, but not the same again and again."""
        now = time.monotonic()
        key = child, refusal
        if now < self._quiet_until.get(key, 0.0):
            return
        self._quiet_until[key] = now + _QUIET_S
        text = "%s for frame %s at time %f according to authority %s"
        _LOG.warning(text, refusal, child, stamp * 1e-9, authority)

    def clear(self) -> None:
        """Discard all placements but static ones; the frames stay known."""
        with self._lock:
            for cache in self._caches.values():
                if cache is not None:
                    cache.clear()

    def on_change(self, callback: Callable[[], None]) -> None:
        """Call `callback` after each placement."""
        self._changed.append(callback)

    # Looking up --------------------------------------------------------------------------

    def lookup(self, target: str, source: str, stamp: int = 0) -> StampedTransform:
        """Return the transform from `source` to `target` at a time.

        Raises:
            InvalidArgumentException: A name is empty or starts with a slash.
            LookupException: A frame does not exist, or the tree has a loop.
            ConnectivityException: There is no way between the frames.
            ExtrapolationException: The time is not held.
        """
        with self._lock:
            if target == source:
                return StampedTransform(self._own_stamp(target) if stamp == 0 else stamp)
            self._check("lookupTransform argument target_frame", target)
            self._check("lookupTransform argument source_frame", source)
            return self._transform(target, source, stamp)

    def lookup_full(
        self, target: str, target_stamp: int, source: str, source_stamp: int, fixed: str
    ) -> StampedTransform:
        """Return the transform between two times, through a frame that stands still.

        Raises:
            InvalidArgumentException: A name is empty or starts with a slash.
            LookupException: A frame does not exist, or the tree has a loop.
            ConnectivityException: There is no way between the frames.
            ExtrapolationException: The time is not held.
        """
        with self._lock:
            self._check("lookupTransform argument target_frame", target)
            self._check("lookupTransform argument source_frame", source)
            self._check("lookupTransform argument fixed_frame", fixed)
            first = self.lookup(fixed, source, source_stamp)
            second = self.lookup(target, fixed, target_stamp)
        turn = matrix(second.rotation)
        return StampedTransform(
            second.stamp,
            add(apply(turn, first.translation), second.translation),
            quaternion(product(turn, matrix(first.rotation))),
        )

    def latest_common_time(self, target: str, source: str) -> int:
        """Return the latest time [ns] at which both frames are known.

        0 if all between them is static.

        Raises:
            LookupException: A frame does not exist.
            TransformException: There is no way between the frames, or the tree has a loop.
        """
        with self._lock:
            for name in (target, source):
                self._check("get_latest_common_time", name)
            try:
                return self._common_time(target, source)
            except (ConnectivityException, LookupException) as error:
                raise TransformException(error.message) from None

    def chain(
        self, target: str, target_stamp: int, source: str, source_stamp: int, fixed: str
    ) -> list[str]:
        """Return the frames on the way from `source` over `fixed` to `target`.

        Raises:
            TransformException: As `lookup_full`.
        """
        with self._lock:
            for name in (target, source, fixed):
                self._check("lookupTransform argument", name)
            there = self._names(fixed, source, source_stamp)
            back = self._names(target, fixed, target_stamp)
        return there + back[1:]

    def has(self, name: str) -> bool:
        """Return whether a frame is known."""
        return name in self._caches

    def names(self) -> list[str]:
        """Return all frames, in the order in which they became known."""
        with self._lock:
            return list(self._caches)

    def known(self) -> list[tuple[str, str, FrameCache]]:
        """Return name, authority and placements of each known frame."""
        with self._lock:
            return [
                (name, self._authorities.get(name, "no recorded authority"), cache)
                for name, cache in self._caches.items()
                if cache is not None
            ]

    def as_string(self) -> str:
        """Return one line for each frame and its parent."""
        lines = []
        for name, _, cache in self.known():
            latest = cache.latest()
            lines.append(
                f"Frame {name} exists with parent {latest[1] if latest else 'NO_PARENT'}.\n"
            )
        return "".join(lines)

    # Traversal of the tree ----------------------------------------------------------------------

    def _check(self, what: str, name: str) -> None:
        fault = name_fault(name, what)
        if fault:
            raise InvalidArgumentException(fault)
        if name not in self._caches:
            raise LookupException(f'"{name}" passed to {what} does not exist. ')

    def _own_stamp(self, name: str) -> int:
        cache = self._caches.get(name)
        latest = cache.latest() if cache is not None else None
        return latest[0] if latest else 0

    def _transform(self, target: str, source: str, stamp: int) -> StampedTransform:
        if stamp == 0:
            stamp = self._common_time(target, source)
        up, down = self._way(target, source, stamp)
        translation, rotation = _accumulate(up)
        if not down:
            return StampedTransform(stamp, translation, rotation)
        other, turned = _accumulate(down)
        back = conjugate(turned)
        offset = rotate(back, minus(other))
        if not up:
            return StampedTransform(stamp, offset, back)
        return StampedTransform(
            stamp, add(rotate(back, translation), offset), multiply(back, rotation)
        )

    def _names(self, target: str, source: str, stamp: int) -> list[str]:
        if target == source:
            return [target]
        if stamp == 0:
            stamp = self._common_time(target, source)
        up, down = self._way(target, source, stamp)
        if up and down:
            return [source, *(p.parent for p in up), *(p.parent for p in down[-2::-1]), target]
        if up:
            return [source, *(placement.parent for placement in up)]
        return [source, *(placement.parent for placement in down[-2::-1]), target]

    def _way(
        self, target: str, source: str, stamp: int
    ) -> tuple[list[ParentTransform], list[ParentTransform]]:
        """Return the placements from `source` up to the common frame, and those from `target`."""
        up, top, outside = self._climb(source, stamp, target)
        if top == target:
            return up, []
        down, end, beyond = self._climb(target, stamp, top, source)
        if end == source:
            return [], down
        between = f", when looking up transform from frame [{source}] to frame [{target}]"
        if end == top:
            return up, down
        if beyond is not None:
            raise ExtrapolationException(beyond + between)
        if outside is not None:
            raise ExtrapolationException(outside + between)
        raise self._not_connected(target, source)

    def _climb(
        self, start: str, stamp: int, *goals: str
    ) -> tuple[list[ParentTransform], str, str | None]:
        """Return placements from a frame towards the root, the last frame, and why not further."""
        path: list[ParentTransform] = []
        frame = start
        caches = self._caches
        while frame not in goals:
            cache = caches.get(frame)
            if cache is None:
                return path, frame, None
            try:
                placement = cache.at(stamp)
            except OutsideError as error:
                return path, frame, str(error)
            if placement is None:
                return path, frame, ""
            path.append(placement)
            frame = placement.parent
            self._limit(len(path))
        return path, frame, None

    def _common_time(self, target: str, source: str) -> int:
        if target == source:
            return self._own_stamp(source)
        above: list[tuple[int, str]] = []
        common = _FOREVER
        for latest in self._ancestors(source):
            above.append(latest)
            common = _earlier(common, latest[0])
            if latest[1] == target:
                return common % _FOREVER
        parents = {latest[1] for latest in above}
        common = _FOREVER
        for stamp, parent in self._ancestors(target):
            common = _earlier(common, stamp)
            if parent == source:
                return common % _FOREVER
            if parent in parents:
                for other in above:
                    common = _earlier(common, other[0])
                    if other[1] == parent:
                        break
                return common % _FOREVER
        raise self._not_connected(target, source)

    def _ancestors(self, name: str) -> list[tuple[int, str]]:
        """Return latest time and parent of a frame, of its parent, and so on to the root."""
        found: list[tuple[int, str]] = []
        cache = self._caches.get(name)
        while cache is not None:
            latest = cache.latest()
            if latest is None:
                break
            found.append(latest)
            self._limit(len(found))
            cache = self._caches.get(latest[1])
        return found

    def _limit(self, depth: int) -> None:
        if depth > _MAX_DEPTH:
            raise LookupException(
                "The tf tree is invalid because it contains a loop.\n" + self.as_string() + "\n"
            )

    @staticmethod
    def _not_connected(target: str, source: str) -> ConnectivityException:
        return ConnectivityException(
            f"Could not find a connection between '{target}' and '{source}' because they are not "
            "part of the same tree.Tf has two or more unconnected trees."
        )


def _earlier(common: int, stamp: int) -> int:
    """Return the earlier time; 0, a static frame, does not count."""
    return min(common, stamp) if stamp else common


def _accumulate(path: list[ParentTransform]) -> tuple[Vector, Quaternion]:
    """Return the transform from the first frame of a path to the parent of the last."""
    if not path:
        return ORIGIN, IDENTITY
    translation, rotation = path[0].translation, path[0].rotation
    for placement in path[1:]:
        turn = placement.rotation
        translation = add(rotate(turn, translation), placement.translation)
        rotation = multiply(turn, rotation)
    return translation, rotation
