"""The lock on a simulation: posted work is done, a closed one refuses, an ended owner is reported."""

import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

from gazelle.errors import SimulationError
from gazelle.simulation.state_lock import StateLock


def test_what_is_posted_while_another_owns_the_state_is_done_when_that_gives_it_up():
    lock, owned, give_up = StateLock(), threading.Event(), threading.Event()

    def hold():
        owned.set()
        assert give_up.wait(120.0)

    holder = threading.Thread(target=lock.wrap(hold))
    holder.start()
    assert owned.wait(60.0)
    posted = lock.post(lambda: "done")
    assert not posted.done()
    give_up.set()
    assert posted.result(timeout=60.0) == "done"
    holder.join()


def test_what_is_posted_within_work_is_done_at_once_and_what_waits_comes_after_it():
    lock, order = StateLock(), []

    def outer():
        order.append("outer begins")
        other = threading.Thread(target=lambda: lock.post(lambda: order.append("posted")))
        other.start()
        other.join()
        lock.post(lambda: order.append("inner"))
        order.append("outer ends")

    lock.post(outer)
    assert order == ["outer begins", "inner", "outer ends", "posted"]


def test_what_posted_work_raises_is_in_its_future_and_stops_nobody():
    lock, order = StateLock(), []
    with lock:
        waits = []

        def post():
            waits.append(lock.post(lambda: 1 / 0))
            waits.append(lock.post(lambda: order.append("next")))

        other = threading.Thread(target=post)
        other.start()
        other.join()
    with pytest.raises(ZeroDivisionError):
        waits[0].result(timeout=60.0)
    assert order == ["next"]
    assert lock.owner == 0


def test_many_threads_lose_nothing():
    lock, count = StateLock(), [0]

    def add():
        count[0] += 1

    def work(_):
        futures = [lock.post(add) for _ in range(200)]
        with lock:
            add()
        return [future.result(timeout=60.0) for future in futures]

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(work, range(8)))
    assert count[0] == 8 * 201


def test_a_closed_lock_refuses_all_but_who_holds_it():
    lock, errors = StateLock(), []

    def ask():
        try:
            with lock:
                errors.append(None)
        except SimulationError as error:
            errors.append(error.message)

    with lock:
        waiting = threading.Thread(target=ask)
        waiting.start()
        while not lock.waiting:
            time.sleep(0.001)
        lock.close("over")
        with lock:
            pass
    waiting.join()
    ask()
    with pytest.raises(SimulationError, match="over"):
        lock.post(lambda: None).result()
    assert errors == ["over", "over"]
    assert lock.owner == 0


def test_a_thread_that_ended_with_the_lock_is_reported_to_all_that_wait():
    lock, errors = StateLock(), []

    def ask():
        with pytest.raises(SimulationError) as raised, lock:
            pass
        errors.append(raised.value)

    def hold():
        lock.acquire()
        held.set()
        while len(lock.waiting) < 3:
            time.sleep(0.001)

    held = threading.Event()
    ended = threading.Thread(target=hold)
    ended.start()
    held.wait()
    threads = [threading.Thread(target=ask) for _ in range(3)]
    for thread in threads:
        thread.start()
    for thread in [*threads, ended]:
        thread.join()
    assert len(errors) == 3
    assert all("a thread ended while it held the state lock" in error.message for error in errors)
    assert not lock.waiting
