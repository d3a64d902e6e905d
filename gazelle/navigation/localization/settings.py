"""Parameters of ``amcl``."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gazelle.argument_checks import checked
from gazelle.errors import Error, did_you_mean
from gazelle.navigation.localization.odometry_models import check_model
from gazelle_ros.base.parameter_values import Values, fields_of

LASER_MODELS = ("likelihood_field", "beam", "likelihood_field_prob")


@checked(Error)
@dataclass(frozen=True, slots=True)
class AmclSettings:
    """Parameters; names and defaults are those of ``amcl``.

    Attributes:
        laser_surfaces_only: Of Gazelle alone, for both models of the likelihood field: measure distances
            from the cells of obstacles that a laser can see, not from those inside. On a map with thick
            walls each end of a beam within a wall fits as well as one on it, as in the original, which
            draws estimates some 0.1 to 0.2 m towards walls.
    """

    min_particles: int = 100
    max_particles: int = 5000
    kld_err: float = 0.01
    kld_z: float = 0.99
    update_min_d: float = 0.2
    update_min_a: float = math.pi / 6.0
    resample_interval: int = 2
    recovery_alpha_slow: float = 0.001
    recovery_alpha_fast: float = 0.1
    selective_resampling: bool = False
    laser_min_range: float = -1.0
    laser_max_range: float = -1.0
    laser_max_beams: int = 30
    laser_z_hit: float = 0.95
    laser_z_short: float = 0.1
    laser_z_max: float = 0.05
    laser_z_rand: float = 0.05
    laser_sigma_hit: float = 0.2
    laser_lambda_short: float = 0.1
    laser_likelihood_max_dist: float = 2.0
    laser_model_type: str = "likelihood_field"
    laser_surfaces_only: bool = False
    do_beamskip: bool = False
    beam_skip_distance: float = 0.5
    beam_skip_threshold: float = 0.3
    beam_skip_error_threshold: float = 0.9
    odom_model_type: str = "diff"
    odom_alpha1: float = 0.2
    odom_alpha2: float = 0.2
    odom_alpha3: float = 0.2
    odom_alpha4: float = 0.2
    odom_alpha5: float = 0.2

    @classmethod
    def read(cls, values: Values) -> AmclSettings:
        """Read the parameters.

        Raises:
            Error: One is of the wrong kind, or a model is unknown.
        """
        # The original has this name with a dash at its end, too, which goes before the other one.
        name = "beam_skip_error_threshold"
        if f"{name}_" in values:
            values = {**values, name: values[f"{name}_"]}
        return cls(**fields_of(cls, values))

    def __post_init__(self) -> None:
        check_model(self.odom_model_type)
        laser = self.laser_model_type
        if laser not in LASER_MODELS:
            raise Error(
                f"the laser model '{laser}' is unknown", hint=did_you_mean(laser, LASER_MODELS)
            )
