"""Logging of ROS tools: Python's, with a file if the environment names a folder."""

from __future__ import annotations

import logging
import os
from pathlib import Path


def configure_logging(
    logname: str,
    level: int = logging.INFO,
    filename: str | None = None,
    env: dict[str, str] | None = None,
) -> str | None:
    """Log to a file, if one is named or ROS_LOG_DIR is set.

    Returns:
        The file; None if there is none.
    """
    folder = (os.environ if env is None else env).get("ROS_LOG_DIR")
    if filename is None and folder:
        filename = str(Path(folder) / f"{logname}.log")
    if filename is None:
        return None
    Path(filename).parent.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(filename=filename, level=level)
    return filename
