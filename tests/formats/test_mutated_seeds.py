"""Files that Gazelle writes are read whole, and broken ones end in a result or in one of its errors."""

import random

import mutated_seeds
import pytest
import structured_mutations
from mutated_ros_readers import READERS

from gazelle import Error

BROKEN = 4
"""Broken copies of each file; ``tools/mutate_files.py`` makes thousands."""
REFUSED = {"ground.world", "inc.xacro"}
"""One names a part that its mesh lacks, one is only there to be included."""


@pytest.mark.long
@pytest.mark.filterwarnings("ignore")
def test_made_files_are_read_whole_and_do_no_harm_broken(tmp_path):
    chance, kinds = random.Random(1), set()
    for seed in mutated_seeds.make_seeds(tmp_path):
        whole = seed.file.read_bytes()
        kinds.add(seed.reader)
        if seed.file.name in REFUSED:
            with pytest.raises(Error):
                READERS[seed.reader](seed.file)
        else:
            READERS[seed.reader](seed.file)
        for _ in range(BROKEN):
            broken = structured_mutations.broken(seed.family, whole, chance)
            seed.file.write_bytes(broken)
            try:
                READERS[seed.reader](seed.file)
            except Error:
                continue
            except Exception as error:
                raise AssertionError(
                    f"{seed.reader} {seed.file.name}: {broken[:2000]!r}"
                ) from error
        seed.file.write_bytes(whole)
    assert len(kinds) > 15
