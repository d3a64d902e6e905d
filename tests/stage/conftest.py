"""Stage worlds that tests write, run and close."""

import pytest
from stage_samples import write

from gazelle.stage import StageSimulation


@pytest.fixture
def start(tmp_path):
    """Yield a function that makes a simulation of a world file's text, with one thread."""
    made = []

    def make(text, **options):
        made.append(StageSimulation(write(tmp_path, text), threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()
