"""Threads that share work."""

import gc
import threading
import time

import numpy as np
import pytest

from gazelle.errors import EngineError
from gazelle.native.paths import ModelPath, PosePath
from gazelle.native.worker_pool import WorkerPool


def worker_threads():
    return [each for each in threading.enumerate() if each.name.startswith("worker_")]


@pytest.fixture
def pool():
    made = WorkerPool(3)
    yield made
    made.close()


def test_every_part_is_done_once_by_a_thread_of_its_own(pool):
    for count in (30, 31, 1000):
        seen = pool.share(
            lambda first, last, part: (first, last, part, threading.get_ident()), count, 10
        )
        assert [each[0] for each in seen] == [0, *(each[1] for each in seen[:-1])]
        assert seen[-1][1] == count
        assert [each[2] for each in seen] == [0, 1, 2]
        assert len({each[3] for each in seen}) == 3


def test_little_work_is_done_at_once(pool):
    assert pool.share(lambda *part: part, 19, 10) == [(0, 19, 0)]
    assert not pool._workers


@pytest.mark.parametrize("who", [0, 1, 2])
def test_an_error_comes_after_all_have_ended_and_harms_nobody(pool, who):
    ended = []

    def work(first, last, part):
        if part == who:
            raise ValueError(f"part {part}")
        ended.append(part)

    with pytest.raises(ValueError, match=f"part {who}"):
        pool.share(work, 30, 10)
    assert sorted([*ended, who]) == [0, 1, 2]
    assert pool.share(lambda *part: part[2], 30, 10) == [0, 1, 2]


@pytest.mark.parametrize("nworld", [1, 2, 5, 1000])
def test_every_row_of_a_system_is_updated(pool, nworld):
    none = np.zeros((0, 3))
    start, attitude = np.arange(3.0), np.array([0.0, 0.0, 0.0, 1.0])
    path = ModelPath(
        none[:, 0], none, np.zeros((0, 4)), start, attitude, np.ones(3), False, np.zeros(nworld)
    )
    position, quaternion = np.full((nworld, 3), np.nan), np.full((nworld, 4), np.nan)
    arm, moved = np.zeros(3), np.zeros(1)
    system = PosePath(path, position, quaternion, arm=arm, turned=attitude, moved=moved)
    pool.update(system, nworld, 10**9)
    assert (position == start).all()
    assert (quaternion == quaternion[0]).all()


@pytest.mark.long
def test_threads_end_when_it_is_closed_or_forgotten():
    gc.collect()  # pools that other tests have forgotten
    before = len(worker_threads())
    for closed in (True, False):
        pool = WorkerPool(3)
        pool.share(lambda *part: part, 30, 10)
        assert len(worker_threads()) == before + 2
        if closed:
            pool.close()
            assert pool.share(lambda *part: part[2], 30, 10) == [0, 1, 2]
        del pool
        gc.collect()
        assert len(worker_threads()) == before


def test_nobody_is_no_crew():
    with pytest.raises(EngineError, match="at least 1"):
        WorkerPool(0)


class InterruptedLock:
    """A lock whose holder is interrupted as soon as it has it, once."""

    def __init__(self, lock):
        self.lock, self.interrupts = lock, 1

    def acquire(self):
        self.lock.acquire()
        if self.interrupts:
            self.interrupts -= 1
            raise KeyboardInterrupt

    def release(self):
        self.lock.release()


def test_ctrl_c_when_a_part_has_just_ended_is_no_deadlock(pool):
    def work(first, last, part):
        if part == 1:
            time.sleep(0.001)  # the caller waits
        return part

    pool.share(lambda *_: None, 30, 10)
    lock = pool._workers[0]._done = InterruptedLock(pool._workers[0]._done)
    interrupted = 0
    for _ in range(200):
        lock.interrupts = 1
        try:
            assert pool.share(work, 30, 10) == [0, 1, 2]
        except KeyboardInterrupt:
            interrupted += 1
    assert interrupted
    lock.interrupts = 0
    assert pool.share(work, 30, 10) == [0, 1, 2]
