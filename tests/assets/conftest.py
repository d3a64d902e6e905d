"""Where the public files are that the bundled ones are compared with."""

from __future__ import annotations

import os
from pathlib import Path

import pytest


@pytest.fixture(scope="session")
def corpus():
    beside = Path(__file__).parents[3] / "shared" / "corpus"
    folder = Path(os.environ.get("GAZELLE_CORPUS", beside))
    if not folder.is_dir():
        pytest.skip("no corpus of public robot files (GAZELLE_CORPUS)")
    return folder
