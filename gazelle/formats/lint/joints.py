"""Joints that do not do what their author meant."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from gazelle.description import Joint, JointAxis, JointPhysics, Model, World
from gazelle.errors import did_you_mean
from gazelle.formats.lint.diagnostic import Diagnostic
from gazelle.kinematics.mimics import leaders_of, mimic_cycles

_USUAL = JointPhysics()


def lint(world: World) -> Iterator[Diagnostic]:
    """Yield findings on every joint of a model that moves."""
    for top in world.models:
        for placed in top.walk():
            links = _link_names(placed.model)
            leaders = leaders_of((each.name, each) for each in placed.model.joints)
            cycles = mimic_cycles(leaders)
            known = {each.name for each in placed.model.joints} if leaders else set()
            for joint in placed.model.joints:
                name = f"{placed.scope}::{joint.name}"
                yield from _links(name, joint, links)
                yield from _ode_terms(name, joint)
                for axis in joint.axes:
                    yield from _axis(name, joint, axis)
                    yield from _mimic(name, joint, axis, known, cycles)
            if top.static and placed.model.joints:
                yield _in_static(placed.scope, placed.model)


def _links(name: str, joint: Joint, known: set[str]) -> Iterator[Diagnostic]:
    for role, link in (("parent", joint.parent), ("child", joint.child)):
        if link != "world" and link not in known:
            yield Diagnostic(
                "joint-link",
                f"joint '{name}' has the {role} link '{link}', which is not there",
                "the model cannot be simulated",
                did_you_mean(link, known),
                joint.source,
            )


def _link_names(model: Model, prefix: str = "") -> set[str]:
    names = {f"{prefix}{link.name}" for link in model.links}
    names |= {f"{prefix}{frame.name}" for frame in model.frames}
    for nested in model.models:
        names |= _link_names(nested, f"{prefix}{nested.name}::")
    return names


def _ode_terms(name: str, joint: Joint) -> Iterator[Diagnostic]:
    """Yield a diagnostic for terms that only ODE's solver uses."""
    given, usual = joint.physics, _USUAL
    terms = [
        term
        for term in ("fudge_factor", "cfm", "erp", "suspension_cfm", "suspension_erp")
        if getattr(given, term) != getattr(usual, term)
    ]
    if terms:
        yield Diagnostic(
            "ode-terms",
            f"joint '{name}' has ODE's {', '.join(terms)}, which has no effect here",
            "they make ODE's joints give way, or keep its motors from jumping at a stop",
            "for a joint that gives way use <spring_stiffness>, <damping> and limits with <stiffness>",
            joint.source,
        )


def _axis(name: str, joint: Joint, axis: JointAxis) -> Iterator[Diagnostic]:
    bounded = math.isfinite(axis.lower) or math.isfinite(axis.upper)
    if axis.lower > axis.upper:
        yield Diagnostic(
            "limits-crossed",
            f"joint '{name}': its lower limit {axis.lower:g} is above its upper {axis.upper:g}",
            "the joint is pushed from both sides at once",
            "swap the two limits",
            joint.source,
        )
    if joint.type == "prismatic" and not bounded:
        yield Diagnostic(
            "no-limits",
            f"prismatic joint '{name}' has no limits",
            "under its weight the link slides away for ever",
            "give it <limit> with <lower> and <upper>",
            joint.source,
        )
    for term, value in (("damping", axis.damping), ("friction", axis.friction)):
        if value < 0.0:
            yield Diagnostic(
                "negative-damping",
                f"joint '{name}' has a {term} of {value:g}",
                "below zero it drives the joint, or does nothing, instead of braking it",
                f"give a {term} of zero or more",
                joint.source,
            )
    if axis.effort == 0.0:
        yield Diagnostic(
            "no-effort",
            f"joint '{name}' has an effort limit of 0",
            "a controller cannot move it",
            "give the largest force or torque of its actuator, or leave the limit out",
            joint.source,
        )
    if axis.velocity == 0.0:
        yield Diagnostic(
            "no-velocity",
            f"joint '{name}' has a velocity limit of 0",
            "a planner or controller that keeps to it cannot move the joint",
            "give the largest speed of its actuator, or leave the limit out",
            joint.source,
        )


def _mimic(
    name: str, joint: Joint, axis: JointAxis, known: set[str], cycles: Mapping[str, str]
) -> Iterator[Diagnostic]:
    if axis.mimic is None:
        return
    if axis.mimic.joint not in known:
        yield Diagnostic(
            "mimic-leader",
            f"joint '{name}' mimics '{axis.mimic.joint}', which is not there",
            "it will not move",
            did_you_mean(axis.mimic.joint, known),
            joint.source,
        )
    if joint.name in cycles:
        yield Diagnostic(
            "mimic-cycle",
            f"joint '{name}' mimics itself: {cycles[joint.name]}",
            "none of these joints leads, so nothing can say where they are",
            "let one of them mimic no other",
            joint.source,
        )


def _in_static(scope: str, model: Model) -> Diagnostic:
    return Diagnostic(
        "static-joints",
        f"model '{scope}' is static, so its {len(model.joints)} joints do not move",
        "a static model is one piece of the world",
        "set <static> to false, or leave the joints out",
        model.source,
    )
