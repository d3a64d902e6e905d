"""Plugins that have nothing to do here, and need no word about it."""

from __future__ import annotations

from gazelle.simulation import WorldPlugin


class Silent(WorldPlugin):
    """Does nothing: Gazelle does what it is for by itself, or it is a library of others."""
