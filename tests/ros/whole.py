"""Mark of tests that need the package gazelle, where only gazelle-ros is installed."""

from importlib.util import find_spec

import pytest

needs_gazelle = pytest.mark.skipif(find_spec("gazelle") is None, reason="gazelle is not installed")
