"""Classes of Debian's genpy for packages that Debian has none for, made from our definitions."""

from __future__ import annotations

from rossuites import definitions
from rossuites.generating import generate


def generate_real_classes(packages, folder):
    """Return the entry of PYTHONPATH for a real client."""
    source, target = folder / "source", folder / "classes"
    definitions.write(packages, source)
    generate(source, target)
    return target
