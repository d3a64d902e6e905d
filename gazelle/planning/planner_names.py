"""Planners by the names that MoveIt's configurations have for OMPL's."""

from __future__ import annotations

import re
import warnings

from gazelle.errors import PlanningError, PlanningWarning, closest_of

OWN = "RRTConnect"
"""Planner used where OMPL is not installed, and on constraints."""

BOUND = {
    "AORRTC": "AORRTC",
    "BFMT": "BFMT",
    "BITstar": "BITstar",
    "BKPIECE": "BKPIECE1",
    "FMT": "FMT",
    "InformedRRTstar": "InformedRRTstar",
    "KPIECE": "KPIECE1",
    "LBKPIECE": "LBKPIECE1",
    "PRM": "PRM",
    "PRMstar": "PRMstar",
    "RRT": "RRT",
    "RRTConnect": "RRTConnect",
    "RRTstar": "RRTstar",
    "SORRTstar": "SORRTstar",
}
"""Names without ``geometric::``, and what OMPL's Python package calls them."""

UNBOUND = (
    "ABITstar",
    "AITstar",
    "AnytimePathShortening",
    "BiEST",
    "BiTRRT",
    "EST",
    "LBTRRT",
    "LazyPRM",
    "LazyPRMstar",
    "LazyRRT",
    "PDST",
    "ProjEST",
    "SBL",
    "SPARS",
    "SPARStwo",
    "STRIDE",
    "TRRT",
)
"""Planners that OMPL's Python package does not have; RRTConnect takes their place."""

_PLAIN = re.compile(r"^(?:\w+\[)?(?:geometric::)?(\w+?)(?:kConfigDefault|ConfigDefault)?\]?$")


def planner_of(name: str) -> str:
    """Return the planner of a name: a key of ``BOUND``.

    Args:
        name: Such as ``RRTConnect``, ``geometric::RRTConnect``, ``RRTConnectkConfigDefault`` or
            ``arm[RRTConnect]``; empty for the default.

    Raises:
        PlanningError: There is no such planner.
    """
    if not name:
        return OWN
    match = _PLAIN.match(name)
    plain = match.group(1) if match else name
    known = {each.lower(): each for each in (*BOUND, *UNBOUND, *BOUND.values())}
    found = known.get(plain.lower())
    if found is None:
        raise PlanningError(
            f"there is no planner '{name}'", hint=closest_of(plain, (*BOUND, *UNBOUND))
        )
    if found in UNBOUND:
        text = f"OMPL's Python package has no planner {found}; RRTConnect plans instead"
        warnings.warn(PlanningWarning(text), stacklevel=2)
        return OWN
    return next(key for key, value in BOUND.items() if found in (key, value))
