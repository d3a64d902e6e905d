"""A costmap from its ROS parameters, in the form with plugins or in the flat one before it."""

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from gazelle.argument_checks import checked
from gazelle.errors import Error, SimulationWarning, did_you_mean
from gazelle.navigation.costmap.costmap import Costmap, Layer
from gazelle.navigation.costmap.footprint import footprint_of
from gazelle.navigation.costmap.inflation_layer import InflationLayer
from gazelle.navigation.costmap.obstacle_layer import ObservationSource, ObstacleLayer
from gazelle.navigation.costmap.static_layer import StaticLayer
from gazelle.navigation.costmap.voxel_layer import VoxelLayer
from gazelle_ros.base.parameter_values import Values, value_of


@dataclass(frozen=True, slots=True)
class SensorTopic:
    """Topic of a sensor that feeds a layer.

    Attributes:
        layer: Name of the layer that it is for.
        source: Its name in the layer.
        topic: Of its messages.
        kind: LaserScan, PointCloud or PointCloud2.
        sensor_frame: Of the sensor; empty for that of its messages.
        inf_is_valid: Whether an infinite range means free space up to the sensor's greatest.
        expected_update_rate: Longest time between two messages [s]; 0 for any.
    """

    layer: str
    source: str
    topic: str
    kind: str = "PointCloud"
    sensor_frame: str = ""
    inf_is_valid: bool = False
    expected_update_rate: float = 0.0


@checked(Error)
@dataclass(frozen=True, slots=True)
class CostmapSetup:
    """A costmap and what feeds it.

    Attributes:
        costmap: The costmap.
        base_frame: Of the robot.
        update_frequency: Update rate [Hz].
        publish_frequency: Publishing rate [Hz]; 0 for never.
        transform_tolerance: Largest age of the robot's pose [s].
        map_topics: Of static layers, by the layer's name.
        sensors: Topics of sensors.
        always_full: Publish all of it each time, never only what changed.
        padding: Of footprints that come later [m].
    """

    costmap: Costmap
    base_frame: str
    update_frequency: float
    publish_frequency: float
    transform_tolerance: float
    map_topics: Mapping[str, str]
    sensors: tuple[SensorTopic, ...]
    always_full: bool
    padding: float


def costmap_of(values: Values, *, name: str = "costmap", frame: str = "map") -> CostmapSetup:
    """Return a costmap from its parameters.

    Args:
        values: Parameters below ``~global_costmap`` or ``~local_costmap``, nested.
        name: Of the costmap, for messages.
        frame: If ``global_frame`` is not there.

    Raises:
        Error: A parameter is wrong, or a layer's type unknown.
    """
    plugins = values.get("plugins")
    if plugins is None:
        values, plugins = _from_flat(values, name)
    layers: list[Layer] = []
    maps: dict[str, str] = {}
    sensors: list[SensorTopic] = []
    for plugin in plugins:
        layer = _layer(plugin, values, maps, sensors)
        layer.enabled = value_of(section(values, layer.name), "enabled", True)
        layers.append(layer)
    padding = value_of(values, "footprint_padding", 0.01)
    costmap = Costmap(
        layers,
        footprint_of(
            values.get("footprint", "[]"), value_of(values, "robot_radius", 0.46), padding
        ),
        width=value_of(values, "width", 10.0),
        height=value_of(values, "height", 10.0),
        resolution=value_of(values, "resolution", 0.05),
        origin=(value_of(values, "origin_x", 0.0), value_of(values, "origin_y", 0.0)),
        rolling=value_of(values, "rolling_window", False),
        track_unknown=value_of(values, "track_unknown_space", False),
        frame=value_of(values, "global_frame", frame).strip("/"),
    )
    return CostmapSetup(
        costmap,
        value_of(values, "robot_base_frame", "base_link").strip("/"),
        value_of(values, "update_frequency", 5.0),
        value_of(values, "publish_frequency", 0.0),
        value_of(values, "transform_tolerance", 0.3),
        maps,
        tuple(sensors),
        value_of(values, "always_send_full_costmap", False),
        padding,
    )


def section(values: Values, name: str) -> Values:
    """Return the parameters below a name; none if there is no mapping."""
    found = values.get(name, {})
    return found if isinstance(found, Mapping) else {}


_STATIC_KEYS = (
    "map_topic", "lethal_cost_threshold", "unknown_cost_value", "trinary_costmap", "use_maximum",
    "subscribe_to_updates",
)  # fmt: skip
_INFLATION_KEYS = ("inflation_radius", "cost_scaling_factor", "inflate_unknown")


def _from_flat(values: Values, name: str) -> tuple[Values, list[dict[str, str]]]:
    """Convert flat parameters, older than plugins, to layers as costmap_2d does it."""
    nested: dict[str, Any] = dict(values)
    plugins = []
    default_map = not value_of(values, "rolling_window", False)
    if value_of(values, "static_map", default_map):
        plugins.append({"name": "static_layer", "type": "costmap_2d::StaticLayer"})
        own = {key: values[key] for key in _STATIC_KEYS if key in values}
        nested["static_layer"] = {**own, **section(values, "static_layer")}
    voxel = str(values.get("map_type", "costmap")) == "voxel"
    kind = "VoxelLayer" if voxel else "ObstacleLayer"
    plugins.append({"name": "obstacle_layer", "type": f"costmap_2d::{kind}"})
    taken = {*_STATIC_KEYS, *_INFLATION_KEYS, "static_layer", "obstacle_layer", "inflation_layer"}
    own = {key: value for key, value in values.items() if key not in taken}
    nested["obstacle_layer"] = {**own, **section(values, "obstacle_layer")}
    plugins.append({"name": "inflation_layer", "type": "costmap_2d::InflationLayer"})
    own = {key: values[key] for key in _INFLATION_KEYS if key in values}
    nested["inflation_layer"] = {**own, **section(values, "inflation_layer")}
    if any(key in values for key in (*_INFLATION_KEYS, "observation_sources", "map_type")):
        warnings.warn(
            SimulationWarning(
                f"{name}: pre-Hydro parameters are used for the layers static_layer, "
                "obstacle_layer and inflation_layer; name them in 'plugins'"
            ),
            stacklevel=3,
        )
    return nested, plugins


def _layer(plugin: Any, values: Values, maps: dict[str, str], sensors: list[SensorTopic]) -> Layer:
    """Return the layer of an entry ``{name, type}`` of ``plugins``."""
    if not isinstance(plugin, Mapping) or not {"name", "type"} <= set(plugin):
        raise Error(f"an entry of 'plugins' has a name and a type, not {plugin!r}")
    name, kind = str(plugin["name"]), str(plugin["type"])
    known = {f"costmap_2d::{each}": make for each, make in _LAYERS.items()}
    if kind not in known:
        raise Error(f"the layer type '{kind}' is unknown", hint=did_you_mean(kind, known))
    return known[kind](name, values, maps, sensors)


def _static(name: str, values: Values, maps: dict[str, str], sensors: list[SensorTopic]) -> Layer:
    del sensors
    own = section(values, name)
    maps[name] = value_of(own, "map_topic", "map")
    return StaticLayer(
        name,
        lethal=value_of(own, "lethal_cost_threshold", 100),
        unknown=value_of(own, "unknown_cost_value", -1),
        trinary=value_of(own, "trinary_costmap", True),
        use_maximum=value_of(own, "use_maximum", False),
    )


def _inflation(
    name: str, values: Values, maps: dict[str, str], sensors: list[SensorTopic]
) -> Layer:
    del maps, sensors
    own = section(values, name)
    return InflationLayer(
        name,
        radius=value_of(own, "inflation_radius", 0.55),
        scaling=value_of(own, "cost_scaling_factor", 10.0),
        inflate_unknown=value_of(own, "inflate_unknown", False),
    )


def _obstacle(name: str, values: Values, maps: dict[str, str], sensors: list[SensorTopic]) -> Layer:
    del maps
    own = section(values, name)
    return ObstacleLayer(
        name,
        _sources(name, own, sensors),
        max_height=value_of(own, "max_obstacle_height", 2.0),
        footprint_clearing=value_of(own, "footprint_clearing_enabled", True),
        overwrite=value_of(own, "combination_method", 1) == 0,
    )


def _voxel(name: str, values: Values, maps: dict[str, str], sensors: list[SensorTopic]) -> Layer:
    del maps
    own = section(values, name)
    return VoxelLayer(
        name,
        _sources(name, own, sensors),
        z_voxels=value_of(own, "z_voxels", 10),
        z_resolution=value_of(own, "z_resolution", 0.2),
        origin_z=value_of(own, "origin_z", 0.0),
        unknown_threshold=value_of(own, "unknown_threshold", 15),
        mark_threshold=value_of(own, "mark_threshold", 0),
        max_height=value_of(own, "max_obstacle_height", 2.0),
        footprint_clearing=value_of(own, "footprint_clearing_enabled", True),
        overwrite=value_of(own, "combination_method", 1) == 0,
    )


def _sources(layer: str, own: Values, sensors: list[SensorTopic]) -> dict[str, ObservationSource]:
    """Return the sensors of ``observation_sources``."""
    found = {}
    for name in str(own.get("observation_sources", "")).split():
        values = section(own, name)
        sensors.append(
            SensorTopic(
                layer,
                name,
                value_of(values, "topic", name),
                value_of(values, "data_type", "PointCloud"),
                value_of(values, "sensor_frame", "").strip("/"),
                value_of(values, "inf_is_valid", False),
                value_of(values, "expected_update_rate", 0.0),
            )
        )
        # A source of its own range goes before the layer's.
        near, far = value_of(own, "obstacle_range", 2.5), value_of(own, "raytrace_range", 3.0)
        found[name] = ObservationSource(
            marking=value_of(values, "marking", True),
            clearing=value_of(values, "clearing", False),
            obstacle_range=value_of(values, "obstacle_range", near),
            raytrace_range=value_of(values, "raytrace_range", far),
            min_height=value_of(values, "min_obstacle_height", 0.0),
            max_height=value_of(values, "max_obstacle_height", 2.0),
            persistence=value_of(values, "observation_persistence", 0.0),
        )
    return found


_LAYERS: dict[str, Callable[[str, Values, dict[str, str], list[SensorTopic]], Layer]] = {
    "StaticLayer": _static,
    "ObstacleLayer": _obstacle,
    "VoxelLayer": _voxel,
    "InflationLayer": _inflation,
}
