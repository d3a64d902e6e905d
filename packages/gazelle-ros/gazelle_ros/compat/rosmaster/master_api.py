"""A constant, where rosmaster keeps it."""

NUM_WORKERS = 3
"""Accepted everywhere, and not needed: one event loop notifies all nodes."""
