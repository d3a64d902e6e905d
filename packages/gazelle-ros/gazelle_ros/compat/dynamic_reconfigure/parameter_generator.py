"""The older name of `parameter_generator_catkin`."""

from gazelle_ros.compat.dynamic_reconfigure.parameter_generator_catkin import (
    ParameterGenerator,
    bool_t,
    double_t,
    int_t,
    str_t,
)

__all__ = ["ParameterGenerator", "bool_t", "double_t", "int_t", "str_t"]
