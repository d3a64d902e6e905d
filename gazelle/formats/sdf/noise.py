"""``<noise>`` of a sensor's channel."""

from __future__ import annotations

from gazelle.description import Noise, NoiseType, Parameters
from gazelle.formats import values

_TYPES: dict[str, NoiseType] = {
    "none": "none",
    "gaussian": "gaussian",
    "gaussian_quantized": "gaussian_quantized",
}


def read_noise(node: Parameters | None, default: NoiseType = "none") -> Noise:
    """Read the noise; without a type it is of the ``default`` one, as in the schema.

    Raises:
        FormatError: The type is unknown, or a standard deviation is negative.
    """
    if node is None:
        return Noise()
    text = node.attributes.get("type", "") or values.word(node, "type", default)
    if text == "custom":  # made by a plugin
        return Noise()
    if text not in _TYPES:
        raise values.fail(
            node, f"unknown noise '{text}'", hint=f"there are: {', '.join(sorted(_TYPES))}"
        )
    return Noise(
        type=_TYPES[text],
        mean=values.real(node, "mean", 0.0),
        stddev=_deviation(node, "stddev"),
        bias_mean=values.real(node, "bias_mean", 0.0),
        bias_stddev=_deviation(node, "bias_stddev"),
        dynamic_bias_stddev=_deviation(node, "dynamic_bias_stddev"),
        dynamic_bias_correlation_time=values.real(node, "dynamic_bias_correlation_time", 0.0),
        precision=values.real(node, "precision", 0.0),
    )


def _deviation(node: Parameters, tag: str) -> float:
    value = values.real(node, tag, 0.0)
    if value < 0.0:
        raise values.fail(node.find(tag) or node, f"<{tag}> must not be negative, found {value:g}")
    return value
