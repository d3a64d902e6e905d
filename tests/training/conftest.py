from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))
import corridor


@pytest.fixture(autouse=True)
def _corridors():
    corridor.register()


@pytest.fixture
def tiny():
    """A recipe that trains in a moment."""
    from gazelle.training import PPOSettings, Recipe

    return Recipe(
        steps=1024,
        num_envs=8,
        net_arch=(16,),
        settings=PPOSettings(n_steps=16, batch_size=32, n_epochs=2),
    )
