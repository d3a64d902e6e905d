"""Description of a built-in ROS package."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path


@dataclass(frozen=True, slots=True)
class BuiltinPackage:
    """A ROS package that Gazelle stands in for where it is not installed."""

    name: str
    nodes: Mapping[str, str] = field(default_factory=dict)
    """From the type of a node to ``module:function``, a `Main`."""
    nodelets: Mapping[str, str] = field(default_factory=dict)
    """From the class of a nodelet, without the package, to ``module:function``, which makes a `NodeWork`."""
    folder: Path | None = None
    """Result of ``$(find PACKAGE)``, if it has files."""
    skipped: str | None = None
    """Why its nodes are left out, such as "it needs a screen"; all others of it are then skipped."""
    windows: Mapping[str, str] = field(default_factory=dict)
    """From a program with a window to ``module:function``; launch files leave it out, ``rosrun`` runs it."""
    preferred: frozenset[str] = frozenset()
    """Node types run from here even where the installed package has a program for them."""
    process_names: Mapping[str, str] = field(default_factory=dict)
    """From the type of a node to what its process is called, where that is something else."""
