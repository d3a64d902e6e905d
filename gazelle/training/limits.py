"""Limits of what folders of runs may hold."""

MAX_BYTES = 1 << 36
"""Arrays of a checkpoint, unpacked: a replay memory of pictures is large."""

MAX_ENTRIES = 200_000
"""Files and folders that are looked at for runs: a home folder may have millions."""
