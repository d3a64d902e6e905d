import importlib.util

import pytest


@pytest.fixture(scope="session", autouse=True)
def bullet():
    """The other engine, or a skipped test where it is not there."""
    if importlib.util.find_spec("pybullet") is None:
        pytest.skip(
            "Bullet, the second physics engine, is not here (pip install 'gazelle[oracle]')"
        )
