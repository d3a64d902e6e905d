"""Classes of Debian's genpy for packages that Debian has none for, made from our definitions."""

from __future__ import annotations

from rossuites import definitions
from rossuites.generating import generate


def generate_real_classes(packages, folder):
    """What goes on PYTHONPATH of a real client."""
    source, target = folder / "source", folder / "classes"
    definitions.write(packages, source)
    generate(source, target)
    return target
