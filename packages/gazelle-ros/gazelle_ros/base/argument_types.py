"""Numbers on command lines; a bad one is one clear error."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable
from typing import Any, TypeVar

N = TypeVar("N", int, float)

_NEGATIVE = re.compile(r"-(\.?\d|\.?inf\b|\.?nan\b)", re.IGNORECASE)

_LARGEST = 1e9
MOST_INT = 2**63 - 1
"""Largest int that arrays and files can hold."""


class NumberParser(argparse.ArgumentParser):
    """A parser that takes ``-1,0.5`` and ``-1e-3`` for values, as argparse takes ``-1``."""

    def _parse_optional(self, arg_string: str) -> Any:
        # An option such as "-1" (rostopic's "once") is still one, also in "-1l", but not "-15".
        if _NEGATIVE.match(arg_string) and not self._is_flags(arg_string):
            return None
        return super()._parse_optional(arg_string)

    def _is_flags(self, text: str) -> bool:
        """Return whether a text is an option, or several of one letter and no number."""
        known = self._option_string_actions
        if text in known:
            return True
        return _number(float, text) is None and all(f"-{letter}" in known for letter in text[1:])


def _number(kind: Callable[[str], N], text: str) -> N | None:
    """Return the number that a text is; None if it is none."""
    try:
        return kind(text)
    except (ValueError, OverflowError):
        return None


def _int(text: str) -> int:
    return int(text) if "e" not in text.lower() else int(float(text))


def positive_int(text: str) -> int:
    """Return an int of at least 1, also written like 2_000 or 1e6."""
    number = _number(_int, text)
    if number is None or number < 1:
        raise argparse.ArgumentTypeError(f"expected an int above 0, not '{text}'")
    if number > MOST_INT:
        raise argparse.ArgumentTypeError(f"expected an int below 2^63, not '{text}'")
    return number


def positive_float(text: str) -> float:
    """Return a number above 0, with an inverse and nanoseconds of an ordinary size, too."""
    number = _number(float, text)
    if number is None or not 0.0 < number < math.inf:
        raise argparse.ArgumentTypeError(f"expected a number above 0, not '{text}'")
    if not 1.0 / _LARGEST <= number <= _LARGEST:
        raise argparse.ArgumentTypeError(f"expected a number from 1e-9 to 1e9, not '{text}'")
    return number


def seconds(text: str) -> float:
    """Return a time of either sign that a clock can wait for [s]."""
    number = _number(float, text)
    if number is None or not -_LARGEST <= number <= _LARGEST:
        raise argparse.ArgumentTypeError(f"expected seconds from -1e9 to 1e9, not '{text}'")
    return number


def port_number(text: str) -> int:
    """Return a TCP port, 0 for any free one."""
    number = _number(int, text)
    if number is None or not 0 <= number < 65536:
        raise argparse.ArgumentTypeError(f"expected a port from 0 to 65535, not '{text}'")
    return number


def peer_port(text: str) -> int:
    """Return a TCP port that others connect to, so not 0."""
    number = port_number(text)
    if not number:
        raise argparse.ArgumentTypeError(f"expected a port from 1 to 65535, not '{text}'")
    return number
