"""Limits of what the folder of a run may hold."""

MAX_BYTES = 1 << 36
"""Arrays of a checkpoint, unpacked: a replay memory of pictures is large."""
