import importlib.util

import pytest
from missing import skip_or_fail


@pytest.fixture(scope="session", autouse=True)
def bullet():
    """The other engine, or a skipped test where it is not there."""
    if importlib.util.find_spec("pybullet") is None:
        skip_or_fail(
            "Bullet, the second physics engine, is not here (pip install 'gazelle[oracle]')"
        )
