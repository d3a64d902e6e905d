"""Parameters of ``ekf_localization_node`` and ``ukf_localization_node``."""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from gazelle.array_types import Bools, Floats
from gazelle.errors import Error
from gazelle.navigation.estimation.control import ControlModel
from gazelle.navigation.estimation.motion import SIZE
from gazelle_ros.base.parameter_values import Values, fields_of, positive, value_of, warn_of_unknown
from gazelle_ros.base.real_numbers import finite

_LOG = logging.getLogger(__name__)
_POSED = ("differential", "relative")
_ANY = ("config", "queue_size", "nodelay")
SUFFIXES: Mapping[str, tuple[str, ...]] = {
    "odom": (
        *_ANY, *_POSED, "pose_use_child_frame", "pose_rejection_threshold", "twist_rejection_threshold",
    ),
    "pose": (*_ANY, *_POSED, "rejection_threshold"),
    "twist": (*_ANY, "rejection_threshold"),
    "imu": (
        *_ANY, *_POSED, "pose_rejection_threshold", "twist_rejection_threshold",
        "angular_velocity_rejection_threshold", "linear_acceleration_rejection_threshold",
        "remove_gravitational_acceleration",
    ),
}  # fmt: skip
"""Endings of a source's parameters, by its kind."""
_SOURCE = re.compile(r"(odom|pose|twist|imu)(\d+)(?:_(\w+))?")
_ELSEWHERE = (
    "sensor_timeout", "control_timeout", "control_config", "acceleration_limits", "deceleration_limits",
    "acceleration_gains", "deceleration_gains", "initial_state", "process_noise_covariance",
    "initial_estimate_covariance", "base_link_frame_output", "world_frame", "silent_tf_failure", "debug",
    "debug_out_file", "tf_prefix", "alpha", "kappa", "beta",
)  # fmt: skip
"""Parameters that are not fields of the settings."""


@dataclass(frozen=True, slots=True)
class SourceSettings:
    """Parameters of a source of measurements.

    Attributes:
        name: Such as ``odom0``.
        kind: odom, pose, twist or imu.
        topic: Of its messages.
        used: Elements of the state to take from it, in its own frame, shape (15,).
        queue_size: Messages kept while the filter is busy.
        nodelay: Have the publisher send small packets at once.
        differential: Take the change of its pose as a velocity.
        relative: Take its pose relative to its first one.
        pose_use_child_frame: Its pose is that of its child frame, not of the robot.
        pose_threshold: Greatest Mahalanobis distance at which a pose counts.
        twist_threshold: The same for a velocity.
        acceleration_threshold: The same for an acceleration.
        remove_gravity: Subtract gravity from its acceleration.
    """

    name: str
    kind: str
    topic: str
    used: Bools
    queue_size: int = 1
    nodelay: bool = False
    differential: bool = False
    relative: bool = False
    pose_use_child_frame: bool = False
    pose_threshold: float = np.inf
    twist_threshold: float = np.inf
    acceleration_threshold: float = np.inf
    remove_gravity: bool = False

    def uses(self, elements: slice) -> bool:
        """Return whether any of some elements is used."""
        return bool(self.used[elements].any())


@dataclass(frozen=True, slots=True)
class FilterSettings:
    """Parameters; names and defaults are those of ``robot_localization``.

    Attributes:
        sensor_timeout: Time without a measurement after which the filter predicts [s].
        control: Response to commands; None without ``use_control``.
        process_noise: Shape (15, 15); None for the usual one, as the two below.
        initial_state: Shape (15,).
        initial_covariance: Shape (15, 15).
        sources: Of measurements.
    """

    frequency: float = 30.0
    two_d_mode: bool = False
    map_frame: str = "map"
    odom_frame: str = "odom"
    base_link_frame: str = "base_link"
    transform_time_offset: float = 0.0
    transform_timeout: float = 0.0
    publish_tf: bool = True
    invert_tf: bool = False
    publish_acceleration: bool = False
    permit_corrected_publication: bool = False
    print_diagnostics: bool = True
    gravitational_acceleration: float = 9.80665
    smooth_lagged_data: bool = False
    history_length: float = 0.0
    reset_on_time_jump: bool = False
    predict_to_current_time: bool = False
    disabled_at_startup: bool = False
    dynamic_process_noise_covariance: bool = False
    use_control: bool = False
    stamped_control: bool = False
    sensor_timeout: float = field(default=0.0, kw_only=True)
    base_link_frame_output: str = field(default="", kw_only=True)
    world_frame: str = field(default="", kw_only=True)
    control: ControlModel | None = field(default=None, kw_only=True)
    process_noise: Floats | None = field(default=None, kw_only=True)
    initial_state: Floats | None = field(default=None, kw_only=True)
    initial_covariance: Floats | None = field(default=None, kw_only=True)
    sources: tuple[SourceSettings, ...] = field(default=(), kw_only=True)

    @classmethod
    def read(cls, values: Values) -> FilterSettings:
        """Read the parameters; unknown ones are logged.

        Raises:
            Error: One is of the wrong kind or size, or frames are the same.
        """
        plain = [each.name for each in fields(cls) if not each.kw_only]
        others = [each.name for each in fields(cls) if each.kw_only]
        _warn_of_unknown(values, plain)
        found = fields_of(cls, values, without=others)
        positive("frequency", found["frequency"])
        if found["history_length"] < 0.0:
            raise Error(f"'history_length' must not be negative, but is {found['history_length']}")
        base, odom = found["base_link_frame"], found["odom_frame"]
        timeout = value_of(values, "sensor_timeout", 1.0 / found["frequency"])
        made = cls(
            **found,
            sensor_timeout=timeout,
            base_link_frame_output=value_of(values, "base_link_frame_output", base),
            world_frame=value_of(values, "world_frame", odom),
            control=_control(values, timeout) if found["use_control"] else None,
            process_noise=_matrix(values, "process_noise_covariance"),
            initial_state=_row(values, "initial_state", SIZE),
            initial_covariance=_matrix(values, "initial_estimate_covariance"),
            sources=tuple(_sources(values)),
        )
        made._check_frames()
        return made

    def _check_frames(self) -> None:
        whole, odom, base = self.map_frame, self.odom_frame, self.base_link_frame
        if len({whole, odom, base}) < 3 or self.base_link_frame_output in (whole, odom):
            raise Error(
                f"map_frame '{whole}', odom_frame '{odom}' and base_link_frame '{base}' are different frames"
            )
        if self.world_frame not in (whole, odom):
            raise Error(
                f"world_frame '{self.world_frame}' is the map_frame '{whole}' or the odom_frame '{odom}'"
            )


def _warn_of_unknown(values: Values, plain: list[str]) -> None:
    """Log parameters that are unknown or not supported."""
    matches = filter(None, map(_SOURCE.fullmatch, values))
    sources = sorted({(kind, "0") for kind in SUFFIXES} | {(each[1], each[2]) for each in matches})
    of_sources = [
        f"{kind}{number}{ending}"
        for kind, number in sources
        for ending in ("", *(f"_{suffix}" for suffix in SUFFIXES[kind]))
    ]
    warn_of_unknown("~", values, [*plain, *_ELSEWHERE, *of_sources])
    if values.get("debug"):
        _LOG.warning("the parameter 'debug' is not supported: no file is written")


def _sources(values: Values) -> list[SourceSettings]:
    found = []
    for kind in SUFFIXES:
        numbers = sorted(
            int(match[2])
            for match in map(_SOURCE.fullmatch, values)
            if match is not None and match[1] == kind and match[3] is None
        )
        for number in numbers:
            if number and number - 1 not in numbers:
                _LOG.warning(
                    "%s%d is ignored, as those after it: there is no %s%d",
                    kind, number, kind, number - 1,
                )  # fmt: skip
                break
            found.append(_source(values, kind, f"{kind}{number}"))
    return found


def _source(values: Values, kind: str, name: str) -> SourceSettings:
    def get(suffix: str, default: Any) -> Any:
        return value_of(values, f"{name}_{suffix}", default)

    differential, relative = get("differential", False), get("relative", False)
    if differential and relative:
        _LOG.warning("%s is both differential and relative: it is taken as differential", name)
    used = _flags(values, f"{name}_config", SIZE)
    if not used.any():
        _LOG.warning("%s is ignored: all of %s_config is false", name, name)
    own = get("rejection_threshold", np.inf)  # of a pose or twist alone
    turning = get("angular_velocity_rejection_threshold", own)
    return SourceSettings(
        name,
        kind,
        value_of(values, name, ""),
        used,
        queue_size=max(get("queue_size", 1), 1),
        nodelay=get("nodelay", False),
        differential=differential,
        relative=relative and not differential,
        pose_use_child_frame=get("pose_use_child_frame", False),
        pose_threshold=get("pose_rejection_threshold", own),
        twist_threshold=get("twist_rejection_threshold", turning),
        acceleration_threshold=get("linear_acceleration_rejection_threshold", np.inf),
        remove_gravity=get("remove_gravitational_acceleration", False),
    )


def _control(values: Values, timeout: float) -> ControlModel:
    ones = np.ones(6)
    rows = {
        name: _row(values, name, 6)
        for name in ("acceleration_limits", "acceleration_gains", "deceleration_limits", "deceleration_gains")
    }  # fmt: skip

    def row(*names: str) -> Floats:
        return next((found for name in names if (found := rows[name]) is not None), ones)

    return ControlModel(
        _flags(values, "control_config", 6),
        value_of(values, "control_timeout", timeout),
        acceleration_limits=row("acceleration_limits"),
        acceleration_gains=row("acceleration_gains"),
        deceleration_limits=row("deceleration_limits", "acceleration_limits"),
        deceleration_gains=row("deceleration_gains", "acceleration_gains"),
    )


def _flags(values: Values, name: str, size: int) -> Bools:
    value = values.get(name)
    listed = value if isinstance(value, list) else []
    if len(listed) != size or not all(each in (0, 1) for each in listed):
        raise Error(f"the parameter '{name}' must be a list of {size} bools, not {value!r:.60}")
    return np.array(listed, bool)


def _row(values: Values, name: str, size: int) -> Floats | None:
    value = values.get(name)
    if value is None:
        return None
    numbers = [_number(each) for each in value] if isinstance(value, list) else [None]
    if None in numbers or len(numbers) != size:
        raise Error(f"the parameter '{name}' must be a list of {size} numbers, not {value!r:.60}")
    return np.array(numbers, float)


def _number(value: object) -> float | None:
    """Return a number, also of text: YAML has ``1e-9``, without a point, as text."""
    if isinstance(value, str):
        with suppress(ValueError):
            return finite(float(value))
    return finite(value)


def _matrix(values: Values, name: str) -> Floats | None:
    found = _row(values, name, SIZE * SIZE)
    return None if found is None else found.reshape(SIZE, SIZE)
