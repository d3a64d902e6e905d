"""A lock that threads hold in the order in which they ask for it."""

import signal
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from types import SimpleNamespace

import pytest

from gazelle.native import BUILD
from gazelle.native.fair_lock import FairLock, locked


def asking(lock, work):
    """Return a thread that does work with the lock, once it waits for it."""
    before = len(lock.waiting)

    def ask():
        with lock:
            work()

    thread = threading.Thread(target=ask)
    thread.start()
    while len(lock.waiting) == before:
        time.sleep(0.001)
    return thread


def test_each_thread_holds_it_in_turn_and_as_often_as_it_likes():
    lock, order = FairLock(), []

    def note(number):
        with lock:
            order.append((number, lock.is_owner()))

    with lock:
        threads = [asking(lock, lambda n=n: note(n)) for n in range(4)]
        assert order == []
        assert lock.is_owner()
    for thread in threads:
        thread.join()
    assert order == [(n, True) for n in range(4)]
    assert not lock.is_owner()
    assert lock.owner == 0


def test_who_lends_it_has_it_back_before_those_that_come_later():
    lock, order, late = FairLock(), [], []

    def first():
        order.append("first")
        late.append(asking(lock, lambda: order.append("late")))

    with lock:
        threads = [asking(lock, first), asking(lock, lambda: order.append("second"))]
        lock.yield_lock()
        assert lock.is_owner()
        order.append("owner")
    for thread in threads + late:
        thread.join()
    assert order == ["first", "second", "owner", "late"]


def test_who_holds_it_twice_does_not_lend_it():
    lock, order = FairLock(), []
    with lock:
        with lock:
            thread = asking(lock, lambda: order.append("other"))
            lock.yield_lock()
            order.append("owner")
        lock.yield_lock()
        order.append("again")
    thread.join()
    assert order == ["owner", "other", "again"]


@pytest.mark.parametrize("lends", [False, True])
def test_threads_in_loops_all_make_progress(lends):
    """They ask again at once, and go on until each has had many turns."""
    counts, lock = [0] * 6, FairLock()

    def loop(number):
        while min(counts) < 300:
            with lock:
                counts[number] += 1
                if lends and number == 0:
                    lock.yield_lock()

    with ThreadPoolExecutor(len(counts)) as pool:
        list(pool.map(loop, range(len(counts))))
    assert lock.owner == 0
    assert not lock.waiting


def test_no_two_threads_hold_it_at_once():
    lock, count = FairLock(), [0]

    def work(_):
        for _ in range(300):
            with lock:
                count[0], before = -1, count[0]
                count[0] = before + 1
                if before % 7 == 0:
                    lock.yield_lock()

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(work, range(12)))
    assert count[0] == 12 * 300


def test_an_error_of_who_holds_it_gives_it_up():
    lock, threads = FairLock(), []

    def fail():
        with lock:
            threads.append(asking(lock, lambda: None))
            _ = 1 / 0

    with pytest.raises(ZeroDivisionError):
        fail()
    threads[0].join()
    assert lock.owner == 0


def test_an_error_of_who_borrows_it_gives_it_back():
    lock, errors = FairLock(), []

    def ask():
        with pytest.raises(ZeroDivisionError), lock:
            errors.append(1 / 0)

    with lock:
        thread = threading.Thread(target=ask)
        thread.start()
        while not lock.waiting:
            time.sleep(0.001)
        lock.yield_lock()
        assert lock.is_owner()
    thread.join()
    assert errors == []


def test_only_who_holds_it_releases_it():
    lock = FairLock()
    with pytest.raises(RuntimeError, match="does not hold it"):
        lock.release()
    with lock:
        answer = ThreadPoolExecutor(1).submit(lock.release)
        with pytest.raises(RuntimeError, match="does not hold it"):
            answer.result()
        assert lock.is_owner()


def test_work_is_done_at_once_by_the_owner_and_else_by_whoever_holds_the_lock():
    lock, done = FairLock(), []
    lock.submit(lambda: done.append("free"))
    with lock:
        lock.submit(lambda: done.append("owner"))
        other = threading.Thread(target=lambda: lock.submit(lambda: done.append("other")))
        other.start()
        other.join()
        assert done == ["free", "owner"]
        lock.yield_lock()
        assert done == ["free", "owner", "other"]


class Watched(FairLock):
    """Ends the waiting of all at once."""

    def watch(self):
        def check(owner):
            raise TimeoutError(owner)

        return check


def test_who_gives_up_waiting_leaves_the_queue():
    lock = Watched()
    with lock:
        waits = [ThreadPoolExecutor(1).submit(lock.acquire) for _ in range(3)]
        for wait in waits:
            with pytest.raises(TimeoutError):
                wait.result()
        assert not lock.waiting
    assert lock.owner == 0


def test_who_lends_it_to_one_that_keeps_it_gives_up_without_it():
    lock, keep = Watched(), threading.Event()
    with lock:
        thread = asking(lock, keep.wait)
        lock.acquire()
        lock.release()
        with pytest.raises(TimeoutError):
            lock.yield_lock()
        assert not lock.is_owner()
        keep.set()
        thread.join()
        lock.acquire()  # for the end of this block
    assert lock.owner == 0


@pytest.fixture
def interrupts():
    """Yield a function that raises KeyboardInterrupt in the main thread, at most once a call."""
    state = SimpleNamespace(armed=False)

    def interrupt(_signal, _frame):
        if state.armed:
            state.armed = False
            raise KeyboardInterrupt

    def send():
        signal.pthread_kill(threading.main_thread().ident, signal.SIGINT)

    state.send = send
    before = signal.signal(signal.SIGINT, interrupt)
    yield state
    signal.signal(signal.SIGINT, before)


def test_an_interrupt_ends_the_waiting_and_leaves_the_queue(interrupts):
    lock, held, keep = FairLock(), threading.Event(), threading.Event()

    def hold():
        with lock:
            held.set()
            while not lock.waiting:  # which is inside the block that expects it
                time.sleep(0.001)
            interrupts.send()
            keep.wait()

    holder = threading.Thread(target=hold)
    holder.start()
    held.wait()
    interrupts.armed = True
    with pytest.raises(KeyboardInterrupt):
        lock.acquire()
    assert not lock.waiting
    assert not lock.is_owner()
    keep.set()
    holder.join()
    with lock:
        pass
    assert lock.owner == 0


def test_an_interrupt_of_who_lends_it_is_raised_when_the_lock_is_back(interrupts):
    lock, order = FairLock(), []

    def hold():
        interrupts.send()
        while interrupts.armed:  # until the main thread has got it
            time.sleep(0.001)
        order.append("given back")

    def yield_lock():
        with lock:
            threads.append(asking(lock, hold))
            interrupts.armed = True
            try:
                lock.yield_lock()
            finally:
                order.append(lock.is_owner())

    threads = []
    with pytest.raises(KeyboardInterrupt):
        yield_lock()
    assert order == ["given back", True]
    threads[0].join()
    assert lock.owner == 0


@pytest.mark.skipif(BUILD == "python", reason="only compiled code has no signals between its lines")
def test_no_interrupt_leaves_the_lock_with_a_thread_that_does_not_know_it(interrupts):
    lock, done, caught = FairLock(), threading.Event(), 0

    def disturb():
        while not done.is_set():
            time.sleep(0.0002)
            interrupts.send()

    def ask():
        while not done.is_set():
            with lock:
                pass

    threads = [threading.Thread(target=each) for each in (disturb, ask)]
    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-4)
    for thread in threads:
        thread.start()
    try:
        while caught < 100:
            with suppress(KeyboardInterrupt):
                interrupts.armed = True
                while True:
                    with lock:
                        pass
            caught += 1
            assert not lock.is_owner()
    finally:
        sys.setswitchinterval(interval)
        done.set()
        for thread in threads:
            thread.join()
    assert lock.owner == 0
    assert not lock.waiting


class Kept:
    """Has a lock, and methods of both kinds that hold it."""

    def __init__(self, lock):
        self._lock = lock

    @locked
    def owner(self):
        """Return who holds the lock."""
        return self._lock and self._lock.owner

    @locked
    def nested(self, first, *, second=0):
        """Return who holds the lock, and the arguments."""
        return self.owner(), first, second

    @locked
    def fail(self):
        """Raise an error."""
        raise LookupError


def test_a_locked_method_holds_the_lock_and_gives_it_up():
    kept = Kept(FairLock())
    me = threading.get_ident()
    assert kept.owner() == me
    assert kept.nested(1, second=2) == (me, 1, 2)
    with pytest.raises(LookupError):
        kept.fail()
    with kept._lock:
        assert kept.nested(3) == (me, 3, 0)
    assert kept._lock.owner == 0
    assert Kept(None).nested(1) == (None, 1, 0)
    assert Kept.owner.__doc__ == "Return who holds the lock."


@pytest.mark.parametrize("call", [Kept.owner, lambda kept: kept.nested(1)])
def test_a_locked_method_waits_for_its_turn(call):
    kept, found = Kept(FairLock()), []
    with kept._lock:
        other = threading.Thread(target=lambda: found.append(call(kept)))
        other.start()
        while not kept._lock.waiting:
            time.sleep(0.001)
        assert not found
    other.join()
    assert found


@pytest.mark.parametrize("call", [Kept.owner, lambda kept: kept.nested(1)])
def test_a_locked_method_is_refused_by_a_closed_lock(call):
    class Refusing(FairLock):
        def refuse(self):
            raise LookupError

    kept = Kept(Refusing())
    kept._lock.closed = True
    with pytest.raises(LookupError):
        call(kept)
    assert kept._lock.owner == 0


def test_a_locked_method_needs_its_object():
    with pytest.raises(TypeError, match="self"):
        Kept.owner()
