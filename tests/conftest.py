"""Fixtures that every room's tests share."""

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of public robot files, or a skipped test where it is not there."""
    beside = Path(__file__).parents[2] / "shared" / "corpus"
    folder = Path(os.environ.get("GAZELLE_CORPUS", beside))
    if not folder.is_dir():
        pytest.skip("the corpus of public robot files is not here (set GAZELLE_CORPUS)")
    return folder
