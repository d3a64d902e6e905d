"""What to do when something that a test compares with is not there."""

import os
from typing import NoReturn

import pytest


def skip_or_fail(reason: str) -> NoReturn:
    """Skip the test; in CI fail it, for there everything has been installed."""
    if os.environ.get("CI"):
        pytest.fail(f"{reason}; in CI it must be", pytrace=False)
    pytest.skip(reason)
