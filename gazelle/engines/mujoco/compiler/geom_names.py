"""Names of geoms all at once: of a city's hundreds of thousands, MuJoCo's views take seconds."""

from __future__ import annotations

import mujoco


def geom_names(model: mujoco.MjModel) -> list[str]:
    """Return the names of all geoms, by number."""
    text = bytes(model.names)
    starts: list[int] = model.name_geomadr.tolist()
    return [text[start : text.index(b"\0", start)].decode() for start in starts]


def geom_ids(model: mujoco.MjModel) -> dict[str, int]:
    """Return the ids of all geoms, by name."""
    return {name: number for number, name in enumerate(geom_names(model))}
