"""The event loop and its thread pool: who runs what, and who closes what."""

from __future__ import annotations

import ast
import gc
import logging
import os
import socket
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from ros.graph import until

import gazelle_ros
from gazelle_ros import loop as loops
from gazelle_ros import thread_pool
from gazelle_ros.loop import READ, WRITE, EventLoop
from gazelle_ros.serial_queue import SerialQueue


@pytest.fixture
def loop():
    made = EventLoop()
    yield made
    made.stop()


@pytest.fixture
def pair():
    ends = socket.socketpair()
    for end in ends:
        end.setblocking(False)
    yield ends
    for end in ends:
        end.close()


def workers():
    return [t for t in threading.enumerate() if t.name.startswith("gazelle-ros-")]


# Sockets -----------------------------------------------------------------------------------


def test_a_handler_is_called_on_the_loop_for_what_it_asked_for(loop, pair):
    here, there = pair
    seen = []

    def ready(events):
        seen.append((events, threading.current_thread() is loop._thread))
        loop.unwatch(here)

    loop.run(lambda: loop.watch(here, READ, ready))
    time.sleep(0.02)
    assert seen == []
    there.send(b"x")
    until(lambda: seen)
    loop.run(lambda: loop.watch(here, READ | WRITE, ready))
    until(lambda: len(seen) == 2)
    time.sleep(0.02)
    assert seen == [(READ, True), (READ | WRITE, True)]


@pytest.mark.parametrize("use", ["watch", "unwatch", "close"])
def test_only_the_loop_handles_the_sockets_it_watches(loop, pair, use):
    arguments = (READ, print) if use == "watch" else ()
    with pytest.raises(RuntimeError, match="only the event loop's thread"):
        getattr(loop, use)(pair[0], *arguments)
    assert pair[0].fileno() >= 0


def test_a_closed_socket_is_refused_aloud(loop, pair):
    pair[0].close()
    with pytest.raises(ValueError, match="a closed socket cannot be watched"):
        loop.run(lambda: loop.watch(pair[0], READ, print))


def test_closing_forgets_the_number_and_again_is_harmless(loop, pair):
    here, _ = pair
    number = here.fileno()
    loop.run(lambda: loop.watch(here, READ, print))
    assert loop.run(lambda: loop.watches(number))
    for _ in range(2):
        loop.run(lambda: loop.close(here))
    assert not loop.run(lambda: loop.watches(number))
    assert here.fileno() == -1


def test_a_socket_closed_behind_the_loops_back_is_said_and_its_number_serves_the_next(
    loop, pair, caplog
):
    here, _ = pair
    number = here.fileno()
    loop.run(lambda: loop.watch(here, READ, print))
    mine, theirs = socket.socketpair()
    here.close()
    os.dup2(mine.fileno(), number)
    heir = socket.socket(fileno=number)
    heard = threading.Event()
    with caplog.at_level(logging.ERROR, "gazelle.ros"):
        loop.run(lambda: loop.watch(heir, READ, lambda _events: (heard.set(), loop.unwatch(heir))))
    assert "was closed while it was watched" in caplog.text
    theirs.send(b"x")
    assert heard.wait(60)
    for each in (heir, mine, theirs):
        each.close()


def test_a_handler_may_close_a_socket_that_is_ready_in_the_same_round(loop):
    pairs = [socket.socketpair() for _ in range(2)]
    called = []

    def ready(_events):
        called.append(1)
        for here, _ in pairs:
            loop.close(here)

    def start():
        for here, there in pairs:
            there.send(b"x")
            loop.watch(here, READ, ready)

    loop.run(start)
    until(lambda: called)
    time.sleep(0.05)
    assert called == [1]
    for _, there in pairs:
        there.close()


@pytest.mark.long
def test_no_module_closes_a_watched_socket_itself():
    """Who gives its sockets to the loop leaves closing to it; a blocking client has no loop."""
    found = [
        f"{path.name}:{node.lineno} {ast.unparse(node)}"
        for path in Path(gazelle_ros.__file__).parent.rglob("*.py")
        for part in ast.parse(path.read_text(encoding="utf-8")).body
        if isinstance(part, ast.ClassDef) and "loop.watch(" in ast.unparse(part)
        for node in ast.walk(part)
        if isinstance(node, ast.Call)
        and ast.unparse(node.func)
        in {"self._sock.close", "self.sock.close", "self._listener.close"}
    ]
    assert found == []


# Timers and tasks --------------------------------------------------------------------------


def test_timers_run_in_order_and_can_be_cancelled(loop, monkeypatch):
    seen, now = [], [0.0]
    monkeypatch.setattr(loops, "time", SimpleNamespace(monotonic=lambda: now[0]))
    for name, seconds in (("c", 0.06), ("a", 0.02), ("b", 0.04)):
        loop.call_later(seconds, lambda name=name: seen.append(name))
    loop.call_later(0.03, lambda: seen.append("never")).cancel()
    loop.run(lambda: None)
    assert seen == []
    for time_now, wanted in ((0.03, ["a"]), (1.0, ["a", "b", "c"])):
        now[0] = time_now
        loop.run(lambda: None)
        until(lambda wanted=wanted: seen == wanted)


def test_run_returns_what_the_function_does_and_raises_what_it_raises(loop):
    assert loop.run(loop.is_current) is True
    assert loop.run(lambda: loop.run(lambda: 7)) == 7
    with pytest.raises(ZeroDivisionError):
        loop.run(lambda: 1 / 0)


def test_what_raises_ends_neither_loop_nor_worker(loop, caplog):
    for ask in (loop.call_soon, loop.submit, lambda task: loop.call_later(0.0, task)):
        with caplog.at_level(logging.ERROR, "gazelle.ros"):
            ask(lambda: 1 / 0)
            done = threading.Event()
            ask(done.set)
            assert done.wait(60)
    until(lambda: caplog.text.count("ZeroDivisionError") == 3)  # by a worker beside the last one's


# Workers -----------------------------------------------------------------------------------


def test_many_short_tasks_need_few_workers(loop):
    done = []
    for _ in range(500):
        loop.submit(lambda: done.append(1))
    until(lambda: len(done) == 500)
    # Two or three; each one that is scheduled late counts as one that blocks, so some more.
    assert len(workers()) <= 50


def test_tasks_that_block_hold_up_nobody(loop):
    """However many: each gets a worker; afterwards only a few are kept."""
    before = len(workers())
    release, started = threading.Event(), []

    def block():
        started.append(1)
        release.wait(120)

    for _ in range(40):
        loop.submit(block)
    until(lambda: len(started) == 40)
    free = threading.Event()
    loop.submit(free.set)
    assert free.wait(60)
    release.set()
    until(lambda: len(workers()) <= before + thread_pool.MAX_IDLE + 1)


def test_a_task_may_wait_for_one_it_submits(loop):
    """Ten deep: nobody waits for a worker that waits."""
    deepest = threading.Event()

    def nest(depth):
        if not depth:
            deepest.set()
            return
        inner = threading.Event()
        loop.submit(lambda: (nest(depth - 1), inner.set()))
        assert inner.wait(60)

    loop.submit(lambda: nest(10))
    assert deepest.wait(60)


def test_stopping_ends_all_threads_and_runs_what_workers_asked_for():
    loop = EventLoop()
    here, there = socket.socketpair()
    loop.run(lambda: loop.watch(here, READ, lambda _events: None))
    loop.submit(lambda: (time.sleep(0.1), loop.call_soon(lambda: loop.close(here))))
    time.sleep(0.02)
    loop.stop(60.0)
    assert here.fileno() == -1
    assert not loop._thread.is_alive()
    there.close()
    loop.submit(print)
    loop.call_soon(print)


def test_without_eventfd_the_pool_works_too(monkeypatch):
    monkeypatch.delattr(os, "eventfd", raising=False)
    loop = EventLoop()
    done = []
    for number in range(100):
        loop.submit(lambda number=number: done.append(number))
    until(lambda: len(done) == 100)
    loop.stop()


def test_the_loop_of_a_process_is_shared_and_ends_with_its_last_user():
    first, second = loops.acquire(), loops.acquire()
    assert first is second
    loops.release(first)
    assert second.run(lambda: 1) == 1
    loops.release(second)
    third = loops.acquire()
    assert third is not first or third.run(lambda: 1) == 1
    loops.release(third)


# Queues ------------------------------------------------------------------------------------


def test_a_serial_queue_keeps_the_order_whoever_posts(loop):
    seen, most = [], []
    inside = threading.Lock()

    def handle(item):
        most.append(inside.acquire(blocking=False))
        seen.append(item)
        if most[-1]:
            inside.release()

    queue = SerialQueue(loop, handle, "numbers")

    def post(who):
        for number in range(2000):
            queue.post((who, number))

    threads = [threading.Thread(target=post, args=(who,)) for who in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    until(lambda: len(seen) == 8000)
    assert all(most)
    for who in range(4):
        assert [number for owner, number in seen if owner == who] == list(range(2000))


def test_items_are_handled_here_if_nobody_is_at_it(loop):
    where, gate = [], threading.Event()

    def handle(item):
        where.append((item, threading.get_ident(), queue.runs_here()))
        if item == "slow":
            gate.wait(120)

    queue = SerialQueue(loop, handle, "items")
    assert queue.handle_all(["a", "b"]) is True
    assert where == [(name, threading.get_ident(), True) for name in "ab"]
    queue.post("slow")
    until(lambda: len(where) == 3)
    assert queue.handle_all(["c"]) is True
    assert len(where) == 3
    assert not queue.post_all(["d"])
    gate.set()
    until(lambda: len(where) == 5)
    assert [name for name, *_ in where] == ["a", "b", "slow", "c", "d"]
    assert where[-1][1] != threading.get_ident()


def test_slow_items_are_said(loop):
    queue = SerialQueue(loop, time.sleep, "naps")
    assert queue.handle_all([0.05]) is False
    # One that has to wait for a processor is slow, too.
    assert any(queue.handle_all([0.0]) for _ in range(20))


@pytest.mark.skipif(not hasattr(os, "eventfd"), reason="Linux has eventfd")
@pytest.mark.filterwarnings("error::pytest.PytestUnraisableExceptionWarning")
def test_a_queue_interrupted_while_it_is_made_goes_quietly(monkeypatch):
    def interrupted(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "eventfd", interrupted)
    with pytest.raises(KeyboardInterrupt):
        thread_pool.EventTaskQueue()
    gc.collect()
