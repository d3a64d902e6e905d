"""Built pieces pass `gazelle check` and run, one by one."""

import inspect
import warnings

import pytest

import gazelle
from gazelle import builders, formats
from gazelle.description import World

PIECES = (
    "box", "building", "bush", "cabinet", "chair", "cylinder", "desk", "fence", "log",
    "office_chair", "plant", "road", "rock", "room", "round_table", "shelf", "sofa", "sphere",
    "table", "tree", "whiteboard",
)  # fmt: skip
NEEDED = {
    "box": {"name": "b"},
    "cylinder": {"name": "c"},
    "fence": {"points": [(0.0, 0.0), (3.0, 0.0), (3.0, 2.0)]},
    "road": {"points": [(0.0, 0.0), (3.0, 0.0), (6.0, 2.0)]},
    "room": {"length": 4.0, "width": 3.0},
    "sphere": {"name": "s"},
}


def built(name):
    """Yield the piece at a place where it can be pushed, if it is movable."""
    build = getattr(builders, name)
    yield build(**NEEDED.get(name, {}))
    if "movable" in inspect.signature(build).parameters:
        yield build(**NEEDED.get(name, {}), movable=True)


@pytest.mark.parametrize("name", PIECES)
def test_a_piece_passes_the_check_and_runs(name, tmp_path):
    for number, piece in enumerate(built(name)):
        file = tmp_path / f"{number}.world"
        formats.save(World(models=(builders.ground(), piece)), file)
        assert formats.check(file) == []
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            simulation = gazelle.Simulation(file)
        simulation.run(0.1)
        simulation.close()
