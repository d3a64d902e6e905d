"""Limits of what a launch file makes large."""

from __future__ import annotations

import os
import selectors
import stat
import subprocess
import time
from pathlib import Path

from gazelle_ros.launch.errors import LaunchError

MAX_FILES = 2_000
"""Includes of a launch, each counted as often as it is read."""

MAX_TEXT = 16 * 2**20
"""Characters of an attribute after substitution, and bytes of a file or of a command's output."""


def read_bounded(file: Path) -> bytes:
    """Return the content of a file.

    Raises:
        LaunchError: It is a pipe, or too large.
        OSError: It cannot be read.
    """
    if stat.S_ISFIFO(file.stat().st_mode):
        raise LaunchError(f"'{file}' is a pipe, and no file")
    with file.open("rb") as opened:
        data = opened.read(MAX_TEXT + 1)
    if len(data) > MAX_TEXT:
        raise LaunchError(f"'{file}' has more than the limit of {MAX_TEXT:,} bytes")
    return data


def check_text(text: str) -> str:
    """Return a text that is not too long.

    Raises:
        LaunchError: It is.
    """
    if len(text) > MAX_TEXT:
        raise LaunchError(f"it makes {len(text):,} characters, more than the limit of {MAX_TEXT:,}")
    return text


def communicate(process: subprocess.Popen[bytes], seconds: float) -> tuple[bytes, bytes]:
    """Return output and errors of a process at its end.

    Raises:
        LaunchError: It writes too much.
        TimeoutExpired: It does not end by then.
    """
    end = time.monotonic() + seconds
    found = {each.fileno(): bytearray() for each in (process.stdout, process.stderr) if each}
    with selectors.DefaultSelector() as streams:
        for each in found:
            streams.register(each, selectors.EVENT_READ)
        while streams.get_map():
            left = end - time.monotonic()
            if left <= 0.0:
                raise subprocess.TimeoutExpired(process.args, seconds)
            for key, _ in streams.select(left):
                data = os.read(key.fd, 1 << 16)
                found[key.fd] += data
                if not data:
                    streams.unregister(key.fd)
                if len(found[key.fd]) > MAX_TEXT:
                    raise LaunchError(f"it writes more than the limit of {MAX_TEXT:,} bytes")
    process.wait(max(0.0, end - time.monotonic()))
    output, errors = found.values()
    return bytes(output), bytes(errors)
