"""Arms under ros_control in a simulation."""

from __future__ import annotations

from pathlib import Path

import gazelle
from gazelle import formats
from gazelle.description import World

DATA = Path(__file__).parents[1] / "data"


def arm_text(interface="Effort", **changes):
    """Return the URDF of the two-link arm, commanded through an interface."""
    text = (DATA / "two_link_arm.urdf").read_text(encoding="utf-8")
    for old, new in changes.pop("replace", {}).items():
        assert old in text
        text = text.replace(old, new)
    return text.replace("INTERFACE", interface)


def arm(interface="Effort", nworld=1, replace=None, **options):
    """Return a simulation with it, and the robot."""
    model = formats.load_model_string(arm_text(interface, replace=replace or {}))
    sim = gazelle.Simulation(World("w"), nworld=nworld, **options)
    return sim, sim.spawn(model)


JOINTS = ["shoulder", "elbow"]
