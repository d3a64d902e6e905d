"""Requests from other threads: each is carried out, also when nothing steps."""

import threading
from concurrent.futures import ThreadPoolExecutor

import pytest

from gazelle.simulation.requests import RequestQueue


def test_what_is_posted_while_another_owns_the_state_is_done_when_that_lets_go():
    queue, owned, let_go = RequestQueue(), threading.Event(), threading.Event()

    def hold():
        owned.set()
        assert let_go.wait(120.0)

    holder = threading.Thread(target=queue.call, args=(hold,))
    holder.start()
    assert owned.wait(60.0)
    posted = queue.post(lambda: "done")
    assert not posted.done()
    let_go.set()
    assert posted.result(timeout=60.0) == "done"
    holder.join()


def test_what_is_posted_while_the_owner_lets_go_waits_for_nobody():
    queue = RequestQueue()
    late = []
    drain = queue.drain

    def drain_and_post():
        drain()
        if not late:
            # As from another thread: after the last look, before the lock is free.
            late.append(None)
            other = threading.Thread(target=lambda: late.append(queue.post(lambda: 7)))
            other.start()
            other.join()

    queue.drain = drain_and_post
    assert queue.post(lambda: 5).result(timeout=60.0) == 5
    assert late[1].result(timeout=60.0) == 7


def test_work_within_work_is_done_at_once_and_what_waits_comes_after_it():
    queue, order = RequestQueue(), []

    def outer():
        order.append("outer begins")
        other = threading.Thread(target=lambda: queue.post(lambda: order.append("posted")))
        other.start()
        other.join()
        queue.call(lambda: order.append("inner"))
        order.append("outer ends")

    queue.call(outer)
    assert order == ["outer begins", "inner", "outer ends", "posted"]


def test_what_work_raises_goes_to_who_asked():
    with pytest.raises(ZeroDivisionError):
        RequestQueue().call(lambda: 1 / 0)


def test_many_threads_lose_nothing():
    queue, count = RequestQueue(), [0]

    def add():
        count[0] += 1

    def work(_):
        futures = [queue.post(add) for _ in range(200)]
        queue.call(add)
        return [future.result(timeout=60.0) for future in futures]

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(work, range(8)))
    assert count[0] == 8 * 201
