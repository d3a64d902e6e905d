"""Checks of frame names and transforms, with tf2's messages."""

from __future__ import annotations

import math

from gazelle_ros.base.real_numbers import real
from gazelle_ros.base.rotations import Quaternion, Vector

_NORM_TOLERANCE = 10e-3


def name_fault(name: str, what: str) -> str:
    """Return the fault in a frame name of a look-up, empty if there is none."""
    if not name:
        return f"Invalid argument passed to {what} in tf2 frame_ids cannot be empty"
    if name.startswith("/"):
        return (
            f'Invalid argument "{name}" passed to {what} in tf2 frame_ids cannot start with a '
            "'/' like: "
        )
    return ""


def placement_fault(
    parent: str, child: str, translation: Vector, rotation: Quaternion, authority: str
) -> str:
    """Return the fault in a transform, empty if there is none."""
    if child == parent and child:
        return (
            f'TF_SELF_TRANSFORM: Ignoring transform from authority "{authority}" with frame_id and '
            f'child_frame_id  "{child}" because they are the same'
        )
    if not child:
        return (
            f'TF_NO_CHILD_FRAME_ID: Ignoring transform from authority "{authority}" because '
            "child_frame_id not set "
        )
    if not parent:
        return (
            f'TF_NO_FRAME_ID: Ignoring transform with child_frame_id "{child}"  from authority '
            f'"{authority}" because frame_id not set'
        )
    if not (_count(translation) == 3 and _count(rotation) == 4):
        return (
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because it needs 3 and 4 numbers, not {translation!r} and {rotation!r}'
        )
    if not are_finite(translation, rotation):
        return (
            f'TF_NAN_INPUT: Ignoring transform for child_frame_id "{child}" from authority '
            f'"{authority}" because of a nan value in the transform '
            f"({_numbers(translation)}) ({_numbers(rotation)})"
        )
    x, y, z, w = rotation
    norm = x * x + y * y + z * z + w * w
    if abs(norm - 1.0) >= _NORM_TOLERANCE:
        return (
            f'TF_DENORMALIZED_QUATERNION: Ignoring transform for child_frame_id "{child}" from '
            f'authority "{authority}" because of an invalid quaternion in the transform '
            f"({_numbers(rotation)})"
        )
    return ""


def are_finite(translation: Vector, rotation: Quaternion) -> bool:
    """Return whether all numbers of a transform are finite."""
    try:
        return all(map(math.isfinite, (*translation, *rotation)))
    except OverflowError:  # an int beyond all floats
        return False


def _count(values: object) -> int:
    try:
        return len(values)  # type: ignore[arg-type]
    except TypeError:
        return 0


def _numbers(values: tuple[float, ...]) -> str:
    numbers = (real(value) for value in values)
    return " ".join("inf" if each is None else f"{each:f}" for each in numbers)
