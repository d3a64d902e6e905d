"""Stage worlds that tests write, run and close."""

import pytest
from stage_samples import write

from gazelle.stage import StageSimulation


@pytest.fixture
def start(tmp_path):
    """Makes a simulation of the text of a world file, with one thread."""
    made = []

    def make(text, **options):
        made.append(StageSimulation(write(tmp_path, text), threads=1, **options))
        return made[-1]

    yield make
    for sim in made:
        sim.close()
