"""Ten thousand robots in a Stage file: how long it takes to load, and what each weighs."""

import gc
import time
import tracemalloc

import pytest
from stage_samples import write

from gazelle.stage import StageSimulation


def crowd(folder, count):
    """Return robots without sensors, a line each."""
    lines = ['define robot position ( size [.2552 .2552 .4] drive "diff" color "gray" )']
    lines += [
        f'robot ( name "r{i}" pose [ {0.7 * (i % 100):.3f} {0.7 * (i // 100):.3f} 0 {i % 360}.5 ] )'
        for i in range(count)
    ]
    return write(folder, "\n".join(lines))


@pytest.mark.long
def test_ten_thousand_load_within_a_second_or_two(tmp_path):
    file = crowd(tmp_path, 10_000)
    times = []
    for _ in range(2):
        began = time.process_time()
        with StageSimulation(file, threads=1) as sim:
            times.append(time.process_time() - began)
            assert len(sim.robots) == 10_000
    assert min(times) < 5.0  # 0.8 s on an AMD EPYC; Stage takes ten


@pytest.mark.long
def test_each_takes_less_than_four_kilobytes_with_what_the_file_says_of_it(tmp_path):
    count = 2_000
    file = crowd(tmp_path, count)
    StageSimulation(file, threads=1).close()
    gc.collect()
    tracemalloc.start()
    try:
        with StageSimulation(file, threads=1) as sim:
            sim.step()
            gc.collect()
            used, _ = tracemalloc.get_traced_memory()
    finally:
        tracemalloc.stop()
    assert used / count < 4000
