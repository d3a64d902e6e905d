"""Joints that controllers of ros_control cannot command."""

from __future__ import annotations

import math
from collections.abc import Iterator

from gazelle.description import TRANSMISSION_WIDTHS, Joint, Model, World
from gazelle.errors import did_you_mean
from gazelle.formats.lint.diagnostic import Diagnostic

_PLUGIN = "gazebo_ros_control"


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on every model with the plugin of ros_control."""
    for model in world.models:
        yield from _unknown_joints(model)
        if any(_PLUGIN in plugin.filename for plugin in model.plugins):
            yield from _left_out(model)
            yield from _unknown_types(model)


def _unknown_joints(model: Model) -> Iterator[Diagnostic]:
    """Yield transmissions of unknown joints."""
    known = {joint.name for joint in model.joints}
    for each in model.transmissions:
        for name, _ in each.joints:
            if name not in known:
                yield Diagnostic(
                    "transmission-joint",
                    f"transmission '{each.name}' is of the joint '{name}', which does not move or is not there",
                    "the plugin of ros_control does not come up",
                    did_you_mean(name, known),
                    each.source,
                )


def _unknown_types(model: Model) -> Iterator[Diagnostic]:
    """Yield types that ros_control has no transmission of, each once."""
    known = {*TRANSMISSION_WIDTHS, *(each.rpartition("/")[2] for each in TRANSMISSION_WIDTHS)}
    for kind, each in {each.type: each for each in reversed(model.transmissions)}.items():
        if kind not in known:
            yield Diagnostic(
                "transmission-type",
                f"transmission '{each.name}' is of the type '{kind}', which ros_control does not have",
                "a simulated robot runs without it, but the hardware of a real one does not load it",
                did_you_mean(kind, TRANSMISSION_WIDTHS),
                each.source,
            )


def _rolls(joint: Joint) -> bool:
    """Return whether a joint seems passive: it has neither position limits nor an effort limit."""
    return all(
        axis.lower == -math.inf and axis.upper == math.inf == axis.effort for axis in joint.axes
    )


def _left_out(model: Model) -> Iterator[Diagnostic]:
    """Yield movable joints without a transmission."""
    driven = {name for each in model.transmissions for name, _ in each.joints}
    if not driven:  # those of the parameter robot_description count, which no file shows
        return
    for joint in model.joints:
        led = any(axis.mimic for axis in joint.axes)
        if joint.axes and joint.name not in driven and not led and not _rolls(joint):
            yield Diagnostic(
                "joint-transmission",
                f"joint '{joint.name}' has no transmission",
                "controllers can neither read nor command it",
                "give it a <transmission>, unless it is to turn freely",
                joint.source,
            )
