"""A class name is used once in the package, so that a reader knows which it is."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

import gazelle

PACKAGE = Path(gazelle.__file__).parent

TWICE = {
    "Body",
    "Caller",
    "Camera",
    "Clock",
    "Code",
    "Command",
    "Context",
    "Decoder",
    "Drive",
    "Encoder",
    "Entry",
    "Graph",
    "Joint",
    "JointStatePublisher",
    "Kind",
    "Layout",
    "Limits",
    "Machine",
    "Message",
    "Mimic",
    "Odometry",
    "Outcome",
    "Pacer",
    "Parameter",
    "Parameters",
    "Part",
    "Pictures",
    "Pieces",
    "Place",
    "Placement",
    "Plugin",
    "Publisher",
    "RangeNoise",
    "Rate",
    "Recipe",
    "Recorder",
    "Robot",
    "Scan",
    "Scene",
    "Schedule",
    "Scope",
    "Sight",
    "Solid",
    "Source",
    "Step",
    "Surface",
    "Table",
    "Transform",
    "Tree",
    "View",
}
"""Names that still are used more than once; to be emptied, never to grow."""


def class_names():
    """Of all modules but ROS's own, whose names are given, and bundled programs."""
    for path in PACKAGE.rglob("*.py"):
        place = path.relative_to(PACKAGE)
        if place.parts[0] == "assets" or place.parts[:2] == ("ros", "compat"):
            continue
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
                yield node.name


def test_class_names_are_used_once():
    assert {name for name, count in Counter(class_names()).items() if count > 1} <= TWICE
