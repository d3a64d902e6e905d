"""Planners as the parameters of ``move_group`` name them."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any

from gazelle.errors import PlanningError, PlanningWarning
from gazelle.planning.planner_names import BOUND, planner_of
from gazelle.planning.state_validity import LONGEST_SEGMENT
from gazelle_ros.base.real_numbers import real
from gazelle_ros.builtin.parameters import private_values
from gazelle_ros.node import Node

PIPELINE = "ompl"


class PlannerSettings:
    """``planner_configs`` and what groups say of them, of the node's own parameters.

    Args:
        node: Node of the settings, or below ``planning_pipelines/ompl`` there.
    """

    def __init__(self, node: Node) -> None:
        own = private_values(node)
        pipelines = own.get("planning_pipelines")
        inner = pipelines.get(PIPELINE) if isinstance(pipelines, Mapping) else None
        self._received: dict[str, dict[str, str]] = {}
        self._given: Mapping[str, Any] = own if not isinstance(inner, Mapping) else {**own, **inner}

    def names(self, groups: list[str]) -> list[str]:
        """Return the valid values of ``planner_id``: each group, and ``GROUP[CONFIG]``."""
        found = []
        for group in groups:
            configs = self._group(group).get("planner_configs") or [*self._configs()] or [*BOUND]
            found += [group, *(f"{group}[{config}]" for config in configs)]
        return found

    def planner(self, name: str, group: str) -> str:
        """Return the planner of a ``planner_id``.

        The group's default, with a warning, if it is unknown.
        """
        plain = name.removeprefix(f"{group}[").removesuffix("]") if "[" in name else name
        plain = "" if plain == group else plain
        default = str(self._group(group).get("default_planner_config") or "")
        for each in (plain, default):
            if not each:
                continue
            kind = self.parameters(each, group).get("type", each)
            try:
                return planner_of(str(kind))
            except PlanningError as error:
                text = f"planner '{each}' of group '{group}': {error.message}; its default plans"
                warnings.warn(PlanningWarning(text), stacklevel=2)
        return ""

    def segment(self, group: str) -> float:
        """Return the distance of checked states, as a fraction of the extent."""
        value = self._group(group).get("longest_valid_segment_fraction", LONGEST_SEGMENT)
        number = real(value)
        return number if number is not None and number > 0.0 else LONGEST_SEGMENT

    def parameters(self, config: str, group: str) -> dict[str, str]:
        """Return the parameters of a planner's configuration and its group; empty without any."""
        found: dict[str, str] = {}
        for name in (config, f"{group}[{config}]") if group else (config,):
            given = self._configs().get(name)
            if isinstance(given, Mapping):
                found |= {str(key): str(value) for key, value in given.items()}
            found |= self._received.get(name, {})
        return found

    def set_parameters(
        self, config: str, group: str, values: Mapping[str, str], *, replace: bool
    ) -> None:
        """Set values of a planner's configuration; for one group if it is named."""
        name = f"{group}[{config}]" if group else config
        self._received[name] = ({} if replace else self._received.get(name, {})) | dict(values)

    def _configs(self) -> Mapping[str, Any]:
        found = self._given.get("planner_configs")
        return found if isinstance(found, Mapping) else {}

    def _group(self, name: str) -> Mapping[str, Any]:
        found = self._given.get(name)
        return found if isinstance(found, Mapping) else {}
