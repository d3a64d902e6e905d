"""Parameters of ``teb_local_planner``, and the shape of its robot."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Final

import numpy as np

from gazelle.array_types import Floats
from gazelle.errors import Error, did_you_mean
from gazelle_ros.base.parameter_values import settings_from, value_of
from gazelle_ros.base.tuned_fields import tunable

UNUSED: Final = frozenset(
    [
        "odom_topic",
        "map_frame",
        "transform_tolerance",
        "via_points_ordered",
        "exact_arc_length",
        "min_resolution_collision_check_angular",
        "is_footprint_dynamic",
        "complete_global_plan",
        "costmap_obstacles_behind_robot_dist",
        "obstacle_poses_affected",
        "legacy_obstacle_association",
        "obstacle_association_force_inclusion_factor",
        "obstacle_association_cutoff_factor",
        "costmap_converter_plugin",
        "costmap_converter_spin_thread",
        "costmap_converter_rate",
        "obstacle_proximity_ratio_max_vel",
        "obstacle_proximity_lower_bound",
        "obstacle_proximity_upper_bound",
        "optimization_verbose",
        "weight_velocity_obstacle_ratio",
        "weight_prefer_rotdir",
        "enable_multithreading",
        "max_number_plans_in_current_class",
        "selection_dropping_probability",
        "roadmap_graph_samples",
        "h_signature_prescaler",
        "h_signature_threshold",
        "visualize_hc_graph",
        "visualize_with_time_as_z_axis_scale",
        "delete_detours_backwards",
        "detours_orientation_tolerance",
        "length_start_orientation_vector",
        "shrink_horizon_backup",
        "shrink_horizon_min_duration",
        "oscillation_recovery",
        "oscillation_v_eps",
        "oscillation_omega_eps",
        "oscillation_recovery_min_duration",
        "oscillation_filter_duration",
        "divergence_detection",
        "divergence_detection_max_chi_squared",
        "feasibility_check_lookahead_distance",
        "prevent_look_ahead_poses_near_goal",
        "footprint_model",
    ]
)
"""Parameters of the original that are known and change nothing here."""


@dataclass(frozen=True, slots=True)
class TebSettings:
    """Parameters of ``teb_local_planner``; names and defaults are the original's.

    Of those that dynamic_reconfigure changes, limits and defaults are of its server: as in the original it
    sets them once at the start. Some differ from those of the class and of the documentation there.
    """

    teb_autosize: bool = tunable(True)
    dt_ref: float = tunable(0.3, 0.01, 1.0)
    dt_hysteresis: float = tunable(0.1, 0.002, 0.5)
    min_samples: int = 3
    max_samples: int = 500
    global_plan_overwrite_orientation: bool = tunable(True)
    allow_init_with_backwards_motion: bool = tunable(False)
    global_plan_viapoint_sep: float = tunable(-0.1, -0.1, 5.0)
    max_global_plan_lookahead_dist: float = tunable(3.0, 0.0, 50.0)
    global_plan_prune_distance: float = 1.0
    force_reinit_new_goal_dist: float = tunable(1.0, 0.0, 10.0)
    force_reinit_new_goal_angular: float = tunable(0.78, 0.0, 4.0)
    feasibility_check_no_poses: int = tunable(5, -1, 50)
    control_look_ahead_poses: int = tunable(1, 1, 100)
    max_vel_x: float = tunable(0.4, 0.01, 100.0)
    max_vel_x_backwards: float = tunable(0.2, 0.01, 100.0)
    max_vel_y: float = tunable(0.0, 0.0, 100.0)
    max_vel_trans: float = tunable(0.0, 0.0, 100.0)
    max_vel_theta: float = tunable(0.3, 0.01, 100.0)
    acc_lim_x: float = tunable(0.5, 0.01, 100.0)
    acc_lim_y: float = tunable(0.5, 0.01, 100.0)
    acc_lim_theta: float = tunable(0.5, 0.01, 100.0)
    min_turning_radius: float = tunable(0.0, 0.0, 50.0)
    wheelbase: float = tunable(1.0, -10.0, 10.0)
    cmd_angle_instead_rotvel: bool = tunable(False)
    use_proportional_saturation: bool = tunable(False)
    xy_goal_tolerance: float = tunable(0.2, 0.001, 10.0)
    yaw_goal_tolerance: float = tunable(0.1, 0.001, 3.2)
    free_goal_vel: bool = tunable(False)
    trans_stopped_vel: float = tunable(0.1, 0.0, math.inf)
    theta_stopped_vel: float = tunable(0.1, 0.0, math.inf)
    min_obstacle_dist: float = tunable(0.5, 0.0, 10.0)
    inflation_dist: float = tunable(0.6, 0.0, 15.0)
    publish_feedback: bool = tunable(False)
    include_costmap_obstacles: bool = tunable(True)
    include_dynamic_obstacles: bool = tunable(False)
    dynamic_obstacle_inflation_dist: float = tunable(0.6, 0.0, 15.0)
    no_inner_iterations: int = tunable(5, 1, 100)
    no_outer_iterations: int = tunable(4, 1, 100)
    optimization_activate: bool = tunable(True)
    penalty_epsilon: float = tunable(0.05, 0.0, 1.0)
    weight_max_vel_x: float = tunable(2.0, 0.0, 1000.0)
    weight_max_vel_y: float = tunable(2.0, 0.0, 1000.0)
    weight_max_vel_theta: float = tunable(1.0, 0.0, 1000.0)
    weight_acc_lim_x: float = tunable(1.0, 0.0, 1000.0)
    weight_acc_lim_y: float = tunable(1.0, 0.0, 1000.0)
    weight_acc_lim_theta: float = tunable(1.0, 0.0, 1000.0)
    weight_kinematics_nh: float = tunable(1000.0, 0.0, 10000.0)
    weight_kinematics_forward_drive: float = tunable(1.0, 0.0, 10000.0)
    weight_kinematics_turning_radius: float = tunable(1.0, 0.0, 1000.0)
    weight_optimaltime: float = tunable(1.0, 0.0, 1000.0)
    weight_shortest_path: float = tunable(0.0, 0.0, 100.0)
    weight_obstacle: float = tunable(50.0, 0.0, 1000.0)
    weight_inflation: float = tunable(0.1, 0.0, 10.0)
    weight_dynamic_obstacle: float = tunable(50.0, 0.0, 1000.0)
    weight_dynamic_obstacle_inflation: float = tunable(0.1, 0.0, 10.0)
    weight_viapoint: float = tunable(1.0, 0.0, 1000.0)
    weight_adapt_factor: float = tunable(2.0, 1.0, 100.0)
    obstacle_cost_exponent: float = tunable(1.0, 0.01, 100.0)
    enable_homotopy_class_planning: bool = True
    simple_exploration: bool = False
    max_number_classes: int = tunable(5, 1, 100)
    selection_cost_hysteresis: float = tunable(1.0, 0.0, 2.0)
    selection_prefer_initial_plan: float = tunable(0.95, 0.0, 1.0)
    selection_obst_cost_scale: float = tunable(2.0, 0.0, 1000.0)
    selection_viapoint_cost_scale: float = tunable(1.0, 0.0, 100.0)
    selection_alternative_time_cost: bool = tunable(False)
    switching_blocking_period: float = tunable(0.0, 0.0, 60.0)
    max_ratio_detours_duration_best_duration: float = 3.0
    viapoints_all_candidates: bool = tunable(True)
    obstacle_keypoint_offset: float = 0.1
    obstacle_heading_threshold: float = tunable(0.45, 0.0, 1.0)
    roadmap_graph_no_samples: int = tunable(15, 1, 100)
    roadmap_graph_area_width: float = tunable(5.0, 0.1, 20.0)
    roadmap_graph_area_length_scale: float = tunable(1.0, 0.5, 2.0)

    def __post_init__(self) -> None:
        for name in ("dt_ref", "max_vel_x", "max_vel_theta", "acc_lim_x", "acc_lim_theta"):
            if not 0.0 < getattr(self, name) < math.inf:
                raise Error(f"'{name}' must be above 0, not {getattr(self, name)}")
        for each in fields(self):
            value = getattr(self, each.name)
            if each.name.startswith("weight_") and not 0.0 <= value < math.inf:
                raise Error(f"'{each.name}' must be 0 or more, not {value}")
        for name in ("max_number_classes", "roadmap_graph_no_samples"):
            if not 1 <= getattr(self, name) <= 100:
                raise Error(f"'{name}' must be 1 to 100, not {getattr(self, name)}")
        if not 3 <= self.min_samples <= self.max_samples:
            raise Error(f"'min_samples' must be 3 to 'max_samples', not {self.min_samples}")

    @property
    def fastest(self) -> float:
        """Greatest speed in any direction [m/s]; ``max_vel_trans`` if that is given."""
        return self.max_vel_trans if self.max_vel_trans > 0.0 else self.max_vel_x

    @classmethod
    def read(cls, name: str, values: Mapping[str, Any]) -> TebSettings:
        """Read the parameters; unknown ones are warned of.

        Raises:
            Error: One is of the wrong kind, or out of range.
        """
        return settings_from(name, values, cls, others=UNUSED)


@dataclass(frozen=True, slots=True)
class TebFootprint:
    """Circles that stand for the robot.

    Attributes:
        centers: In the robot's frame [m], shape (n, 2).
        radii: Of the circles [m], shape (n,).
    """

    centers: Floats
    radii: Floats

    @classmethod
    def read(cls, values: Mapping[str, Any]) -> TebFootprint:
        """Return the shape by ``footprint_model``; lines are points, 5 cm apart.

        Raises:
            Error: The type is unknown, or a value is of the wrong kind.
        """
        model = values.get("footprint_model", {})
        if not isinstance(model, Mapping):
            raise Error(f"'footprint_model' must be a namespace, not {model!r:.60}")
        kind = value_of(model, "type", "point")
        if kind == "point":
            return cls(np.zeros((1, 2)), np.zeros(1))
        if kind == "circular":
            return cls(np.zeros((1, 2)), np.array([_number(model, "radius")]))
        if kind == "two_circles":
            offsets = _number(model, "front_offset"), -_number(model, "rear_offset")
            radii = _number(model, "front_radius"), _number(model, "rear_radius")
            return cls(np.array([[each, 0.0] for each in offsets]), np.array(radii))
        if kind == "line":
            corners = _points([model.get("line_start"), model.get("line_end")], "line_start")
            return _along(corners)
        if kind == "polygon":
            corners = _points(model.get("vertices"), "vertices")
            return _along(np.vstack((corners, corners[:1])))
        hint = did_you_mean(kind, ("point", "circular", "two_circles", "line", "polygon"))
        raise Error(f"'footprint_model/type' is no '{kind}'", hint=hint)


_APART = 0.05


def _along(corners: Floats) -> TebFootprint:
    """Return points along lines."""
    parts = [corners[-1:]]
    for first, last in itertools.pairwise(corners):
        count = max(1, math.ceil(float(np.hypot(*(last - first))) / _APART))
        share = np.arange(count)[:, None] / count
        parts.append(first + share * (last - first))
    centers = np.concatenate(parts)
    return TebFootprint(centers, np.zeros(len(centers)))


def _number(model: Mapping[str, Any], name: str) -> float:
    if name not in model:
        raise Error(f"'footprint_model/{name}' is missing")
    number = float(value_of(model, name, 0.0))
    if not 0.0 <= abs(number) < math.inf:
        raise Error(f"'footprint_model/{name}' must be a number, not {number}")
    return number


def _points(value: Any, name: str) -> Floats:
    try:
        points = np.array(value, np.float64)
    except (TypeError, ValueError):
        points = np.zeros(0)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2 or not np.isfinite(points).all():
        raise Error(f"'footprint_model/{name}' must be points [x, y], not {value!r:.60}")
    return points
