"""Processes of tests: whether they run."""

from pathlib import Path


def is_running(process):
    """Return whether a process runs; one that has ended and is not waited for yet does not."""
    try:
        stat = Path(f"/proc/{process}/stat").read_text(errors="replace")
    except (FileNotFoundError, ProcessLookupError):
        return False
    return stat.rpartition(")")[2].split()[0] not in "ZX"
