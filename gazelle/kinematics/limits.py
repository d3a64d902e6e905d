"""Limits of what the arguments of kinematics make large."""

from __future__ import annotations

MAX_SAMPLES = 2**20
"""Random positions of joints that are drawn at once, such as attempts of inverse kinematics."""
