"""What to do when something that a test compares with is not there."""

import os
from typing import NoReturn

import pytest


def skip_or_fail(reason: str, *, whole_file: bool = False) -> NoReturn:
    """Skip the test, or the file that is being imported; in CI fail it, for there everything has been installed."""
    if os.environ.get("CI"):
        pytest.fail(f"{reason}; in CI it must be", pytrace=False)
    pytest.skip(reason, allow_module_level=whole_file)
