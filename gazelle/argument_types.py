"""Numbers on command lines; what is none is one clear error."""

from __future__ import annotations

import argparse


def positive_int(text: str) -> int:
    """An int of at least 1, also written like 2_000 or 1e6."""
    try:
        number = int(text) if "e" not in text.lower() else int(float(text))
    except (ValueError, OverflowError):
        number = 0
    if number < 1:
        raise argparse.ArgumentTypeError(f"expected an int above 0, not '{text}'")
    return number


def positive_float(text: str) -> float:
    """A finite number above 0."""
    try:
        number = float(text)
    except ValueError:
        number = 0.0
    if not 0.0 < number < float("inf"):
        raise argparse.ArgumentTypeError(f"expected a number above 0, not '{text}'")
    return number
