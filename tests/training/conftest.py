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
    """Return a recipe that trains in a moment."""
    from gazelle.training import PPOSettings, Recipe

    return Recipe(
        steps=1024,
        num_envs=8,
        net_arch=(16,),
        settings=PPOSettings(n_steps=16, batch_size=32, n_epochs=2),
    )


@pytest.fixture
def cli(capsys):
    """Return a runner of the command line, which returns exit code, output and errors."""
    from gazelle.cli.main import main

    def run(*arguments):
        code = main([str(argument) for argument in arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return run
