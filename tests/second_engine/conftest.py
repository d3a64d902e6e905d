import importlib.util

import pytest


@pytest.fixture(scope="session", autouse=True)
def bullet():
    """Skip the test without the other engine."""
    if importlib.util.find_spec("pybullet") is None:
        pytest.skip(
            "Bullet, the second physics engine, is not here (pip install 'gazelle[oracle]')"
        )
